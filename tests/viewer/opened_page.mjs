// SPDX-License-Identifier: MIT
//
// The page that a test has open, and how it is asked.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before } from "node:test";
import { parseArgs } from "node:util";

import { Browser } from "./browser.mjs";

export const { values: options } = parseArgs({ options: {
  browser: { type: "string" }, pages: { type: "string" },
  examples: { type: "string" }, program: { type: "string" },
  pictures: { type: "string" } } });

export const folder = mkdtempSync(path.join(tmpdir(), "btcheck-pages-"));
export const file = (name) => path.join(folder, name);
const COLOURS = { unvisited: "rgb(255, 255, 255)", here: "rgb(29, 79, 159)",
                  waiting: "rgb(166, 205, 250)", running: "rgb(255, 210, 74)",
                  success: "rgb(88, 189, 124)", failure: "rgb(236, 91, 91)",
                  halted: "rgb(157, 107, 211)", halting: "rgb(247, 177, 220)",
                  skipped: "rgb(211, 215, 220)" };

export let browser;
export let page;

before(async () => {
  execFileSync(options.pages,
               [path.join(options.examples, "drone3.btf"), folder]);
  browser = await Browser.open(options.browser);
  page = await browser.newPage();
});

after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

export async function open(name, { hash = "", width = 1280, height = 800,
                                   theme = "light" } = {}) {
  await page.resize(width, height, theme);
  await page.open(file(`${name}.html`), hash);
}

// The run of a page as the machine's copy tells it.
export function recorded(name) {
  const run = JSON.parse(readFileSync(file(`${name}.itf.json`), "utf8"));
  run.where = (event, from = 0) => {
    const found = run.states.findIndex((state, i) =>
      i >= from && state.event === event);
    assert.notEqual(found, -1, event);
    return found;
  };
  return run;
}

export const step = () =>
  page.evaluate("Number(document.getElementById('slider').value)");
export const text = (id) =>
  page.evaluate(`document.getElementById("${id}").textContent`);
export const isHidden = (id) =>
  page.evaluate(`document.getElementById("${id}").hidden`);
export const go = (to) => page.evaluate(`(() => {
  const slider = document.getElementById("slider");
  slider.value = ${to};
  slider.dispatchEvent(new Event("input"));
})()`);

// What a node looks like.
export const look = (key) => page.evaluate(`(() => {
  const box = [...document.querySelectorAll(".node")].find((node) =>
    node.dataset.key === ${JSON.stringify(key)});
  const fill = getComputedStyle(box, "::before");
  return { colour: fill.backgroundColor, opacity: Number(fill.opacity),
           border: getComputedStyle(box).borderTopStyle,
           glyph: box.querySelector("use").getAttribute("href"),
           spoken: box.getAttribute("aria-label"), isHidden: box.hidden };
})()`);

export async function checkLook(key, phase, isStale) {
  const seen = await look(key);
  assert.equal(seen.colour, COLOURS[phase], `${key} is ${phase}`);
  assert.equal(seen.glyph, `#glyph-${phase}`);
  assert.equal(seen.opacity < 0.5, isStale, `${key} faded: ${isStale}`);
  assert.equal(seen.border, isStale ? "dashed" : "solid");
  assert.equal(seen.spoken.includes("earlier tick"), isStale);
}

// The run, unpacked by the page itself.
export const loaded = `new Run(JSON.parse(
  document.getElementById("run").textContent))`;
