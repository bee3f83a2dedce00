# SPDX-License-Identifier: MIT
"""LTSmin with libbtcheck-pins.so on 1, 2 and 4 ranks of this machine: what a
state costs, what a message adds, how much memory a state takes; and a model of
when machines pay against one machine with a disk, made of the runs with one
rank and two and checked against the one with four. Processor time is counted,
not wall time: four ranks share what cores there are. Asked for by name; needs
LTSmin (docs/scaling.md).
"""
import functools
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

from runs import ROOT, in_turn, middle, space, tree
from tables import count, mebibytes, millions, seconds, table

PAGE = ROOT / "docs" / "scaling.md"
MODULE = ROOT / "build" / "release" / "libbtcheck-pins.so"
# The words of the module, and how many integers a state is then: two for each
# word of the packed state, or one for each variable.
WAYS = {"packed": "--packed", "variables": ""}
TREES = [("nav2 1", "none"), ("drone0 2 2", "root")]
QUICK = [("drone0 1 1", "root")]
RANKS = (1, 2, 4)
# What is not measured here, but stands in the model.
NETWORK = 1.25e9  # bytes a second from one machine to the others: 10 Gbit/s
LINES = (2, 4, 16, 64)


def program(name):
    folder = os.environ.get("LTSMIN", "")
    found = (pathlib.Path(folder) / name if folder else shutil.which(name))
    if not found or not MODULE.exists():
        sys.exit("LTSmin is not installed, or libbtcheck-pins is not built")
    return str(found)


def search(words, ticks, way, ranks):
    """One run of dist; of 0 ranks, of seq."""
    with tempfile.NamedTemporaryFile("r") as cost:
        # Of each rank by itself: a line of seconds, seconds and kilobytes.
        command = ["/usr/bin/time", "-q", "-a", "-f", "%U %S %M", "-o",
                   cost.name,
                   program("pins2lts-dist" if ranks else "pins2lts-seq"),
                   f"--loader={MODULE}", str(tree(words))]
        if ranks:
            command = ["mpirun", "--allow-run-as-root", "--oversubscribe",
                       "--mca", "mpi_yield_when_idle", "1", "-np", str(ranks),
                       *command, "--mpi"]
        start = time.perf_counter()
        done = subprocess.run(
            command, capture_output=True, text=True, check=False,
            env=os.environ | {"BTCHECK_PINS": f"{WAYS[way]} --tick {ticks}"})
        wall = time.perf_counter() - start
        lines = [tuple(map(float, line.split())) for line in cost]
    cpu = sum(user + system for user, system, _ in lines)
    told = done.stdout + done.stderr
    found = re.findall(r"state space (?:has )?\d+ levels,? (\d+) states (\d+)",
                       told)
    if not found:
        sys.exit(f"{' '.join(command)}\n{told[-2000:]}")
    states, transitions = map(int, found[-1])
    length = re.search(r"State length is (\d+)", told)
    print(f"  {words}, {way}, {ranks} ranks: {cpu:.1f} s",
          file=sys.stderr)
    return {"ranks": ranks, "states": states, "transitions": transitions,
            "cpu": cpu, "wall": wall,
            "peaks": [1024 * peak for _, _, peak in lines],
            "slots": int(length.group(1)) if length else None}


def on_disk(setting, words, ticks, states):
    """btcheck with a sixth of the memory that it would take."""
    folder = ROOT / "build" / "bench" / "disk"
    return space(setting, words, "--tick", ticks, "--threads", 1, "--memory",
                 max(20_000_000, states * 2), "--on-disk", folder)


def measure(setting):
    rows = []
    for words, ticks in QUICK if setting.quick else TREES:
        ours = space(setting, words, "--tick", ticks, "--threads", 1)
        disk = on_disk(setting, words, ticks, ours["states"])
        for way in WAYS:
            jobs = [functools.partial(search, words, ticks, way, ranks)
                    for ranks in (0, *RANKS)]
            runs = [middle(each, "cpu")
                    for each in in_turn(jobs, setting.rounds)]
            for run in runs:
                setting.expect(
                    (run["states"], run["transitions"]) ==
                    (ours["states"], ours["transitions"]),
                    f"{words}: counts with {run['ranks']} ranks, {way}")
            rows.append({"words": words, "ticks": ticks, "way": way,
                         "ours": ours, "disk": disk, "runs": runs})
    if not setting.quick:
        draw(rows[0])
    return {"rows": rows}


