// SPDX-License-Identifier: MIT
//
// Chromium, driven by its DevTools protocol over a pipe: messages are JSON, a
// zero byte ends each. Nothing to install beside node and the browser.
import { spawn } from "node:child_process";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";

const KEYS = { ArrowLeft: 37, ArrowUp: 38, ArrowRight: 39, ArrowDown: 40,
               PageUp: 33, PageDown: 34, End: 35, Home: 36, Enter: 13,
               Escape: 27, Tab: 9, " ": 32 };

export class Browser {
  static async open(program) {
    const browser = new Browser();
    browser.profile = await mkdtemp(path.join(tmpdir(), "btcheck-viewer-"));
    browser.process = spawn(program, [
      "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run",
      "--disable-background-networking", "--disable-component-update",
      "--disable-dev-shm-usage", "--force-color-profile=srgb",
      `--user-data-dir=${browser.profile}`, "--remote-debugging-pipe",
      "about:blank",
    ], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    browser.listen();
    return browser;
  }

  listen() {
    this.waiting = new Map();
    this.pages = new Map();
    this.number = 0;
    let rest = Buffer.alloc(0);
    this.process.stdio[4].on("data", (data) => {
      rest = Buffer.concat([rest, data]);
      for (let end = rest.indexOf(0); end >= 0; end = rest.indexOf(0)) {
        this.take(JSON.parse(rest.subarray(0, end).toString()));
        rest = rest.subarray(end + 1);
      }
    });
    this.ended = new Promise((done) => this.process.on("exit", done));
    this.process.on("exit", () => {
      for (const { reject } of this.waiting.values()) {
        reject(new Error("the browser has ended"));
      }
    });
  }

  take(message) {
    if (message.id === undefined) {
      this.pages.get(message.sessionId)?.hear(message);
      return;
    }
    const { resolve, reject, method } = this.waiting.get(message.id);
    this.waiting.delete(message.id);
    if (message.error) {
      reject(new Error(`${method}: ${message.error.message}`));
    } else {
      resolve(message.result);
    }
  }

  send(method, params = {}, sessionId = undefined) {
    const id = ++this.number;
    this.process.stdio[3].write(
      JSON.stringify({ id, method, params, sessionId }) + "\0");
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject, method });
    });
  }

  async newPage() {
    const { targetId } = await this.send("Target.createTarget",
                                         { url: "about:blank" });
    const { sessionId } = await this.send("Target.attachToTarget",
                                          { targetId, flatten: true });
    const page = new Page(this, sessionId);
    this.pages.set(sessionId, page);
    for (const domain of ["Page", "Runtime", "Network", "Log"]) {
      await page.send(`${domain}.enable`);
    }
    return page;
  }

  async close() {
    await this.send("Browser.close").catch(() => {});
    await this.ended;
    await rm(this.profile, { recursive: true, force: true, maxRetries: 5 });
  }
}

// What is heard of a page: complaints on its console, and what it asks for.
class Page {
  constructor(browser, session) {
    this.browser = browser;
    this.session = session;
    this.complaints = [];
    this.requests = [];
    this.once = new Map();
  }

  send(method, params = {}) {
    return this.browser.send(method, params, this.session);
  }

  hear({ method, params }) {
    if (method === "Runtime.exceptionThrown") {
      const { text, exception } = params.exceptionDetails;
      this.complaints.push(exception?.description ?? text);
    } else if (method === "Runtime.consoleAPICalled") {
      this.complaints.push(JSON.stringify(params.args));
    } else if (method === "Log.entryAdded") {
      this.complaints.push(params.entry.text);
    } else if (method === "Network.requestWillBeSent") {
      this.requests.push(params.request.url);
    }
    this.once.get(method)?.(params);
    this.once.delete(method);
  }

  event(name) {
    return new Promise((done) => this.once.set(name, done));
  }

  // Opens a file from disk.
  async open(file, hash = "") {
    await this.visit("about:blank");
    this.complaints = [];
    this.requests = [];
    this.url = pathToFileURL(file).href;
    await this.visit(this.url + hash);
  }

  async visit(url) {
    const loaded = this.event("Page.loadEventFired");
    await this.send("Page.navigate", { url });
    await loaded;
  }

  async evaluate(expression) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate", {
      expression, returnByValue: true, awaitPromise: true });
    if (exceptionDetails) {
      throw new Error(exceptionDetails.exception?.description ?? expression);
    }
    return result.value;
  }

  async press(key, { shift = false } = {}) {
    const code = KEYS[key] ?? key.toUpperCase().charCodeAt(0);
    const about = { key, windowsVirtualKeyCode: code, modifiers: shift ? 8 : 0 };
    const text = key.length === 1 ? key : undefined;
    await this.send("Input.dispatchKeyEvent",
                    { type: text ? "keyDown" : "rawKeyDown", text, ...about });
    await this.send("Input.dispatchKeyEvent", { type: "keyUp", ...about });
  }

  async click(x, y) {
    const about = { x, y, button: "left", clickCount: 1 };
    await this.send("Input.dispatchMouseEvent",
                    { type: "mousePressed", ...about });
    await this.send("Input.dispatchMouseEvent",
                    { type: "mouseReleased", ...about });
  }

  // `theme` is light or dark.
  async resize(width, height, theme, media = "") {
    await this.send("Emulation.setDeviceMetricsOverride", {
      width, height, deviceScaleFactor: width < 500 ? 2 : 1,
      mobile: width < 500 });
    await this.send("Emulation.setEmulatedMedia", {
      media, features: [
        { name: "prefers-color-scheme", value: theme },
        { name: "prefers-reduced-motion", value: "reduce" }] });
  }

  async picture(file, isWhole = false) {
    const { data } = await this.send("Page.captureScreenshot", {
      format: "png", captureBeyondViewport: isWhole });
    await writeFile(file, Buffer.from(data, "base64"));
  }

  async print(file) {
    const { data } = await this.send("Page.printToPDF", {
      preferCSSPageSize: true, printBackground: false });
    await writeFile(file, Buffer.from(data, "base64"));
  }
}
