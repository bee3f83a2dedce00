# SPDX-License-Identifier: MIT
"""How many checks and lints one core makes in a second, and what memory so many
checks take: python_rates.py CHECKS. Fails where memory grows."""

import gc
import os
import sys
import time
from pathlib import Path

import btcheck

SOURCES = Path(os.environ["BTCHECK_SOURCES"])
NAV2 = SOURCES / "examples/nav2/main/navigate_to_pose_w_replanning_and_recovery.xml"
# 10 nodes, and nothing to warn of. In the other one the gripper is left open, and
# a change that mends it is looked for by checking again.
TREE = """<root BTCPP_format="4"><BehaviorTree ID="M"><Sequence>
  <a/><b/><Fallback><c/><d/><e/></Fallback><f/><g/></Sequence></BehaviorTree></root>"""
WARNED = """<root BTCPP_format="4"><BehaviorTree ID="M"><Sequence>
  <CheckBattery/><OpenGripper/>
  <Fallback><GraspDirectly/><GraspFromAbove/></Fallback>
  <CloseGripper/><Lift/><Place/></Sequence></BehaviorTree></root>"""


def rate(what, call):
    """Calls in a second of processor time, and of time."""
    call()
    calls, began, cpu = 0, time.monotonic(), time.process_time()
    while time.monotonic() - began < 3:
        call()
        calls += 1
    print("%-36s %6.0f per second of processor time, %6.0f per second"
          % (what, calls / (time.process_time() - cpu),
             calls / (time.monotonic() - began)))


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def check():
    report = btcheck.check(TREE)
    assert report.ok and report.findings and report.node_count == 10


rate("check of 10 nodes, ok alone", lambda: btcheck.check(TREE).ok)
rate("check of 10 nodes, with findings", check)
rate("check of 10 nodes, a rule that holds",
     lambda: btcheck.check(TREE, "never g.halted").ok)
rate("check of 10 nodes, a warning", lambda: btcheck.check(WARNED).findings)
text = NAV2.read_text()
rate("lint of Nav2's default tree", lambda: btcheck.lint(text).findings)
rate("lint of it by its path", lambda: btcheck.lint(NAV2).findings)

checks = int(sys.argv[1])
for _ in range(200):
    check()
gc.collect()
before = resident()
for _ in range(checks):
    check()
gc.collect()
grown = resident() - before
print("%d checks: %.1f MB more of %.1f MB" % (checks, grown / 1e6, before / 1e6))
# A report that is not freed takes 100 kB.
if grown > 8 << 20:
    sys.exit("memory has grown")
