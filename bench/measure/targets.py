# SPDX-License-Identifier: MIT
"""The table of targets: what must be reached, what would be better, what was
measured, and by which command. It runs nothing: the figures are those that the
other parts kept last.
"""
import json

import properties
import reductions
import spin
from runs import FOLDER
from tables import seconds, table, times

FAST = "btcheck space TREE --reduce none --threads 2"
SPIN_NOTE = "export --to promela, tick none; worst above 1 M states"


def kept(name, quick):
    file = FOLDER / f"{name}{'-quick' if quick else ''}.json"
    return json.loads(file.read_text()) if file.exists() else None


def measure(setting):
    return {name: kept(name, setting.quick)
            for name in ("rates", "spin", "reductions", "properties")}


def ways(rates, words):
    """The four runs of a tree by store and threads."""
    row = next((row for row in rates["rows"] if row["words"] == words), None)
    return {(run["store"], run["threads"]): run
            for run in row["runs"]} if row else {}


def row(name, must, stretch, measured, command):
    return [name, must, stretch, measured, command]


def rate_rows(rates):
    for words, name, must, stretch in (
            ("drone 6 3", "out-degree 5, 2 threads: transitions/s", "30 M",
             "60 M"),
            ("drone0 6 12", "out-degree 2, 400 bits, 2 threads: "
             "transitions/s", "12 M", "30 M")):
        if runs := ways(rates, words):
            measured = "; ".join(
                f"{store} {run['transitions'] / run['wall'] / 1e6:.1f} M"
                for (store, threads), run in runs.items() if threads == 2)
            yield row(name, must, stretch, measured, f"{FAST}, `{words}`")
    gains = [(runs[store, 1]["wall"] / runs[store, 2]["wall"], words, store)
             for words in ("drone 6 3", "drone 7 8", "drone0 6 12",
                           "drone0 12 12", "nav2 1")
             if (runs := ways(rates, words)) for store in
             ("exact", "compressed")]
    if gains:
        low, high = min(gains), max(gains)
        yield row("2 threads against 1, equal counts", "1.8", "2.0",
                  f"{low[0]:.2f} ({low[1]}, {low[2]}) to {high[0]:.2f} "
                  f"({high[1]}, {high[2]})", "the same with --threads 1")


def size_rows(rates):
    for words, name, must, stretch in (
            ("drone 7 8", "over 47 M states unreduced", "10 s, 800 MB",
             "5 s, 300 MB"),
            ("drone0 24 17", "over 170 M states unreduced", "40 s, 3 GB",
             "15 s, 1 GB")):
        if runs := ways(rates, words):
            measured = "; ".join(
                f"{store} {seconds(run['wall'])} s, {run['peak'] / 1e6:,.0f}"
                " MB" for (store, threads), run in runs.items()
                if threads == 2)
            yield row(name, must, stretch, measured, f"{FAST}, `{words}`")
    for store, must in (("exact", "13"), ("compressed", "7")):
        found = [(run["peak"] / run["states"], line["words"])
                 for line in rates["rows"] for run in line["runs"]
                 if run["store"] == store and run["states"] > 10_000_000]
        if found:
            low, high = min(found), max(found)
            yield row(f"bytes per state, whole process, {store}, above 10 M "
                      "states", must, "", f"{low[0]:.1f} ({low[1]}) to "
                      f"{high[0]:.1f} ({high[1]})", f"--store {store}")


def spin_rows(figures):
    large = [row for row in figures["rows"]
             if row["ours"]["states"] >= spin.LARGE]
    for form in spin.FORMS if large else []:
        ratios = [spin.ratios(row, form) for row in large]
        yield row(f"against SPIN, model {form}", "8 × faster, 15 × smaller",
                  "20 ×", f"{times(min(one[0] for one in ratios))} × faster, "
                  f"{times(min(one[1] for one in ratios))} × smaller",
                  SPIN_NOTE)


def reduction_rows(figures):
    kinds = (("with free variables", "20 ×", "60 ×",
              ("drone ", "examples/mars")),
             ("without", "40 ×", "250 ×",
              ("drone0", "nav2", "examples/drone3.")))
    for name, must, stretch, starts in kinds:
        found = [(row["words"], reductions.fewer(row, "full"))
                 for row in figures["rows"] if row["words"].startswith(starts)]
        measured = "; ".join(f"{words}: {times(factor)}" if factor else
                             f"{words}: cut" for words, factor in found)
        yield row(f"states, full against none, {name}", must, stretch,
                  measured, "btcheck space TREE --reduce full")
    same = all(line["same"] for line in figures["equal"])
    count = sum(line["properties"] for line in figures["equal"])
    yield row("verdicts of none, live, full", "equal", "",
              f"{count} properties, {'equal' if same else 'NOT EQUAL'}",
              "btcheck TREE --prop FILE --reduce KIND")


def property_rows(figures):
    for one in figures["single"]:
        name, wall = properties.slowest(figures, one["tree"])
        yield row(f"every property of {one['tree']}", "1 s", "0.2 s",
                  f"slowest {seconds(wall)} s ({name})",
                  f"btcheck examples/{one['tree']}.btf --prop ONE")
    if response := figures.get("response"):
        yield row("true response on an 8 M-state product, one thread", "4 s",
                  "1.5 s", f"{seconds(response['wall'])} s, "
                  f"{response['explored']:,} states, {response['verdict']}",
                  f"`{' '.join(properties.RESPONSE)}` --reduce none "
                  "--threads 1")
    report, alone = figures["one"]["report"], figures["one"]["space"]
    yield row("all default properties of a tree", "one exploration", "",
              f"largest search {report['explored']:,} of {alone['states']:,} "
              f"states, {times(report['wall'] / alone['wall'])} × the time of "
              "one exploration", "btcheck examples/drone3-fixed.btf")
    reports = {one["tree"]: one for one in figures["reports"]}
    for words, must, stretch in (("binary 2055", "1 s", "0.1 s"),
                                 ("drones 2", "60 s", "5 s"),
                                 ("drones 3", "undecided and why, or decided",
                                  "")):
        if one := reports.get(words):
            yield row(f"{words}, {one['what']}", must, stretch,
                      f"{seconds(one['wall'])} s, {one['end']}",
                      f"btcheck, `{words}`")


def text(figures):
    rows = []
    for name, makers in (("rates", (rate_rows, size_rows)),
                         ("spin", (spin_rows,)),
                         ("reductions", (reduction_rows,)),
                         ("properties", (property_rows,))):
        if figures[name]:
            for maker in makers:
                rows += maker(figures[name])
    return table(["target", "must", "better", "measured", "command"], rows,
                 left=5)
