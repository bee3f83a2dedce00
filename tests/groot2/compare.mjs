// SPDX-License-Identifier: MIT
//
// `btcheck watch` beside a robot that really runs: script/compare-groot2.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync }
  from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { setTimeout as rest } from "node:timers/promises";

import { Browser } from "../viewer/browser.mjs";

const [publisher, btcheck, browserProgram, seconds, picture] =
  process.argv.slice(2);
const folder = mkdtempSync(path.join(tmpdir(), "btcheck-groot2-"));
const file = (name) => path.join(folder, name);
let port = 21700;

// A program, its lines with the time at which each came, and its end.
function started(program, words) {
  const child = spawn(program, words, { stdio: ["pipe", "pipe", "pipe"] });
  const run = { child, out: "", told: "", lines: [] };
  child.stdout.on("data", (data) => {
    run.out += data;
    for (const line of String(data).split("\n")) {
      run.lines.push({ line, time: Date.now() });
    }
  });
  child.stderr.on("data", (data) => { run.told += data; });
  run.ended = new Promise((done) => child.on("exit", done));
  return run;
}

async function until(what, holds) {
  for (let i = 0; i < 2000; ++i) {
    if (await holds()) return;
    await rest(20);
  }
  assert.fail(`never: ${what}`);
}

function logOf(name) {
  const bytes = readFileSync(file(name));
  const begin = 23 + bytes.readUInt32LE(19) + 8;
  const records = [];
  for (let at = begin; at + 9 <= bytes.length; at += 9) {
    records.push(`${bytes.readUInt16LE(at + 6)}:${bytes[at + 8]}`);
  }
  return records;
}

function figures(delays) {
  const sorted = [...delays].sort((a, b) => a - b);
  return `median ${sorted[Math.floor(sorted.length / 2)]} ms, ` +
         `most ${sorted.at(-1)} ms`;
}

async function watchForLong() {
  const rules = Array.from({ length: 12 }, (_, i) =>
    `property quiet_${i}: never alarm_${i}.failure`);
  writeFileSync(file("rules.ltl"), [...rules,
    "property near: never near_0.success",
    "property order: go_3.success precedes look_3.success",
    "property counts: always not count.failure", ""].join("\n"));
  port += 2;
  const watch = started(btcheck, ["watch", `groot2://127.0.0.1:${port}`,
    "--prop", file("rules.ltl"), "--view", "-o", file("watched.btlog")]);
  await until("an address", () => /^view: (\S+)$/m.test(watch.told));
  const robot = started(publisher,
    [String(port), seconds, "62", "20", file("real.btlog")]);
  const browser = await Browser.open(browserProgram);
  const page = await browser.newPage();
  await page.resize(1280, 800, "light");
  await page.visit(/^view: (\S+)$/m.exec(watch.told)[1]);
  await until("the page of the run", () => page.evaluate(
    "Boolean(document.getElementById('rules'))").catch(() => false));
  // When the page shows each verdict.
  const observe = `window.seen ??= {}; window.look = () => {
      for (const item of document.querySelectorAll("#rules li")) {
        const found = /VIOLATED\\s*(quiet_\\d+)/.exec(item.textContent);
        if (found) window.seen[found[1]] ??= Date.now();
      }
    };
    new MutationObserver(window.look).observe(document.body,
      { childList: true, subtree: true, characterData: true });
    window.look(); true`;
  await page.evaluate(observe);
  let seen = {};
  // The page is loaded again where a chapter begins.
  const robotEnds = robot.ended.then(() => "ended");
  while (await Promise.race([robotEnds, rest(100)]) !== "ended") {
    const now = await page.evaluate("window.seen ?? null").catch(() => ({}));
    if (now === null) await page.evaluate(observe).catch(() => {});
    seen = { ...now, ...seen };
    if (picture && robot.out.split("alarm_").length === 4) {
      if (!watchForLong.isPictured) {
        watchForLong.isPictured = true;
        await rest(500);
        await page.picture(picture);
      }
    }
  }
  for (let i = 0; i < 50; ++i) {  // a page that is late is seen to be so
    await rest(200);
    seen = { ...await page.evaluate("window.seen ?? {}").catch(() => ({})),
             ...seen };
    if (Object.keys(seen).length === robot.out.split("alarm_").length - 1) break;
  }
  watch.child.kill("SIGINT");
  const code = await watch.ended;
  await browser.close();
  const failed = [...robot.out.matchAll(/^alarm_(\d+) (\d+)$/gm)].map(
    ([, number, time]) => ({ number, time: Number(time) / 1000 }));
  assert.ok(failed.length > 0, robot.out);
  const onPage = [];
  const onTerminal = [];
  for (const { number, time } of failed) {
    const line = watch.lines.find((one) =>
      one.line.startsWith("VIOLATED") && one.line.includes(`quiet_${number} `));
    assert.ok(line, `quiet_${number} is not told: ${watch.out}`);
    assert.ok(seen[`quiet_${number}`], `quiet_${number} is not on the page`);
    onTerminal.push(Math.round(line.time - time));
    onPage.push(Math.round(seen[`quiet_${number}`] - time));
  }
  const real = logOf("real.btlog");
  const watched = logOf("watched.btlog");
  console.log(/^nodes.*$/m.exec(robot.out)[0] + ", " +
              /^ticks.*$/m.exec(robot.out)[0] + `, records ${real.length}`);
  console.log(`verdicts on the terminal: ${figures(onTerminal)}`);
  console.log(`verdicts on the page: ${figures(onPage)}`);
  console.log(`recordings: ${existsSync(file("watched-2.btlog")) ? 2 : 1}, ` +
              `records ${watched.length}`);
  assert.equal(code, 1);
  assert.ok(!existsSync(file("watched-2.btlog")), watch.told);
  // The last changes of a program that ends may not be asked for any more.
  assert.ok(watched.length > real.length - 1000);
  assert.equal(watched.join(), real.slice(0, watched.length).join());
  const conforms = spawnSync(btcheck, ["conform", file("watched.btlog")],
                             { encoding: "utf8" });
  console.log(conforms.stdout.trim().split("\n").at(-1).trim());
  assert.equal(conforms.status, 0, conforms.stdout + conforms.stderr);
  if (Math.max(...onPage) > 300) console.log("a verdict was later than 0.3 s");
}

