# SPDX-License-Identifier: MIT
"""Questions instead of counts: each property of drone3 and Nav2 alone, the
default report of every example, a binary tree of 2,055 nodes, drones on one
battery, and a response that is true on a product of millions of states.
Seconds are those of the whole process.
"""
import re

from runs import FOLDER, ROOT, in_turn, middle, rules, run, space, tree
from tables import count, mebibytes, seconds, table

EXAMPLES = ["recovery", "roundrobin", "train", "mars_rover", "drone1",
            "drone3", "drone3-fixed", "nav2"]
EXPLORED = re.compile(r"explored up to ([\d,]+) states")
VERDICT = re.compile(r"^(HOLDS|VIOLATED|UNDECIDED)\b", re.MULTILINE)
UNDECIDED = re.compile(r"^UNDECIDED .*", re.MULTILINE)
ENDS = {0: "all as it should be", 1: "a fault is found", 3: "undecided"}
RESPONSE = ("drone0 6 6", "every_look_ends")  # a product of eight million
# Rows of the default report and beyond: name, tree, rules or none, seconds.
REPORTS = [("binary 2055", True, 120), ("drones 2", False, 300),
           ("drones 3", False, 180)]


def alone(text):
    """Each property of a file with the declarations it needs, by name."""
    lines = [line for line in text.splitlines()
             if line.strip() and not line.lstrip().startswith("#")]
    head, blocks, block = [], [], None
    for line in lines:
        word = line.split()[0]
        if word in ("let", "tick", "assume", "tree"):
            block = head if word != "tree" else []
        elif word == "expect" or (
                word == "property" and
                not (blocks and block is blocks[-1] and
                     len(block) == 1 and block[0].startswith("expect"))):
            block = []
            blocks.append(block)
        block.append(line)
    name = re.compile(r"property +(\w+)")
    return {name.search("\n".join(block))[1]: "\n".join(head + block) + "\n"
            for block in blocks}


def asked(setting, words, properties, *options, limit=60):
    """btcheck on a tree, with properties or (None) the default report. The
    longest search of all is told at the end, unless -q is given."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    arguments = []
    if properties is not None:
        file = FOLDER / "asked.ltl"
        file.write_text(properties)
        arguments = ["--prop", file]
    outcome = run([setting.program, tree(words), *arguments, "--timeout",
                   limit, *options])
    told = VERDICT.search(outcome.text)
    undecided = UNDECIDED.search(outcome.text)
    explored = EXPLORED.search(outcome.errors)
    if not setting.expect(outcome.code in ENDS, f"{words}: {outcome.errors}"):
        return {"wall": outcome.seconds, "peak": outcome.peak, "explored": 0,
                "verdict": "", "end": "failed"}
    return {"wall": outcome.seconds, "peak": outcome.peak,
            "verdict": told[1] if told else "",
            "explored": int(explored[1].replace(",", "")) if explored else 0,
            "end": undecided[0] if undecided else ENDS[outcome.code]}


def repeated(setting, *arguments, enough=60, **keywords):
    jobs = [lambda: asked(setting, *arguments, **keywords)]
    return middle(in_turn(jobs, setting.rounds, enough)[0])


def one_by_one(setting, name):
    words = f"examples/{name}.btf"
    text = (ROOT / "examples" / f"{name}.ltl").read_text()
    return {"tree": name, "properties": {
        key: repeated(setting, words, one, enough=20)
        for key, one in alone(text).items()}}


def response(setting):
    words, name = RESPONSE
    text = alone(rules(words).read_text())[name]
    return repeated(setting, words, text, "--reduce", "none", "--threads",
                    "1", enough=90)


def measure(setting):
    names = ["drone3"] if setting.quick else ["drone3", "nav2"]
    figures = {"single": [one_by_one(setting, name) for name in names]}
    figures["default"] = [
        {"tree": name} | repeated(setting, f"examples/{name}.btf", None)
        for name in (EXAMPLES[:-1] if setting.quick else EXAMPLES)]
    figures["reports"] = []
    for words, has_rules, limit in REPORTS[:1 if setting.quick else None]:
        text = rules(words).read_text() if has_rules else None
        figures["reports"].append(
            {"tree": words, "what": "its LTL rule" if has_rules else
             "default report"} | repeated(setting, words, text, limit=limit))
    figures["one"] = one_exploration(setting)
    if not setting.quick:
        figures["response"] = response(setting)
    return figures


def one_exploration(setting):
    """The default report beside one search of the same states."""
    words, options = "examples/drone3-fixed.btf", ("--reduce", "none")
    return {"report": repeated(setting, words, None, *options),
            "space": middle(in_turn([lambda: space(setting, words, *options)],
                                    setting.rounds)[0])}


def slowest(figures, name):
    """Name and seconds of the slowest property of an example."""
    group = next(one for one in figures["single"] if one["tree"] == name)
    return max(((key, one["wall"]) for key, one in
                group["properties"].items()), key=lambda pair: pair[1])


def report_row(words, what, one):
    return [words, what, seconds(one["wall"]), mebibytes(one["peak"]),
            count(one["explored"]) if one["explored"] else "", one["end"]]


def text(figures):
    rows = []
    for group in figures["single"]:
        for key, one in group["properties"].items():
            rows.append([group["tree"], f"`{key}`", seconds(one["wall"]),
                         one["verdict"]])
    reports = [report_row(one["tree"], "default report", one)
               for one in figures["default"]]
    reports += [report_row(one["tree"], one["what"], one)
                for one in figures["reports"]]
    if "response" in figures:
        reports.append(report_row(
            RESPONSE[0], f"`{RESPONSE[1]}`, `--reduce none --threads 1`",
            figures["response"]))
    return (table(["tree", "question", "s", "peak MiB", "largest search, "
                   "states", "says"], reports, left=2, last=1) + "\n" +
            table(["tree", "property alone", "s", "verdict"], rows, left=2,
                  last=1))
