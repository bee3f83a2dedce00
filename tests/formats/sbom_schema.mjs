// SPDX-License-Identifier: MIT
//
// Validates what script/sbom writes against the schema of CycloneDX 1.5, as the
// package cyclonedx-library comes with it, its licences against SPDX's list, and
// its components against cmake/sources.txt.
//
//   node tests/formats/sbom_schema.mjs SBOM build/formats
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [file, modules] = process.argv.slice(2).map((word) => resolve(word));
if (!modules) {
  console.error('usage: node sbom_schema.mjs SBOM FOLDER_OF_NODE_MODULES');
  process.exit(2);
}
const sources = dirname(dirname(dirname(fileURLToPath(import.meta.url))));
const require = createRequire(join(modules, 'node_modules', 'index.js'));
const Ajv = require('ajv').default ?? require('ajv');
const addFormats = require('ajv-formats').default ?? require('ajv-formats');
const schemas = join(modules, 'node_modules/@cyclonedx/cyclonedx-library',
  'res/schema');
const schema = (name) =>
  JSON.parse(readFileSync(join(schemas, `${name}.SNAPSHOT.schema.json`)));
const kHome = 'http://cyclonedx.org/schema/';
const licences = schema('spdx');
const ajv = new Ajv({ allErrors: true, strict: false });
addFormats(ajv);
ajv.addFormat('iri-reference', /^\S+$/);
ajv.addFormat('idn-email', /^\S+@\S+$/);
for (const name of ['spdx', 'jsf-0.82']) {
  ajv.addSchema({ ...schema(name), $id: `${kHome}${name}.SNAPSHOT.schema.json` });
}
const isValid = ajv.compile(schema('bom-1.5'));

const failures = [];
const bom = JSON.parse(readFileSync(file));
if (isValid({ ...bom, components: [{ name: 'no type' }] })) {
  failures.push('anything is valid');
}
if (!isValid(bom)) {
  failures.push(...isValid.errors.map((e) => `${e.instancePath} ${e.message}`));
}
const table = readFileSync(join(sources, 'cmake/sources.txt'), 'utf8');
const rows = [...table.matchAll(/^([^#\s]\S*) +(source|package) +(\S+) +(.+)$/gm)];
const sums = [...table.matchAll(/^([0-9a-f]{64})  (\S+)$/gm)];
for (const [, name, from, , licence] of rows) {
  const found = bom.components.find((each) => each.name === name);
  const said = found?.licenses[0].expression;
  if (said !== licence || !found.version || !found.purl.startsWith('pkg:deb/')) {
    failures.push(`${name} is not told as the table has it`);
  }
  // What SPDX has no word for is a reference to its text (SPDX 2.3, annex D).
  const isOwn = /^LicenseRef-[A-Za-z0-9.-]+$/.test(licence);
  if (!isOwn && !licences.enum.includes(licence.split(' WITH ')[0])) {
    failures.push(`SPDX knows no licence ${licence}`);
  }
  if (from === 'source' && !found?.externalReferences?.length) {
    failures.push(`${name} has no files`);
  }
}
const told = bom.components.flatMap((each) => each.externalReferences ?? [])
  .map((each) => `${each.hashes[0].content}  ${each.url}`).sort();
const wanted = sums.map(([line]) => line).sort();
if (rows.length !== bom.components.length || `${told}` !== `${wanted}`) {
  failures.push('the table has other components or files');
}
for (const each of failures) console.error(each);
console.log(`${bom.components.length} components with ${told.length} files, held ` +
  `against CycloneDX ${bom.specVersion}: ${failures.length} failures`);
process.exit(failures.length > 0 || rows.length === 0 ? 1 : 0);
