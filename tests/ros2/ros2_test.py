# SPDX-License-Identifier: MIT
"""The node of contrib/ros2 over a stand-in for rclpy:
ros2_test.py PROGRAM SOURCES"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCES = (pathlib.Path(word) for word in sys.argv[1:3])

TREE = """<root BTCPP_format="4"><BehaviorTree ID="Main">
<Sequence name="go"><Action ID="Plan" name="plan"/><Action ID="Drive" name="drive"/></Sequence>
</BehaviorTree></root>
"""
RULES = """tree "nav.xml"
property planned: plan.success precedes drive.ticked
property drives: never drive.failure
"""


def change(name, uid, before, after):
    return {"timestamp": {"sec": 1700000000, "nanosec": 0}, "node_name": name,
            "uid": uid, "previous_status": before, "current_status": after}


def run(messages, *words):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "nav.xml").write_text(TREE)
        (folder / "rules.ltl").write_text(RULES)
        lines = "".join(json.dumps({"event_log": each}) + "\n"
                        for each in messages)
        return subprocess.run(
            [sys.executable, SOURCES / "contrib/ros2/btcheck_watch.py", "--ros-args",
             "-p", f"btcheck:={PROGRAM.resolve()}", *words],
            input=lines, text=True, capture_output=True, cwd=folder, timeout=60,
            env=dict(os.environ, PYTHONDONTWRITEBYTECODE="1",
                     PYTHONPATH=str(SOURCES / "tests/ros2/stand_in")))


class Ros2(unittest.TestCase):
    both = ("-p", "tree:=nav.xml", "-p", "rules:=rules.ltl")

    def test_a_rule_that_is_violated_is_told_once(self):
        told = run([[change("go", 1, "IDLE", "RUNNING"),
                     change("drive", 3, "IDLE", "RUNNING")],
                    [change("drive", 3, "RUNNING", "FAILURE")],
                    [change("drive", 3, "FAILURE", "IDLE")]], *self.both)
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertEqual(
            [line for line in told.stdout.splitlines() if "warning" not in line],
            ["error: rule planned is violated", "/btcheck/violated: planned",
             "error: rule drives is violated", "/btcheck/violated: drives"])

    def test_nothing_is_told_of_a_run_that_keeps_the_rules(self):
        told = run([[change("go", 1, "IDLE", "RUNNING"),
                     change("plan", 2, "IDLE", "SUCCESS"),
                     change("drive", 3, "IDLE", "RUNNING")],
                    [change("drive", 3, "RUNNING", "SUCCESS")]], *self.both)
        self.assertEqual((told.returncode, told.stdout), (0, ""), told.stderr)

    def test_without_a_tree_it_says_what_is_missing(self):
        told = run([])
        self.assertEqual(told.returncode, 1)
        self.assertIn("set the parameters tree and rules", told.stderr)

    def test_where_btcheck_ends_it_ends(self):
        told = run([[change("go", 1, "IDLE", "RUNNING")]], "-p", "tree:=gone.xml",
                   "-p", "rules:=rules.ltl")
        self.assertEqual(told.returncode, 1)
        self.assertIn("btcheck has ended", told.stderr)


unittest.main(argv=sys.argv[:1])
