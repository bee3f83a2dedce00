// SPDX-License-Identifier: MIT
//
// Makes what highlights .btf files, rules and contracts from the words of the
// program (words.mjs): TextMate grammars for VS Code, and whoever else reads
// them, syntax files for Vim and Neovim, words for Emacs.
//   node editors/vscode/script/grammars.mjs           writes them
//   node editors/vscode/script/grammars.mjs --check   says which are not current
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";

import { root, words } from "./words.mjs";

const escaped = (word) => word.replace(/[\\^$.*+?()[\]{}|/]/g, "\\$&");
const longestFirst = (list) =>
  [...list].sort((a, b) => b.length - a.length || (a < b ? -1 : 1));
const oneOf = (list) => longestFirst(list).map(escaped).join("|");

// A word of .btf ends at a blank, a parenthesis, a quote or a comment.
const END = "(?=[\\s()\";]|$)";
const BEGIN = "(?<![^\\s()\\[\\],])";

function btfGrammar(forms, name, scope) {
  const { types, keywords, operators, values } = words().btf;
  const own = scope.replace("source.", "");
  const head = (list, as, before = "(?i)") => ({
    match: `${before}(\\()\\s*(${oneOf(list)})${END}`,
    captures: { 1: { name: `punctuation.section.list.${own}` },
                2: { name: as } } });
  return {
    name, scopeName: scope,
    patterns: [{ include: "#all" }],
    repository: { all: { patterns: [
      { match: ";.*$", name: `comment.line.semicolon.${own}` },
      { match: "\\(\\*@.*?@\\*\\)", name: `invalid.illegal.label.${own}` },
      { begin: "\"", end: "\"|$", name: `string.quoted.double.${own}` },
      { match: `(?i)(\\()\\s*(${oneOf(forms.filter((form) =>
                 form.startsWith("def")))})\\s+("[^"]*"|[^\\s()";]+)`,
        captures: { 1: { name: `punctuation.section.list.${own}` },
                    2: { name: `keyword.declaration.${own}` },
                    3: { name: `entity.name.function.${own}` } } },
      head(forms, `keyword.declaration.${own}`),
      head(types, `entity.name.type.node.${own}`),
      head(operators, `keyword.operator.${own}`, ""),
      { match: `(?i)(:(?:name|ID|sv))\\s+([^\\s()";:]+)`,
        captures: { 1: { name: `entity.other.attribute-name.${own}` },
                    2: { name: `entity.name.function.${own}` } } },
      { match: `(?i)${BEGIN}:(?:${oneOf(keywords)})${END}`,
        name: `entity.other.attribute-name.${own}` },
      { match: `(?i)${BEGIN}:?(?:${oneOf(values)})(?=[\\s()";,\\]]|$)`,
        name: `constant.language.${own}` },
      { match: `${BEGIN}[-+]?\\.?\\d[\\d.]*(?:[eE][-+]?\\d+)?(?:ms|s)?` +
               "(?=[\\s()\";,\\]]|$)",
        name: `constant.numeric.${own}` },
      { match: "\\$[^\\s()\";]+", name: `variable.other.${own}` },
      { match: `([^\\s()";]+)(\\.rstatus)${END}`,
        captures: { 1: { name: `variable.other.node.${own}` },
                    2: { name: `support.variable.event.${own}` } } },
      { match: "[()]", name: `punctuation.section.list.${own}` },
      { match: "[\\[\\],]", name: `punctuation.section.interval.${own}` },
    ] } },
  };
}

