// SPDX-License-Identifier: MIT
//
// The words of btcheck's languages, read from the program's own sources: the
// readers of .btf files, contracts and rules. What highlights them is made from
// these lists (grammars.mjs), so that it knows what the program knows.
import { readFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

export const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)),
                                 "../../..");

function source(file) {
  return readFileSync(path.join(root, "src", file), "utf8")
    .replace(/^\s*\/\/.*$|\s\/\/ .*$/gm, "");
}

// The text between what `begin` matches and the `end` behind it.
function part(file, begin, end) {
  const text = source(file);
  const from = text.search(begin);
  if (from < 0) throw new Error(`${file}: nothing matches ${begin}`);
  const to = text.indexOf(end, from);
  if (to < 0) throw new Error(`${file}: no ${end} behind ${begin}`);
  return text.slice(from, to);
}

// The first group of each match; `least`: fewer are a mistake in here.
function all(text, pattern, least) {
  const found = [...new Set([...text.matchAll(pattern)].map((m) => m[1]))];
  if (found.length < least) {
    throw new Error(`only ${found.length} words match ${pattern}`);
  }
  return found;
}

const QUOTED = /"([^"\s]+)"/g;

function nodeTypes() {
  const text = source("model/tree/node_types.hpp");
  const rows = text.slice(text.indexOf("kNodeTypes"));
  return all(rows, /NodeType::\w+,\s+"(\w+)",\s+In::(?:Btf|Both|All)\b/g, 20);
}

// Keywords of .btf forms, without the colon.
function keywords() {
  const tables = [["btf/nodes.cpp", /KeywordRule, \d+> kKeywords/],
                  ["btf/variables.cpp", /KeywordRule, \d+> kRules/],
                  ["btf/contracts.cpp", /std::array kContractRules/],
                  ["declared_entries.cpp", /KeywordRule, \d+> kEntryRules/]];
  return [...new Set(tables.flatMap(([file, begin]) =>
    all(part(`model/${file}`, begin, "};"), /\{\s*"([\w-]+)"/g, 5)))];
}

export function words() {
  const rules = (name) => part("ltl/rules/lexer.cpp", name, "};");
  return {
    btf: {
      types: nodeTypes(),
      forms: all(source("model/btf/reader.cpp"),
                 /is_head\(\*head, "(\w+)"\)/g, 6),
      leafForms: all(source("model/leaf_files.cpp"),
                     /equal_ignoring_case\(word, "(def\w+)"\)/g, 4),
      keywords: keywords(),
      operators: [":=", ...all(part("model/btf/expression.cpp",
                                    /kOperators = /, "};"),
                               /\{"([^"]+)", Operation::/g, 15)],
      values: ["success", "failure", "running", "skipped", "all", "free",
               "sampled", "inf", "yes", "no", "once", "anew"],
    },
    rules: {
      items: all(part("ltl/rules/parser.cpp", "kItems", "};"), QUOTED, 7),
      operators: all(rules("kOperatorWords"), QUOTED, 12),
      symbols: all(rules("kSymbols\\[\\]"),
                   /sign\("((?:[^"\\]|\\.)+)"/g, 30)
        .map((sign) => JSON.parse(`"${sign}"`)),
      joining: all(rules("kJoiningWords"), QUOTED, 10),
      opening: all(rules("words = "), QUOTED, 15),
      other: all(rules("kOtherWords"), QUOTED, 10),
      events: [...new Set([
        ...all(part("ltl/rules/event.cpp", /std::string event_of/, "})"),
               QUOTED, 8),
        ...all(part("ltl/rules/event.cpp", /> kEvents = /, "};"), QUOTED, 8),
        "rstatus"])],
      macros: {
        patterns: all(part("ltl/rules/body.cpp", /kMacroPatterns\[\]/, "};"),
                      /\{"(\w+)"/g, 5),
        scopes: all(part("ltl/rules/body.cpp", /kMacroScopes\[\]/, "};"),
                    /\{"(\w+)"/g, 5),
      },
      ticks: all(part("ltl/rules/reader.cpp", /words = \{"root"/, "};"),
                 QUOTED, 4),
      verdicts: all(part("ltl/rules/reader.cpp", /words = \{"holds"/, "};"),
                    QUOTED, 2),
      tickWords: all(part("ltl/rules/tick_rule.cpp", /\{"every"/, "};"),
                     /\{"(\w+)"/g, 3),
    },
  };
}