def fitted(row):
    """Seconds of a state, and of a message, of the runs with one rank and two:
    of two ranks half of the transitions go to the other one."""
    one, two = row["runs"][1], row["runs"][2]
    state = one["cpu"] / one["states"]
    message = max(0.0, two["cpu"] - one["cpu"]) / (two["transitions"] / 2)
    return state, message


def predicted(row, ranks):
    state, message = fitted(row)
    run = row["runs"][1]
    return run["states"] * state + run["transitions"] * message * (
        1 - 1 / ranks)


def needed(row):
    """From how many machines on they are faster than one with a disk: each has
    its share of the states, and of the messages."""
    run, disk = row["runs"][1], row["disk"]
    state, message = fitted(row)
    fan = run["transitions"] / run["states"]
    for machines in range(2, 10_001):
        share = (state + fan * (1 - 1 / machines) * message) / machines
        if share < disk["wall"] / disk["states"]:
            return machines
    return None


def cost_row(row):
    state, message = fitted(row)
    seq, four = row["runs"][0], row["runs"][3]
    off = predicted(row, 4) / four["cpu"] - 1
    return [f"`{row['words']}`, tick {row['ticks']}", row["way"],
            count(seq["states"]), micro(row["ours"]["wall"] / seq["states"]),
            micro(row["disk"]["wall"] / seq["states"]),
            micro(seq["cpu"] / seq["states"]), micro(state), micro(message),
            f"{off:+.0%}", needed(row) or "none"]


def micro(value):
    return f"{value * 1e6:.2f}"


def run_row(row, run):
    name = f"dist, {run['ranks']}" if run["ranks"] else "seq"
    return [f"`{row['words']}`, {row['way']}", name, seconds(run["wall"]),
            seconds(run["cpu"]), millions(run["states"] / run["cpu"]),
            mebibytes(max(run["peaks"])),
            f"{sum(run['peaks']) / run['states']:.0f}"]


def text(figures):
    rows = figures["rows"]
    return (table(["tree", "slots", "states", "btcheck", "on disk", "seq",
                   "a state", "a message", "model of 4 ranks",
                   "machines"], [cost_row(row) for row in rows], left=2) +
            "\nMicroseconds for each state, or each message; *btcheck* and *on "
            "disk* are wall time with one thread, all others processor time.\n"
            "\n" +
            table(["tree", "program, ranks", "wall, s", "processor, s",
                   "M states for a second of it", "largest rank, MiB",
                   "bytes a state, all ranks"],
                  [run_row(row, run) for row in rows for run in row["runs"]],
                  left=2) +
            "\n![Model: seconds against states](pictures/scaling-time.svg)\n")


def draw(row):
    """What the model says of larger spaces: seconds against states, of one
    machine with a disk and of several, whose network counts as well."""
    state, message = fitted(row)
    run, disk = row["runs"][1], row["disk"]
    fan = run["transitions"] / run["states"]
    # A state, where it comes from, and three labels.
    size = 4 * (row["runs"][0]["slots"] + 1 + 3)
    points = []
    for power in range(12, 24):
        states = 10 ** (power / 2)
        points.append(("one, disk", states,
                       states * disk["wall"] / disk["states"]))
        for machines in LINES:
            sent = states * fan * (1 - 1 / machines) / machines
            points.append((f"{machines} machines", states,
                           states * state / machines + sent * message +
                           sent * size / NETWORK))
    file = ROOT / "docs" / "pictures" / "scaling-time.svg"
    made = subprocess.run(
        [ROOT / "bench" / "plot", f"Model, {row['words']}", "states",
         "seconds"], input="".join(f"{name}\t{x}\t{y}\n"
                                   for name, x, y in points),
        capture_output=True, text=True, check=True)
    file.write_text(made.stdout)

