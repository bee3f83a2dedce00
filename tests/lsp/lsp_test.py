#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""btcheck lsp, over real messages: lsp_test.py PROGRAM SOURCE_FOLDER"""
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from client import Editor, uri_of, utf16  # noqa: E402

PROGRAM, SOURCE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])

# A guard that is not asked again, and a subtree in another file.
PATROL = """<root BTCPP_format="4" main_tree_to_execute="Patrol">
  <BehaviorTree ID="Patrol">
    <Sequence name="all">
      <Script code=" goal := 'dock' "/>
      <SubTree ID="Drive" target="{goal}" state="{done}"/>
      <Wash name="wash" where="{goal}"/>
      <SubTree ID="Rest" _autoremap="true"/>
    </Sequence>
  </BehaviorTree>
  <TreeNodesModel>
    <Action ID="Wash">
      <input_port name="where" type="std::string" default="here">what is washed</input_port>
    </Action>
    <Action ID="GoTo">
      <input_port name="to"/>
      <output_port name="said"/>
    </Action>
  </TreeNodesModel>
</root>
"""
PARTS = """<root BTCPP_format="4">
  <BehaviorTree ID="Drive">
    <Fallback name="drive">
      <GoTo name="first" to="{target}" said="{state}"/>
      <GoTo name="again" to="{target}" said="{state}"/>
    </Fallback>
  </BehaviorTree>
  <BehaviorTree ID="Rest">
    <AlwaysSuccess name="rest" _skipIf="goal == 'none'"/>
  </BehaviorTree>
</root>
"""
RULES = """tree "patrol.xml"
let washes = wash.running

## It is washed some time.
property washed: possible wash.success
property kept: never washes and first.failure
property broken: never again.failure
"""
LEAVES = "(defaction Wash :returns (success failure running))\n"


def write(folder, name, text):
    os.makedirs(os.path.dirname(os.path.join(folder, name)), exist_ok=True)
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


class Session(unittest.TestCase):
    """A folder and an editor for each test."""
    files = {"patrol.xml": PATROL, "parts.xml": PARTS, "patrol.ltl": RULES}
    options = {}

    def setUp(self):
        self.held = tempfile.TemporaryDirectory()
        for name, text in self.files.items():
            write(self.held.name, name, text)
        self.editor = Editor(PROGRAM, self.held.name, options=self.options)

    def tearDown(self):
        self.editor.end()
        self.held.cleanup()

    def opened(self, *names):
        for name in names:
            self.editor.open(name)
        for name in names:
            self.editor.checked(name)
        return self.editor


class Life(Session):
    def test_capabilities(self):
        offers = self.editor.initialized["capabilities"]
        for each in ("hover", "definition", "references", "documentHighlight",
                     "documentSymbol", "codeAction", "codeLens",
                     "documentFormatting", "rename", "foldingRange",
                     "selectionRange", "semanticTokens", "inlayHint",
                     "completion"):
            self.assertTrue(offers[each + "Provider"], each)
        self.assertEqual(offers["positionEncoding"], "utf-16")

    def test_end(self):
        self.assertIsNone(self.editor.result("shutdown"))
        self.editor.notify("exit")
        self.assertEqual(self.editor.process.wait(10), 0)

    def test_end_without_shutdown(self):
        self.editor.notify("exit")
        self.assertEqual(self.editor.process.wait(10), 1)

    def test_a_closed_pipe_ends_it(self):
        self.editor.process.stdin.close()
        self.assertEqual(self.editor.process.wait(10), 1)

    def test_what_is_not_known(self):
        answer = self.editor.ask("textDocument/moniker")
        self.assertEqual(answer["error"]["code"], -32601)
        answer = self.editor.ask("textDocument/hover")
        self.assertEqual(answer["error"]["code"], -32602)
        answer = self.editor.ask("textDocument/hover",
                                 **{"textDocument": {"uri": "file:///no.xml"},
                                    "position": {"line": 0, "character": 0}})
        self.assertEqual(answer["error"]["code"], -32602)
        self.editor.notify("textDocument/didChange", textDocument={
            "uri": "file:///no.xml", "version": 2},
            contentChanges=[{"text": "x"}])
        self.editor.notify("textDocument/didOpen")
        self.opened("patrol.xml")

    def test_cancelled(self):
        editor = self.opened("patrol.xml")
        many = [editor.begin("textDocument/semanticTokens/full",
                             **editor.of("patrol.xml")) for _ in range(300)]
        last = editor.begin("textDocument/hover",
                            **editor.at("patrol.xml", "<Wash", 2))
        editor.notify("$/cancelRequest", id=last)
        self.assertEqual(editor.answer(last)["error"]["code"], -32800)
        for each in many:
            self.assertIn("result", editor.answer(each))

    def test_positions_in_bytes(self):
        folder = self.held.name
        write(folder, "umlaut.xml", PATROL.replace('"here"', '"höre 𝄞"'))
        for encoding, size in (("utf-8", lambda t: len(t.encode())),
                               ("utf-16", utf16), ("utf-32", len)):
            with Editor(PROGRAM, folder, capabilities={"general": {
                    "positionEncodings": [encoding]}}) as editor:
                self.assertEqual(
                    editor.initialized["capabilities"]["positionEncoding"],
                    encoding)
                editor.open("umlaut.xml")
                text = editor.texts["umlaut.xml"]
                line = next(i for i, each in enumerate(text.split("\n"))
                            if "𝄞" in each)
                before = text.split("\n")[line].split("what is")[0]
                found = editor.result(
                    "textDocument/selectionRange", **editor.of("umlaut.xml"),
                    positions=[{"line": line, "character": size(before)}])
                self.assertEqual(found[0]["range"], {
                    "start": {"line": line, "character": size(before)},
                    "end": {"line": line, "character": size(before) + 4}})


