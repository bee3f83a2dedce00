// SPDX-License-Identifier: MIT
//
// Which documents are ours. Most XML is not: only what is about behavior trees.
import * as vscode from "vscode";

import { isTreeXml } from "./scan";

export const LANGUAGES = ["btf", "btcheck-rules", "btcheck-leaves"] as const;

export function isTree(document: vscode.TextDocument): boolean {
  return document.languageId === "btf" ||
    document.languageId === "xml" && isTreeXml(document.getText());
}

export function isOurs(document: vscode.TextDocument): boolean {
  return (LANGUAGES as readonly string[]).includes(document.languageId) ||
    isTree(document);
}

/** Keys for `when` clauses, and whoever else follows the active editor. */
export function followEditors(
    onChange: (document: vscode.TextDocument | undefined) => void):
    vscode.Disposable {
  const tell = (editor = vscode.window.activeTextEditor): void => {
    // A web view beside the text is no reason to forget what it shows.
    const document = editor?.document;
    const set = (key: string, value: boolean): void =>
      void vscode.commands.executeCommand("setContext", key, value);
    set("btcheck.isTree", document !== undefined && isTree(document));
    set("btcheck.isOurs", document !== undefined && isOurs(document));
    onChange(document);
  };
  tell();
  return vscode.Disposable.from(
    vscode.window.onDidChangeActiveTextEditor(tell),
    vscode.workspace.onDidOpenTextDocument(() => tell()),
    vscode.workspace.onDidSaveTextDocument(() => tell()));
}

/** What the server is told to do; it has its own defaults. */
export function settings(): Record<string, unknown> {
  const given = vscode.workspace.getConfiguration("btcheck");
  return {
    profile: given.get<string>("profile") || undefined,
    checkOnType: given.get("checkOnType"),
    repairs: given.get("repairs"),
    seconds: given.get("seconds"),
  };
}
