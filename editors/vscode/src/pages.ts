// SPDX-License-Identifier: MIT
//
// Pages of the viewer beside the text: a run, or the tree as it stands. A click
// on a node goes to its line; the cursor chooses the node that it is in.
import * as vscode from "vscode";

import { along, folderOf, wayTo } from "./paths";
import { around, scan } from "./scan";
import { Page, Session, told } from "./session";

const PAUSE = 400;  // milliseconds without an edit, before a picture is drawn anew

// What the page says by events and messages of its own window (docs/traces.md)
// is handed on. It knows nothing of VS Code, so it is told here which colours
// the editor has.
const BRIDGE = `<style>body { padding-left: 0; padding-right: 0; }</style>
<script>(() => {
  const editor = acquireVsCodeApi();
  editor.postMessage(
    { tree: JSON.parse(document.getElementById("run").textContent).tree });
  addEventListener("btcheck-node",
    ({ detail }) => editor.postMessage({ node: detail }));
  const follow = () => {
    const { classList } = document.body;
    if (typeof setTheme === "function") {
      setTheme(classList.contains("vscode-dark") ||
               classList.contains("vscode-high-contrast") &&
               !classList.contains("vscode-high-contrast-light"));
    }
  };
  follow();
  new MutationObserver(follow)
    .observe(document.body, { attributeFilter: ["class"] });
})();</script>
`;

// Of a run that stands for the tree alone, the tree is shown: all of it, as it
// is before the first tick.
const DRAWING = `<style>
  header, #timeline, aside, .legend, #fold-all { display: none !important; }
  body { padding: 0; height: 100vh; min-height: 0; }
  main { display: flex; flex-direction: column; flex: 1; }
  #tree { flex: 1; height: auto; min-height: 0; border: 0; }
</style>
<script>(() => {
  document.getElementById("to-start").click();
  const unfold = document.getElementById("fold-all");
  if (!unfold.hidden) unfold.click();
})();</script>
`;

type Kind = "btcheck.run" | "btcheck.tree";
interface Told {
  tree?: string;  // what the page calls the tree's file
  node?: { file: string; line: number; column: number };
}

class PageView {
  private readonly panel: vscode.WebviewPanel;
  private readonly rest: vscode.Disposable[] = [];
  private html = "";
  private tree = "";
  private selected = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly uri: vscode.Uri, private readonly kind: Kind,
              title: string, onEnd: () => void) {
    this.panel = vscode.window.createWebviewPanel(
      kind, title, { viewColumn: vscode.ViewColumn.Beside,
                     preserveFocus: true },
      { enableScripts: true, retainContextWhenHidden: true,
        localResourceRoots: [], enableFindWidget: true });
    this.rest.push(
      this.panel.webview.onDidReceiveMessage((message: Told) =>
        this.goTo(message)),
      vscode.window.onDidChangeTextEditorSelection(
        ({ textEditor, kind: by }) => {
          // What was clicked in the page is chosen there already.
          if (by !== undefined) this.chooseAt(textEditor);
        }));
    this.panel.onDidDispose(() => {
      clearTimeout(this.timer);
      for (const one of this.rest) one.dispose();
      onEnd();
    });
  }

  /** Something that ends with the page. */
  add(one: vscode.Disposable): void { this.rest.push(one); }

  show({ title, html }: Page): void {
    this.panel.title = title;
    if (html === this.html) return;
    this.html = html;
    this.panel.webview.html =
      withEnd(html, this.kind === "btcheck.tree" ? BRIDGE + DRAWING : BRIDGE);
    this.selected = 0;
  }

  reveal(): void {
    if (!this.panel.visible) this.panel.reveal(undefined, true);
  }

  /** Calls `draw` when nothing has been asked for during a pause. */
  soon(draw: () => void): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(draw, PAUSE);
  }

  // The page's name of a file: other ones than the tree's have the server's.
  private fileOf(uri: vscode.Uri): string {
    if (uri.toString() === this.uri.toString()) return "";
    return along(folderOf(this.tree),
                 wayTo(folderOf(this.uri.path), uri.path));
  }

  private async goTo({ node, tree }: Told): Promise<void> {
    if (typeof tree === "string") this.tree = tree;
    if (!node || !Number.isInteger(node.line) || node.line < 1) return;
    const uri = node.file === "" ? this.uri : this.uri.with({
      path: along(folderOf(this.uri.path),
                  wayTo(folderOf(this.tree), node.file)) });
    try {
      const document = await vscode.workspace.openTextDocument(uri);
      const line = Math.min(node.line, document.lineCount) - 1;
      const at = columnOf(document.lineAt(line).text, node.column);
      const where = new vscode.Range(line, at, line, at);
      // Where the text is seen already, or in the other half.
      const seen = vscode.window.visibleTextEditors.find((editor) =>
        editor.document.uri.toString() === uri.toString());
      await vscode.window.showTextDocument(document, {
        selection: where, viewColumn: seen?.viewColumn ??
          (this.panel.viewColumn === vscode.ViewColumn.One
             ? vscode.ViewColumn.Two : vscode.ViewColumn.One) });
    } catch (error) {
      void vscode.window.showWarningMessage(
        `btcheck: ${node.file || "the tree"} cannot be opened: ${told(error)}`);
    }
  }

  private chooseAt({ document, selection }: vscode.TextEditor): void {
    const isTree = ["btf", "xml"].includes(document.languageId);
    if (!isTree || !this.panel.visible) return;
    // Before the first word of a line one is at that word.
    const { active } = selection;
    const first = document.lineAt(active.line).firstNonWhitespaceCharacterIndex;
    const part = around(
      scan(document.languageId, document.getText()), document.offsetAt(
        active.with({ character: Math.max(active.character, first) })));
    const line = part ? document.positionAt(part.begin).line + 1 : 0;
    if (line === this.selected) return;
    this.selected = line;
    if (line > 0) {
      void this.panel.webview.postMessage(
        { btcheck: "select", file: this.fileOf(document.uri), line });
    }
  }
}

