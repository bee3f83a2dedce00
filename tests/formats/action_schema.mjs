// SPDX-License-Identifier: MIT
//
// Holds action/action.yml, the workflows of docs/ci.md and the recipe of
// contrib/clusters against the schemas of GitHub's actions and workflows, which
// the package @action-validator/core comes with.
//
//   node tests/formats/action_schema.mjs FOLDER_OF_NODE_MODULES
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [modules] = process.argv.slice(2).map((word) => resolve(word));
if (!modules) {
  console.error('usage: node action_schema.mjs FOLDER_OF_NODE_MODULES');
  process.exit(2);
}
const root = dirname(dirname(dirname(fileURLToPath(import.meta.url))));
const require = createRequire(join(modules, 'node_modules', 'index.js'));
const { validateAction, validateWorkflow } = require('@action-validator/core');
const text = (name) => readFileSync(join(root, name), 'utf8');

let faults = 0;
function hold(what, { errors }) {
  for (const error of errors) {
    console.error(`${what}: ${JSON.stringify(error)}`);
    ++faults;
  }
}

const action = text('action/action.yml');
const broken = [action.replace('using: composite', 'using: compost'),
  action.replace('  name:\n    description:', '  name:\n    describes:'),
  action.replace("run: '\"$GITHUB_ACTION_PATH/run\" find'", 'runs: find')];
for (const each of broken) {
  if (each === action) throw new Error('nothing was broken');
  if (validateAction(each).errors.length === 0) throw new Error('anything is valid');
}
hold('action/action.yml', validateAction(action));
const workflows = text('docs/ci.md').match(/^```yaml\n(name: [^]*?)^```$/gm)
  .map((block) => block.slice('```yaml\n'.length, -'```'.length));
if (workflows.length === 0) throw new Error('docs/ci.md has no workflow');
workflows.forEach((each, i) => hold(`docs/ci.md, ${i + 1}`, validateWorkflow(each)));
const recipe = 'contrib/clusters/github-actions.yml';
hold(recipe, validateWorkflow(text(recipe)));
console.log(`an action, ${workflows.length + 1} workflows, ${faults} faults`);
process.exit(faults ? 1 : 0);
