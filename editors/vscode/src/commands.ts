// SPDX-License-Identifier: MIT
//
// The commands that the desktop and a browser have in common. What a code lens
// or a code action hands over is an object; from the palette comes nothing.
import * as vscode from "vscode";

import { isOurs, isTree } from "./documents";
import { Pages } from "./pages";
import { Session, told } from "./session";

export interface Argument { uri?: string; run?: string; tree?: string }

/** A command whose mistakes are shown to people. */
export function command(name: string,
                        act: (argument: Argument) => Promise<unknown>):
    vscode.Disposable {
  return vscode.commands.registerCommand(name, async (given?: unknown) => {
    try {
      await act(argumentOf(given));
    } catch (error) {
      void vscode.window.showErrorMessage(`btcheck: ${told(error)}`);
    }
  });
}

// The menus of an editor hand over its address.
function argumentOf(given: unknown): Argument {
  if (given instanceof vscode.Uri) return { uri: given.toString() };
  return given !== null && typeof given === "object" ? given : {};
}

/** The document that a command is about; what is wrong with it, else. */
export async function documentOf(
    { uri }: Argument, isWanted: (document: vscode.TextDocument) => boolean,
    wanted: string): Promise<vscode.TextDocument> {
  const document = uri
    ? await vscode.workspace.openTextDocument(vscode.Uri.parse(uri))
    : vscode.window.activeTextEditor?.document;
  if (!document || !isWanted(document)) {
    throw new Error(`open ${wanted} first`);
  }
  return document;
}

const ANY_FILE = "a behavior tree, rules or contracts of leaves";
export const A_TREE = "a behavior tree, an .xml or .btf file";

export function registerCommands(session: Session): vscode.Disposable {
  const pages = new Pages(session);
  return vscode.Disposable.from(pages,
    command("btcheck.check", async (argument) => {
      const { uri } = await documentOf(argument, isOurs, ANY_FILE);
      const { summary } = await vscode.window.withProgress(
        { location: vscode.ProgressLocation.Window, title: "btcheck" },
        () => session.ask<{ summary: string }>("btcheck/check", {
          textDocument: { uri: uri.toString() } }));
      vscode.window.setStatusBarMessage(`btcheck: ${summary}`, 8000);
    }),
    command("btcheck.showRun", async (argument) => {
      const { uri } = await documentOf(argument, isOurs, ANY_FILE);
      await pages.showRun(uri, argument.run);
    }),
    command("btcheck.drawTree", async (argument) =>
      pages.draw(await documentOf(argument, isTree, A_TREE))),
    command("btcheck.restart", () => session.restart()),
    command("btcheck.showOutput", async () => session.output.show(true)));
}
