#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How soon a process that stays answers behind an edit of one leaf.

    bench/edits.py PROGRAM TREE [--file FILE] [--leaves N] [--repairs]
                   [--rounds N]

Asks `btcheck serve` for the report of TREE, of which FILE (TREE itself, unless
said otherwise) is edited: each of its first N leaves, six without it, is in
turn called something else, taken for one that always succeeds, inverted and
left out, each edit taken back before the next. Prints the milliseconds of the
first report, and of those behind edits of each kind the median and the most;
and the memory of the process behind each of the rounds, one without it.
"""
import argparse
import os
import re
import statistics
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "serve"))
from session import Session  # noqa: E402

NO_LEAVES = {"include", "SubTree", "SubTreePlus", "Script", "ScriptCondition",
             "AlwaysSuccess", "AlwaysFailure"}


def edits(text, leaves):
    """The kind of each edit, and the text that it makes."""
    count = 0
    for leaf in re.finditer(r"<(\w+)[^<>]*/>", text):
        if leaf[1] in NO_LEAVES:
            continue
        count += 1
        if count > leaves:
            return
        for kind, by in (
                ("another name", leaf[0].replace(leaf[1], leaf[1] + "X", 1)),
                ("AlwaysSuccess", "<AlwaysSuccess/>"),
                ("inverted", "<Inverter>%s</Inverter>" % leaf[0]),
                ("left out", "")):
            yield kind, text[:leaf.start()] + by + text[leaf.end():]


def resident(process):
    with open("/proc/%d/status" % process.pid) as status:
        line = next(each for each in status if each.startswith("VmRSS"))
    return int(line.split()[1]) / 1024


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("tree")
    parser.add_argument("--file")
    parser.add_argument("--leaves", type=int, default=6)
    parser.add_argument("--repairs", action="store_true")
    parser.add_argument("--rounds", type=int, default=1)
    given = parser.parse_args()
    folder, tree = os.path.split(os.path.abspath(given.tree))
    file = os.path.relpath(given.file or given.tree, folder)
    with open(os.path.join(folder, file)) as stream:
        text = stream.read()
    with Session(os.path.abspath(given.program), "serve", "--stdio", "--root",
                 folder, cwd=folder) as session:
        def milliseconds(now):
            begin = time.monotonic()
            session.result("check", tree=tree, files={file: now},
                           tries_repairs=given.repairs)
            return 1000 * (time.monotonic() - begin)

        print("first %.0f ms" % milliseconds(text))
        taken = {}
        for count in range(given.rounds):
            for number, (kind, edited) in enumerate(edits(text, given.leaves)):
                mark = "<!-- %d.%d -->" % (count, number)
                taken.setdefault(kind, []).append(milliseconds(edited + mark))
                taken.setdefault("taken back", []).append(
                    milliseconds(text + mark))
            print("%.0f MiB" % resident(session.process))
        for kind, each in taken.items():
            print("%-14s median %4.0f ms, at most %4.0f ms" %
                  (kind, statistics.median(each), max(each)))


main()
