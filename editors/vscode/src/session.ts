// SPDX-License-Identifier: MIT
//
// The language server as the editor has it: started when the first of our
// documents is opened, told of settings, shown in the status bar. How it is
// reached is told by who makes the session: a process on the desktop, a
// WebSocket elsewhere.
import * as vscode from "vscode";
import { BaseLanguageClient, DidChangeConfigurationNotification,
         DocumentFormattingRequest, LanguageClientOptions, ServerCapabilities,
         State } from "vscode-languageclient";

import { followEditors, isOurs, LANGUAGES, onlyOurs, settings,
         TreeFormatters } from "./documents";

export interface RunTitle { name: string; title: string }
export interface Page { title: string; html: string }

/** A client that is not started yet; a message for people, where there is none. */
export type Connect = (options: LanguageClientOptions) =>
    Promise<BaseLanguageClient | Unreachable>;

/** Why no server can be reached, and what can be done about it. */
export class Unreachable {
  constructor(readonly message: string,
              readonly actions: Record<string, () => unknown> = {}) {}
}

export class Session implements vscode.Disposable {
  private client: BaseLanguageClient | undefined;
  private starting: Promise<void> | undefined;
  private readonly runsOf = new Map<string, RunTitle[]>();
  private readonly status: vscode.StatusBarItem;
  private readonly rest: vscode.Disposable[] = [];
  private formatters: vscode.Disposable | undefined;
  private failure = "";
  private isEnded = false;
  readonly output: vscode.LogOutputChannel;

  constructor(private readonly connect: Connect) {
    this.output = vscode.window.createOutputChannel("btcheck", { log: true });
    this.status = vscode.window.createStatusBarItem(
      "btcheck.status", vscode.StatusBarAlignment.Right, 100);
    this.status.name = "btcheck";
    this.status.text = "btcheck";
    this.status.command = "btcheck.showOutput";
    this.rest.push(this.output, this.status,
      followEditors((document) => {
        if (document && isOurs(document)) {
          this.status.show();
          void this.start();
        } else {
          this.status.hide();
        }
      }),
      vscode.workspace.onDidChangeConfiguration((event) =>
        this.reconfigure(event)));
    this.startIfNeeded();
  }

  get isRunning(): boolean { return this.client?.state === State.Running; }

  runs(uri: string): RunTitle[] { return this.runsOf.get(uri) ?? []; }

  /** A request; a message for people where nobody answers. */
  async ask<Answer>(method: string, parameters: object): Promise<Answer> {
    await this.start();
    if (!this.client || !this.isRunning) {
      throw new Error(this.failure || "the language server does not run");
    }
    return await this.client.sendRequest<Answer>(method, parameters);
  }

  /** Starts the server once; a failure stays until somebody asks again. */
  start(): Promise<void> {
    this.starting ??= this.startNow();
    return this.starting;
  }

  async restart(): Promise<void> {
    await this.stop();
    await this.start();
  }

  private startIfNeeded(): void {
    if (vscode.workspace.textDocuments.some(isOurs)) void this.start();
  }

  private async startNow(): Promise<void> {
    this.say("loading~spin", "btcheck is starting");
    this.failure = "";
    const found = await this.connect(this.options());
    if (this.isEnded) return;
    if (found instanceof Unreachable) return this.refuse(found);
    this.client = found;
    found.onNotification("btcheck/runs",
      ({ uri, runs }: { uri: string; runs: RunTitle[] }) => {
        this.runsOf.set(vscode.Uri.parse(uri).toString(), runs);
      });
    this.formatters = formatTrees(found);
    found.onDidChangeState(({ newState }) => this.follow(newState));
    try {
      await found.start();
    } catch (error) {
      this.fail(`the language server does not start: ${told(error)}`);
    }
  }

  private options(): LanguageClientOptions {
    return {
      documentSelector: [...LANGUAGES, "xml"].map((language) => ({ language })),
      initializationOptions: settings(),
      outputChannel: this.output,
      traceOutputChannel: this.output,
      progressOnInitialization: false,
      middleware: {
        ...onlyOurs(),
        workspace: {
          // Only our own settings, and as the server knows them.
          didChangeConfiguration: async () => {},
        },
      },
    };
  }

  private follow(state: State): void {
    const isRunning = state === State.Running;
    void vscode.commands.executeCommand("setContext", "btcheck.hasServer",
                                        isRunning);
    if (isRunning) {
      this.failure = "";
      const { name, version } = this.client?.initializeResult?.serverInfo ?? {};
      this.say("", `${name ?? "btcheck"} ${version ?? ""}`.trim() +
                   ": the language server runs");
    } else if (state === State.Stopped && !this.isEnded) {
      this.fail("the language server has ended; " +
                "`btcheck: Restart the language server` starts it again");
      this.runsOf.clear();
    }
  }

  private say(icon: string, tooltip: string, isBad = false): void {
    this.status.text = icon ? `$(${icon}) btcheck` : "btcheck";
    this.status.tooltip = tooltip;
    this.status.backgroundColor = isBad
      ? new vscode.ThemeColor("statusBarItem.warningBackground") : undefined;
  }

  private fail(why: string): void {
    this.failure = why;
    this.say("warning", `btcheck: ${why}`, true);
  }

  // Said once, with what can be done; the status bar keeps it.
  private async refuse({ message, actions }: Unreachable): Promise<void> {
    this.fail(message);
    this.output.error(message);
    void vscode.window.showWarningMessage(`btcheck: ${message}`,
                                          ...Object.keys(actions))
      .then((chosen) => chosen && actions[chosen]?.());
  }

  private async reconfigure(event: vscode.ConfigurationChangeEvent):
      Promise<void> {
    if (!event.affectsConfiguration("btcheck")) return;
    if (["path", "server"].some((key) =>
          event.affectsConfiguration(`btcheck.${key}`))) {
      if (this.starting) await this.restart();
      return;
    }
    if (!this.client || !this.isRunning) return;
    await this.client.sendNotification(DidChangeConfigurationNotification.type,
                                       { settings: { btcheck: settings() } });
  }

  private async stop(): Promise<void> {
    await this.starting?.catch(() => {});
    const { client } = this;
    this.client = undefined;
    this.starting = undefined;
    this.formatters?.dispose();
    this.runsOf.clear();
    if (!client) return;
    try {
      if (client.needsStop()) await client.stop();
      await client.dispose();
    } catch (error) {
      this.output.warn(`stopping the language server: ${told(error)}`);
    }
  }

  async dispose(): Promise<void> {
    this.isEnded = true;
    await this.stop();
    for (const one of this.rest) one.dispose();
  }
}

// Formatting, which the client would offer for all XML, for trees alone.
function formatTrees(client: BaseLanguageClient): vscode.Disposable {
  const feature = client.getFeature(DocumentFormattingRequest.method);
  const { initialize } = feature;
  let isOffered = false;
  feature.initialize = (capabilities: ServerCapabilities): void => {
    isOffered = Boolean(capabilities.documentFormattingProvider);
    initialize?.call(feature, capabilities,
                     LANGUAGES.map((language) => ({ language })));
  };
  return new TreeFormatters({
    provideDocumentFormattingEdits: async (document, options, token) => {
      if (!isOffered) return undefined;
      const edits = await client.sendRequest(DocumentFormattingRequest.type, {
        textDocument: { uri: document.uri.toString() },
        options: client.code2ProtocolConverter
          .asFormattingOptions(options, {}) }, token);
      return client.protocol2CodeConverter.asTextEdits(edits, token);
    },
  });
}

export function told(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
