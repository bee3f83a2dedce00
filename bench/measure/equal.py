# SPDX-License-Identifier: MIT
"""The counts of SPIN and btcheck on every tree of examples/ and the members of
every family up to twenty million states: as many states, as many transitions.
Each tree once, and not timed: SPIN takes the model as it is exported up to four
million states, and process by process above, where the other form would take it
a quarter of an hour. In memory and on disk btcheck counts the same.
"""
import math

import spin
from runs import FOLDER, ROOT, space
from tables import count, table

LARGEST = 20_000_000
LARGEST_AS_EXPORTED = 4_000_000
FAMILIES = ["drone 1 1", "drone 2 1", "drone 6 1", "drone 6 3", "drone0 1 1",
            "drone0 2 2", "drone0 6 3", "drone0 6 6", "drone0 6 12",
            "drones 1", "nav2 1", "nav2 2", "parallel 2", "parallel 3",
            "parallel 4", "binary 11", "binary 39", "binary 135",
            "rate 4", "rate 8", "rate 12"]


def trees(setting):
    if setting.quick:
        return spin.QUICK + ["parallel 3", "binary 39", "rate 4"]
    examples = [f"examples/{file.name}"
                for file in sorted((ROOT / "examples").glob("*.btf"))]
    return examples + FAMILIES


def compare(setting, words):
    ours = space(setting, words, *spin.OURS, "--max-states", LARGEST)
    row = {"words": words, "ours": ours, "form": None}
    if not ours["complete"]:
        return row
    row["form"] = ("as exported" if ours["states"] <= LARGEST_AS_EXPORTED
                   else "process by process")
    verifiers = spin.Verifiers(setting, words, [row["form"]], [""],
                               optimisation="-O1")
    slots = max(16, math.ceil(math.log2(ours["states"])))
    theirs = verifiers.search(row["form"], slots)
    row["equal"] = spin.is_equal(setting, ours, theirs)
    row["others"] = setting.expect(
        all(same(ours, space(setting, words, *spin.OURS[:4], *options))
            for options in (("--store", "exact", "--threads", 2),
                            ("--threads", 2), on_disk(ours))),
        f"two threads, the other store or the disk differ on {words}")
    return row


def on_disk(ours):
    """With so little memory that a search of more than two million states has
    to go on on disk, and enough for the halves of its vectors."""
    return ("--threads", 2, "--on-disk", FOLDER / "disk", "--memory",
            max(20_000_000, ours["search_bytes"] * 9 // 10))


def same(ours, other):
    keys = ("states", "markings", "transitions", "dead_states", "depth",
            "largest_frontier")
    return all(ours[key] == other[key] for key in keys)


def measure(setting):
    return {"rows": [compare(setting, words) for words in trees(setting)]}


def text(figures):
    rows = []
    for row in figures["rows"]:
        if row["form"] is None:
            rows.append([f"`{row['words']}`", f"more than {count(LARGEST)}",
                         "", "not asked", ""])
            continue
        rows.append([f"`{row['words']}`", count(row["ours"]["states"]),
                     count(row["ours"]["transitions"]),
                     f"{'equal' if row['equal'] else 'NOT EQUAL'}, "
                     f"{row['form']}", "equal" if row["others"] else
                     "NOT EQUAL"])
    return table(["tree", "states", "transitions", "SPIN",
                  "two threads, both stores, disk"], rows, left=1)
