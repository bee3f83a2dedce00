// SPDX-License-Identifier: MIT
//
// Reads MCAP recordings of the program with the format's own library, and
// compares each with the ITF file of the same run, state by state.
//
// script/test installs what package.json names and runs
//
//   node tests/formats/mcap_core.mjs build/release/btcheck build/formats
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [program, modules] = process.argv.slice(2).map((word) => resolve(word));
if (!modules) {
  console.error('usage: node mcap_core.mjs BTCHECK FOLDER_OF_NODE_MODULES');
  process.exit(2);
}
const require = createRequire(join(modules, 'node_modules', 'index.js'));
const { McapStreamReader } = require('@mcap/core');
const examples = join(
  dirname(dirname(dirname(fileURLToPath(import.meta.url)))), 'examples');
const decoder = new TextDecoder('utf-8', { fatal: true });

function check(holds, what) {
  if (!holds) throw new Error(what);
}

function runProgram(words) {
  const run = spawnSync(program, words, { cwd: examples, encoding: 'utf8' });
  check(run.status === 0 || run.status === 1,
    `${words.join(' ')}: exit code ${run.status}\n${run.stderr}`);
}

// The records of a file; the reader throws at whatever is wrong with it.
function recordsOf(file) {
  const reader = new McapStreamReader({ validateCrcs: true });
  reader.append(readFileSync(file));
  const records = [];
  for (let record; (record = reader.nextRecord());) records.push(record);
  check(reader.done(), 'the recording does not end');
  check(reader.bytesRemaining() === 0, 'bytes follow the recording');
  return records;
}

// Topics with what was said on them last, at each step.
function stepsOf(records) {
  const topics = new Map();
  const steps = [];
  let last = {};
  for (const record of records) {
    if (record.type === 'Channel') {
      check(record.messageEncoding === 'json', 'a channel without JSON');
      topics.set(record.id, record.topic);
    }
    if (record.type !== 'Message') continue;
    const topic = topics.get(record.channelId);
    check(record.logTime === record.publishTime, 'two times of one message');
    if (topic === '/step') steps.push((last = { ...last }));
    last[topic] = JSON.parse(decoder.decode(record.data));
  }
  return steps;
}

function plain(name) {
  return name.replace(/[^A-Za-z0-9_-]/gu, '_');
}

function compare(run, records) {
  const types = new Set(records.map((record) => record.type));
  for (const type of ['Header', 'Schema', 'Channel', 'DataEnd', 'Footer']) {
    check(types.has(type), `no ${type}`);
  }
  const about = records.find((record) => record.type === 'Metadata');
  check(about.metadata.get('verdict') === run['#meta'].verdict, 'verdict');
  const steps = stepsOf(records);
  const looped = run.loop === undefined ? 0 : run.states.length - run.loop;
  check(steps.length === run.states.length + looped,
    `${steps.length} steps of ${run.states.length} states`);
  let compared = 0;
  for (const step of steps) {
    const state = run.states[step['/step'].state];
    for (const node of run['#meta'].nodes) {
      const topic = `/bt/${node.id}_${plain(node.type)}_${plain(node.name)}`;
      check(step[topic].status === state.phase[node.key],
        `${topic} in state ${step['/step'].state}`);
      ++compared;
    }
    for (const [name, value] of Object.entries(state.variables)) {
      check(step[`/variables/${plain(name)}`].value === value, name);
    }
  }
  return compared;
}

const folder = mkdtempSync(join(tmpdir(), 'btcheck-'));
let compared = 0;
let recordings = 0;
try {
  runProgram(['drone3.btf', '--prop', 'demo.ltl', '--trace-dir', folder]);
  runProgram(['mars_rover.btf', '--prop', 'mars_rover.ltl', '--trace-dir',
    folder]);
  for (const name of readdirSync(folder)) {
    if (!name.endsWith('.itf.json')) continue;
    const itf = join(folder, name);
    const mcap = join(folder, `${name}.mcap`);
    runProgram(['trace', itf, '--to', 'mcap', '-o', mcap]);
    try {
      compared += compare(JSON.parse(readFileSync(itf, 'utf8')),
        recordsOf(mcap));
    } catch (error) {
      error.message = `${name}: ${error.message}`;
      throw error;
    }
    ++recordings;
  }
  check(recordings > 0, 'no run was written');
} finally {
  rmSync(folder, { recursive: true });
}
console.log(`${recordings} recordings read by @mcap/core, ` +
  `${compared} phases compared: all equal`);
