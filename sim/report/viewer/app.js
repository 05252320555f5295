// SPDX-License-Identifier: BSD-3-Clause
// The page: what is shown at which time, and how it is asked for.
'use strict';

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 30, 60, 120, 300];
const byId = (id) => document.getElementById(id);

class App {
  constructor(page) {
    this.page = page;
    this.run = new Run(page);
    const {clearance, units} = page.scene;
    this.seen = {times: page.column(clearance.ticks, units.ticks_per_s), values: page.column(clearance.values, units.clearance_per_mm),
      pair: page.column(clearance.pair), pairs: clearance.pairs};
    this.findings = page.result.findings.map((finding, i) => this.place(finding, page.scene.contacts[i]));
    this.nearest = this.nearestPairs();
    this.time = 0;
    this.playing = false;
    this.current = null;
    const go = {time: (t) => this.goTo(t), finding: (f) => this.goToFinding(f), line: (f, l) => this.goToLine(f, l)};
    this.view = new View(byId('canvas'), page, this.run);
    this.path = new TipPath(this.view, this.run, this.view.tools);
    this.charts = new Charts(page, this.run, this.seen, this.findings, go);
    this.list = new FindingList(page.result, this.findings, this.nearest, go);
    this.text = new ProgramText(page.scene.texts, this.findings, go);
    this.head();
    this.buttons();
    this.keyboard();
    this.theme(matchMedia('(prefers-color-scheme: dark)').matches);
    new ResizeObserver(() => this.charts.draw()).observe(byId('plot'));
    new ResizeObserver(() => { this.text.drawn = null; this.text.draw(); }).observe(byId('nc'));
    this.open();
    this.path.make(this.faulty());
    this.last = performance.now();
    requestAnimationFrame((now) => this.frame(now));
  }

  /** A finding with its instant: its own, or that of its block. */
  place(finding, points) {
    const fileIndex = Math.max(0, this.page.scene.texts.findIndex((text) => text.name === finding.file));
    let time = finding.time_s === undefined ? null : finding.time_s, moves = time !== null;
    if (time === null && finding.line > 0) {
      const step = this.run.stepOfLine(fileIndex, finding.line, -1);
      moves = step >= 0;
      time = moves ? this.run.begin[step] : this.endBefore(fileIndex, finding.line);
    }
    return {...finding, fileIndex, points, time, moves, bodies: finding.bodies || []};
  }

  /** Where a line makes no motion the machine stands as the last one before it has left it; null before the first. */
  endBefore(file, line) {
    const step = this.run.stepBefore(file, line);
    return step < 0 ? null : this.run.endOf(step);
  }