function rulesGrammar() {
  const own = "btcheck-rules";
  const rules = words().rules;
  const singles = (list) => list.filter((word) => word.length === 1);
  const longer = (list) => list.filter((word) => word.length > 1);
  // A word; behind a point it is an event, before one the name of a node.
  const word = (list, as) => {
    const of = (some, before) => `${before}(?<![\\w.])(?:${oneOf(some)})` +
      "(?![\\w.@])";
    const patterns = [];
    if (longer(list).length > 0) {
      patterns.push({ match: of(longer(list), "(?i)"), name: `${as}.${own}` });
    }
    if (singles(list).length > 0) {  // these have a case
      patterns.push({ match: of(singles(list), ""), name: `${as}.${own}` });
    }
    return patterns;
  };
  const { patterns, scopes } = rules.macros;
  const constants = ["true", "false", "T"];
  return {
    name: "btcheck rules", scopeName: "source.btcheck-rules",
    patterns: [
      { match: "^\\s*(##)(?!#)(.*)$", name: `comment.line.documentation.${own}`,
        captures: { 2: { name: `markup.heading.${own}` } } },
      { match: "(?:#|//|;).*$", name: `comment.line.${own}` },
      { begin: "/\\*", end: "\\*/", name: `comment.block.${own}` },
      { match: "\"[^\"\\n]*\"", name: `string.quoted.double.${own}` },
      { match: "(?i)(?<![\\w.])(property|prove|assert)\\s+" +
               "([\\p{L}_][\\p{L}\\p{N}_]*)(?=\\s*(?:\\[|:|is\\b|expect\\b|$))",
        captures: { 1: { name: `keyword.declaration.${own}` },
                    2: { name: `entity.name.function.${own}` } } },
      { match: "(?i)(?<![\\w.])(let)\\s+([\\p{L}_][\\p{L}\\p{N}_]*)(?=\\s*=)",
        captures: { 1: { name: `keyword.declaration.${own}` },
                    2: { name: `entity.name.constant.${own}` } } },
      { match: `(?i)(?<![\\w.])(expect)\\s+(${oneOf(rules.verdicts)})\\b`,
        captures: { 1: { name: `keyword.declaration.${own}` },
                    2: { name: `constant.language.verdict.${own}` } } },
      { match: `(?i)^\\s*(tick)\\s+(${oneOf(rules.ticks)})\\b`,
        captures: { 1: { name: `keyword.declaration.${own}` },
                    2: { name: `constant.language.${own}` } } },
      { match: `(?i)(?<![\\w.])(?:in\\s+)?(?:${oneOf(rules.tickWords)})\\s+` +
               "tick\\b", name: `keyword.control.${own}` },
      { match: `(?i)(\\.)\\s*(${oneOf(rules.events)}|ends|passes)\\b`,
        captures: { 2: { name: `support.variable.event.${own}` } } },
      { match: "(?i)(?<=/)\\s*(state|value|tag|event)\\b",
        name: `keyword.other.${own}` },
      { match: `(?i)(?<![\\w.])(?:${oneOf(patterns)})(?:${oneOf(scopes)})\\b`,
        name: `keyword.control.${own}` },
      ...word(constants, "constant.language"),
      ...word(rules.items, "keyword.declaration"),
      ...word(rules.operators, "keyword.operator.word"),
      ...word([...rules.opening, ...rules.joining, ...rules.other]
                .filter((one) => !constants.includes(one) &&
                                 !rules.operators.includes(one) &&
                                 !rules.items.includes(one)),
              "keyword.control"),
      ...word(["first", "once", "previously", "ticks"], "keyword.control"),
      ...word(["success", "failure", "running", "skipped", "inf", "infinity"],
              "constant.language"),
      { match: "@\\d+", name: `constant.numeric.line.${own}` },
      { match: "\\b\\d+(?:\\.\\d+)?\\b", name: `constant.numeric.${own}` },
      { match: oneOf([...rules.symbols, "..."]),
        name: `keyword.operator.${own}` },
    ],
  };
}

// Of Vim: a word may hold what stands in a word of the language.
function vimOf(name, { forms, keep }) {
  const lines = ["\" SPDX-License-Identifier: MIT",
                 `\" Made by editors/vscode/script/grammars.mjs: ${name}.`,
                 "if exists(\"b:current_syntax\") | finish | endif", ...keep];
  for (const [group, list, link] of forms) {
    lines.push(`syntax keyword ${group} ${longestFirst(list).join(" ")}`);
    lines.push(`highlight default link ${group} ${link}`);
  }
  return [...lines, `let b:current_syntax = "${name}"`, ""].join("\n");
}

function vimBtf(name, forms) {
  const { types, keywords, operators, values } = words().btf;
  return vimOf(name, {
    keep: [
      "syntax case ignore",
      "syntax iskeyword @,48-57,_,-,:",
      "syntax match btfComment \";.*$\" contains=@Spell",
      "syntax region btfString start=+\"+ end=+\"+ oneline",
      "syntax match btfNumber \"\\<[-+]\\?\\d[0-9.]*\\(ms\\|s\\)\\?\\>\"",
      "syntax match btfVariable \"\\$[^ \\t()\\\";]\\+\"",
      `syntax match btfOperator "(\\s*\\zs\\(${longestFirst(operators)
        .map((sign) => sign.replace(/[*~/]/g, "\\$&")).join("\\|")}\\)\\ze\\s"`,
      "highlight default link btfComment Comment",
      "highlight default link btfString String",
      "highlight default link btfNumber Number",
      "highlight default link btfVariable Identifier",
      "highlight default link btfOperator Operator"],
    forms: [["btfForm", forms, "Structure"], ["btfType", types, "Type"],
            ["btfKeyword", keywords.map((word) => `:${word}`), "Label"],
            ["btfValue", [...values, ":all"], "Constant"]] });
}

