#!/usr/bin/env node
// SPDX-License-Identifier: MIT
//
// A language server of this machine for editors in a browser: each connection
// to a WebSocket gets a process `btcheck lsp` of its own.
//   node bridge.mjs [--port 0] [--program btcheck] [--secret WORD]
//     [--map PREFIX=FOLDER]…
// Prints the address, which has a secret in it: without that, every page that
// this machine's browsers have open could read files here.
import { spawn } from "node:child_process";
import { randomBytes, timingSafeEqual } from "node:crypto";
import { createServer } from "node:http";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { parseArgs } from "node:util";

import { WebSocketServer } from "ws";

const { values: options } = parseArgs({ options: {
  port: { type: "string", default: "0" },
  program: { type: "string", default: "btcheck" },
  secret: { type: "string", default: randomBytes(16).toString("hex") },
  map: { type: "string", multiple: true, default: [] } } });

// Addresses of the editor's files, and the folders that they are here.
const places = options.map.map((pair) => {
  const at = pair.lastIndexOf("=");
  if (at < 1) throw new Error(`--map ${pair}: it is PREFIX=FOLDER`);
  return { there: pair.slice(0, at).replace(/\/$/, ""),
           here: pathToFileURL(path.resolve(pair.slice(at + 1))).href };
});

// A message with each address below `from` as one below `to`.
function moved(value, from, to) {
  if (typeof value === "string") {
    for (const place of places) {
      const rest = value.slice(place[from].length);
      if (value.startsWith(place[from]) && (rest === "" || rest[0] === "/")) {
        return place[to] + rest;
      }
    }
    return value;
  }
  if (Array.isArray(value)) return value.map((one) => moved(one, from, to));
  if (value === null || typeof value !== "object") return value;
  return Object.fromEntries(Object.entries(value).map(([key, one]) =>
    [moved(key, from, to), moved(one, from, to)]));
}

// Messages behind their `Content-Length`, as a server writes them.
function* messages(buffer) {
  for (;;) {
    const end = buffer.bytes.indexOf("\r\n\r\n");
    if (end < 0) return;
    const head = buffer.bytes.subarray(0, end).toString("ascii");
    const length = Number(/^Content-Length: *(\d+)/im.exec(head)?.[1]);
    if (!Number.isInteger(length)) throw new Error(`no message: ${head}`);
    const from = end + 4;
    if (buffer.bytes.length < from + length) return;
    yield JSON.parse(buffer.bytes.subarray(from, from + length).toString());
    buffer.bytes = buffer.bytes.subarray(from + length);
  }
}

function serve(socket) {
  const server = spawn(options.program, ["lsp"],
                       { stdio: ["pipe", "pipe", "inherit"] });
  server.on("error", (error) => {
    console.error(`${options.program}: ${error.message}`);
    socket.close(1011, "the program cannot be started");
  });
  server.on("exit", () => socket.close());
  server.stdin.on("error", () => {});
  socket.on("close", () => {
    server.stdin.end();
    setTimeout(() => server.kill(), 2000).unref();
  });
  socket.on("message", (data) => {
    let message;
    try {
      message = JSON.parse(data.toString());
    } catch {
      return socket.close(1007, "no JSON");
    }
    const text = JSON.stringify(places.length > 0
      ? moved(message, "there", "here") : message);
    server.stdin.write(
      `Content-Length: ${Buffer.byteLength(text)}\r\n\r\n${text}`);
  });
  const buffer = { bytes: Buffer.alloc(0) };
  server.stdout.on("data", (data) => {
    buffer.bytes = Buffer.concat([buffer.bytes, data]);
    for (const message of messages(buffer)) {
      socket.send(JSON.stringify(moved(message, "here", "there")));
    }
  });
}

function isSecret(url) {
  const given = Buffer.from(url ?? "");
  const wanted = Buffer.from(`/${options.secret}`);
  return given.length === wanted.length && timingSafeEqual(given, wanted);
}

const http = createServer((_, response) => response.writeHead(404).end());
const sockets = new WebSocketServer({ noServer: true });
http.on("upgrade", (request, socket, head) => {
  if (!isSecret(request.url)) {
    socket.end("HTTP/1.1 403 Forbidden\r\n\r\n");
    return;
  }
  sockets.handleUpgrade(request, socket, head, serve);
});
http.listen(Number(options.port), "127.0.0.1", () => {
  console.log(`ws://127.0.0.1:${http.address().port}/${options.secret}`);
});
