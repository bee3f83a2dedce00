# SPDX-License-Identifier: MIT
"""A scripted session with `btcheck mcp`; mcp_client.mjs has one with the
official client.

    python3 mcp_test.py BTCHECK SOURCES
"""
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
from session import Session  # noqa: E402

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
SOURCES = pathlib.Path(sys.argv[2]).resolve()
NAV2 = "examples/nav2/main/navigate_to_pose_w_replanning_and_recovery.xml"
ROOT = {"tree": NAV2, "profile": "nav2-main"}


class Mcp(unittest.TestCase):
    def setUp(self):
        self.session = Session(PROGRAM, "mcp", cwd=SOURCES, framed=False)
        self.addCleanup(self.session.__exit__)
        self.session.result("initialize", protocolVersion="2025-06-18",
                            capabilities={}, clientInfo={"name": "test"})
        self.session.notify("notifications/initialized")

    def call(self, tool, **arguments):
        return self.session.result("tools/call", name=tool,
                                   arguments=arguments)

    def text(self, tool, **arguments):
        answer = self.call(tool, **arguments)
        self.assertFalse(answer["isError"], answer)
        return answer["content"][0]["text"]

    def fault(self, tool, **arguments):
        answer = self.call(tool, **arguments)
        self.assertTrue(answer["isError"], answer)
        return answer["content"][0]["text"]

    def test_versions(self):
        for asked, told in (("2024-11-05", "2024-11-05"),
                            ("1999-01-01", "2025-11-25")):
            answer = self.session.result("initialize", protocolVersion=asked)
            self.assertEqual(answer["protocolVersion"], told)

    def test_a_repair_by_nothing_but_the_tools(self):
        answer = self.call("check_tree", **ROOT)
        finding = answer["structuredContent"]["findings"][0]
        self.assertEqual(finding["finding"], "BT2208@50:12")
        self.assertTrue(finding["has_repair"])
        self.assertIn('+          <RoundRobin name="RecoveryActions" '
                      'wrap_around="true">',
                      self.text("propose_repair", finding="BT2208@50:12",
                                **ROOT))
        edited = self.call("apply_repair", finding="BT2208@50:12", **ROOT)
        file, = edited["structuredContent"]["files"]
        self.assertEqual(file["file"], NAV2)
        text = (SOURCES / NAV2).read_text()
        self.assertEqual(file["text"], text.replace(
            '<RoundRobin name="RecoveryActions">',
            '<RoundRobin name="RecoveryActions" wrap_around="true">'))
        after = self.text("check_tree", text=file["text"], **ROOT)
        self.assertNotIn("BT2208", after)
        self.assertIn("no finding `BT2208@50:12`",
                      self.fault("apply_repair", finding="BT2208@50:12",
                                 text=file["text"], **ROOT))

    def test_answers_are_short(self):
        text = self.text("check_tree", tree="examples/drone3.btf",
                         rules=["examples/drone3.ltl"],
                         typed_rules=["never land@23.success"])
        self.assertIn("rule prove1: VIOLATED", text)
        self.assertIn("rules as expected", text)
        self.assertLess(len(text.splitlines()), 80)
        self.assertTrue(all(len(line) < 400 for line in text.splitlines()))

    def test_explain_and_simulate(self):
        self.assertIn("unknown or ambiguous node",
                      self.text("explain_finding", code="BT1014"))
        text = self.text("explain_finding", finding="BT2209@49:12", **ROOT)
        self.assertIn("tick 2", text)
        self.assertIn("BT2209:", text)
        text = self.text("simulate", seed=1, run_ticks=4, **ROOT)
        self.assertIn("tick 1: root=", text)

    def test_node_types(self):
        text = self.text("list_node_types", profile="nav2-jazzy",
                         part="retry")
        self.assertIn("RetryUntilSuccessful: Decorator (num_attempts: int",
                      text)
        self.assertNotIn("Inverter", text)
        self.assertIn("Inverter: one child.",
                      self.text("list_node_types", profile="paper"))
        self.assertIn("no profile `ros`",
                      self.fault("list_node_types", profile="ros"))

    def test_resources(self):
        all_of_them = self.session.result("resources/list")["resources"]
        for each in all_of_them:
            content, = self.session.result("resources/read",
                                           uri=each["uri"])["contents"]
            self.assertGreater(len(content["text"]), 100)
            folder = SOURCES / each["uri"].removeprefix("btcheck://")
            if folder.exists():
                self.assertEqual(content["text"], folder.read_text())
        error = self.session.error("resources/read",
                                   uri="btcheck:///etc/passwd")
        self.assertEqual(error["code"], -32002)

    def test_what_is_wrong_is_told_to_the_agent(self):
        self.assertIn("did you mean `tree`?",
                      self.fault("check_tree", tre="x"))
        self.assertIn("`finding` is needed",
                      self.fault("propose_repair", **ROOT))
        self.assertIn("outside", self.text("check_tree", tree="/etc/passwd"))
        error = self.session.error("tools/call", name="rm", arguments={})
        self.assertEqual(error["code"], -32602)

    def test_cancelled_requests_are_not_answered(self):
        with tempfile.TemporaryDirectory() as folder:
            leaves = "".join(f'<Action ID="a{i}"/>' for i in range(12))
            text = ('<root BTCPP_format="4"><BehaviorTree ID="t"><Parallel>'
                    f"{leaves}</Parallel></BehaviorTree></root>")
            with Session(PROGRAM, "mcp", cwd=folder, framed=False) as session:
                number = session.begin("tools/call", name="check_tree",
                                       arguments={"tree": "t.xml",
                                                  "text": text},
                                       _meta={"progressToken": "p"})
                told = session.read()
                self.assertEqual(told["method"], "notifications/progress")
                self.assertEqual(told["params"]["progressToken"], "p")
                session.notify("notifications/cancelled", requestId=number)
                self.assertEqual(session.result("ping"), {})
                self.assertFalse([m for m in session.others
                                  if m.get("id") == number])
                self.assertEqual(session.end(), 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
