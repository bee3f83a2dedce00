# SPDX-License-Identifier: MIT
"""How fast states are found, and how much memory they take: both stores, one
thread and two, every interleaving. The counts of the four must be equal.
"""
from runs import counts, in_turn, middle, space
from tables import count, mebibytes, millions, seconds, table, times

# What each is here for. The sizes are the smallest that reach the ones asked
# for in the table of targets.
TREES = {
    "drone 6 3": "out-degree 5, over 10 M states",
    "drone 7 8": "over 47 M states, two variables move",
    "drone0 6 12": "out-degree 2, 400 bits, over 10 M",
    "drone0 12 12": "the same, longer vectors",
    "nav2 1": "one tree in daily use, clocks",
    "drone0 24 17": "over 170 M states",
    "binary 2055": "2,055 nodes",
    "rate 8": "eight clocks",
    "examples/drone3.btf": "the paper's drone",
}
QUICK = ["drone 2 1", "drone0 6 3", "binary 263", "examples/drone3.btf"]
WAYS = [(threads, store) for store in ("exact", "compressed")
        for threads in (1, 2)]


def options(threads, store):
    return ("--reduce", "none", "--threads", threads, "--store", store)


def measure(setting):
    rows = []
    for words in QUICK if setting.quick else TREES:
        jobs = [lambda way=way: space(setting, words, *options(*way))
                for way in WAYS]
        runs = [middle(outcomes) for outcomes in in_turn(jobs, setting.rounds)]
        first = counts(runs[0])
        for way, figures in zip(WAYS, runs):
            setting.expect(counts(figures) == first,
                           f"{words}: counts with {way}")
        rows.append({"words": words, "runs": runs})
    return {"rows": rows}


def way_cells(figures, alone):
    return [figures["store"], figures["threads"], seconds(figures["wall"]),
            millions(figures["states"] / figures["wall"]),
            millions(figures["transitions"] / figures["wall"]),
            f"{figures['bytes_per_state']:.1f}",
            f"{figures['peak'] / figures['states']:.1f}",
            mebibytes(figures["peak"]),
            "" if figures["threads"] == 1 else
            times(alone["wall"] / figures["wall"])]


def text(figures):
    shapes, costs = [], []
    for row in figures["rows"]:
        runs = row["runs"]
        one = runs[0]
        shapes.append([f"`{row['words']}`", TREES.get(row["words"], ""),
                       count(one["states"]), count(one["transitions"]),
                       f"{one['transitions'] / one['states']:.2f}",
                       one["vector_bits"], count(one["depth"]),
                       count(one["largest_frontier"])])
        for i, way in enumerate(runs):
            costs.append([f"`{row['words']}`" if i == 0 else "",
                          *way_cells(way, runs[i - i % 2])])
    return (table(["tree", "here for", "states", "transitions", "out-degree",
                   "bits", "depth", "largest level"], shapes, left=2) + "\n" +
            table(["tree", "store", "threads", "s", "M states/s",
                   "M transitions/s", "B/state, search", "B/state, process",
                   "peak MiB", "speed-up"], costs, left=2))
