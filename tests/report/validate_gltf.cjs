// SPDX-License-Identifier: BSD-3-Clause
// node validate_gltf.cjs FILE: what the Khronos validator says, as JSON; exit code 1 for an error or a warning.
const fs = require('fs');
const validator = require('gltf-validator');

validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2]))).then((report) => {
  console.log(JSON.stringify(report.issues, null, 1));
  process.exitCode = report.issues.numErrors + report.issues.numWarnings > 0 ? 1 : 0;
});
