// SPDX-License-Identifier: MIT
//
// A language server at the other end of a WebSocket, one message of JSON-RPC in
// each frame. Only on this machine, or encrypted.
import { AbstractMessageReader, AbstractMessageWriter, BaseLanguageClient,
         DataCallback, Disposable, LanguageClientOptions, Message,
         MessageTransports } from "vscode-languageclient";

import { refusal } from "./address";
import { Connect, told, Unreachable } from "./session";

const PATIENCE = 10_000;  // milliseconds until it must have answered

function opened(address: string): Promise<WebSocket> {
  const socket = new WebSocket(address);
  return new Promise((done, refuse) => {
    const giveUp = (): void => {
      socket.close();
      refuse(new Error("nobody answers at the address of `btcheck.server`, " +
                       new URL(address).host));
    };
    const timer = setTimeout(giveUp, PATIENCE);
    socket.addEventListener("open", () => {
      clearTimeout(timer);
      done(socket);
    });
    socket.addEventListener("close", giveUp);
  });
}

class SocketClient extends BaseLanguageClient {
  constructor(options: LanguageClientOptions, private readonly address: string,
              private first: WebSocket | undefined) {
    super("btcheck", "btcheck", options);
  }

  // Again for each start: a server that has gone is looked for anew.
  protected override async createMessageTransports(): Promise<MessageTransports> {
    const socket = this.first ?? await opened(this.address);
    this.first = undefined;
    return { reader: new SocketReader(socket),
             writer: new SocketWriter(socket) };
  }
}

class SocketReader extends AbstractMessageReader {
  constructor(private readonly socket: WebSocket) {
    super();
    socket.addEventListener("close", () => this.fireClose());
  }

  listen(callback: DataCallback): Disposable {
    const hear = ({ data }: MessageEvent): void => {
      try {
        callback(JSON.parse(String(data)) as Message);
      } catch (error) {
        this.fireError(error as Error);
      }
    };
    this.socket.addEventListener("message", hear);
    return { dispose: () => this.socket.removeEventListener("message", hear) };
  }
}

class SocketWriter extends AbstractMessageWriter {
  constructor(private readonly socket: WebSocket) {
    super();
    socket.addEventListener("close", () => this.fireClose());
  }

  async write(message: Message): Promise<void> {
    this.socket.send(JSON.stringify(message));
  }

  end(): void { this.socket.close(); }
}

/** Reaches the server at an address. */
export function overSocket(address: string): Connect {
  return async (options) => {
    const why = refusal(address);
    if (why) return new Unreachable(`\`btcheck.server\`, ${address}: ${why}`);
    if (typeof WebSocket === "undefined") {
      return new Unreachable("this editor has no WebSocket: leave " +
                             "`btcheck.server` empty, and set `btcheck.path`");
    }
    try {
      return new SocketClient(options, address, await opened(address));
    } catch (error) {
      return new Unreachable(told(error));
    }
  };
}