class Diagnostics(Session):
    def test_three_stages(self):
        shutil.copy(os.path.join(
            SOURCE, "examples/nav2/jazzy/"
            "navigate_to_pose_w_replanning_and_recovery.xml"),
            os.path.join(self.held.name, "nav2.xml"))
        editor = self.opened("nav2.xml")
        self.assertIn("BT2208", editor.codes("nav2.xml"))
        editor.history.clear()
        editor.replace("nav2.xml", 'name="RecoveryActions"', 'name="Again"')
        editor.checked("nav2.xml")
        mine = [each for each in editor.history
                if each[1] == editor.uri("nav2.xml")]
        named = [any("`Again`" in one["message"] for one in each[3])
                 for each in mine]
        self.assertFalse(named[0], "reading alone does not search")
        self.assertTrue(named[-1])
        # What was found stays where it stands now, until it is known anew.
        self.assertEqual(mine[0][2], editor.versions["nav2.xml"])

    def test_stale_words_go(self):
        # A tree whose search takes long: what was found in the text before is
        # taken back before 200 ms are over.
        leaves = "".join(f'<A{i} name="a{i}"/>' for i in range(60))
        tree = ('<root BTCPP_format="4"><BehaviorTree ID="T">'
                '<Sequence><Never/>{}<ForceSuccess><AlwaysFailure/>'
                '</ForceSuccess></Sequence></BehaviorTree></root>')
        found = ('<root BTCPP_format="4"><BehaviorTree ID="T"><Fallback>'
                 '<AlwaysSuccess/><B/></Fallback></BehaviorTree></root>')
        write(self.held.name, "slow.xml", found)
        editor = self.opened("slow.xml")
        self.assertIn("BT2201", editor.codes("slow.xml"))
        slow = tree.format('<Parallel success_count="-1">' + leaves +
                           "</Parallel>")
        editor.history.clear()
        begun = time.monotonic()
        editor.set("slow.xml", slow.replace(
            "<Never/>", "<Fallback><AlwaysSuccess/><B/></Fallback>"))
        time.sleep(0.4)
        while editor.take(0.01):
            pass
        told = [each for each in editor.history
                if each[1] == editor.uri("slow.xml")]
        late = [each for each in told if each[0] - begun > 0.2]
        for each in late:
            # Whatever is still said is said of this text.
            self.assertEqual(each[2], editor.versions["slow.xml"])
        self.assertNotIn("BT2201", editor.codes("slow.xml"))

    def test_another_file_of_the_tree(self):
        editor = self.opened("patrol.xml", "parts.xml")
        clean = editor.codes("patrol.xml")
        editor.replace("parts.xml", '<BehaviorTree ID="Rest">',
                       '<BehaviorTree ID="Sleep">')
        editor.checked("patrol.xml")
        self.assertNotEqual(editor.codes("patrol.xml"), clean)
        editor.replace("parts.xml", '<BehaviorTree ID="Sleep">',
                       '<BehaviorTree ID="Rest">')
        editor.checked("patrol.xml")
        self.assertEqual(editor.codes("patrol.xml"), clean)

    def test_a_file_on_disk(self):
        editor = self.opened("patrol.xml")
        clean = editor.codes("patrol.xml")
        write(self.held.name, "parts.xml", PARTS.replace("Rest", "Sleep"))
        editor.notify("workspace/didChangeWatchedFiles", changes=[
            {"uri": editor.uri("parts.xml"), "type": 2}])
        editor.checked("patrol.xml")
        self.assertNotEqual(editor.codes("patrol.xml"), clean)

    def test_a_file_on_disk_that_nobody_tells_of(self):
        editor = self.opened("patrol.xml")
        clean = editor.codes("patrol.xml")
        time.sleep(1.2)  # it has been looked at
        write(self.held.name, "parts.xml", PARTS.replace("Rest", "Sleep"))
        editor.until(lambda: editor.codes("patrol.xml") != clean, 10)

    def test_broken_and_mended(self):
        editor = self.opened("patrol.xml")
        clean = editor.codes("patrol.xml")
        editor.replace("patrol.xml", "</Sequence>", "</Sequenz>")
        editor.checked("patrol.xml")
        said = editor.said("patrol.xml")
        self.assertEqual([each["severity"] for each in said], [1])
        editor.replace("patrol.xml", "</Sequenz>", "</Sequence>")
        editor.checked("patrol.xml")
        self.assertEqual(editor.codes("patrol.xml"), clean)

    def test_rules(self):
        editor = self.opened("patrol.ltl")
        self.assertEqual(editor.codes("patrol.ltl"), ["BT2001", "BT2004"])
        at = next(each for each in editor.said("patrol.ltl")
                  if each["code"] == "BT2001")
        self.assertEqual(editor.range_text("patrol.ltl", at["range"]), "broken")
        self.assertTrue(at["relatedInformation"])
        editor.replace("patrol.ltl", "again.failure", "again.failed")
        editor.checked("patrol.ltl")
        self.assertEqual([each["severity"]
                          for each in editor.said("patrol.ltl")], [1])

    def test_contracts(self):
        write(self.held.name, "wrong.leaves", "(defaction Wash :returns (sucess))")
        self.editor.open("wrong.leaves")
        self.editor.until(lambda: self.editor.said("wrong.leaves"))
        self.assertEqual(self.editor.codes("wrong.leaves")[0][:4], "BT10")

    def test_what_is_no_tree(self):
        write(self.held.name, "launch.xml", "<launch><root/></launch>")
        self.editor.open("launch.xml")
        self.editor.until(lambda: self.editor.said("launch.xml") is not None)
        self.assertEqual(self.editor.said("launch.xml"), [])

    def test_closed(self):
        editor = self.opened("patrol.xml", "patrol.ltl")
        self.assertTrue(editor.said("patrol.ltl"))
        editor.close("patrol.ltl")
        editor.close("patrol.xml")
        editor.until(lambda: not editor.said("patrol.ltl"))

    def test_settings(self):
        editor = self.opened("patrol.xml")
        editor.notify("workspace/didChangeConfiguration", settings={
            "btcheck": {"profile": "btcpp-4.2"}})
        editor.checked("patrol.xml")
        self.assertTrue(any("4.2" in json.dumps(each)
                            for each in editor.said("patrol.xml")) or
                        editor.said("patrol.xml") is not None)
        write(self.held.name, "btcheck.toml", "profle = 1\n")
        editor.notify("workspace/didChangeWatchedFiles", changes=[
            {"uri": editor.uri("btcheck.toml"), "type": 1}])
        editor.until(lambda: editor.diagnostics.get(
            editor.uri("btcheck.toml")) or any(
                each["severity"] < 3 for each in editor.said("patrol.xml")))


