// SPDX-License-Identifier: MIT
//
// In a browser, where no program runs: highlighting, outline and folding, which
// need no search. With a server at the end of a WebSocket, all the rest.
import * as vscode from "vscode";

import { followEditors, isOurs, LANGUAGES } from "./documents";
import { registerCommands } from "./commands";
import { Part, scan } from "./scan";
import { Session } from "./session";
import { overSocket } from "./socket";

const SAID = "btcheck runs on the desktop; here: highlighting and outline";
let session: Session | undefined;

const KINDS: Record<Part["kind"], vscode.SymbolKind> = {
  tree: vscode.SymbolKind.Class,
  node: vscode.SymbolKind.Method,
  leaf: vscode.SymbolKind.Function,
  declaration: vscode.SymbolKind.Variable,
  rule: vscode.SymbolKind.Property,
  section: vscode.SymbolKind.Namespace,
};

function symbols(document: vscode.TextDocument):
    vscode.DocumentSymbol[] | undefined {
  if (!isOurs(document)) return undefined;
  const range = (begin: number, end: number): vscode.Range =>
    new vscode.Range(document.positionAt(begin), document.positionAt(end));
  const made = (part: Part): vscode.DocumentSymbol => {
    const symbol = new vscode.DocumentSymbol(
      part.name, part.detail, KINDS[part.kind], range(part.begin, part.end),
      range(part.nameBegin, part.nameEnd));
    symbol.children = part.parts.map(made);
    return symbol;
  };
  return scan(document.languageId, document.getText()).map(made);
}

function folds(document: vscode.TextDocument):
    vscode.FoldingRange[] | undefined {
  if (!isOurs(document)) return undefined;  // it has folds of the editor's own
  const found: vscode.FoldingRange[] = [];
  const visit = (part: Part): void => {
    const first = document.positionAt(part.begin).line;
    const last = document.positionAt(part.end).line;
    if (last > first) found.push(new vscode.FoldingRange(first, last));
    part.parts.forEach(visit);
  };
  scan(document.languageId, document.getText()).forEach(visit);
  return found;
}

function withoutServer(): vscode.Disposable {
  const selector = [...LANGUAGES, "xml"].map((language) => ({ language }));
  const status = vscode.window.createStatusBarItem(
    "btcheck.status", vscode.StatusBarAlignment.Right, 100);
  status.name = status.text = "btcheck";
  status.tooltip = SAID;
  return vscode.Disposable.from(status,
    vscode.languages.registerDocumentSymbolProvider(
      selector, { provideDocumentSymbols: symbols }, { label: "btcheck" }),
    vscode.languages.registerFoldingRangeProvider(
      selector, { provideFoldingRanges: folds }),
    followEditors((document) => {
      if (document && isOurs(document)) status.show();
      else status.hide();
    }),
    ...["check", "showRun", "drawTree", "restart", "showOutput"].map((name) =>
      vscode.commands.registerCommand(`btcheck.${name}`, () =>
        vscode.window.showInformationMessage(`${SAID}.`))));
}

export function activate(context: vscode.ExtensionContext): void {
  const stepThrough = vscode.commands.registerCommand(
    "btcheck.stepThrough", () => vscode.window.showInformationMessage(
      "btcheck steps through a tree in a terminal, on the desktop."));
  let current: vscode.Disposable | undefined;
  const choose = async (): Promise<void> => {
    current?.dispose();
    await session?.dispose();
    session = undefined;
    const address = vscode.workspace.getConfiguration("btcheck")
      .get<string>("server")?.trim();
    if (address) {
      session = new Session(overSocket(address));
      current = registerCommands(session);
    } else {
      current = withoutServer();
    }
  };
  void choose();
  context.subscriptions.push(stepThrough,
    vscode.workspace.onDidChangeConfiguration((event) => {
      if (event.affectsConfiguration("btcheck.server")) void choose();
    }));
}

export async function deactivate(): Promise<void> {
  await session?.dispose();
}
