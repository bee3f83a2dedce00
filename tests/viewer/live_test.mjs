// SPDX-License-Identifier: MIT
//
// A run that goes on while the page looks at it: followed, scrubbed, ended.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { appendFileSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { setTimeout as rest } from "node:timers/promises";

import { file, go, options, page, step, text } from "./opened_page.mjs";

// btcheck with --view: its address, once it is told, and its end.
async function started(words) {
  const child = spawn(path.resolve(options.program), words,
                      { stdio: ["ignore", "pipe", "pipe"] });
  const run = { child, lines: "", told: "" };
  child.stdout.on("data", (data) => { run.lines += data; });
  run.ended = new Promise((done) => child.on("exit", done));
  run.address = await new Promise((done, fail) => {
    child.stderr.on("data", (data) => {
      run.told += data;
      const found = /^view: (\S+)$/m.exec(run.told);
      if (found) done(found[1]);
    });
    child.on("exit", () => fail(new Error(run.told)));
  });
  return run;
}

async function look(run, width = 1280, height = 800) {
  await page.resize(width, height, "light");
  await page.visit("about:blank");
  page.complaints = [];
  page.requests = [];
  await page.visit(run.address);
}

// Waits until it is so on the page.
async function until(expression) {
  for (let i = 0; i < 1200; ++i) {
    // While a page is loaded there is nothing to ask.
    const asked = `document.body?.classList.contains("ready") && ` +
                  `Boolean(${expression})`;
    if (await page.evaluate(asked).catch(() => false)) return;
    await rest(25);
  }
  assert.fail(`never: ${expression}; ${await text("live")}; ` +
              page.complaints.join());
}

const last = () => page.evaluate("Number(byId('slider').max)");
const isFollowing = () => page.evaluate(
  "byId('follow').getAttribute('aria-pressed') === 'true'");
const isLive = "byId('verdict').textContent === 'LIVE'";
const isEnded = "byId('verdict').textContent === 'ENDED'";
const tickAtLeast = (tick) => `(/tick (\\d+)/.exec(
  byId('where').textContent)?.[1] ?? 0) >= ${tick}`;

const drone = path.join(options.examples, "drone3-fixed.btf");
// A tree that runs until it is interrupted, however slow the browser is.
const endless = file("endless.btf");
writeFileSync(endless, `(defsv battery :states (Good Low) :init Good)
(BehaviorTree :name t :loop 1
  (Sequence (SetSV :ID measure :sv battery) (Condition :ID clear)
    (ParallelAll (Action :ID act) (Action :ID rest))))`);

test("a run is followed to its end, and the page keeps it", async () => {
  const kept = file("live.itf.json");
  const run = await started(["run", endless, "--seed", "7", "--tick-ms", "50",
                             "--view", "-o", kept]);
  await look(run);
  await until(isLive);
  await until(tickAtLeast(5));
  assert.ok(await isFollowing());
  assert.equal(await text("live"), "following the run");
  assert.equal(await page.evaluate("location.hash"), "");
  // The first Ctrl-C ends the run after the tick, and the page is told.
  run.child.kill("SIGINT");
  await until(isEnded);
  assert.equal(await run.ended, 3);
  assert.equal(await text("live"), "the run is over");
  assert.match(await text("remark"), /^stopped after tick \d+$/);
  assert.equal(await step(), await last());
  // All of it, as the machine's copy has it.
  const states = JSON.parse(readFileSync(kept, "utf8")).states;
  assert.equal(await last(), states.length - 1);
  for (let i = 0; i < states.length; i += 7) {
    await go(i);
    assert.deepEqual(await page.evaluate(
      `Object.fromEntries([...document.querySelectorAll(".node")].map((box) =>
         [box.dataset.key, box.dataset.phase]))`), states[i].phase);
  }
  assert.deepEqual(page.complaints, []);
  const { origin } = new URL(run.address);
  assert.deepEqual(page.requests.filter((url) =>
    !url.startsWith("data:") && !url.startsWith(origin)), []);
});

test("who scrubs back is left in peace, and may follow again", async () => {
  const run = await started(["run", endless, "--seed", "7", "--tick-ms", "40",
                             "--view"]);
  await look(run);
  await until(tickAtLeast(3));
  await go(4);
  const before = await last();
  const seen = await text("sentence");
  await until(`Number(byId('slider').max) > ${before + 40}`);
  assert.equal(await step(), 4);
  assert.equal(await text("sentence"), seen);
  assert.ok(!await isFollowing());
  assert.match(await text("live"), /^\d+ steps back; it goes on$/);
  await page.press("ArrowRight");
  assert.equal(await step(), 5);
  await page.press("End");
  assert.ok(await isFollowing());
  const tick = Number(/tick (\d+)/.exec(await text("where"))[1]);
  await until(tickAtLeast(tick + 2));
  await page.press("Home");
  assert.ok(!await isFollowing());
  await page.evaluate("byId('follow').click()");
  assert.ok(await isFollowing());
  await until(tickAtLeast(tick + 4));
  run.child.kill("SIGINT");
  await run.ended;
  assert.deepEqual(page.complaints, []);
});

test("after many ticks a window of the last ones is seen", async () => {
  const run = await started(["run", endless, "--seed", "7", "--tick-ms", "4",
                             "--view"]);
  await look(run);
  await until(tickAtLeast(400));
  assert.ok(await isFollowing());
  run.child.kill("SIGINT");
  await until(isEnded);
  const [, from, to, all] =
    /^ticks (\d+) to (\d+) of (\d+)$/.exec(await text("shown-ticks"));
  assert.equal(to, all);
  assert.ok(Number(from) > 350 && Number(from) < Number(to), from);
  assert.ok(await page.evaluate(
    "document.getElementById('playhead').offsetWidth") >= 3);
  assert.deepEqual(page.complaints, []);
});

