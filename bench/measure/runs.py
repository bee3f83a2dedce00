# SPDX-License-Identifier: MIT
"""Running a program and what it cost: seconds of wall time and the largest
memory of the whole process, as GNU time tells it. Every figure of the page is
made here. Programs that are compared run in turn, so that a slow minute of the
machine hits both, and the median of the rounds is taken.
"""
import dataclasses
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "build" / "bench"  # trees, verifiers and figures of this run


@dataclasses.dataclass
class Setting:
    """How to measure: which btcheck, how often, and how much there is time
    for. `complaints` collects what ought to be equal and is not."""
    program: str
    quick: bool
    rounds: int
    beside: str = ""  # another btcheck, to compare with
    complaints: list = dataclasses.field(default_factory=list)

    def expect(self, truth, complaint):
        if not truth:
            print("NOT EQUAL:", complaint, file=sys.stderr)
            self.complaints.append(complaint)
        return truth


@dataclasses.dataclass
class Outcome:
    code: int
    text: str
    errors: str
    seconds: float  # wall time of the process
    peak: int       # bytes, largest resident set of the process


def run(command, folder=ROOT, timeout=None):
    """Runs a list of words in a folder. A timeout gives code None."""
    with tempfile.NamedTemporaryFile("r") as cost:
        words = ["/usr/bin/time", "-q", "-f", "%M", "-o", cost.name,
                 *map(str, command)]
        start = time.perf_counter()
        try:
            done = subprocess.run(words, cwd=folder, capture_output=True,
                                  text=True, timeout=timeout, check=False)
        except subprocess.TimeoutExpired:
            return Outcome(None, "", "", time.perf_counter() - start, 0)
        seconds = time.perf_counter() - start
        peak = 1024 * int(cost.read().split()[-1])
    return Outcome(done.returncode, done.stdout, done.stderr, seconds, peak)


def tree(words):
    """The file of a tree: a path from the root, or a family and its numbers,
    which is printed into the folder of this run."""
    if words.endswith(".btf"):
        return ROOT / words
    return generated(words, ".btf", [])


def rules(words):
    """The property file of a family."""
    return generated(words, ".ltl", ["--properties"])


def generated(words, ending, options):
    FOLDER.mkdir(parents=True, exist_ok=True)
    file = FOLDER / (words.replace(" ", "_") + ending)
    made = subprocess.run([ROOT / "bench" / "families", *words.split(),
                           *options], capture_output=True, text=True,
                          check=True)
    file.write_text(made.stdout)
    return file


def space(setting, words, *options):
    """`btcheck space` of a tree: its JSON, with the seconds and the peak of
    the whole process beside it."""
    outcome = run([setting.program, "space", tree(words), "-q", "--stats",
                   "json", *options])
    if outcome.code not in (0, 3):  # 3: a limit was reached
        sys.exit(f"btcheck space {words} {' '.join(map(str, options))}\n"
                 f"{outcome.errors}")
    figures = json.loads(outcome.text)
    figures |= {"words": words, "wall": outcome.seconds, "peak": outcome.peak}
    print(f"  {words} {' '.join(map(str, options))}: {figures['states']:,} "
          f"states, {outcome.seconds:.2f} s", file=sys.stderr)
    return figures


def counts(figures):
    """What must not depend on threads, store or machine."""
    return {key: figures[key]
            for key in ("states", "transitions", "dead_states")}


def in_turn(jobs, rounds, enough=240.0):
    """Calls each job `rounds` times, in turn; fewer rounds once `enough`
    seconds are gone. Returns what each job gave, a list per job."""
    results = [[] for _ in jobs]
    start = time.perf_counter()
    for _ in range(rounds):
        for result, job in zip(results, jobs):
            result.append(job())
        spent = time.perf_counter() - start
        if spent + spent / len(results[0]) > enough:
            break
    return results


def middle(outcomes, key="wall"):
    """The run whose `key` is the median."""
    low = statistics.median_low([figures[key] for figures in outcomes])
    return next(figures for figures in outcomes if figures[key] == low)
