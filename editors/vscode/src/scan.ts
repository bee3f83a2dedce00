// SPDX-License-Identifier: MIT
//
// What can be said of a text without a search: which parts it has. Tolerant: a
// text is scanned while it is typed. It knows nothing of VS Code.

export interface Part {
  kind: "tree" | "node" | "leaf" | "declaration" | "rule" | "section";
  name: string;
  detail: string;
  /** Offsets in the text: of all of it, and of its name. */
  begin: number;
  end: number;
  nameBegin: number;
  nameEnd: number;
  parts: Part[];
}

export type Language = "btf" | "btcheck-leaves" | "btcheck-rules" | "xml";

/** Whether an XML text is about behavior trees; other XML is none of ours. */
export function isTreeXml(text: string): boolean {
  return /<(BehaviorTree|TreeNodesModel)[\s/>]|\bBTCPP_format\b/
    .test(text.slice(0, 200_000));
}

export function scan(language: string, text: string): Part[] {
  switch (language) {
    case "btf":
    case "btcheck-leaves": return scanForms(text);
    case "btcheck-rules": return scanRules(text);
    case "xml": return isTreeXml(text) ? scanXml(text) : [];
    default: return [];
  }
}

const DEEPEST = 500;  // what is nested deeper is no part: btcheck refuses it
const LEAVES = /^(action|condition|setsv|eval|wait)$/i;
const DECLARATIONS = /^(defsv|defaction|defcondition|defun|defenum|trees)$/i;
const OPERATORS = /^(:=|=|~=|\/=|!=|<|<=|>|>=|and|or|~|not|\+|-|\*|\/|mod)$/i;

interface Open { part?: Part; words: Token[] }
interface Token { text: string; begin: number; end: number }

// Lists of .btf whose head says that they are nodes or declarations.
function scanForms(text: string): Part[] {
  const found: Part[] = [];
  const open: Open[] = [];
  const tokens = /;[^\n]*|\(\*@.*?@\*\)|"[^"\n]*"?|[()]|[^\s()";]+/g;
  const close = (end: number): void => {
    const list = open.pop();
    const part = list && partOf(list, end);
    if (!part) return;
    const above = open.findLast((one) => one.part)?.part;
    (above ? above.parts : found).push(part);
  };
  for (const { 0: word, index } of text.matchAll(tokens)) {
    if (word.startsWith(";") || word.startsWith("(*@")) continue;
    const end = index + word.length;
    if (word === "(") {
      open.push({ words: [] });
      continue;
    }
    if (word === ")") {
      close(end);
      continue;
    }
    const list = open.at(-1);
    if (!list) continue;
    list.words.push({ text: word, begin: index, end });
    if (list.words.length === 1 && open.length < DEEPEST && isNamedForm(word)) {
      list.part = { kind: "node", name: word, detail: "", parts: [],
                    begin: text.lastIndexOf("(", index), end,
                    nameBegin: index, nameEnd: end };
    }
  }
  while (open.length > 0) close(text.length);
  return found;
}

// A list of values, `(Good Low)`, does not begin like a type of nodes: those
// are few, but programs of tomorrow may have more.
function isNamedForm(head: string): boolean {
  return DECLARATIONS.test(head) ||
    !OPERATORS.test(head) && /^[A-Z]\w+$/.test(head) ||
    LEAVES.test(head) || /^behaviortree$/i.test(head);
}

function partOf({ part, words }: Open, end: number): Part | undefined {
  if (!part || !words[0]) return undefined;
  part.end = end;
  const head = words[0].text;
  const value = (keyword: string): Token | undefined => {
    const at = words.findIndex(({ text }) => text.toLowerCase() === keyword);
    return at < 0 ? undefined : words[at + 1];
  };
  const isDeclaration = DECLARATIONS.test(head);
  const name = isDeclaration ? words[1] : value(":name") ?? value(":id");
  // `(Good Low)` below :states begins with a capital as well.
  const isNode = isDeclaration || name || part.parts.length > 0 ||
    LEAVES.test(head) || words.length === 1 ||
    words[1]?.text.startsWith(":");
  if (!isNode) return undefined;
  part.kind = isDeclaration ? "declaration"
    : /^behaviortree$/i.test(head) ? "tree"
    : LEAVES.test(head) ? "leaf" : "node";
  if (name) {
    part.name = name.text;
    part.detail = head;
    part.nameBegin = name.begin;
    part.nameEnd = name.end;
  }
  return part;
}

