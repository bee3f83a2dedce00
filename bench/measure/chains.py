# SPDX-License-Identifier: MIT
"""How the default report grows with the length of a tree: a Sequence of 100 to
800 actions in either language, which have as many times the states, and a state
as many times the bits. As two pictures in docs/pictures, each beside a line of
2.5 times for every doubling.
"""
import re
import subprocess

from runs import FOLDER, ROOT, in_turn, middle, run
from tables import count, mebibytes, table, times

LENGTHS = (100, 200, 400, 800)
LANGUAGES = ("xml", "btf")
LIMITS = ("--timeout", 5, "--memory", "500M")
BOUND = 2.5  # for every doubling
PICTURES = {"chain-time": ("time of the default report", "seconds", "seconds"),
            "chain-memory": ("memory of the default report", "MiB", "peak")}


def chain(length, language):
    """A tree of so many actions in one Sequence."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    file = FOLDER / f"chain_{length}.{language}"
    names = [f"Step{i}" for i in range(1, length + 1)]
    file.write_text(in_xml(names) if language == "xml" else in_btf(names))
    return file


def in_xml(names):
    leaves = "".join(f"<{name}/>\n" for name in names)
    models = "".join(f'<Action ID="{name}"/>\n' for name in names)
    return ('<root BTCPP_format="4">\n<BehaviorTree ID="Chain">\n'
            f"<Sequence>\n{leaves}</Sequence>\n</BehaviorTree>\n"
            f"<TreeNodesModel>\n{models}</TreeNodesModel>\n</root>\n")


def in_btf(names):
    leaves = "\n".join(f"  (Action :ID {name})" for name in names)
    return f"(BehaviorTree :name chain (Sequence\n{leaves}))\n"


def reported(setting, length, language):
    file = chain(length, language)

    def job():
        outcome = run([setting.program, file, *LIMITS])
        states = re.search(r"([\d,]+) states, all runs", outcome.text)
        setting.expect(states, f"a chain of {length} is not decided")
        return {"leaves": length, "language": language, "seconds": outcome.seconds,
                "peak": outcome.peak,
                "states": int(states[1].replace(",", "")) if states else 0}
    return middle(in_turn([job], 3 * setting.rounds)[0], "seconds")


def measure(setting):
    figures = [reported(setting, length, language)
               for language in LANGUAGES for length in LENGTHS]
    if not setting.quick:
        draw(figures)
    return figures


def of(figures, language):
    return [one for one in figures if one["language"] == language]


def draw(figures):
    for name, (title, unit, key) in PICTURES.items():
        scale = 2 ** 20 if key == "peak" else 1
        points = "".join(
            f".{one['language']}\t{one['leaves']}\t{one[key] / scale}\n"
            for one in figures)
        first = figures[0][key] / scale
        points += "".join(
            f"2.5 × per doubling\t{length}\t{first * BOUND ** i}\n"
            for i, length in enumerate(LENGTHS))
        drawn = subprocess.run(
            [ROOT / "bench" / "plot", title, "actions in a Sequence", unit],
            input=points, capture_output=True, text=True, check=True)
        (ROOT / "docs" / "pictures" / f"{name}.svg").write_text(drawn.stdout)


def text(figures):
    rows = []
    for language in LANGUAGES:
        mine = of(figures, language)
        for before, one in zip([None, *mine], mine):
            ratios = [times(one[key] / before[key]) if before else ""
                      for key in ("seconds", "peak")]
            rows.append(["" if before else f".{language}", one["leaves"],
                         count(one["states"]), f"{one['seconds']:.3f}",
                         ratios[0], mebibytes(one["peak"]), ratios[1]])
    pictures = "".join(f"![{title}](pictures/{name}.svg)\n"
                       for name, (title, _, _) in PICTURES.items())
    limits = " ".join(map(str, LIMITS))
    return (f"`btcheck TREE {limits}`.\n\n{pictures}\n" +
            table(["tree", "actions", "states", "s", "times", "peak MiB",
                   "times"], rows))
