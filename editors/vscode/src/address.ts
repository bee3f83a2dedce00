// SPDX-License-Identifier: MIT
//
// Which servers a text may be sent to: of this machine, or through encryption.

/** Why an address is not gone to, or "". */
export function refusal(address: string): string {
  let url: URL;
  try {
    url = new URL(address);
  } catch {
    return "it is no address";
  }
  if (url.protocol === "wss:") return "";
  if (url.protocol !== "ws:") return "it is no WebSocket: ws:// or wss://";
  return ["127.0.0.1", "localhost", "[::1]"].includes(url.hostname) ? ""
    : "a text is not sent through a network without encryption: wss://";
}
