# SPDX-License-Identifier: MIT
"""A scripted session with `btcheck serve`: every method, against what the
command of its name prints; limits, cancelling, and clients that misbehave.

    python3 serve_test.py BTCHECK SOURCES
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True
from session import Session  # noqa: E402

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
SOURCES = pathlib.Path(sys.argv[2]).resolve()
NAV2 = "examples/nav2/main/navigate_to_pose_w_replanning_and_recovery.xml"
PATROL = "examples/world/patrol.xml"


def printed(*words, cwd=SOURCES):
    done = subprocess.run([PROGRAM, *words], cwd=cwd, capture_output=True,
                          text=True, check=False)
    return done.stdout


def comparable(report):
    """Without what differs from run to run; and helps, which speak of options
    to one and of fields to the other."""
    for tree in report["trees"]:
        for each in tree["diagnostics"] + tree["findings"]:
            each["help"] = None
            each.pop("told", None)
        tree.pop("timing", None)
        for file in tree["files"]:
            file.pop("timing", None)
            file.pop("threads", None)
    report.pop("timing", None)
    return report


def answers(report):
    """What is found, however long the runs are that show it."""
    found = comparable(report)["trees"][0]
    file = found["files"][0]
    for node in file["nodes"]:
        for answer in node.values():
            if isinstance(answer, dict):
                answer.pop("time", None)
    for each in found["findings"]:
        each.pop("run", None)
    return [file["nodes"], [each["verdict"] for each in file["answers"]],
            [(each["code"], each["message"]) for each in found["findings"]]]


def large_tree(folder, width=16):
    """More states than can be searched in the time of this test."""
    leaves = "".join(f'<Action ID="a{i}"/>' for i in range(width))
    (folder / "large.xml").write_text(
        '<root BTCPP_format="4"><BehaviorTree ID="t"><Parallel>'
        f"{leaves}</Parallel></BehaviorTree></root>\n")
    return "large.xml"


class Serve(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def session(self, *words, cwd=SOURCES, **more):
        session = Session(PROGRAM, "serve", "--stdio", *words, cwd=cwd, **more)
        self.addCleanup(session.__exit__)
        return session

    # --- Methods -----------------------------------------------------------

    def test_checks_as_the_command_does(self):
        session = self.session()
        for tree, words, params in (
                (PATROL, [], {}),
                (PATROL, ["--leaves", "examples/world/robot.leaves"],
                 {"leaves": ["examples/world/robot.leaves"]}),
                (PATROL, ["--prop", "examples/world/patrol.ltl"],
                 {"rules": ["examples/world/patrol.ltl"]}),
                ("examples/drone3.btf", ["-e", "never land@23.failure"],
                 {"typed_rules": ["never land@23.failure"]}),
                (NAV2, ["--profile", "nav2-main", "--no-repairs"],
                 {"profile": "nav2-main", "tries_repairs": False}),
                ("examples/none.xml", [], {})):
            with self.subTest(tree=tree, **params):
                own = session.result("check", tree=tree, **params)
                program = json.loads(
                    printed(tree, "--format", "json", "-q", *words))
                self.assertEqual(comparable(own), comparable(program))

    def test_lints_as_the_command_does(self):
        own = self.session().result("lint", tree=PATROL)
        program = json.loads(printed("lint", PATROL, "--format", "json"))
        self.assertEqual(comparable(own), comparable(program))

    def test_sarif(self):
        own = self.session().result("check", tree=PATROL, sarif=True)
        self.assertEqual(own["version"], "2.1.0")

    def test_simulates_as_the_command_does(self):
        run = self.session().result("simulate", tree=PATROL, seed=7,
                                    run_ticks=5)
        lines = printed("simulate", PATROL, "--seed", "7", "--ticks", "5")
        self.assertTrue(run["lines"])
        for line in run["lines"]:
            self.assertIn(line, lines)

    def test_init_as_the_command_does(self):
        begun = self.session().result("init", tree=PATROL)
        self.assertEqual(begun["rules"], printed("init", PATROL, "-q"))
        self.assertEqual(begun["outcome"], 0)

    def test_leaves_as_the_command_does(self):
        tree = self.folder / "t.xml"
        tree.write_text('<root BTCPP_format="4"><BehaviorTree ID="t">'
                        '<Sequence><Dock speed="2"/></Sequence>'
                        "</BehaviorTree></root>")
        found = self.session(cwd=self.folder).result("leaves", tree="t.xml")
        self.assertEqual(found["count"], 1)
        self.assertEqual(found["models"],
                         printed("leaves", "t.xml", "-q", cwd=self.folder))

    def test_describe_and_explain(self):
        session = self.session()
        tree = session.result("describe", tree=PATROL)
        self.assertIn("MeasureBattery", [n["label"] for n in tree["nodes"]])
        self.assertIn("fails", session.result("explain", code="BT2208")
                      ["summary"])
        self.assertEqual(session.error("explain", code="BT1")["code"], -32602)

    def test_texts_take_the_place_of_files(self):
        session = self.session()
        before = session.result("lint", tree=PATROL)["trees"][0]
        text = (SOURCES / PATROL).read_text().replace(
            "<IsStorm", "<Sequence/><IsStorm")
        after = session.result("lint", tree=PATROL, text=text)["trees"][0]
        self.assertNotEqual(before["diagnostics"], after["diagnostics"])
        # So do the files beside it.
        (self.folder / "a.xml").write_text(
            '<root BTCPP_format="4"><include path="b.xml"/>'
            '<BehaviorTree ID="A"><SubTree ID="B"/></BehaviorTree></root>')
        session = self.session(cwd=self.folder)
        tree = session.result("check", tree="a.xml")["trees"][0]
        self.assertEqual(tree["exit_code"], 2)
        tree = session.result("check", tree="a.xml", files={
            "b.xml": '<root BTCPP_format="4"><BehaviorTree ID="B">'
                     "<AlwaysSuccess/></BehaviorTree></root>"})["trees"][0]
        self.assertEqual(tree["exit_code"], 0)

    def test_known_results_are_those_of_the_same_texts(self):
        tree = self.folder / "t.xml"
        form = ('<root BTCPP_format="4"><BehaviorTree ID="t"><Sequence>'
                '<Action ID="a"/>{}</Sequence></BehaviorTree></root>')
        session = self.session(cwd=self.folder)
        states = []
        for more in ("", '<Action ID="b"/>', ""):
            tree.write_text(form.format(more))
            files = session.result("check", tree="t.xml")["trees"][0]["files"]
            states.append(json.dumps(files[0]["nodes"]))
        self.assertEqual(states[0], states[2])
        self.assertNotEqual(states[0], states[1])
        # Settings count as well.
        (self.folder / "btcheck.toml").write_text(
            'profile = "btcpp-4.5"\n')
        files = session.result("check", tree="t.xml")["trees"][0]["files"]
        self.assertEqual(files[0]["profile"], "btcpp-4.5")

    def test_edits_of_a_tree_that_is_asked_in_parts(self):
        text = subprocess.run([SOURCES / "bench" / "families", "drones", "2"],
                              capture_output=True, text=True, check=True).stdout
        tree = self.folder / "t.btf"
        session = self.session(cwd=self.folder)
        edits = [text, text.replace(":ID takeoff1", ":ID fly1"),
                 text.replace("(Action :ID takeoff1)", ""), text]
        self.assertEqual(len(set(edits)), 3)
        for number, edited in enumerate(edits):
            tree.write_text(edited)
            with self.subTest(edit=number):
                own = session.result("check", tree="t.btf", text=f"{edited}; {number}\n")
                program = json.loads(printed(
                    "t.btf", "--format", "json", "-q", cwd=self.folder))
                self.assertEqual(answers(own), answers(program))

    def test_what_a_limit_has_shortened_is_not_known_afterwards(self):
        session = self.session()
        for limit in ({"seconds": 0.25}, {"seconds": 0.5}, {"seconds": 1},
                      {"states": 115_000}):
            session.result("check", tree=NAV2, profile="nav2-main", **limit)
        own = session.result("check", tree=NAV2, profile="nav2-main")
        program = json.loads(printed(NAV2, "--profile", "nav2-main", "-q",
                                     "--format", "json"))
        self.assertEqual(comparable(own), comparable(program))

    # --- Several at a time, and their ends -------------------------------------

    def test_cancelled(self):
        session = self.session("--jobs", "2", cwd=self.folder)
        tree = large_tree(self.folder)
        first = session.begin("check", tree=tree, progress=True)
        # A second one goes on beside it, and a third one waits behind them.
        self.assertEqual(session.result("explain", code="BT2208")["code"],
                         "BT2208")
        small = session.result("lint", tree=tree)
        self.assertEqual(small["exit_code"], 0)
        while True:
            message = session.read()
            if message.get("method") == "$/progress":
                break
        self.assertEqual(message["params"]["id"], first)
        self.assertGreater(message["params"]["states"], 0)
        begun = time.monotonic()
        session.notify("$/cancelRequest", id=first)
        session.notify("$/cancelRequest", id=first)  # twice is as once
        session.notify("$/cancelRequest", id="nobody")
        self.assertEqual(session.answer(first)["error"]["code"], -32800)
        self.assertLess(time.monotonic() - begun, 2)
        # What waits is cancelled before it begins.
        busy = [session.begin("check", tree=tree) for _ in range(3)]
        for number in reversed(busy):
            session.notify("$/cancelRequest", id=number)
            answer = session.read()
            self.assertEqual(answer["id"], number)
            self.assertEqual(answer["error"]["code"], -32800)

    def test_limits_of_a_request_and_of_the_process(self):
        tree = large_tree(self.folder)
        session = self.session("--timeout", "0.5", cwd=self.folder)
        for params in ({}, {"seconds": 100}, {"seconds": 0.2},
                       {"states": 1000}):
            begun = time.monotonic()
            report = session.result("check", tree=tree, tries_repairs=False,
                                    **params)
            self.assertEqual(report["exit_code"], 3, params)
            self.assertLess(time.monotonic() - begun, 5)

    def test_memory(self):
        tree = large_tree(self.folder)
        session = self.session("--memory", "64M", cwd=self.folder)
        report = session.result("check", tree=tree, bytes=1 << 20,
                                tries_repairs=False)
        self.assertEqual(report["exit_code"], 3)
        # What a message alone takes is the process's as well.
        error = session.error("check", tree=tree,
                              text="<!--" + "x" * (60 << 20) + "-->")
        self.assertEqual(error["code"], -32001)
        self.assertEqual(session.result("explain", code="BT2208")["code"],
                         "BT2208")

    def test_many_at_once(self):
        session = self.session("--jobs", "8")
        numbers = [session.begin("check", tree=tree)
                   for _ in range(10) for tree in (PATROL, NAV2)]
        answers = [comparable(session.answer(n)["result"]) for n in numbers]
        for answer in answers:
            self.assertIn(answer, answers[:2])

    def test_the_same_id_twice(self):
        session = self.session(cwd=self.folder)
        tree = large_tree(self.folder)
        number = session.begin("check", tree=tree)
        session.count -= 1
        session.begin("check", tree=tree)
        self.assertIn("not answered yet",
                      session.answer(number)["error"]["message"])
        session.notify("$/cancelRequest", id=number)
        self.assertEqual(session.answer(number)["error"]["code"], -32800)

    def test_stdin_closed_while_it_works(self):
        session = self.session()
        number = session.begin("check", tree=NAV2)
        session.process.stdin.close()
        self.assertIn("result", session.answer(number))
        self.assertIsNone(session.read())
        self.assertEqual(session.process.wait(timeout=60), 0)

    def test_a_client_that_goes_away(self):
        session = self.session(cwd=self.folder)
        session.begin("check", tree=large_tree(self.folder))
        time.sleep(0.3)
        session.process.stdin.close()
        session.process.stdout.close()
        session.process.wait(timeout=10)

    def test_exit(self):
        session = self.session()
        self.assertIsNone(session.result("shutdown"))
        session.notify("exit")
        self.assertEqual(session.process.wait(timeout=60), 0)

    # --- Bad input ----------------------------------------------------------

    def test_requests_that_cannot_be_meant(self):
        session = self.session()
        for params, words in (
                ({}, "`tree` is needed"),
                ({"tree": 3}, "`tree` is needed"),
                ({"tree": ["a"]}, "`tree` is needed"),
                ({"tree": PATROL, "sead": 1}, "did you mean `seed`?"),
                ({"tree": PATROL, "profile": "nav3"}, "no profile `nav3`"),
                ({"tree": PATROL, "seconds": -1}, "does not fit `seconds`"),
                ({"tree": PATROL, "seconds": {}}, "`seconds` does not fit"),
                ({"tree": PATROL, "profile": ["a"]}, "`profile` is one text"),
                ({"tree": PATROL, "files": []}, "texts by their names"),
                ({"tree": PATROL, "files": {"a": 1}}, "texts by their names"),
                ({"tree": PATROL, "text": 1}, "`text` is needed")):
            error = session.error("check", **params)
            self.assertEqual(error["code"], -32602)
            self.assertIn(words, error["message"])
        self.assertEqual(session.error("chek")["code"], -32601)

    def test_messages_that_are_none(self):
        session = self.session()
        deep = b'{"jsonrpc":"2.0","id":1,"method":%s}' % (
            b"[" * 100_000 + b"]" * 100_000)
        wide = b'{"jsonrpc":"2.0","id":1,"params":[%s]}' % (
            b"0," * 2_000_000 + b"0")
        for data, words in (
                (b"{{{{", "no JSON"), (b"", "no JSON"), (b"[]", "of their own"),
                (b"3", "a JSON object"), (deep, "nested deeper"),
                (wide, "more than 1000000 values"),
                (b'{"a":1,"a":2}', "there twice"), (b'"\xff"', "no JSON"),
                (b"{}", "`jsonrpc`"),
                (b'{"jsonrpc":"2.0","id":{}}', "a text or a number"),
                (b'{"jsonrpc":"2.0","id":7}', "has a `method`"),
                (b'{"jsonrpc":"2.0","id":7,"method":"check","params":[]}',
                 "has to be an object")):
            session.send(data)
            answer = session.read()
            self.assertIn(words, answer["error"]["message"])
        # Notifications that nobody knows, and answers, are passed over.
        session.notify("$/other")
        session.send({"jsonrpc": "2.0", "id": 5, "result": None})
        self.assertIn("version", session.result("initialize"))

    def test_a_message_that_is_too_large(self):
        session = self.session()
        size = 1 << 30
        session.write(b"Content-Length: %d\r\n\r\n" % size)
        for _ in range(size >> 20):
            session.write(b" " * (1 << 20))
        self.assertIn("128 MiB", session.read()["error"]["message"])
        self.assertIn("version", session.result("initialize"))

    def test_a_stream_that_is_none(self):
        for data in (b"GET / HTTP/1.1\r\n\r\n", b"Content-Length: x\r\n\r\n",
                     b"Content-Length: 10\r\n\r\n{}", b"Content-Length: 5\r\n",
                     b"a" * 100_000 + b"\n"):
            session = self.session()
            session.write(data)
            session.process.stdin.close()
            self.assertIn("error", session.read())
            self.assertIsNone(session.read())
            self.assertEqual(session.process.wait(timeout=60), 2)

    def test_what_may_be_read(self):
        project = self.folder / "project"
        project.mkdir()
        (project / ".git").mkdir()
        (project / ".git" / "config").write_text("secret")
        (self.folder / "other.xml").write_text("secret")
        os.symlink(self.folder / "other.xml", project / "link.xml")
        os.mkfifo(project / "pipe.xml")
        (project / "t.xml").write_text(
            '<root BTCPP_format="4"><include path="../other.xml"/>'
            '<BehaviorTree ID="t"><SubTree ID="u"/></BehaviorTree></root>')
        session = self.session(cwd=project)
        for tree in ("../other.xml", str(self.folder / "other.xml"),
                     "link.xml", ".git/config", "/etc/passwd", "-",
                     "/dev/stdin", "/proc/self/fd/0", "pipe.xml", "t.xml",
                     "a\nb.xml", "."):
            report = session.result("check", tree=tree)
            self.assertEqual(report["exit_code"], 2, tree)
            self.assertNotIn("secret", json.dumps(report))
        for field in ("rules", "leaves", "models"):
            report = session.result("check", tree="t.xml",
                                    **{field: ["../other.xml"]})
            self.assertEqual(report["exit_code"], 2)
        error = session.error("check", tree="t.xml", settings="/etc/passwd")
        self.assertIn("outside", error["message"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