class OnSave(Session):
    options = {"checkOnType": False}

    def test_only_what_is_saved_is_searched(self):
        editor = self.opened("patrol.ltl")
        self.assertEqual(editor.codes("patrol.ltl"), ["BT2001", "BT2004"])
        editor.replace("patrol.ltl", "never again.failure",
                       "possible again.failure")
        time.sleep(1)
        while editor.take(0.01):
            pass
        self.assertEqual(editor.codes("patrol.ltl"), [])
        editor.replace("patrol.ltl", "possible again", "never again")
        editor.notify("textDocument/didSave", **editor.of("patrol.ltl"))
        editor.until(lambda: editor.codes("patrol.ltl") == [
            "BT2001", "BT2004"])


class Questions(Session):
    def hovered(self, name, word, plus=1):
        found = self.editor.result("textDocument/hover",
                                   **self.editor.at(name, word, plus))
        return found["contents"]["value"] if found else None

    def test_hover(self):
        self.opened("patrol.xml", "parts.xml", "patrol.ltl")
        text = self.hovered("patrol.xml", "<Wash name")
        self.assertIn("**Wash** Action", text)
        self.assertIn("what is washed", text)
        self.assertIn("default `here`", text)
        self.assertIn("can succeed", text)
        text = self.hovered("parts.xml", "<AlwaysSuccess")
        self.assertIn("never skipped", text)
        text = self.hovered("parts.xml", "{target}", 2)
        self.assertIn("read by `first`", text)
        text = self.hovered("patrol.xml", "{goal}", 2)
        self.assertIn("written by", text)
        self.assertIn("reaches P", self.hovered("patrol.ltl", "possible"))
        self.assertIn("Wash", self.hovered("patrol.ltl", "wash.success"))
        self.assertIn("VIOLATED", self.hovered("patrol.ltl", "broken"))
        self.assertIn("it answers failure",
                      self.hovered("patrol.ltl", "again.failure", 8))

    def completed(self, name, word, plus):
        found = self.editor.result("textDocument/completion",
                                   **self.editor.at(name, word, plus))
        return {each["label"]: each for each in found["items"]}

    def test_completion(self):
        editor = self.opened("patrol.xml", "parts.xml", "patrol.ltl")
        items = self.completed("patrol.xml", "<Wash name", 1)
        for each in ("Sequence", "RetryUntilSuccessful", "Wash", "GoTo",
                     "SubTree Drive"):
            self.assertIn(each, items)
        self.assertEqual(items["Sequence"]["textEdit"]["newText"],
                         "Sequence>\n\t$0\n</Sequence>")
        items = self.completed("patrol.xml", ' where="{goal}"', 1)
        self.assertIn("_skipIf", items)
        self.assertNotIn("name", items)  # it has one
        items = self.completed("patrol.xml", 'where="{goal}"', 8)
        self.assertIn("{goal}", items)
        items = self.completed("patrol.xml", 'ID="Drive" target', 4)
        self.assertLessEqual({"Drive", "Rest", "Patrol"}, set(items))
        items = self.completed("patrol.xml", 'target="{goal}" state', 0)
        # Half written: nothing behind the cursor makes sense.
        editor.replace("patrol.xml", "    </Sequence>", "      <Retr")
        items = self.completed("patrol.xml", "<Retr", 5)
        self.assertIn("RetryUntilSuccessful", items)
        snippet = items["RetryUntilSuccessful"]["textEdit"]
        self.assertEqual(editor.range_text("patrol.xml", snippet["range"]),
                         "Retr")
        items = self.completed("patrol.ltl", "wash.running", 5)
        self.assertLessEqual({"running", "success", "halted"}, set(items))
        self.assertNotIn("never", items)
        items = self.completed("patrol.ltl", "possible wash", 9)
        self.assertLessEqual({"wash", "first", "washes", "never"}, set(items))
        items = self.completed("patrol.ltl", '"patrol.xml"', 1)
        self.assertIn("parts.xml", items)

    def places(self, found, name):
        uri = self.editor.uri(name)
        return [self.editor.range_text(name, each["range"])
                for each in found if each["uri"] == uri]

    def test_definition(self):
        editor = self.opened("patrol.xml", "parts.xml", "patrol.ltl")

        def defined(name, word, plus=1):
            return editor.result("textDocument/definition",
                                 **editor.at(name, word, plus))
        found = defined("patrol.xml", 'ID="Drive"', 5)
        self.assertEqual(self.places(found, "parts.xml"), ["Drive"])
        found = defined("patrol.xml", "<Wash name")
        self.assertEqual(self.places(found, "patrol.xml"), ["Wash"])
        found = defined("parts.xml", "{state}", 2)
        self.assertEqual(self.places(found, "parts.xml"), ["state", "state"])
        found = defined("parts.xml", "{target}", 2)  # by its name in the caller
        self.assertEqual(self.places(found, "patrol.xml"), ["Script"])
        found = defined("patrol.ltl", "first.failure")
        self.assertEqual(self.places(found, "parts.xml"), ["GoTo"])
        found = defined("patrol.ltl", "washes and")
        self.assertEqual(self.places(found, "patrol.ltl"), ["washes"])
        self.assertEqual(found[0]["range"]["start"]["line"], 1)
        found = defined("patrol.ltl", "patrol.xml")
        self.assertEqual(found[0]["uri"], editor.uri("patrol.xml"))

    def test_references(self):
        editor = self.opened("patrol.xml", "parts.xml", "patrol.ltl")

        def referred(name, word, plus=1):
            return editor.result("textDocument/references",
                                 **editor.at(name, word, plus),
                                 context={"includeDeclaration": True})
        found = referred("parts.xml", "{target}", 2)
        self.assertEqual(self.places(found, "parts.xml"), ["target"] * 2)
        self.assertEqual(self.places(found, "patrol.xml"), ["target"])
        # `goal` is what the subtree without a remapping reads as well.
        found = referred("patrol.xml", "{goal}", 2)
        self.assertEqual(len(self.places(found, "patrol.xml")), 3)
        self.assertEqual(self.places(found, "parts.xml"), ["goal"])
        found = referred("patrol.xml", 'ID="Rest"', 5)
        self.assertEqual(self.places(found, "parts.xml"), ["Rest"])
        found = referred("patrol.ltl", "wash.running")
        self.assertEqual(self.places(found, "patrol.xml"), ["wash"])
        self.assertEqual(self.places(found, "patrol.ltl"), ["wash"] * 2)
        lit = editor.result("textDocument/documentHighlight",
                            **editor.at("patrol.ltl", "washes"))
        self.assertEqual(len(lit), 2)

    def test_rename(self):
        editor = self.opened("patrol.xml", "parts.xml", "patrol.ltl")
        before = {name: editor.checked(name) for name in self.files}

        def rename(name, word, plus, to):
            self.assertIsNotNone(editor.result(
                "textDocument/prepareRename", **editor.at(name, word, plus)))
            edit = editor.result("textDocument/rename", newName=to,
                                 **editor.at(name, word, plus))
            self.assertEqual(editor.apply(edit), {})
        rename("patrol.xml", "{goal}", 2, "aim")
        rename("patrol.xml", 'ID="Drive"', 5, "Go")
        rename("patrol.xml", 'name="wash"', 7, "wash up")
        rename("patrol.ltl", "first.failure", 2, "trial")
        rename("patrol.ltl", "washes", 2, "is_washing")
        self.assertIn('<SubTree ID="Go" target="{aim}"',
                      editor.texts["patrol.xml"])
        self.assertIn("""_skipIf="aim == 'none'\"""", editor.texts["parts.xml"])
        self.assertIn('let is_washing = "wash up".running',
                      editor.texts["patrol.ltl"])
        self.assertIn("never is_washing and trial.failure",
                      editor.texts["patrol.ltl"])
        for name, summary in before.items():
            self.assertEqual(editor.checked(name), summary)
        for wrong in ("again", "a\"b", ""):
            answer = editor.ask("textDocument/rename", newName=wrong,
                                **editor.at("patrol.ltl", "trial", 2))
            self.assertIn("error", answer, wrong)
        self.assertIsNone(editor.result(
            "textDocument/prepareRename", **editor.at("patrol.xml", "<Seq", 2)))

    def test_symbols(self):
        editor = self.opened("patrol.xml", "patrol.ltl")
        found = editor.result("textDocument/documentSymbol",
                              **editor.of("patrol.xml"))
        self.assertEqual([each["name"] for each in found],
                         ["Patrol", "TreeNodesModel"])
        names = [each["name"] for each in found[0]["children"][0]["children"]]
        self.assertEqual(names, ["Script", "Drive", "wash", "Rest"])
        found = editor.result("textDocument/documentSymbol",
                              **editor.of("patrol.ltl"))
        self.assertEqual([each["name"] for each in found],
                         ["patrol.xml", "washes", "washed", "kept", "broken"])
        folds = editor.result("textDocument/foldingRange",
                              **editor.of("patrol.xml"))
        self.assertIn({"startLine": 1, "endLine": 7}, folds)

    def test_tokens(self):
        editor = self.opened("patrol.xml", "patrol.ltl")
        kinds = editor.initialized["capabilities"]["semanticTokensProvider"][
            "legend"]["tokenTypes"]
        for name, wanted in (
                ("patrol.xml", {"Sequence": "class", "Wash": "function",
                                "{goal}": "variable", "where": "property"}),
                ("patrol.ltl", {"property": "keyword", "running": "event",
                                "wash": "variable"})):
            data = editor.result("textDocument/semanticTokens/full",
                                 **editor.of(name))["data"]
            self.assertEqual(len(data) % 5, 0)
            line = at = 0
            seen = {}
            for i in range(0, len(data), 5):
                line += data[i]
                at = data[i + 1] + (at if data[i] == 0 else 0)
                seen.setdefault(editor.range_text(name, {
                    "start": {"line": line, "character": at},
                    "end": {"line": line, "character": at + data[i + 2]}}),
                    kinds[data[i + 3]])
            for word, kind in wanted.items():
                self.assertEqual(seen.get(word), kind, word)

    def test_formatting(self):
        editor = self.opened("patrol.xml", "patrol.ltl")
        for name in self.files:
            if name not in editor.texts:
                editor.open(name)
            if name.endswith(".xml"):
                editor.replace(name, "  <BehaviorTree", "<BehaviorTree")
            edits = editor.result("textDocument/formatting",
                                  options={"tabSize": 2}, **editor.of(name))
            editor.apply({"changes": {editor.uri(name): edits}})
            with tempfile.TemporaryDirectory() as folder:
                write(folder, name, editor.texts[name])
                self.assertEqual(subprocess.run(
                    [PROGRAM, "fmt", "--check", os.path.join(folder, name)],
                    check=False).returncode, 0)
            self.assertEqual(editor.result(
                "textDocument/formatting", options={}, **editor.of(name)), [])
        editor.replace("patrol.xml", "</Sequence>", "</Sequenz>")
        self.assertIsNone(editor.result(
            "textDocument/formatting", options={}, **editor.of("patrol.xml")))

    def test_lenses_hints_and_pages(self):
        editor = self.opened("patrol.xml", "patrol.ltl")
        lenses = editor.result("textDocument/codeLens",
                               **editor.of("patrol.ltl"))
        runs = [each["command"]["arguments"][0]["run"] for each in lenses]
        self.assertIn("broken", runs)
        page = editor.result("btcheck/page", **editor.of("patrol.ltl"),
                             run="broken")
        self.assertIn("<html", page["html"])
        self.assertIn("error", editor.ask("btcheck/page", run="no such run",
                                          **editor.of("patrol.ltl")))
        whole = {"start": {"line": 0, "character": 0},
                 "end": {"line": 99, "character": 0}}
        hints = editor.result("textDocument/inlayHint", range=whole,
                              **editor.of("patrol.ltl"))
        said = {each["position"]["line"]: each["label"] for each in hints}
        self.assertTrue(said[4].startswith("HOLDS"), said)
        self.assertTrue(said[6].startswith("VIOLATED"), said)
        hints = editor.result("textDocument/inlayHint", range=whole,
                              **editor.of("patrol.xml"))
        self.assertRegex(hints[0]["label"], r"^\d+ states · \d+ finding")
        lenses = editor.result("textDocument/codeLens",
                               **editor.of("patrol.xml"))
        self.assertIn("btcheck.stepThrough",
                      [each["command"]["command"] for each in lenses])
        page = editor.result("btcheck/drawing", **editor.of("patrol.xml"))
        self.assertIn("<html", page["html"])
        self.assertEqual(page["title"], "patrol.xml")
        told = [each for each in editor.notices
                if each["method"] == "btcheck/runs"]
        self.assertTrue(told)


