// SPDX-License-Identifier: MIT
//
// An agent's work with the official client of the Model Context Protocol:
// mends the planted bugs of tests/findings by nothing but the tools of
// `btcheck mcp`, and checks each text that it got.
//
// script/test installs what tests/formats/package.json names and runs
//
//   node tests/serve/mcp_client.mjs build/release/btcheck build/formats
import { readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const [program, modules] = process.argv.slice(2).map((word) => resolve(word));
if (!modules) {
  console.error('usage: node mcp_client.mjs BTCHECK FOLDER_OF_NODE_MODULES');
  process.exit(2);
}
const require = createRequire(join(modules, 'node_modules', 'index.js'));
const load = (name) => import(
  pathToFileURL(require.resolve(`@modelcontextprotocol/sdk/${name}`)));
const { Client } = await load('client/index.js');
const { StdioClientTransport } = await load('client/stdio.js');
const here = dirname(fileURLToPath(import.meta.url));
const findings = join(dirname(here), 'findings');

function check(holds, what) {
  if (!holds) throw new Error(what);
}

const client = new Client({ name: 'mcp_client', version: '1' });
await client.connect(new StdioClientTransport(
  { command: program, args: ['mcp'], cwd: findings }));

async function call(name, args) {
  const answer = await client.callTool({ name, arguments: args });
  check(!answer.isError, `${name}: ${answer.content?.[0]?.text}`);
  return answer.structuredContent;
}

const { tools } = await client.listTools();
check(tools.length === 6 && tools.every((tool) => tool.description),
  'not all tools are listed');
const { resources } = await client.listResources();
const { contents } = await client.readResource({ uri: resources[0].uri });
check(contents[0].text === readFileSync(
  join(dirname(dirname(here)), 'docs', 'findings.md'), 'utf8'),
  'a document is not what it is');

let trees = 0;
let proposed = 0;
let mended = 0;
for (const tree of readdirSync(findings).sort()) {
  if (!/-bug\.(xml|btf)$/.test(tree)) continue;
  trees += 1;
  const before = await call('check_tree', { tree });
  const finding = before.findings.find((each) => each.has_repair);
  if (!finding) continue;
  proposed += 1;
  const named = { tree, finding: finding.finding };
  await call('propose_repair', named);
  const { files } = await call('apply_repair', named);
  const texts = Object.fromEntries(
    files.map(({ file, text }) => [file, text]));
  check(Object.entries(texts).every(
    ([file, text]) => text !== readFileSync(join(findings, file), 'utf8')),
  `${tree}: nothing was changed`);
  const after = await call('check_tree', { tree, files: texts });
  const stays = (list) => list.filter(
    ({ code, node }) => code === finding.code && node === finding.node).length;
  const known = new Set(before.findings.map(({ code }) => code));
  if (stays(after.findings) < stays(before.findings) &&
      after.findings.every(
        ({ code, level }) => level === 'question' || known.has(code))) {
    mended += 1;
  } else {
    console.log(`${tree}: ${finding.finding} is not mended`);
  }
}
await client.close();
console.log(`MCP: ${trees} planted bugs, ${proposed} with a repair, ` +
  `${mended} of them mended by the tools alone`);
check(proposed > 0 && 2 * mended >= proposed, 'fewer than half are mended');
