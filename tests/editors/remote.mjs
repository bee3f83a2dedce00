// SPDX-License-Identifier: MIT
//
// VS Code as a server, from the npm package code-server: its extensions run in
// Node.js, as on a desktop, and its workbench in a browser.
import { execFileSync, spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { createInterface } from "node:readline";

import { QUIET } from "./workbench.mjs";

export class RemoteWorkbench {
  // `code`: the folder of out/server-main.js; `extension`: a .vsix; `folder`:
  // what is opened; `settings`: those of the machine.
  constructor({ code, extension, folder, settings }) {
    Object.assign(this, { code, extension, folder, settings });
  }

  async open() {
    this.data = mkdtempSync(path.join(tmpdir(), "btcheck-server-"));
    for (const place of ["Machine", "User"]) {
      const at = path.join(this.data, "data", place);
      mkdirSync(at, { recursive: true });
      writeFileSync(path.join(at, "settings.json"),
                    JSON.stringify({ ...QUIET, ...this.settings }));
    }
    const main = path.join(this.code, "out/server-main.js");
    const common = ["--server-data-dir", this.data, "--extensions-dir",
                    path.join(this.data, "extensions"),
                    "--accept-server-license-terms"];
    execFileSync(process.execPath, [main, ...common, "--install-extension",
                                    this.extension], { stdio: "ignore" });
    this.server = spawn(process.execPath, [
      main, ...common, "--host", "127.0.0.1", "--port", "0",
      "--without-connection-token", "--telemetry-level", "off"],
      { stdio: ["ignore", "pipe", "ignore"] });
    this.ended = new Promise((done) => this.server.on("exit", done));
    for await (const line of createInterface({ input: this.server.stdout })) {
      const port = /listening on (\d+)/.exec(line)?.[1];
      if (!port) continue;
      this.url = `http://localhost:${port}/?folder=${this.folder}`;
      break;
    }
    this.server.stdout.resume();
  }

  async close() {
    this.server.kill();
    await this.ended;
    rmSync(this.data, { recursive: true, force: true, maxRetries: 5 });
  }
}