class Actions(Session):
    def offered(self, name, code):
        at = next(each for each in self.editor.said(name)
                  if each["code"] == code)
        found = self.editor.result("textDocument/codeAction", range=at["range"],
                                   context={"diagnostics": [at]},
                                   **self.editor.of(name))
        return [each for each in found if "edit" in each]

    def test_a_repair(self):
        name = "nav2.xml"
        shutil.copy(os.path.join(
            SOURCE, "examples/nav2/main/"
            "navigate_to_pose_w_replanning_and_recovery.xml"),
            os.path.join(self.held.name, name))
        editor = self.opened(name)
        self.assertIn("BT2208", editor.codes(name))
        action = next(each for each in self.offered(name, "BT2208")
                      if each.get("isPreferred"))
        self.assertEqual(editor.apply(action["edit"]), {})
        editor.checked(name)
        self.assertNotIn("BT2208", editor.codes(name))

    def test_every_finding_can_be_allowed(self):
        # Planted bugs: the comment goes where it counts.
        count = 0
        for name in sorted(os.listdir(os.path.join(SOURCE, "tests/findings"))):
            path = os.path.join(SOURCE, "tests/findings", name)
            if not name.endswith((".xml", ".btf")) or count >= 25:
                continue
            shutil.copy(path, self.held.name)
            editor = self.opened(name)
            for code in sorted(set(editor.codes(name))):
                actions = [each for each in self.offered(name, code)
                           if f"allow {code} here" in each["title"]]
                if not actions:
                    continue
                text = editor.texts[name]
                before = editor.codes(name).count(code)
                editor.apply(actions[0]["edit"])
                editor.checked(name)
                self.assertLess(editor.codes(name).count(code), before,
                                f"{name}: {code}")
                editor.set(name, text)
                editor.checked(name)
                count += 1
            editor.close(name)
        self.assertGreaterEqual(count, 5)

    def test_a_rule_for_a_finding(self):
        write(self.held.name, "dead.xml", """<root BTCPP_format="4">
  <BehaviorTree ID="T">
    <Fallback>
      <AlwaysSuccess/>
      <Wash name="wash"/>
    </Fallback>
  </BehaviorTree>
</root>
""")
        editor = self.opened("dead.xml")
        self.assertIn("BT2201", editor.codes("dead.xml"))
        action = next(each for each in self.offered("dead.xml", "BT2201")
                      if "write a rule" in each["title"])
        others = editor.apply(action["edit"])
        (uri, edits), = others.items()
        self.assertEqual(uri, editor.uri("dead.ltl"))
        write(self.held.name, "dead.ltl", edits[0]["newText"])
        editor.open("dead.ltl")
        editor.checked("dead.ltl")
        self.assertEqual(editor.codes("dead.ltl"), ["BT2001"])