  /** Of each step: is an error told of it? One is told for a run of blocks, with the last of them. */
  faulty() {
    const faulty = new Uint8Array(this.run.begin.length);
    for (const finding of this.findings) {
      if (finding.severity !== 'error' || !finding.moves) continue;
      const first = this.run.stepAt(finding.time + 1e-6), end = finding.message.match(/the last is line (\d+)\)/);
      const last = end ? this.run.stepOfLine(finding.fileIndex, Number(end[1]), finding.time) : first;
      for (let i = first; i <= Math.max(first, last); ++i) faulty[i] = 1;
    }
    return faulty;
  }

  /** Pairs by their least clearance, as findings that may be gone to. */
  nearestPairs() {
    const pairs = this.page.result.clearances.filter((c) => c.proven_mm !== null && c.line > 0);
    return pairs.sort((a, b) => a.proven_mm - b.proven_mm).map((c) => this.placeNearest({severity: 'pass', rule: 'least clearance', file: c.file,
      line: c.line, column: 1, bodies: c.bodies,
      message: c.proven_mm < 0 ? `${c.bodies.join(' and ')}: in contact`
        : `${c.bodies.join(' and ')}: never less than ${c.proven_mm.toFixed(2)} mm` + (c.seen_mm === null ? '' : `, seen ${c.seen_mm.toFixed(2)} mm`)}, []));
  }

  /** At the instant of its block at which it was seen nearest. */
  placeNearest(pair, points) {
    const placed = this.place(pair, points), {times, values, pair: which, pairs} = this.seen;
    const name = pair.bodies.join();
    let least = Infinity;
    for (const step of (this.run.visits.get(placed.fileIndex + ':' + pair.line) || []).slice(0, 4)) {
      for (let i = lastAtMost(times, this.run.begin[step]); i < times.length && times[i] <= this.run.endOf(step) + 1e-6; ++i) {
        if (times[i] < this.run.begin[step] - 1e-6 || values[i] >= least || pairs[which[i]].join() !== name) continue;
        least = values[i];
        placed.time = times[i];
      }
    }
    return placed;
  }

  head() {
    const {result, scene} = this.page;
    byId('verdict').textContent = result.verdict;
    byId('verdict').classList.add(result.verdict);
    byId('program').textContent = result.program.split('/').pop();
    byId('program').title = result.program;
    byId('facts').textContent = byId('facts').title = `${result.model} · ${scene.summary}`;
    byId('fine').textContent = `Between keyframes no body is shown more than ${scene.units.shown_within_mm} mm from where it was. ` +
      'The clearance in the time line is what was seen at single instants, of pairs that must never touch; what is proven stands in the list.';
    for (const speed of SPEEDS) byId('speed').append(new Option(speed + '×', speed));
    byId('speed').value = this.run.end > 3600 ? 60 : this.run.end > 300 ? 10 : 1;
    byId('scrub').max = this.run.end;
  }

  /** The first error, at the moment of contact; else the nearest that anything comes. */
  open() {
    this.view.fit();
    const first = SEVERITIES.map((s) => this.findings.find((f) => f.severity === s && (f.bodies.length || s !== 'warning'))).find((f) => f) || this.nearest[0];
    if (first) this.goToFinding(first); else this.goTo(0);
  }

  goTo(time, keep = false) {
    this.time = Math.max(0, Math.min(this.run.end, time));
    if (!keep && this.current) this.leave();
    this.show(this.run.poseAt(this.time));
  }

  leave() {
    this.current = null;
    this.view.light([], []);
    this.list.mark(null);
    this.headline();
  }

  show(pose) {
    const step = this.run.stepAt(this.time), tool = this.run.tool.length ? this.run.tool[step] : 0;
    this.view.setPose(pose, tool);
    this.path.upTo(this.time);
    this.charts.playhead(this.time);
    this.charts.values(pose, tool);
    byId('scrub').value = this.time;
    byId('clock').textContent = `${timeText(this.time, this.run.end < 600 ? 1 : 0)} / ${timeText(this.run.end)}`;
    if (this.run.line.length) {
      this.text.at(this.run.file[step], this.run.line[step]);
      byId('block').textContent = `line ${this.run.line[step]} · ${this.run.kinds[this.run.kind[step]]}${tool ? ' · T' + tool : ''}`;
    }
  }

  goToFinding(finding) {
    this.play(false);
    this.current = finding;
    if (finding.time !== null) this.time = finding.time;
    const pose = this.run.poseAt(this.time);
    // A rapid may meet it on another way than the one shown: the finding's own axes are where it happens.
    for (const axis of this.run.axes) {
      if (finding.axes && axis.letter in finding.axes) pose[axis.joint] = finding.axes[axis.letter];
    }
    this.show(pose);
    if (finding.line > 0) this.text.at(finding.fileIndex, finding.line);
    this.view.light(finding.bodies, finding.points);
    this.lookAt(finding);
    this.list.mark(finding);
    this.headline();
  }

  lookAt({time, points, bodies}) {
    if (time === null && !bodies.length) return this.view.fit();
    if (points.length) return this.view.near(new THREE.Vector3(...points[0]), 700);
    const {point, size} = this.view.middleOf(bodies);
    return this.view.near(point, Math.max(bodies.length ? 700 : 1100, 1.8 * size));
  }

  goToLine(file, line) {
    const step = this.run.stepOfLine(file, line, this.time);
    const time = step >= 0 ? this.run.begin[step] : this.endBefore(file, line);
    if (time !== null) this.goTo(time);
  }

  headline() {
    const box = byId('headline'), finding = this.current;
    box.hidden = !finding;
    if (!finding) return;
    box.className = 'headline ' + finding.severity;
    const all = this.findings.filter((f) => f.severity === finding.severity), at = all.indexOf(finding) + 1;
    const rank = at ? `${finding.severity} ${at} of ${all.length}` : 'nearest';
    // In short: where it is can be seen, the axes stand below, the rest in the list.
    const short = finding.message.replace(/,? at( [A-Z]-?[\d.]+)+/, '').split(';')[0];
    const clear = finding.severity === 'pass' && this.page.result.verdict === 'pass';
    box.replaceChildren(phrase('b', '', (clear ? 'Nothing touches. Nearest: ' : '') + short), element('div', 'where', ''));
    const where = box.lastChild;
    where.append(finding.line > 0 ? `${rank} · line ${finding.line} ` : rank + ' ');
    const text = this.text.texts[finding.fileIndex];
    if (text && finding.line > 0 && text.lines[finding.line - 1]) where.append(phrase('code', '', text.lines[finding.line - 1].trim().slice(0, 80)));
    if (finding.posted_from) box.append(this.origin(finding.posted_from));
    if (finding.bodies.length === 2) {
      const lit = element('div', 'lit');
      finding.bodies.forEach((name, i) => lit.append(element('span', 'chip ' + 'ab'[i], name)));
      box.append(lit);
    }
    const more = element('button', 'more', '▾');
    more.setAttribute('aria-label', 'Whole text');
    more.setAttribute('aria-expanded', false);
    box.append(more);
  }

  /** On a narrow page the headline is short until it is tapped. */
  unfold() {
    const box = byId('headline');
    box.lastChild.setAttribute('aria-expanded', box.classList.toggle('open'));
  }

  /** The record of the cutter-location file. */
  origin({file, line}) {
    const box = element('div', 'where', `from ${file.split('/').pop()} line ${line} `);
    const text = this.text.texts.find((one) => one.name === file), record = text && text.lines[line - 1];
    if (record) box.append(element('code', '', record.trim().slice(0, 80)));
    return box;
  }

  stepFinding(way) {
    const timed = this.findings.filter((f) => f.time !== null);
    if (!timed.length) return;
    const sorted = [...timed].sort((a, b) => a.time - b.time);
    const here = this.current ? sorted.indexOf(this.current) : -1;
    if (here >= 0) return this.goToFinding(sorted[(here + way + sorted.length) % sorted.length]);
    const later = sorted.findIndex((f) => f.time > this.time);
    const next = way > 0 ? (later < 0 ? 0 : later) : (later < 0 ? sorted.length - 1 : (later - 1 + sorted.length) % sorted.length);
    this.goToFinding(sorted[next]);
  }

  stepBlock(way) {
    const step = this.run.stepAt(this.time + 1e-6) + way;
    this.goTo(step < 0 ? 0 : step < this.run.begin.length ? this.run.begin[step] : this.run.end);
  }

  play(on = !this.playing) {
    if (on && this.time >= this.run.end) this.time = 0;
    this.playing = on;
    byId('play').textContent = on ? '❚❚' : '▶';
  }

  frame(now) {
    const passed = Math.min(0.1, (now - this.last) / 1000);
    this.last = now;
    if (this.playing) {
      const time = this.time + passed * Number(byId('speed').value);
      if (time >= this.run.end) this.play(false);
      this.goTo(time);
    }
    this.view.draw();
    requestAnimationFrame((next) => this.frame(next));
  }

  theme(dark) {
    this.dark = dark;
    document.documentElement.classList.toggle('dark', dark);
    document.documentElement.style.colorScheme = dark ? 'dark' : 'light';
    this.view.theme(getComputedStyle(document.documentElement));
    this.path.paint();
    this.charts.draw();
  }

  toggle(id, on) {
    const button = byId(id), now = on === undefined ? button.getAttribute('aria-pressed') !== 'true' : on;
    button.setAttribute('aria-pressed', now);
    return now;
  }

  follow() { this.view.following = this.toggle('follow'); if (this.view.following) this.view.near(); }
  xray() { this.view.xray = this.toggle('xray'); this.view.changed = true; }
  showPath() { this.path.show(this.toggle('showpath')); }

  section(on) {
    const cutting = this.toggle('section', on);
    byId('sectionbox').hidden = !cutting;
    if (cutting) {
      this.bodyList(false);
      const point = this.current && this.current.points.length ? new THREE.Vector3(...this.current.points[0]) : this.view.tip();
      byId('cutat').value = 1000 * this.view.partAt(this.cutAxis(), point);
      this.flipped = this.view.direction()[this.cutAxis()] < 0;  // What stands before the cut goes.
    }
    this.cut();
  }

  cutAxis() { return document.querySelector('input[name=cut]:checked').value; }

  cut() {
    const on = byId('section').getAttribute('aria-pressed') === 'true';
    this.view.cut(on ? this.cutAxis() : null, byId('cutat').value / 1000, this.flipped);
  }

  bodyList(open = byId('bodylist').hidden) {
    const box = byId('bodylist');
    box.hidden = !open;
    byId('bodies').setAttribute('aria-expanded', open);
    if (!open) return;
    this.section(false);
    box.replaceChildren();
    const groups = [['Tool', (b) => b.tool > 0], ['Part and blank', (b) => b.kind === 'part' || b.kind === 'stock'],
      ['Fixtures', (b) => b.kind === 'fixture'], ['Machine', (b) => b.kind === 'machine']];
    for (const [title, belongs] of groups) {
      const keys = [...new Set(this.view.bodies.filter(belongs).map((b) => b.key))];
      if (keys.length) box.append(element('h3', '', title));
      for (const key of keys) {
        const label = element('label'), check = element('input');
        check.type = 'checkbox';
        check.checked = !this.view.hidden.has(key);
        check.addEventListener('change', () => {
          if (check.checked) this.view.hidden.delete(key); else this.view.hidden.add(key);
          this.view.changed = true;
        });
        label.append(check, ' ' + key);
        box.append(label);
      }
    }
  }

  tab(name) {
    document.body.className = 'tab-' + name;
    for (const button of document.querySelectorAll('#tabs button')) button.setAttribute('aria-selected', button.dataset.tab === name);
    this.charts.draw();
    this.text.drawn = null;
    this.text.reveal();
    this.list.mark(this.current);
  }

  buttons() {
    const on = (id, act) => byId(id).addEventListener('click', act);
    on('headline', () => this.unfold());
    on('play', () => this.play());
    on('toprev', () => this.stepFinding(-1));
    on('tonext', () => this.stepFinding(1));
    on('fit', () => this.view.fit());
    on('near', () => this.view.near());
    on('follow', () => this.follow());
    on('xray', () => this.xray());
    on('showpath', () => this.showPath());
    on('section', () => this.section());
    on('bodies', () => this.bodyList());
    on('theme', () => this.theme(!this.dark));
    on('help', () => byId('keys').showModal());
    on('cutflip', () => { this.flipped = !this.flipped; this.cut(); });
    byId('cutat').addEventListener('input', () => this.cut());
    for (const radio of document.querySelectorAll('input[name=cut]')) radio.addEventListener('change', () => this.section(true));
    byId('scrub').addEventListener('input', () => this.goTo(Number(byId('scrub').value)));
    for (const button of document.querySelectorAll('#tabs button')) button.addEventListener('click', () => this.tab(button.dataset.tab));
    this.tab('findings');
  }

  keyboard() {
    const faster = (way) => {
      const speeds = byId('speed'), next = speeds.selectedIndex + way;
      if (next >= 0 && next < speeds.length) speeds.selectedIndex = next;
    };
    const keys = {' ': () => this.play(), ArrowLeft: () => this.stepBlock(-1), ArrowRight: () => this.stepBlock(1),
      Home: () => this.goTo(0), End: () => this.goTo(this.run.end), '+': () => faster(1), '=': () => faster(1), '-': () => faster(-1),
      n: () => this.stepFinding(1), p: () => this.stepFinding(-1), 0: () => this.view.fit(), 1: () => this.view.near(),
      2: () => this.view.look(0, 0.05), 3: () => this.view.look(-Math.PI / 2, 0.05), 4: () => this.view.look(0, 1.5),
      f: () => this.follow(), x: () => this.xray(), l: () => this.showPath(), s: () => this.section(), b: () => this.bodyList(),
      t: () => this.theme(!this.dark), '?': () => byId('keys').showModal()};
    document.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || byId('keys').open) return;
      const target = event.target.tagName;
      if (target === 'SELECT' || (target === 'INPUT' && event.key.startsWith('Arrow'))) return;
      if (target === 'BUTTON' && event.key === ' ') return;
      const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
      if (!act) return;
      event.preventDefault();
      act();
    });
  }
}

async function start() {
  const begin = performance.now();
  const [three, data] = await Promise.all([unpack('three'), unpack('data')]);
  const script = document.createElement('script');
  script.textContent = new TextDecoder().decode(three);
  document.head.append(script);
  const app = new App(readPage(data));
  app.view.draw();
  byId('loading').remove();
  app.loadedIn = performance.now() - begin;
  window.ncsim = app;
}

start().catch((error) => {
  console.error(error);
  byId('loading').textContent = 'This page cannot be shown: ' + error.message;
});
