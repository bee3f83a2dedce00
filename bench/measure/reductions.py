# SPDX-License-Identifier: MIT
"""What the reductions leave: stored states without, with dead values forgotten
(live) and with that and sleeping interleavings (full). What may not change is
every verdict, which is checked on the property files of the examples and of
the families.
"""
import re

from runs import ROOT, rules, run, space, tree
from tables import count, seconds, table, times

KINDS = ("none", "live", "full")
TREES = ["examples/recovery.btf", "examples/roundrobin.btf",
         "examples/train.btf", "examples/mars_rover.btf",
         "examples/drone1.btf", "examples/drone3.btf",
         "examples/drone3-fixed.btf", "nav2 1", "drone 6 3", "drone 7 8",
         "drone0 6 12", "drone0 12 12", "parallel 4", "binary 263", "rate 8"]
QUICK = ["examples/mars_rover.btf", "examples/drone3.btf", "drone 2 1"]
RULES = ["examples/recovery", "examples/roundrobin", "examples/train",
         "examples/mars_rover", "examples/drone1", "examples/drone3",
         "examples/drone3-fixed", "drone 2 1", "drone0 2 1", "drones 1",
         "parallel 3", "binary 71", "rate 4"]
VERDICT = re.compile(r"^(HOLDS|VIOLATED|UNDECIDED) +(\w+)", re.MULTILINE)


def verdicts(setting, words, kind):
    """Name and verdict of every property."""
    example = words.startswith("examples/")
    pair = ([f"{words}.btf", "--prop", f"{words}.ltl"] if example
            else [tree(words), "--prop", rules(words)])
    outcome = run([setting.program, *pair, "-q", "--reduce", kind], ROOT)
    found = {name: verdict for verdict, name in VERDICT.findall(outcome.text)}
    setting.expect(found, f"no verdicts on {words} with {kind}: "
                          f"{outcome.errors[-300:]}")
    return found


def measure(setting):
    rows, equal = [], []
    for words in QUICK if setting.quick else TREES:
        runs = [space(setting, words, "--reduce", kind, "--timeout", "120")
                for kind in KINDS]
        rows.append({"words": words, "runs": runs})
    for words in RULES[:5] if setting.quick else RULES:
        told = [verdicts(setting, words, kind) for kind in KINDS]
        same = setting.expect(told[0] == told[1] == told[2],
                              f"verdicts on {words}: {told}")
        equal.append({"words": words, "properties": len(told[0]),
                      "same": same})
    return {"rows": rows, "equal": equal}


def fewer(row, kind):
    """How many times fewer states than without reduction; None when one of
    the two searches was cut."""
    runs = dict(zip(KINDS, row["runs"]))
    if not (runs["none"]["complete"] and runs[kind]["complete"]):
        return None
    return runs["none"]["states"] / runs[kind]["states"]


def text(figures):
    rows = []
    for row in figures["rows"]:
        cells = [f"`{row['words']}`"]
        cells += [count(run["states"]) + ("" if run["complete"] else " (cut)")
                  for run in row["runs"]]
        cells += [times(factor) if factor else "–" for factor in
                  (fewer(row, "live"), fewer(row, "full"))]
        cells += [seconds(row["runs"][i]["wall"]) for i in (0, 2)]
        rows.append(cells)
    files = ", ".join(f"{line['words']} ({line['properties']})"
                      for line in figures["equal"] if line["same"])
    return (table(["tree", "none", "live", "full", "fewer: live",
                   "fewer: full", "s, none", "s, full"], rows) +
            f"\nEqual verdicts with all three, properties counted: {files}.\n")