class HalfWritten(Session):
    """Random edits: nothing ends the server, and it still knows what it knew."""
    edits = int(os.environ.get("BTCHECK_EDITS", "400"))

    def test_random_edits(self):
        pieces = ["<", ">", "/", "\"", "'", "<Sequence>", "</Sequence>", "{",
                  "}", "\n", "\r\n", "<!--", "-->", "&amp;", "&", "ü", "𝄞",
                  "(", ")", ":", "[", "property x: ", "never ", ".", "@", "=",
                  " name=\"a\"", "<SubTree ID=\"Patrol\"/>", "\0", "<![CDATA[",
                  "]]>", "<?", "; btcheck: allow BT2208", "{=}", "defaction"]
        shutil.copy(os.path.join(SOURCE, "examples/recovery.btf"),
                    os.path.join(self.held.name, "t.btf"))
        write(self.held.name, "t.leaves", LEAVES)
        chance = random.Random(20261128)
        editor = self.editor
        names = ["patrol.xml", "parts.xml", "patrol.ltl", "t.btf", "t.leaves"]
        texts = {}
        for name in names:
            editor.open(name)
            texts[name] = editor.texts[name]
        asked = ["hover", "completion", "definition", "documentHighlight",
                 "prepareRename", "references", "rename"]
        whole = ["documentSymbol", "codeLens", "foldingRange", "formatting",
                 "semanticTokens/full"]
        for number in range(self.edits):
            name = chance.choice(names)
            text = editor.texts[name]
            begin = chance.randrange(len(text) + 1)
            end = min(len(text), begin + chance.choice([0, 0, 0, 1, 3, 20]))
            editor.change(name, begin, end, chance.choice(pieces))
            if number % 37 == 0:
                editor.set(name, texts[name])
            if number % 3 == 0:
                here = {"textDocument": {"uri": editor.uri(name)},
                        "position": editor.position(name, begin)}
                editor.begin("textDocument/" + chance.choice(asked), **here,
                             newName="fresh",
                             context={"includeDeclaration": True})
                editor.begin("textDocument/" + chance.choice(whole),
                             **editor.of(name))
            while editor.messages.qsize() > 0:
                editor.take(0.001)
            if number % 50 == 49:
                editor.answer(editor.begin("textDocument/hover", **here))
                editor.answers.clear()
                editor.history.clear()
        for name in names:
            editor.set(name, texts[name])
        for name in names[:3]:
            editor.checked(name)
        self.assertEqual(editor.codes("patrol.ltl"), ["BT2001", "BT2004"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
