// SPDX-License-Identifier: MIT
//
// Bundles the extension: one file for the desktop, one for browsers, and the
// licences of what is in them.
//   node script/build.mjs [--production]
import { build } from "esbuild";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "..");
const isProduction = process.argv.includes("--production");
const shared = {
  absWorkingDir: root, bundle: true, format: "cjs", external: ["vscode"],
  target: "es2022", minify: isProduction, sourcemap: !isProduction,
  legalComments: "eof", metafile: true, logLevel: "warning",
};

const made = await Promise.all([
  build({ ...shared, entryPoints: ["src/desktop.ts"], platform: "node",
          outfile: "dist/desktop.js", mainFields: ["module", "main"] }),
  build({ ...shared, entryPoints: ["src/web.ts"], platform: "browser",
          outfile: "dist/web.js" }),
]);

// The folder of the package that a bundled file is of.
const packages = new Set(made.flatMap(({ metafile }) =>
  Object.keys(metafile.inputs)
    .map((file) => /^.*node_modules\/(?:@[^/]+\/)?[^/]+/.exec(file)?.[0])
    .filter(Boolean)));
const licences = [...packages].sort().map((folder) => {
  const at = path.join(root, folder);
  const { name, version, license } =
    JSON.parse(readFileSync(path.join(at, "package.json")));
  const file = readdirSync(at).find((one) => /^licen[cs]e/i.test(one));
  if (!file) throw new Error(`${name} comes without its licence`);
  return `${name} ${version} (${license})\n\n` +
    readFileSync(path.join(at, file), "utf8").replaceAll("\r", "").trim();
});
writeFileSync(path.join(root, "dist/licences.txt"),
              licences.join(`\n\n${"-".repeat(72)}\n\n`) + "\n");
