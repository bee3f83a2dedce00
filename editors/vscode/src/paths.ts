// SPDX-License-Identifier: MIT
//
// Names of files on two sides: the server has paths, the editor addresses. What
// both have in common is the way from the tree's folder to another file.

/** The folder of a path, with its last slash. */
export function folderOf(path: string): string {
  return path.slice(0, path.lastIndexOf("/") + 1);
}

/** The way from a folder to a path: `../common/dock.xml`. */
export function wayTo(folder: string, path: string): string {
  const from = folder.split("/").slice(0, -1);
  const to = path.split("/");
  const differs = from.findIndex((name, i) => name !== to[i]);
  const common = differs < 0 ? from.length : differs;
  return [...from.slice(common).map(() => ".."), ...to.slice(common)].join("/");
}

/** Where a way leads to. */
export function along(folder: string, way: string): string {
  const parts: string[] = [];
  for (const part of (folder + way).split("/")) {
    if (part === ".." && parts.length > 0 && parts.at(-1) !== "..") parts.pop();
    else if (part !== ".") parts.push(part);
  }
  return parts.join("/");
}
