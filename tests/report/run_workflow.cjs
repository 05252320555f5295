// SPDX-License-Identifier: BSD-3-Clause
// node run_workflow.cjs FILE SOURCE FOLDER RUNS: does what the one job of a GitHub workflow or of a GitLab file says, RUNS times, in FOLDER,
// as docs.github.com ("Workflow syntax", the READMEs of the actions) and docs.gitlab.com ("CI/CD YAML syntax reference") have it: a fresh copy of SOURCE each
// time, a cache that lasts, steps that are left out behind one that failed. Prints an array of runs, each an array of steps. What is not known here is refused.
const {spawnSync} = require('child_process');
const fs = require('fs');
const path = require('path');
const YAML = require('yaml');

function refuse(what) { throw new Error(`not known here: ${what}`); }

function only(object, keys) {
  for (const key of Object.keys(object || {})) if (!keys.includes(key)) refuse(key);
  return object || {};
}

/** Steps of either service: what is run, put into the cache or taken from it, or handed over. */
function githubSteps(job, run) {
  only(job, ['runs-on', 'container', 'steps']);
  const fill = (text) => text.replace(/\$\{\{ *(.*?) *\}\}/g, (_, name) => (name === 'github.run_id' ? run : refuse(name)));
  return job.steps.map((step) => {
    only(step, ['name', 'if', 'run', 'uses', 'with']);
    if (step.if !== undefined && step.if !== 'always()') refuse(step.if);
    const always = step.if === 'always()';
    if (step.run) return {always, run: fill(step.run)};
    const [action] = step.uses.split('@');
    const given = only(step.with, {'actions/checkout': [], 'actions/cache/restore': ['path', 'key', 'restore-keys'], 'actions/cache/save': ['path', 'key'],
      'actions/upload-artifact': ['name', 'path'], 'github/codeql-action/upload-sarif': ['sarif_file']}[action] || refuse(action));
    const key = fill(given.key || '');
    if (action === 'actions/checkout') return {always, checkout: true};
    if (action === 'actions/cache/restore') return {always, restore: given.path, keys: [key, ...(given['restore-keys'] || '').split('\n').filter(Boolean)]};
    if (action === 'actions/cache/save') return {always, save: given.path, key};
    return {always, hand: given.path || given.sarif_file};
  });
}

function gitlabSteps(job) {
  only(job, ['rules', 'script', 'cache', 'artifacts']);
  const {key, when, paths = []} = only(job.cache, ['key', 'when', 'paths']);
  const {paths: files = [], when: handed, reports} = only(job.artifacts, ['when', 'paths', 'reports']);
  const report = only(reports, ['junit']).junit;
  return [{checkout: true}, ...paths.map((restore) => ({restore, keys: [key]})), ...job.script.map((run) => ({run})),
    ...paths.map((save) => ({always: when === 'always', save, key})),
    // Reports are handed over whatever came before.
    ...files.map((hand) => ({always: handed === 'always', hand})), ...(report ? [{always: true, hand: report}] : [])];
}

function perform(step, work, source, store) {
  const copy = (from, to) => fs.cpSync(from, to, {recursive: true});
  if (step.checkout) copy(source, work);
  if (step.restore) {
    const kept = fs.existsSync(store) ? fs.readdirSync(store).sort().reverse() : [];
    const found = step.keys.flatMap((key, i) => kept.filter((name) => (i === 0 ? name === key : name.startsWith(key))))[0];
    if (found) copy(path.join(store, found), path.join(work, step.restore));
    return {exit_code: 0, found: found || null};
  }
  if (step.save) copy(path.join(work, step.save), path.join(store, step.key));
  if (step.hand) return {exit_code: fs.existsSync(path.join(work, step.hand)) ? 0 : 1};
  if (!step.run) return {exit_code: 0};
  const said = spawnSync('bash', ['-e', '-c', step.run], {cwd: work, encoding: 'utf8'});
  return {exit_code: said.status, out: said.stdout, err: said.stderr};
}

const [file, source, folder, runs] = process.argv.slice(2);
const text = YAML.parse(fs.readFileSync(file, 'utf8'));
const jobs = Object.values(text.jobs || text);
if (jobs.length !== 1) refuse('more than one job');
const done = [];
for (let run = 1; run <= Number(runs); ++run) {
  const work = path.join(folder, 'checkout');  // The same place each time.
  fs.rmSync(work, {recursive: true, force: true});
  fs.mkdirSync(work, {recursive: true});
  let failed = false;
  done.push((text.jobs ? githubSteps(jobs[0], String(run)) : gitlabSteps(jobs[0])).map((step) => {
    if (failed && !step.always) return {...step, left_out: true};
    const result = perform(step, work, source, path.join(folder, 'store'));
    failed = failed || result.exit_code !== 0;
    return {...step, ...result};
  }));
}
console.log(JSON.stringify(done));