function vimRules() {
  const { items, operators, joining, opening, other, events, verdicts } =
    words().rules;
  const logic = new Set(operators);
  return vimOf("btcheck-rules", {
    keep: [
      "syntax case match",
      "syntax match btruleComment \"#.*$\\|//.*$\\|;.*$\" contains=@Spell",
      "syntax match btruleTitle \"^\\s*##[^#].*$\" contains=@Spell",
      "syntax region btruleComment start=\"/\\*\" end=\"\\*/\"",
      "syntax region btruleString start=+\"+ end=+\"+ oneline",
      "syntax match btruleNumber \"\\<\\d\\+\\>\"",
      `syntax match btruleEvent "\\.\\s*\\zs\\(${
        longestFirst(events).join("\\|")}\\|ends\\|passes\\)\\>"`,
      "highlight default link btruleComment Comment",
      "highlight default link btruleTitle SpecialComment",
      "highlight default link btruleString String",
      "highlight default link btruleNumber Number",
      "highlight default link btruleEvent Special"],
    forms: [["btruleLogic", operators, "Operator"],
            ["btrulePattern", [...opening, ...joining, ...other]
              .filter((word) => !logic.has(word) && !items.includes(word)),
             "Statement"],
            ["btruleItem", items, "Structure"],
            ["btruleVerdict", verdicts, "Constant"]] });
}

// Of Emacs: lists that its modes make expressions of.
function emacsWords() {
  const { btf, rules } = words();
  const list = (name, some) => `(defconst btcheck-words-${name}\n  '(` +
    [...new Set(some)].sort().map((word) => `"${word}"`).join("\n    ") +
    "))\n";
  const logic = new Set([...rules.operators, ...rules.items]);
  return `;;; btcheck-words.el --- What btcheck reads  -*- lexical-binding: t -*-

;; SPDX-License-Identifier: MIT

;;; Commentary:

;; Made by editors/vscode/script/grammars.mjs.

;;; Code:

${list("forms", [...btf.forms, ...btf.leafForms])}
${list("types", btf.types)}
${list("items", rules.items)}
${list("logic", rules.operators)}
${list("patterns", [...rules.opening, ...rules.joining, ...rules.other]
  .filter((word) => !logic.has(word)))}
${list("events", rules.events)}
(provide 'btcheck-words)
;;; btcheck-words.el ends here
`;
}

const json = (value) => JSON.stringify(value, null, 2) + "\n";
export function files() {
  const { forms, leafForms } = words().btf;
  return {
    "editors/vscode/syntaxes/btf.tmLanguage.json":
      json(btfGrammar(forms, "Behavior tree (.btf)", "source.btf")),
    "editors/vscode/syntaxes/leaves.tmLanguage.json":
      json(btfGrammar(leafForms, "btcheck leaf contracts",
                      "source.btcheck-leaves")),
    "editors/vscode/syntaxes/rules.tmLanguage.json": json(rulesGrammar()),
    "editors/neovim/syntax/btf.vim": vimBtf("btf", forms),
    "editors/neovim/syntax/btcheck-leaves.vim":
      vimBtf("btcheck-leaves", leafForms),
    "editors/neovim/syntax/btcheck-rules.vim": vimRules(),
    "editors/emacs/btcheck-words.el": emacsWords(),
  };
}

if (process.argv[1]?.endsWith("grammars.mjs")) {
  const isCheck = process.argv.includes("--check");
  let stale = 0;
  for (const [name, text] of Object.entries(files())) {
    const file = path.join(root, name);
    if (existsSync(file) && readFileSync(file, "utf8") === text) continue;
    ++stale;
    if (isCheck) {
      console.error(`${name} does not have the words of src: run ` +
                    "`node editors/vscode/script/grammars.mjs`");
    } else {
      mkdirSync(path.dirname(file), { recursive: true });
      writeFileSync(file, text);
      console.log(name);
    }
  }
  process.exitCode = isCheck && stale > 0 ? 1 : 0;
}
