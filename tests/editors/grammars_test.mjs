// SPDX-License-Identifier: MIT
//
// What highlights trees, rules and contracts in editors: that it knows the words
// of the program, and what becomes of them in all files of the repository.
//   node grammars_test.mjs MODULES      a folder with vscode-textmate and
//                                       vscode-oniguruma below node_modules
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { test } from "node:test";

import { files } from "../../editors/vscode/script/grammars.mjs";
import { root, words } from "../../editors/vscode/script/words.mjs";

const require = createRequire(path.resolve(process.argv[2], "modules.js"));
const { INITIAL, Registry, parseRawGrammar } = require("vscode-textmate");
const { OnigScanner, OnigString, loadWASM } = require("vscode-oniguruma");

const extension = path.join(root, "editors/vscode");
const about = JSON.parse(readFileSync(`${extension}/package.json`, "utf8"));
await loadWASM(readFileSync(
  path.join(path.dirname(require.resolve("vscode-oniguruma")), "onig.wasm")));
const registry = new Registry({
  onigLib: Promise.resolve({
    createOnigScanner: (sources) => new OnigScanner(sources),
    createOnigString: (text) => new OnigString(text) }),
  loadGrammar: async (scope) => {
    const { path: name } = about.contributes.grammars.find((one) =>
      one.scopeName === scope);
    const file = path.join(extension, name);
    return parseRawGrammar(readFileSync(file, "utf8"), file);
  } });

// The tokens of a text: what is written, and its innermost scope.
async function tokens(language, text) {
  const { scopeName } = about.contributes.grammars.find((one) =>
    one.language === language);
  const grammar = await registry.loadGrammar(scopeName);
  const found = [];
  let stack = INITIAL;
  for (const line of text.split("\n")) {
    const { tokens: parts, ruleStack } = grammar.tokenizeLine(line, stack);
    for (const { startIndex, endIndex, scopes } of parts) {
      found.push({ line, from: startIndex,
                   text: line.slice(startIndex, endIndex),
                   scope: scopes.at(-1) });
    }
    stack = ruleStack;
  }
  return { found, isClosed: stack.depth === 1 };
}

// The scope of a word that stands once in a text; what has no scope of its own
// is one token with its surroundings.
async function scopeOf(language, text, word) {
  const { found } = await tokens(language, text);
  const token = found.find((one) => one.text.trim() === word) ??
    found.find((one) => one.text.includes(word));
  assert.ok(token, `${language}: \`${word}\` is no token of \`${text}\`: ` +
                   JSON.stringify(found.map((one) => one.text)));
  return token.scope;
}

const { btf, rules } = words();

test("what is made from the words of src is current", () => {
  for (const [name, text] of Object.entries(files())) {
    assert.equal(readFileSync(path.join(root, name), "utf8"), text,
                 `${name}: run \`node editors/vscode/script/grammars.mjs\``);
  }
});

test("each word of .btf files and contracts is highlighted", async () => {
  for (const [language, forms] of [["btf", btf.forms],
                                   ["btcheck-leaves", btf.leafForms]]) {
    const check = async (text, word, wanted) => assert.match(
      await scopeOf(language, text, word), wanted, `${word} in ${text}`);
    for (const form of forms) {
      for (const word of [form, form.toLowerCase(), form.toUpperCase()]) {
        await check(`(${word} it)`, word, /^keyword\.declaration\./);
      }
    }
    for (const type of btf.types.filter((one) => !forms.includes(one))) {
      for (const word of [type, type.toLowerCase()]) {
        await check(`( ${word}\n)`, word, /^entity\.name\.type\.node\./);
      }
    }
    for (const sign of btf.operators) {
      await check(`(${sign} a b)`, sign, /^keyword\.operator\./);
    }
    for (const keyword of btf.keywords) {
      await check(`(x :${keyword})`, `:${keyword}`,
                  /^entity\.other\.attribute-name\./);
    }
    for (const value of btf.values) {
      await check(`(x (${value}))`, value, /^constant\.language\./);
    }
    await check("(x :transitions :all)", ":all", /^constant\.language\./);
    await check("(x :max 5)", "5", /^constant\.numeric\./);
    await check("(x [2,inf])", "inf", /^constant\.language\./);
    await check("(x [0.5s,2.5s])", "0.5s", /^constant\.numeric\./);
    await check("(x $goal)", "$goal", /^variable\.other\./);
    await check("(x photo.rstatus)", ".rstatus", /^support\.variable\.event\./);
    await check("(x \"a ; b\")", "a ; b", /^string\.quoted\./);
    await check("(x) ; (Sequence", "; (Sequence", /^comment\.line\./);
    // What only begins like one is none.
    await check("(x)(Sequences)", "Sequences", new RegExp(`^source.${language}`));
    await check("(x :waiting 1)", ":waiting", new RegExp(`^source.${language}`));
  }
});