// Titles, properties and definitions of rules.
function scanRules(text: string): Part[] {
  const found: Part[] = [];
  const comments = /\/\*[\s\S]*?(?:\*\/|$)|"[^"\n]*"?|(?:#|\/\/|;).*/g;
  // As long as before, so that offsets stay; lines too.
  const bare = text.replace(comments, (all) =>
    all.startsWith("\"") ? all : all.replace(/[^\n]/g, " "));
  const items = new RegExp("^[ \\t]*(property|prove|let|assume|tree|assert|" +
    "expect|tick)\\b(?:[ \\t]+(\"[^\"\\n]*\"|[\\p{L}\\p{N}_]+))?", "gimu");
  for (const match of bare.matchAll(items)) {
    const [all, word = "", name] = match;
    const begin = match.index + all.length - all.trimStart().length;
    if (found.length > 0) trim(found.at(-1)!, text, begin);
    const nameEnd = match.index + all.length;
    found.push({
      kind: /^(property|prove|assert)$/i.test(word) ? "rule" : "declaration",
      name: name ?? word, detail: name ? word : "", begin, end: text.length,
      nameBegin: name ? nameEnd - name.length : begin, nameEnd, parts: [] });
  }
  if (found.length > 0) trim(found.at(-1)!, bare, text.length);
  // `expect violated` stands above its property, and is no part by itself.
  return found.filter(({ name, detail }) =>
    !/^(expect|tick)$/i.test(detail || name));
}

// Ends a part where its text does: before blanks and comments.
function trim(part: Part, text: string, end: number): void {
  const inside = text.slice(part.begin, end).replace(/\s+$/, "");
  part.end = Math.max(part.nameEnd, part.begin + inside.length);
}

// Elements of an XML tree.
function scanXml(text: string): Part[] {
  const found: Part[] = [];
  const open: Part[] = [];
  const tags = new RegExp("<!--[\\s\\S]*?(?:-->|$)|<!\\[CDATA\\[[\\s\\S]*?" +
    "(?:\\]\\]>|$)|<[?!][^>]*>?|<(/?)([\\w.:-]+)((?:[^>\"'/]|\"[^\"]*\"|" +
    "'[^']*'|/(?!>))*)(/?)>?", "g");
  const finish = (end: number): void => {
    const part = open.pop();
    if (part) part.end = end;
  };
  for (const match of text.matchAll(tags)) {
    const [all, slash, tag, attributes = "", isClosed] = match;
    if (!tag) continue;
    const end = match.index + all.length;
    if (slash) {
      const at = open.findLastIndex(({ detail, name }) =>
        (detail || name) === tag);
      if (at < 0) continue;
      while (open.length > at) finish(end);
      continue;
    }
    const part = xmlPart(tag, attributes, match.index, end);
    const above = open.at(-1);
    if (open.length < DEEPEST) (above ? above.parts : found).push(part);
    if (!isClosed) open.push(part);
    else if (part.kind === "node") part.kind = "leaf";
  }
  while (open.length > 0) finish(text.length);
  return found;
}

function xmlPart(tag: string, attributes: string, begin: number,
                 end: number): Part {
  const value = (name: string): RegExpExecArray | null =>
    new RegExp(`(?:^|\\s)${name}\\s*=\\s*(?:"([^"]*)"|'([^']*)')`)
      .exec(attributes);
  const named = value("name") ?? value("ID");
  const name = named?.[1] ?? named?.[2];
  const tagBegin = begin + 1;
  return {
    kind: tag === "BehaviorTree" ? "tree"
      : /^(root|include|TreeNodesModel)$/.test(tag) ? "section" : "node",
    name: name || tag, detail: name ? tag : "", begin, end,
    nameBegin: tagBegin, nameEnd: tagBegin + tag.length, parts: [] };
}

/** The innermost node or tree around an offset, or just before it. */
export function around(parts: readonly Part[], offset: number):
    Part | undefined {
  for (const part of [...parts].reverse()) {
    if (offset < part.begin || offset > part.end) continue;
    const inner = around(part.parts, offset);
    if (inner) return inner;
    return part.kind === "declaration" || part.kind === "section"
      ? undefined : part;
  }
  return undefined;
}