// Columns of btcheck count characters, those of the editor UTF-16 units.
function columnOf(text: string, column: number): number {
  return [...text].slice(0, Math.max(0, column - 1)).join("").length;
}

function withEnd(html: string, end: string): string {
  const at = html.lastIndexOf("</body>");
  return at < 0 ? html + end : html.slice(0, at) + end + html.slice(at);
}

export class Pages implements vscode.Disposable {
  private readonly views = new Map<string, PageView>();

  constructor(private readonly session: Session) {}

  dispose(): void {}  // panels are the window's

  /** One run of the file; asks which, where there are several. */
  async showRun(uri: vscode.Uri, run?: string): Promise<void> {
    const chosen = run ?? await this.chooseRun(uri);
    if (chosen === undefined) return;
    const page = await this.session.ask<Page>("btcheck/page", {
      textDocument: { uri: uri.toString() }, run: chosen });
    const view = this.viewOf(uri, "btcheck.run", page.title);
    view.show(page);
    view.reveal();
  }

  private async chooseRun(uri: vscode.Uri): Promise<string | undefined> {
    await this.session.start();
    const runs = this.session.runs(uri.toString());
    if (runs.length < 2) {
      if (!runs[0]) {
        void vscode.window.showInformationMessage(
          "btcheck: there is no run to show: nothing was found that needs one");
      }
      return runs[0]?.name;
    }
    const picked = await vscode.window.showQuickPick(
      runs.map(({ name, title }) => ({ label: title || name, name })),
      { placeHolder: "which run?" });
    return picked?.name;
  }

  /** The tree of the text, followed while it is edited. */
  async draw(document: vscode.TextDocument): Promise<void> {
    const { uri } = document;
    const view = this.viewOf(uri, "btcheck.tree", "tree", (made) => {
      made.add(vscode.workspace.onDidChangeTextDocument((event) => {
        if (event.document.uri.toString() !== uri.toString()) return;
        // What is not well-formed yet leaves the picture as it is.
        made.soon(() => void this.redraw(uri, made).catch(() => {}));
      }));
    });
    view.reveal();
    await this.redraw(uri, view);
  }

  private async redraw(uri: vscode.Uri, view: PageView): Promise<void> {
    view.show(await this.session.ask<Page>("btcheck/drawing", {
      textDocument: { uri: uri.toString() } }));
  }

  private viewOf(uri: vscode.Uri, kind: Kind, title: string,
                 begin: (made: PageView) => void = () => {}): PageView {
    const key = `${kind} ${uri.toString()}`;
    let view = this.views.get(key);
    if (!view) {
      view = new PageView(uri, kind, title, () => this.views.delete(key));
      this.views.set(key, view);
      begin(view);
    }
    return view;
  }
}
