// SPDX-License-Identifier: MIT
//
// The page of `btcheck whatif`: the matrix, its keys, and the runs behind it.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync, statSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { setTimeout as rest } from "node:timers/promises";

import { file, open, options, page } from "./opened_page.mjs";

const NAV2 = "nav2/jazzy/navigate_to_pose_w_replanning_and_recovery.xml";
let made;

// Makes the page once; what the JSON says of it.
function faults() {
  if (made) return made;
  const { status, stderr } = spawnSync(options.program, [
    "whatif", path.join(options.examples, NAV2), "-q", "--order", "2",
    "--format", `html=${file("faults.html")}`,
    "--format", `json=${file("faults.json")}`], { encoding: "utf8" });
  assert.equal(status, 1, stderr);
  made = JSON.parse(readFileSync(file("faults.json"), "utf8"));
  return made;
}

// In the frame, once the run is there.
async function inFrame(expression) {
  const frame = "document.getElementById('viewer').contentDocument";
  for (let i = 0; i < 100; ++i) {
    if (await page.evaluate(
      `Boolean(${frame}?.body?.classList.contains("ready"))`)) {
      return page.evaluate(`((document) => ${expression})(${frame})`);
    }
    await rest(50);
  }
  throw new Error("the run is not shown");
}

const title = () =>
  page.evaluate("document.getElementById('shown-title').textContent");
const isOpen = () => page.evaluate("document.getElementById('shown').open");

test("the matrix has each fault in its colour, with a letter", async () => {
  const { rows } = faults();
  await open("faults");
  const fields = await page.evaluate(
    `[...document.querySelectorAll(".matrix button")].map((one) =>
      [Number(one.dataset.row), one.classList[1], one.textContent,
       one.disabled])`);
  assert.equal(fields.length, rows.length);
  const letters = new Map();
  for (const [number, harm, letter, isDisabled] of fields) {
    assert.equal(harm, rows[number - 1].harm);
    assert.equal(isDisabled, rows[number - 1].run === null);
    letters.set(harm, letter);
  }
  assert.equal(new Set(letters.values()).size, letters.size);
  assert.deepEqual(page.complaints, []);
  assert.deepEqual(page.requests, [page.url]);
  assert.ok(statSync(file("faults.html")).size < 5e6);
});

test("a click shows the run of the fault in the viewer", async () => {
  const { rows } = faults();
  await open("faults");
  for (const row of rows.filter(({ run }) => run).slice(0, 6)) {
    await page.evaluate(
      `document.querySelector('.matrix [data-row="${row.number}"]').click()`);
    assert.ok((await title()).startsWith(`${row.number}: `));
    const events = await inFrame(
      `[...document.querySelectorAll("#event-list li")]
        .map((one) => one.textContent).join("\\n")`);
    // The last of what happens in the run is there.
    const last = row.run.ticks.at(-1).events.at(-1);
    assert.ok(events.includes(last.split(" -> ")[0]), `${last} in ${events}`);
    await page.evaluate("document.getElementById('close').click()");
  }
  // And of the last that there is, whose steps those before it have.
  const last = await page.evaluate("numbers.at(-1)");
  await page.evaluate(`show(${last})`);
  assert.ok(await inFrame(`document.querySelectorAll(".node").length > 20`));
  assert.deepEqual(page.complaints, []);
  assert.deepEqual(page.requests.filter((url) => !url.startsWith("about:")),
                   [page.url]);
});

test("keys go from field to field, to the run and back", async () => {
  faults();
  await open("faults");
  await page.evaluate(`document.querySelector(
    ".matrix button:not(:disabled)").focus()`);
  const at = () => page.evaluate("Number(document.activeElement.dataset.row)");
  const first = await at();
  await page.press("ArrowRight");
  assert.notEqual(await at(), first);
  await page.press("ArrowLeft");
  assert.equal(await at(), first);
  await page.evaluate("document.activeElement.click()");
  assert.ok(await isOpen());
  await inFrame("true");
  await page.press("Escape");
  assert.equal(await isOpen(), false);
  assert.equal(await at(), first);
});

test("the address names the run", async () => {
  const { rows } = faults();
  const { number } = rows.find(({ run }) => run);
  await open("faults", { hash: `#row=${number}` });
  assert.ok(await isOpen());
  await inFrame("true");
  assert.equal(await page.evaluate("location.hash"), `#row=${number}`);
});

test("dark and narrow, nothing is lost", async () => {
  faults();
  for (const theme of ["light", "dark"]) {
    await open("faults", { theme, width: 400, height: 800 });
    const { wide, ground, ink } = await page.evaluate(`({
      wide: document.documentElement.scrollWidth,
      ground: getComputedStyle(document.body).backgroundColor,
      ink: getComputedStyle(document.body).color })`);
    assert.ok(wide <= 400, `${wide}`);
    assert.notEqual(ground, ink);
    if (options.pictures) {
      await page.resize(1280, 800, theme);
      await page.picture(path.join(options.pictures, `whatif-${theme}.png`));
    }
  }
});
