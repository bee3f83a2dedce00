// SPDX-License-Identifier: MIT
//
// Packs the extension, and prints the name of the file.
//   node script/package.mjs [FOLDER]
import { createVSIX } from "@vscode/vsce";
import { mkdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "..");
const folder = path.resolve(process.argv[2] ?? root);
const { name, version } = JSON.parse(readFileSync(`${root}/package.json`));
const packagePath = path.join(folder, `${name}-${version}.vsix`);
mkdirSync(folder, { recursive: true });
// Nothing of node_modules goes in: what is needed is in the bundles. Links of
// the README are for who has the sources, too.
await createVSIX({ cwd: root, packagePath, dependencies: false,
                   allowMissingRepository: true, rewriteRelativeLinks: false });
console.log(packagePath);
