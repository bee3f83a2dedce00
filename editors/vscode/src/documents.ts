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

/** What only our documents are asked for, by the names of the middleware. */
const ASKED = ["provideCodeActions", "provideCodeLenses",
               "provideCompletionItem", "provideDefinition",
               "provideDocumentFormattingEdits", "provideDocumentHighlights",
               "provideDocumentSemanticTokens", "provideDocumentSymbols",
               "provideFoldingRanges", "provideHover", "provideInlayHints",
               "provideReferences", "provideRenameEdits",
               "provideSelectionRanges", "prepareRename"];

/**
 * Answers for XML that is none of ours: nothing at all. An empty list would
 * stand in the way of what the editor does by itself, folding for instance.
 */
export function onlyOurs(): object {
  return Object.fromEntries(ASKED.map((name) => [name,
    (document: vscode.TextDocument, ...rest: unknown[]): unknown => {
      const next = rest.pop() as (...all: unknown[]) => unknown;
      return isOurs(document) ? next(document, ...rest) : undefined;
    }]));
}

/**
 * A formatter for each XML tree that is open. One for all XML would make the
 * editor ask people which of two they want, also for files that are not ours.
 */
export class TreeFormatters implements vscode.Disposable {
  private readonly made = new Map<string, vscode.Disposable>();
  private readonly rest: vscode.Disposable;

  constructor(private readonly provider: vscode.DocumentFormattingEditProvider) {
    this.rest = vscode.Disposable.from(
      vscode.workspace.onDidOpenTextDocument((document) => this.add(document)),
      vscode.workspace.onDidSaveTextDocument((document) => this.add(document)),
      vscode.workspace.onDidCloseTextDocument(({ uri }) => this.drop(uri)));
    vscode.workspace.textDocuments.forEach((document) => this.add(document));
  }

  private add(document: vscode.TextDocument): void {
    const key = document.uri.toString();
    if (document.languageId !== "xml" || this.made.has(key) ||
        !isTree(document)) return;
    const folder = vscode.Uri.joinPath(document.uri, "..");
    const name = document.uri.path.split("/").at(-1) ?? "";
    this.made.set(key, vscode.languages.registerDocumentFormattingEditProvider(
      { language: "xml", scheme: document.uri.scheme,
        pattern: new vscode.RelativePattern(
          folder, name.replace(/[*?[{]/g, "[$&]")) }, this.provider));
  }

  private drop(uri: vscode.Uri): void {
    this.made.get(uri.toString())?.dispose();
    this.made.delete(uri.toString());
  }

  dispose(): void {
    this.rest.dispose();
    for (const one of this.made.values()) one.dispose();
  }
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
