# SPDX-License-Identifier: MIT
"""Side by side with SPIN (G. Holzmann, "The SPIN Model Checker", 2003): one
thread each, every interleaving, no time, in turn. The two explore the same
graph, and that is checked: as many states, and as many transitions but one,
SPIN counting the way into the first state.

SPIN is given the model in two forms (promela.py), each with and without
-DCOLLAPSE, a hash table of as many slots as there are states to come, and a
stack that begins small and grows tenfold where it does not suffice.
"""
import math
import os
import re
import sys
from concurrent.futures import ThreadPoolExecutor

import promela
from runs import FOLDER, in_turn, middle, run, space, tree
from tables import count, mebibytes, seconds, table, times

TREES = ["examples/mars_rover.btf", "examples/drone1.btf",
         "examples/drone3.btf", "drone 2 1", "drone0 6 3", "nav2 1",
         "drone 6 1", "drone0 6 6", "drone0 6 12"]
QUICK = ["examples/mars_rover.btf", "examples/drone1.btf",
         "examples/drone3.btf"]
LARGE = 1_000_000  # states from which on a tree counts for the targets
OURS = ("--tick", "none", "--reduce", "none", "--threads", "1")
FORMS = {"as exported": str, "process by process": promela.process_by_process}
DEFINES = {"": [], ", COLLAPSE": ["-DCOLLAPSE"]}  # SPIN's two stores
GCC = ["gcc", "-w", "-DNOREDUCE", "-DSAFETY", "-DMEMLIM=18000"]


def required(command, folder):
    outcome = run(command, folder)
    if outcome.code != 0:
        sys.exit(f"{' '.join(command)}:\n{outcome.text}{outcome.errors}")
    return outcome


class Verifiers:
    """What SPIN makes of one tree: a verifier for each form and store."""

    def __init__(self, setting, words, forms=tuple(FORMS),
                 stores=tuple(DEFINES), optimisation="-O3"):
        self.depth = 2_000
        self.optimisation = optimisation
        self.folders = {}
        model = promela.without_standing_still(required(
            [setting.program, "export", str(tree(words)), "--to", "promela",
             "--tick", "none"], FOLDER).text)
        for form in forms:
            folder = FOLDER / "spin" / re.sub(r"\W+", "_", f"{words} {form}")
            folder.mkdir(parents=True, exist_ok=True)
            (folder / "model.pml").write_text(FORMS[form](model))
            required(["spin", "-a", "model.pml"], folder)
            for store in stores:
                self.folders[form + store] = (folder, "./pan" + store)
        with ThreadPoolExecutor(os.cpu_count()) as compilers:
            list(compilers.map(self.compile, self.folders))

    def compile(self, kind):
        folder, pan = self.folders[kind]
        required([*GCC, self.optimisation,
                  *DEFINES[pan.removeprefix("./pan")], "-o", pan, "pan.c"],
                 folder)

    def search(self, kind, slots):
        """-E: a tree that has ended is no error; -b: a stack too small is one,
        and stops the search; -n: nobody reads what was not reached."""
        folder, pan = self.folders[kind]
        while True:
            outcome = required([pan, "-n", "-E", "-b",
                                f"-m{self.depth}", f"-w{slots}"], folder)
            if "search depth too small" not in outcome.text:
                break
            self.depth *= 10

        def number(words):
            return int(re.search(words, outcome.text)[1])

        print(f"  pan {kind}: {outcome.seconds:.2f} s", file=sys.stderr)
        return {"kind": kind, "wall": outcome.seconds, "peak": outcome.peak,
                "states": number(r"(\d+) states, stored"),
                "transitions": number(r"(\d+) transitions"),
                "vector": number(r"State-vector (\d+) byte")}


def is_equal(setting, ours, spin):
    """SPIN counts one transition more, the way into the first state."""
    return setting.expect(
        (spin["states"], spin["transitions"]) ==
        (ours["states"], ours["transitions"] + 1),
        f"SPIN and btcheck on {ours['words']}: {spin} {ours}")


def compare(setting, words):
    verifiers = Verifiers(setting, words)
    ours = space(setting, words, *OURS)
    slots = max(16, math.ceil(math.log2(ours["states"])))
    jobs = [lambda: space(setting, words, *OURS)]
    jobs += [lambda kind=kind: verifiers.search(kind, slots)
             for kind in verifiers.folders]
    results = in_turn(jobs, setting.rounds, enough=60)
    ours, *theirs = [middle(outcomes) | {"peak": min(figures["peak"] for
                                                     figures in outcomes)}
                     for outcomes in results]
    equal = all(is_equal(setting, ours, spin) for spin in theirs)
    return {"words": words, "ours": ours, "theirs": theirs, "equal": equal,
            "rounds": len(results[0])}


def ratios(row, form):
    """How many times faster and smaller, against SPIN's faster and SPIN's
    smaller store."""
    theirs = [spin for spin in row["theirs"] if spin["kind"].startswith(form)]
    return [min(spin[key] for spin in theirs) / row["ours"][key]
            for key in ("wall", "peak")]


def measure(setting):
    return {"rows": [compare(setting, words)
                     for words in (QUICK if setting.quick else TREES)]}


def text(figures):
    rows, summary = [], []
    for row in figures["rows"]:
        ours = row["ours"]
        rows.append([f"`{row['words']}`", "btcheck", count(ours["states"]),
                     count(ours["transitions"]),
                     math.ceil(ours["vector_bits"] / 8), seconds(ours["wall"]),
                     mebibytes(ours["peak"]), "", ""])
        for spin in row["theirs"]:
            rows.append(["", "SPIN " + spin["kind"],
                         "equal" if row["equal"] else count(spin["states"]),
                         "equal + 1" if row["equal"]
                         else count(spin["transitions"]), spin["vector"],
                         seconds(spin["wall"]), mebibytes(spin["peak"]),
                         times(spin["wall"] / ours["wall"]),
                         times(spin["peak"] / ours["peak"])])
    for form in FORMS:
        large = [ratios(row, form) for row in figures["rows"]
                 if row["ours"]["states"] >= LARGE]
        if large:
            summary.append(f"{form} {times(min(r[0] for r in large))} times "
                           f"faster, {times(min(r[1] for r in large))} times "
                           "less memory")
    end = ("\nWorst ratio over the trees above 1 M states, against the better "
           f"of SPIN's two stores: {'; '.join(summary)}.\n") if summary else ""
    return table(["tree", "who", "states", "transitions", "vector, bytes", "s",
                  "peak MiB", "time ratio", "memory ratio"], rows, left=2) + end
