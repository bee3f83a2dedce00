// SPDX-License-Identifier: MIT
//
// What the extension says of a text without a server: outline, folding, and the
// node around the cursor.
//   node scan_test.mjs EXTENSION     its folder, with node_modules
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import { fileURLToPath } from "node:url";

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");
const extension = path.resolve(process.argv[2]);
const { buildSync } = createRequire(`${extension}/x.js`)("esbuild");
const made = mkdtempSync(path.join(tmpdir(), "btcheck-scan-"));
after(() => rmSync(made, { recursive: true }));
for (const name of ["scan", "address", "paths"]) {
  buildSync({ entryPoints: [`${extension}/src/${name}.ts`], format: "cjs",
              platform: "node", outfile: `${made}/${name}.cjs` });
}
const require = createRequire(import.meta.url);
const { around, isTreeXml, scan } = require(`${made}/scan.cjs`);
const { along, folderOf, wayTo } = require(`${made}/paths.cjs`);
const { refusal } = require(`${made}/address.cjs`);

const read = (name) => readFileSync(path.join(root, name), "utf8");
// The outline as lines: kind, name, what it is.
const told = (parts, depth = 0) => parts.flatMap((part) =>
  [`${" ".repeat(depth)}${part.kind} ${part.name}` +
     (part.detail ? ` (${part.detail})` : ""),
   ...told(part.parts, depth + 1)]);

test("a .btf file", () => {
  const text = read("examples/drone3.btf");
  const outline = told(scan("btf", text));
  assert.deepEqual(outline.slice(0, 8), [
    "declaration fls (defsv)", "declaration battery (defsv)",
    "tree drone (BehaviorTree)", " node Sequence", "  node ParallelAll",
    "   leaf start_drone (Action)", "   leaf start_camera (Action)",
    "  node ReactiveSequence"]);
  assert.ok(outline.some((line) =>
    line.trim() === "leaf measure_battery (SetSV)"));
  // 38 nodes, as btcheck counts them, and two variables.
  assert.equal(outline.length, 40);
});

test("lists of values are no nodes, unfinished lists are", () => {
  assert.deepEqual(told(scan("btf",
    `(defsv w :states (Calm Storm) :transitions ((Calm Storm)))
     (BehaviorTree :name main ; (Sequence
      (Sequence (Action :ID go :args (x 1 name "a ) b"))
       (Fallback (Condition :ID`)), [
    "declaration w (defsv)", "tree main (BehaviorTree)", " node Sequence",
    "  leaf go (Action)", "  node Fallback", "   leaf Condition"]);
  for (const text of ["", ")", "(((", "\"", "(:name", "; x"]) {
    assert.deepEqual(scan("btf", text), []);
  }
});

test("rules", () => {
  assert.deepEqual(told(scan("btcheck-rules", `tree "a.btf"
## A title
let low = battery == Low   # let high
/* property none: */
property safe [x] expect violated:
    never low
expect holds
property old is absent P
prove always Q
`)), ["declaration \"a.btf\" (tree)", "declaration low (let)",
      "rule safe (property)", "rule old (property)", "rule always (prove)"]);
});

test("contracts", () => {
  assert.deepEqual(told(scan("btcheck-leaves",
                             read("examples/world/robot.leaves"))).slice(2, 6), [
    "declaration weather (defsv)", "declaration rounds (defsv)",
    "declaration IsBatteryLow (defcondition)",
    "declaration IsBatteryOk (defcondition)"]);
});

const nav2 = "examples/nav2/main/navigate_to_pose_w_replanning_and_recovery.xml";

test("an XML tree, and the node around the cursor", () => {
  const text = read(nav2);
  const parts = scan("xml", text);
  assert.equal(parts[0].name, "root");
  const [, tree] = told(parts);
  assert.match(tree, /^ tree \S+ \(BehaviorTree\)$/);
  const at = (word) => around(parts, text.indexOf(word));
  assert.equal(at("RecoveryActions").name, "RecoveryActions");
  assert.equal(at("<Spin").detail || at("<Spin").name, "Spin");
  const line = ({ begin }) => text.slice(0, begin).split("\n").length;
  assert.equal(line(at("RecoveryActions")), 50);
  // Behind the last child one is in the parent again.
  const end = text.indexOf("</RoundRobin>");
  assert.equal(around(parts, end + 3).name, "RecoveryActions");
  assert.equal(around(parts, 0), undefined);
  // Behind a leaf it is that leaf's still; where the next begins it is that.
  const two = scan("xml", "<BehaviorTree ID='t'><A/><B/> </BehaviorTree>");
  const named = (offset) => around(two, offset).name;
  assert.deepEqual([22, 25, 29, 30].map(named), ["A", "B", "B", "t"]);
});

