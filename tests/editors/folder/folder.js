// SPDX-License-Identifier: MIT
//
// A folder of the machine that the workbench is served by, as files of an
// editor in a browser: btcheck-test:/NAME. Only for tests (workbench.mjs).
const vscode = require("vscode");

class Folder {
  constructor(base) {
    this.base = base;
    this.changed = new vscode.EventEmitter();
    this.onDidChangeFile = this.changed.event;
  }

  async ask(what, uri, body) {
    const answer = await fetch(this.base + uri.path, {
      method: what, ...(body ? { body } : {}) });
    if (answer.status === 404) throw vscode.FileSystemError.FileNotFound(uri);
    if (!answer.ok) throw vscode.FileSystemError.Unavailable(uri);
    return answer;
  }

  watch() { return { dispose() {} }; }
  async stat(uri) {
    const { isFolder, size, time } = JSON.parse(
      (await this.ask("GET", uri.with({ path: `/stat${uri.path}` })
        ).then((answer) => answer.text())));
    return { type: isFolder ? 2 : 1, ctime: 0, mtime: time, size };
  }
  async readDirectory(uri) {
    const answer = await this.ask("GET", uri.with({ path: `/list${uri.path}` }));
    return (await answer.json()).map(([name, isFolder]) =>
      [name, isFolder ? 2 : 1]);
  }
  async readFile(uri) {
    const answer = await this.ask("GET", uri.with({ path: `/read${uri.path}` }));
    return new Uint8Array(await answer.arrayBuffer());
  }
  async writeFile(uri, content) {
    await this.ask("PUT", uri.with({ path: `/write${uri.path}` }), content);
    this.changed.fire([{ type: 1, uri }]);
  }
  createDirectory(uri) { throw vscode.FileSystemError.NoPermissions(uri); }
  delete(uri) { throw vscode.FileSystemError.NoPermissions(uri); }
  rename(uri) { throw vscode.FileSystemError.NoPermissions(uri); }
}

exports.activate = ({ extensionUri, subscriptions }) => {
  const base = extensionUri.with({ path: "/files" }).toString(true);
  subscriptions.push(vscode.workspace.registerFileSystemProvider(
    "btcheck-test", new Folder(base), { isCaseSensitive: true }));
};
