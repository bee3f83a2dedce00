// SPDX-License-Identifier: MIT
//
// Validates SARIF reports of the program against the schema of SARIF 2.1.0.
//
// script/test installs what package.json names and runs
//
//   node tests/formats/sarif_schema.mjs build/release/btcheck build/formats
//
// The schema is the one that the package sarif-matcher-utils comes with
// (2.1.0-rtm.5, JSON Schema draft 4). Checked are the examples and every case
// of tests/regress whose files make a report, those that cannot be read
// included.
import { spawnSync } from 'node:child_process';
import { existsSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const kPackage = '@microsoft/sarif-matcher-utils';
const kSchema = `${kPackage}/lib/schemas/sarif-2.1.0-rtm.5.json`;

const [program, modules] = process.argv.slice(2).map((word) => resolve(word));
if (!modules) {
  console.error('usage: node sarif_schema.mjs BTCHECK FOLDER_OF_NODE_MODULES');
  process.exit(2);
}
const tests = dirname(dirname(fileURLToPath(import.meta.url)));
const require = createRequire(join(modules, 'node_modules', 'index.js'));
const Ajv = require('ajv-draft-04').default ?? require('ajv-draft-04');
const addFormats = require('ajv-formats').default ?? require('ajv-formats');
const schema = require(kSchema);
// A pattern of the schema is no regular expression of Unicode mode.
const ajv = new Ajv({ allErrors: true, strict: false, unicodeRegExp: false });
addFormats(ajv);
const isValid = ajv.compile(schema);
if (isValid({ version: '2.1.0' })) throw new Error('anything is valid');

// Folders with the words that check something in them.
function commands() {
  const examples = join(dirname(tests), 'examples');
  const found = readdirSync(examples)
    .filter((name) => name.endsWith('.btf') && !name.startsWith('nav2'))
    .flatMap((name) => {
      const rules = readdirSync(examples).filter(
        (other) => other === name.replace('.btf', '.ltl'));
      return [[examples, [name]],
        ...rules.map((other) => [examples, [name, '--prop', other]])];
    });
  found.push([examples, ['drone3.btf', '--prop', 'demo.ltl']]);
  found.push([examples, ['drone3.btf', '--max-states', '1']]);
  const regress = join(tests, 'regress');
  for (const entry of readdirSync(regress, { withFileTypes: true })) {
    const folder = join(regress, entry.name);
    if (!entry.isDirectory() || !existsSync(join(folder, 'tree.btf'))) continue;
    const rules = readdirSync(folder).filter((name) => name.endsWith('.ltl'));
    const few = ['tree.btf', '--max-states', '500000'];
    found.push([folder, few]);
    for (const name of rules) found.push([folder, [...few, '--prop', name]]);
  }
  found.push([examples, ['there_is_no_such.btf']]);
  return found;
}

let reports = 0;
let results = 0;
let flows = 0;
let failures = 0;
for (const [folder, words] of commands()) {
  const run = spawnSync(
    program,
    ['-q', '--format', 'sarif', ...words],
    { cwd: folder, encoding: 'utf8', maxBuffer: 1 << 28 });
  const name = `${folder}: ${words.join(' ')}`;
  let report;
  try {
    report = JSON.parse(run.stdout);
  } catch (error) {
    console.error(`${name}: exit code ${run.status}, ${error.message}`);
    ++failures;
    continue;
  }
  ++reports;
  const { version, informationUri } = report.runs[0].tool.driver;
  if (!version || !URL.canParse(informationUri)) {
    console.error(`${name}: which version of what is this?`);
    ++failures;
  }
  for (const result of report.runs[0].results) {
    ++results;
    flows += result.codeFlows ? 1 : 0;
  }
  if (isValid(report)) continue;
  ++failures;
  console.error(name);
  for (const error of isValid.errors.slice(0, 10)) {
    console.error(`  ${error.instancePath} ${error.message}`);
  }
}
console.log(`${reports} reports with ${results} results, ${flows} of them with ` +
  `a run, held against SARIF ${schema.title.match(/2\.1\.0\S*/)[0]}: ` +
  `${failures} failures`);
process.exit(failures > 0 || results === 0 || flows === 0 ? 1 : 0);
