#!/usr/bin/env node
// SPDX-License-Identifier: MIT
//
// Starts the program that the package of this platform has brought along, or
// the one that BTCHECK_BINARY names.
'use strict';

const { spawn } = require('node:child_process');
const { isatty } = require('node:tty');
const { optionalDependencies } = require('../package.json');

function refuse(message, help) {
  console.error(`error: ${message}\n  = help: ${help}`);
  process.exit(2);
}

function findProgram() {
  if (process.env.BTCHECK_BINARY) return process.env.BTCHECK_BINARY;
  const platform = `${process.platform}-${process.arch}`;
  const name = `@btcheck/${platform}`;
  if (!(name in optionalDependencies)) {
    refuse(`there is no btcheck for ${platform} on npm`,
      'build one from its sources, and name it by the variable BTCHECK_BINARY');
  }
  try {
    return require.resolve(`${name}/bin/btcheck`);
  } catch {
    return refuse(`the package ${name} is not installed`,
      'install btcheck again, on this machine and without --omit=optional');
  }
}

const program = findProgram();
const child = spawn(program, process.argv.slice(2), { stdio: 'inherit' });

// Ctrl-C on a terminal reaches the program by itself; twice would end it at
// once, without the results that are known.
const signals = ['SIGINT', 'SIGTERM', 'SIGHUP', 'SIGXCPU'];
const hasTerminal = [0, 1, 2].some((file) => isatty(file));
for (const signal of signals) {
  process.on(signal, () => {
    if (signal !== 'SIGINT' || !hasTerminal) child.kill(signal);
  });
}
child.on('error', (fault) => {
  refuse(`cannot run ${program}: ${fault.message}`,
    'see whether the variable BTCHECK_BINARY names a program for this machine');
});
child.on('exit', (code, signal) => {
  if (signal === null) process.exit(code);
  for (const each of signals) process.removeAllListeners(each);
  process.kill(process.pid, signal);
});
