# SPDX-License-Identifier: MIT
"""Trees that several tests check."""

import json
import os
from pathlib import Path

SOURCES = Path(os.environ["BTCHECK_SOURCES"])
NAV2 = SOURCES / "examples/nav2/main/navigate_to_pose_w_replanning_and_recovery.xml"


def tree_of(body, more=""):
    return ('<root BTCPP_format="4" main_tree_to_execute="M">%s<BehaviorTree ID="M">'
            "%s</BehaviorTree></root>" % (more, body))


# 10 nodes.
SMALL = tree_of(
    "<Sequence><Fallback><IsDoorOpen/><Sequence><Unlock/><OpenDoor/></Sequence>"
    '</Fallback><RetryUntilSuccessful num_attempts="3"><GoThrough/>'
    "</RetryUntilSuccessful><CloseDoor/></Sequence>"
)

# More states than a test waits for.
ENDLESS = tree_of(
    '<Parallel success_count="14" failure_count="14">%s</Parallel>'
    % "".join("<Sequence><a%d/><b%d/><c%d/></Sequence>" % (i, i, i) for i in range(14))
)


def comparable(text):
    """A report without what differs from run to run, and without what speaks of
    options where the library speaks of fields."""
    report = json.loads(text)
    report.pop("timing")
    for tree in report["trees"]:
        tree.pop("timing")
        for of in tree["diagnostics"]:
            of.pop("help")
        for of in tree["findings"]:
            of["message"] = of["message"].split("\nHelp:")[0]
    return report
