// SPDX-License-Identifier: MIT
//
// Where programs can be started: VS Code on the desktop, and remote ones.
import { spawn } from "node:child_process";
import { homedir } from "node:os";
import path from "node:path";
import * as vscode from "vscode";
import { LanguageClient } from "vscode-languageclient/node";

import { A_TREE, command, documentOf, registerCommands } from "./commands";
import { isTree, settings } from "./documents";
import { Connect, Session, Unreachable } from "./session";
import { overSocket } from "./socket";

let session: Session | undefined;
let home: vscode.Uri | undefined;  // of the extension

function program(): string {
  const given = vscode.workspace.getConfiguration("btcheck")
    .get<string>("path")?.trim() || "btcheck";
  const folder = vscode.workspace.workspaceFolders?.[0]?.uri.fsPath;
  const named = given.replace(/^~(?=[/\\])/, homedir())
    .replaceAll("${workspaceFolder}", folder ?? "");
  // A path is that of the folder; a name is looked for on the PATH.
  return /[/\\]/.test(named) && folder ? path.resolve(folder, named) : named;
}

// What the program answers to `lsp --help`: "" when it can do that.
function complaint(file: string): Promise<string> {
  return new Promise((done) => {
    const child = spawn(file, ["lsp", "--help"],
                        { stdio: "ignore", timeout: 20_000 });
    child.on("error", (error: NodeJS.ErrnoException) =>
      done(error.code === "ENOENT"
        ? `the program \`${file}\` is not found`
        : `the program \`${file}\` cannot be started: ${error.message}`));
    child.on("exit", (code) => done(code === 0 ? ""
      : `the program \`${file}\` has no language server: it is older than ` +
        "this extension, or something else"));
  });
}

// It tells how btcheck is installed. The packer changes the case of its name.
async function showReadme(): Promise<void> {
  if (!home) return;
  const files = await vscode.workspace.fs.readDirectory(home);
  const readme = files.find(([name]) => /^readme\.md$/i.test(name));
  if (readme) {
    await vscode.commands.executeCommand(
      "markdown.showPreview", vscode.Uri.joinPath(home, readme[0]));
  }
}

const overPipes: Connect = async (options) => {
  const file = program();
  const why = await complaint(file);
  if (why) {
    return new Unreachable(why, {
      "How to install it": showReadme,
      "Set its path": () => vscode.commands.executeCommand(
        "workbench.action.openSettings", "btcheck.path"),
      "Try again": () => session?.restart(),
    });
  }
  return new LanguageClient("btcheck", "btcheck",
                            { command: file, args: ["lsp"] }, options);
};

// `btcheck simulate` in a terminal. The program is the terminal's process, so
// that no shell reads the name of a file.
async function stepThrough(uri: string | undefined, tree?: string):
    Promise<void> {
  const document = await documentOf({ uri }, isTree, A_TREE);
  if (document.isUntitled || document.isDirty) {
    if (!await document.save()) return;
  }
  if (document.uri.scheme !== "file") {
    throw new Error("the tree must be a file of this machine");
  }
  const { profile } = settings();
  const folder = vscode.workspace.getWorkspaceFolder(document.uri);
  const isBtf = document.languageId === "btf";
  const terminal = vscode.window.createTerminal({
    name: `btcheck: ${path.basename(document.fileName)}`,
    cwd: folder?.uri ?? vscode.Uri.file(path.dirname(document.fileName)),
    shellPath: program(),
    shellArgs: ["simulate", document.fileName,
                ...(typeof profile === "string" ? ["--profile", profile] : []),
                ...(tree && !isBtf ? ["--main-tree", tree] : [])],
  });
  terminal.show();
}

export function activate(context: vscode.ExtensionContext): void {
  home = context.extensionUri;
  void vscode.commands.executeCommand("setContext", "btcheck.hasTerminal", true);
  session = new Session((options) => {
    const address = vscode.workspace.getConfiguration("btcheck")
      .get<string>("server")?.trim();
    return (address ? overSocket(address) : overPipes)(options);
  });
  context.subscriptions.push(registerCommands(session),
    command("btcheck.stepThrough", ({ uri, tree }) => stepThrough(uri, tree)));
}

export async function deactivate(): Promise<void> {
  await session?.dispose();
}
