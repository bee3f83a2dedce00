# SPDX-License-Identifier: MIT
"""How time and memory grow with the number of states: each family from its
smallest member upwards, both stores, all cores, as two pictures in
docs/pictures. A larger member of `binary` also has longer vectors, the others
hardly.
"""
import os
import subprocess

from runs import ROOT, in_turn, middle, space
from tables import count, mebibytes, seconds, table

# From ten thousand states to two hundred million.
FAMILIES = {
    "drone": ["drone 1 1", "drone 2 1", "drone 6 1", "drone 6 3",
              "drone 6 6", "drone 7 8", "drone 12 12"],
    "drone0": ["drone0 1 1", "drone0 2 2", "drone0 6 3", "drone0 6 6",
               "drone0 6 12", "drone0 12 12", "drone0 24 17"],
    "binary": ["binary 39", "binary 135", "binary 519", "binary 2055"],
}
STORES = ("exact", "compressed")
QUICK_MEMBERS = 3
PICTURES = {
    "growth-time": ("time per state", "microseconds per state",
                    lambda one: 1e6 * one["seconds"] / one["states"]),
    "growth-memory": ("memory per state", "bytes per state, of the search",
                      lambda one: one["bytes_per_state"]),
}


def searched(setting, words, store):
    """The median of several runs of a small tree, one of a large one."""
    def job():
        return space(setting, words, "--reduce", "none", "--threads",
                     os.cpu_count(), "--store", store, "--timeout", 150)
    return middle(in_turn([job], setting.rounds, enough=10)[0], "seconds")


def measure(setting):
    series = []
    for family, members in FAMILIES.items():
        for store in STORES:
            runs = [searched(setting, words, store)
                    for words in members[:QUICK_MEMBERS if setting.quick
                                         else None]]
            series.append({"family": family, "store": store,
                           "runs": [run for run in runs if run["complete"]]})
    figures = {"series": series}
    if not setting.quick:
        draw(figures)
    return figures


def draw(figures):
    """The pictures, by bench/plot: lines of series, x and y."""
    folder = ROOT / "docs" / "pictures"
    folder.mkdir(exist_ok=True)
    for name, (title, unit, value) in PICTURES.items():
        points = "".join(
            f"{one['family']}, {one['store']}\t{run['states']}\t{value(run)}\n"
            for one in figures["series"] for run in one["runs"])
        drawn = subprocess.run(
            [ROOT / "bench" / "plot", title, "states", unit], input=points,
            capture_output=True, text=True, check=True)
        (folder / f"{name}.svg").write_text(drawn.stdout)


def text(figures):
    rows = []
    for one in figures["series"]:
        for run in one["runs"]:
            rows.append([f"`{run['words']}`", one["store"],
                         count(run["states"]), seconds(run["wall"]),
                         *(f"{value(run):.3g}"
                           for _, _, value in PICTURES.values()),
                         mebibytes(run["peak"])])
    pictures = "".join(f"![{title}](pictures/{name}.svg)\n"
                       for name, (title, _, _) in PICTURES.items())
    return pictures + "\n" + table(
        ["tree", "store", "states", "s", "µs/state, search",
         "B/state, search", "peak MiB"], rows, left=2)