test("each word of rules is highlighted", async () => {
  const check = async (text, word, wanted) => assert.match(
    await scopeOf("btcheck-rules", text, word), wanted, `${word} in ${text}`);
  const keyword = /^(keyword|constant\.language)\./;
  const known = new Set([...rules.opening, ...rules.joining, ...rules.other,
                         ...rules.operators, ...rules.items]);
  for (const word of known) {
    await check(`(${word} (a`, word, keyword);
    // Single letters have a case, the other words do not.
    const other = word.length > 1 ? word.toUpperCase() : word.toLowerCase();
    await check(`(${other} (a`, other, word.length > 1 ? keyword : /^source\./);
    // A part of a name is none.
    await check(`${word}_x = 1`, `${word}_x`, /^source\./);
  }
  for (const sign of rules.symbols) {
    await check(`a ${sign} b`, sign, /^keyword\.operator\./);
  }
  for (const event of rules.events) {
    await check(`land.${event} =>`, event, /^support\.variable\.event\./);
  }
  for (const pattern of rules.macros.patterns) {
    for (const scope of rules.macros.scopes) {
      await check(`${pattern}${scope} P Q`, pattern + scope,
                  /^keyword\.control\./);
    }
  }
  for (const verdict of rules.verdicts) {
    await check(`expect ${verdict}`, verdict, /^constant\.language\.verdict\./);
  }
  for (const ticks of rules.ticks) {
    await check(`tick ${ticks}`, ticks, /^constant\.language\./);
  }
  for (const word of rules.tickWords) {
    await check(`in ${word} tick: P`, `in ${word} tick`, /^keyword\.control\./);
  }
  await check("property safe [x]:", "safe", /^entity\.name\.function\./);
  await check("let low = 1", "low", /^entity\.name\.constant\./);
  await check("land@23.ticked", "@23", /^constant\.numeric\.line\./);
  await check("## A title", "A title", /^markup\.heading\./);
  await check("a // never b", "// never b", /^comment\.line\./);
  await check("/* never\nalways */", "always", /^comment\.block\./);
  await check("x = \"never\"", "\"never\"", /^string\.quoted\./);
  await check("always.ticked", "always", /^source\./);
});

// The files of a kind that the repository has, but for inputs that are wrong on
// purpose; of the specifications, which are many and alike, every fifth.
function* texts(ending) {
  for (const place of ["examples", "properties", "bench", "tests/findings"]) {
    const names = readdirSync(path.join(root, place), { recursive: true })
      .filter((name) => name.endsWith(ending)).sort();
    for (const [i, name] of names.entries()) {
      if (place === "properties" && i % 5 > 0) continue;
      const file = path.join(root, place, name);
      yield [file, readFileSync(file, "utf8")];
    }
  }
}

const lower = (list) => new Set(list.map((word) => word.toLowerCase()));