test("other XML is left alone, broken XML is not", () => {
  for (const other of ["<package><name>x</name></package>",
                       "<svg viewBox='0 0 1 1'/>", "", "no xml",
                       "<BehaviorTrees/>"]) {
    assert.equal(isTreeXml(other), false);
    assert.deepEqual(scan("xml", other), []);
  }
  assert.deepEqual(told(scan("xml", `<root BTCPP_format="4">
    <!-- <Sequence> -->
    <BehaviorTree ID="a"><Sequence><Script code="x > '/>'"/>
      <Action ID='go' </BehaviorTree><![CDATA[ <X> ]]></root>`)), [
    "section root", " tree a (BehaviorTree)", "  node Sequence",
    "   leaf Script", "   node go (Action)"]);
});

test("every file of the repository, and quickly", () => {
  const languages = { ".btf": "btf", ".ltl": "btcheck-rules", ".xml": "xml",
                      ".leaves": "btcheck-leaves" };
  let files = 0;
  const begin = performance.now();
  for (const place of ["examples", "properties", "tests/regress"]) {
    for (const name of readdirSync(path.join(root, place),
                                   { recursive: true })) {
      const language = languages[path.extname(name)];
      if (!language) continue;
      const text = read(path.join(place, name));
      const check = (part, begin, end) => {
        assert.ok(begin <= part.begin && part.begin <= part.nameBegin &&
                  part.nameBegin <= part.nameEnd && part.nameEnd <= part.end &&
                  part.end <= end, `${name}: ${part.name}`);
        for (const one of part.parts) check(one, part.begin, part.end);
      };
      for (const part of scan(language, text)) check(part, 0, text.length);
      ++files;
    }
  }
  assert.ok(files > 500, `${files} files`);
  assert.ok(performance.now() - begin < 20_000);
  // Nothing is searched for from the beginning again and again.
  const long = "(BehaviorTree ".repeat(30_000);
  const before = performance.now();
  scan("btf", long);
  scan("xml", `<root BTCPP_format="4">${"<Sequence>".repeat(30_000)}`);
  scan("xml", `<root BTCPP_format="4">${"<a b=\"".repeat(30_000)}`);
  assert.ok(performance.now() - before < 10_000);
});

test("a text goes to this machine, or through encryption", () => {
  for (const good of ["ws://127.0.0.1:4000/secret", "ws://localhost:1",
                      "ws://[::1]:1/", "wss://robot.example/x"]) {
    assert.equal(refusal(good), "", good);
  }
  for (const bad of ["", "4000", "http://127.0.0.1:1", "ws://robot.example",
                     "ws://127.0.0.1.robot.example", "ws://localhost@robot",
                     "file:///etc/passwd"]) {
    assert.notEqual(refusal(bad), "", bad);
  }
});

test("files have the same way from the tree on both sides", () => {
  for (const [tree, file, way] of [
    ["/home/me/trees/main.xml", "/home/me/trees/sub/dock.xml", "sub/dock.xml"],
    ["/home/me/trees/main.xml", "/home/me/common/dock.xml",
     "../common/dock.xml"],
    ["/main.xml", "/dock.xml", "dock.xml"],
    ["main.xml", "sub/dock.xml", "sub/dock.xml"],
    ["trees/main.xml", "trees/dock.xml", "dock.xml"],
    ["a/b/main.xml", "dock.xml", "../../dock.xml"]]) {
    assert.equal(wayTo(folderOf(tree), file), way);
    assert.equal(along(folderOf(tree), way), file);
  }
  assert.equal(along("/a/", "./b/../c.xml"), "/a/c.xml");
});