async function injectAndBreak() {
  port += 2;
  const watch = started(btcheck, ["watch", `groot2://127.0.0.1:${port}`,
    "-e", "never far_2.failure", "-e", "never far_1.failure",
    "--inject", "far_2 fails from tick 3", "--break", "go_1 from tick 2",
    "--break-for", "300", "--allow-inject", "-o", file("faulty.btlog")]);
  await rest(300);
  const robot = started(publisher, [String(port), "6", "5", "20",
                                    file("really.btlog")]);
  await robot.ended;
  watch.child.kill("SIGINT");
  const code = await watch.ended;
  assert.match(watch.told, /injected `far_2 fails from tick 3` after/);
  assert.match(watch.told, /stands at `go_1` after .*, for 300 ms/);
  assert.match(watch.out, /^VIOLATED {3}\S*.*\n.*never far_2\.failure/m);
  assert.equal(watch.told.match(/: injected `/g).length, 1);
  assert.equal(code, 1, watch.out);
  assert.match(readFileSync(file("faulty.btlog"), "latin1"),
               /on purpose: far_2 fails from tick 3; break go_1 from tick 2/);
  const faulty = logOf("faulty.btlog");
  assert.equal(faulty.join(),
               logOf("really.btlog").slice(0, faulty.length).join());
  // 300 ticks less 15 for each stop.
  const ticks = Number(/^ticks (\d+)$/m.exec(robot.out)[1]);
  console.log(`faults: ${watch.told.match(/stands at/g).length} stops, 1 ` +
              `injected, ticks ${ticks}`);
}

async function startAnew() {
  port += 2;
  const watch = started(btcheck, ["watch", `groot2://127.0.0.1:${port}`,
    "-e", "never near_0.success", "-o", file("twice.btlog")]);
  for (let i = 0; i < 2; ++i) {
    await until(`wait ${i + 1}`, () =>
      watch.told.split("waiting for it").length === i + 2);
    const robot = started(publisher, [String(port), "2", "2", "20"]);
    await robot.ended;
  }
  watch.child.kill("SIGINT");
  assert.equal(await watch.ended, 0, watch.told);
  assert.match(watch.told, /nobody answers there yet; waiting for it/);
  assert.match(watch.told, /does not answer any more, after .* s; waiting/);
  assert.match(watch.told, /the program was started anew/);
  for (const name of ["twice.btlog", "twice-2.btlog"]) {
    assert.ok(logOf(name).length > 100, name);
    assert.equal(spawnSync(btcheck, ["conform", file(name)]).status, 0, name);
  }
  console.log("started anew: 2 recordings that conform");
}

try {
  await watchForLong();
  await injectAndBreak();
  await startAnew();
} finally {
  if (!process.exitCode) rmSync(folder, { recursive: true });
}