test("every tree and contract of the repository is read to its end", async () => {
  let heads = 0;
  for (const [ending, language, forms] of [
    [".btf", "btf", btf.forms], [".leaves", "btcheck-leaves", btf.leafForms]]) {
    const [types, declarations] = [lower(btf.types), lower(forms)];
    const operators = new Set(btf.operators);
    const keywords = lower(btf.keywords);
    for (const [file, text] of texts(ending)) {
      const { found, isClosed } = await tokens(language, text);
      assert.ok(isClosed, file);
      found.forEach(({ text: word, scope, line }, i) => {
        const told = `${file}: \`${word}\` in \`${line}\` is ${scope}`;
        assert.doesNotMatch(scope, /^invalid/, told);
        const name = word.toLowerCase();
        const before = found[i - 1]?.text.trim();
        if (/^(comment|string)/.test(scope)) return;
        if (before === "(" || before?.endsWith("((")) {
          if (declarations.has(name)) assert.match(scope, /^keyword\.decl/, told);
          else if (types.has(name)) assert.match(scope, /^entity\.name\.ty/, told);
          else if (operators.has(word)) assert.match(scope, /^keyword\.op/, told);
          else return;
          ++heads;
        }
        // Whatever begins with a colon is a keyword that is known.
        if (/^:[a-z]/i.test(word) && word !== ":all") {
          assert.ok(keywords.has(name.slice(1)), told);
          assert.match(scope, /^entity\.other/, told);
        }
        // A known word is never left without a colour at the head of a list.
        const left = /\(\s*([A-Za-z]+)\s*$/.exec(word)?.[1]?.toLowerCase();
        assert.ok(!types.has(left) && !declarations.has(left), told);
      });
    }
  }
  assert.ok(heads > 500, `${heads} heads of lists`);
});

test("every word of every rule is highlighted", async () => {
  const known = [...rules.opening, ...rules.joining, ...rules.other,
                 ...rules.operators, ...rules.items];
  const anyCase = lower(known.filter((word) => word.length > 1));
  const letters = new Set(known.filter((word) => word.length === 1));
  let seen = 0;
  for (const [file, text] of texts(".ltl")) {
    const { found, isClosed } = await tokens("btcheck-rules", text);
    assert.ok(isClosed, file);
    for (const { text: part, scope, line, from } of found) {
      if (/^(comment|string|markup|entity)/.test(scope)) continue;
      for (const { 0: word, index } of part.matchAll(/[\p{L}\p{N}_]+/gu)) {
        if (!letters.has(word) && !anyCase.has(word.toLowerCase())) continue;
        const begin = from + index;
        const behind = line.slice(begin + word.length);
        // Names of nodes, events and tags.
        if (/[.@/[]\s*$/.test(line.slice(0, begin)) ||
            /^\s*[.@/]|^[\w, =-]*\]/.test(behind)) continue;
        assert.match(scope, /^(keyword|constant\.language)\./,
                     `${file}: \`${word}\` in \`${line}\``);
        ++seen;
      }
    }
  }
  assert.ok(seen > 500, `${seen} words`);
});

test("the problem matcher finds what btcheck prints", () => {
  const [{ pattern: [first, second] }] = about.contributes.problemMatchers;
  const text = readFileSync(path.join(root,
    "tests/regress/default_findings/expected"), "utf8").split("\n");
  let found = 0;
  text.forEach((line, i) => {
    if (!/^(error|warning|note)\[/.test(line)) return;
    ++found;
    const said = new RegExp(first.regexp).exec(line);
    assert.match(said[first.code], /^BT\d{4}$/);
    assert.ok(said[first.message].length > 10);
    const place = new RegExp(second.regexp).exec(text[i + 1]);
    assert.match(place[second.file], /\.(xml|btf)$/);
    assert.ok(Number(place[second.line]) > 0 &&
              Number(place[second.column]) > 0);
  });
  assert.ok(found > 0);
});

test("settings know the profiles of the program", () => {
  const table = readFileSync(path.join(root, "src/cli/options/tables.cpp"),
                             "utf8");
  const [, names] = /kProfileNames =\s*((?:"[^"]*"\s*)+);/.exec(table);
  const profiles = names.replace(/"\s*"|"/g, "").trim().split(" ");
  assert.ok(profiles.length > 20);
  assert.deepEqual(
    about.contributes.configuration.properties["btcheck.profile"].enum,
    ["", ...profiles]);
});