test("who comes late gets the whole run", async () => {
  const run = await started(["run", endless, "--seed", "7", "--ticks", "100",
                             "--tick-ms", "70", "--view"]);
  while (!run.lines.includes("tick 10:")) await rest(20);
  await look(run);
  await until(isEnded);
  assert.equal(await run.ended, 0);
  assert.equal(await text("remark"), "stopped after tick 100");
  await page.press("Home");
  assert.equal(await text("sentence"), "The run begins");
  await page.press("PageDown");
  await page.press("PageDown");
  assert.match(await text("where"), /tick 2$/);
});

test("a log is shown while it grows", async () => {
  const from = file("grown.btlog");
  const kept = await started(["run", endless, "--seed", "7", "--no-wait",
                              "--ticks", "40", "--btlog", from, "--view"]);
  await kept.ended;
  const bytes = readFileSync(from);
  const log = file("growing.btlog");
  // Everything but the last 60 records, and a piece of the next.
  const whole = bytes.length - 60 * 9;
  writeFileSync(log, bytes.subarray(0, whole + 4));
  const run = await started(["trace", log, "--view"]);
  await look(run);
  await until(isLive);
  await until("Number(byId('slider').max) > 0");
  await rest(300);
  const before = await last();
  appendFileSync(log, bytes.subarray(whole + 4, whole + 9 * 30 + 2));
  await until(`Number(byId('slider').max) > ${before}`);
  assert.ok(await isFollowing());
  appendFileSync(log, bytes.subarray(whole + 9 * 30 + 2));
  await until(tickAtLeast(40));
  run.child.kill("SIGINT");
  await until(isEnded);
  assert.equal(await run.ended, 0);
  assert.match(await text("remark"), /follows the log no longer/);
  assert.deepEqual(page.complaints, []);
});

test("a log that is begun anew is a page that begins anew", async () => {
  const log = file("anew.btlog");
  const bytes = readFileSync(file("grown.btlog"));
  const beginning = bytes.length - 9 * 300;
  const write = (more) =>
    writeFileSync(log, bytes.subarray(0, beginning + 9 * more));
  write(200);
  const run = await started(["trace", log, "--view"]);
  await look(run);
  await until(isLive);
  await until("Number(byId('slider').max) > 100");
  const long = await last();
  write(100);
  await until(`${isLive} && Number(byId('slider').max) > 50 &&
               Number(byId('slider').max) < ${long}`);
  // Who has gone back stays, until he follows.
  await go(3);
  const short = await last();
  write(50);
  await until("byId('live').textContent.includes('its later part')");
  assert.equal(await step(), 3);
  assert.equal(await last(), short);
  await page.evaluate("byId('follow').click()");
  await until(`${isLive} && Number(byId('slider').max) > 50 &&
               Number(byId('slider').max) < ${short}`);
  run.child.kill("SIGINT");
  assert.equal(await run.ended, 0);
});

test("a page that has lost btcheck says so, and keeps the run", async () => {
  const run = await started(["run", endless, "--seed", "7", "--tick-ms", "40",
                             "--view"]);
  await look(run);
  await until(tickAtLeast(3));
  run.child.kill("SIGKILL");
  await run.ended;
  await until("byId('live').textContent.includes('does not answer')");
  await page.press("Home");
  assert.equal(await text("sentence"), "The run begins");
});

// The picture of docs/run.md, made again with --pictures docs/pictures.
test("picture of a live view", { skip: !options.pictures }, async () => {
  mkdirSync(options.pictures, { recursive: true });
  const run = await started(["run", drone, "--loop", "--seed", "7",
                             "--tick-ms", "100", "--view"]);
  await look(run, 1280, 760);
  await until(tickAtLeast(23));
  await page.picture(path.join(options.pictures, "live.png"));
  run.child.kill("SIGINT");
  await run.ended;
});

test("a page beside an editor shows what the last save has come to", async (t) => {
  const tree = file("saved.xml");
  const bad = readFileSync(path.join(options.examples, "nav2/jazzy/" +
    "navigate_to_pose_w_replanning_and_recovery.xml"), "utf8");
  writeFileSync(tree, bad);
  const run = await started(["--watch", tree, "--view"]);
  t.after(() => run.child.kill("SIGKILL"));  // it never ends by itself
  await look(run);
  const says = (id, words) =>
    until(`byId("${id}").textContent === ${JSON.stringify(words)}`);
  const shows = (property) => says("property", property);
  await shows("BT2209-GoalUpdated");
  await says("verdict", "VIOLATED");
  await says("live", "of the last check; the next save may change it");
  await says("sentence", "GoalUpdated \u2192 failure");
  // Who has gone back is shown the next run all the same.
  await go(3);
  writeFileSync(tree, bad.replace("<GoalUpdated/>", "<GlobalUpdatedGoal/>"));
  await shows("nothing is wrong");
  await says("verdict", "NO FAULT");
  assert.equal(await page.evaluate("document.querySelector('main').hidden"),
               true);
  writeFileSync(tree, bad.slice(0, 1500));
  await shows("no run shows what is wrong");
  await says("verdict", "BROKEN");
  assert.match(await text("why-text"), /^this file cannot be read as XML/);
  writeFileSync(tree, bad);
  await shows("BT2209-GoalUpdated");
  assert.deepEqual(page.complaints, []);
  run.child.kill("SIGINT");
  assert.equal(await run.ended, 0);
  await until("byId('live').textContent === 'btcheck watches no longer'");
});
