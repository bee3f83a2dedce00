# SPDX-License-Identifier: MIT
"""Two btchecks in turn, on every row of `rates` and on the questions of
`properties`: what a change has cost, as the ratio of this program's seconds to
the other's (--beside). Counts and verdicts must be equal. Without the four trees
of `rates` that take longest.
"""
import dataclasses

from properties import REPORTS, RESPONSE, EXAMPLES, alone, asked
from rates import QUICK, TREES, WAYS, options
from runs import ROOT, counts, in_turn, middle, rules, space
from tables import count, seconds, table, times

SMALL = 0.05  # seconds, below which a ratio is that of starting a process
ENOUGH = 60   # seconds for one row
SLOW = {"drone 7 8", "drone0 12 12", "drone0 24 17", "binary 2055"}


def pair(setting, ask):
    """What this program and the other one give, the median of each."""
    other = dataclasses.replace(setting, program=setting.beside)
    jobs = [lambda: ask(setting), lambda: ask(other)]
    return [middle(each) for each in in_turn(jobs, setting.rounds, ENOUGH)]


def rate_rows(setting):
    for words in QUICK if setting.quick else TREES:
        if words in SLOW:
            continue
        for way in WAYS:
            ours, theirs = pair(
                setting, lambda one: space(one, words, *options(*way)))
            setting.expect(counts(ours) == counts(theirs),
                           f"{words} {way}: counts")
            yield {"what": f"`{words}`, {way[1]}, {way[0]} thread"
                           f"{'s' if way[0] > 1 else ''}",
                   "ours": ours["wall"], "theirs": theirs["wall"],
                   "states": [ours["states"], theirs["states"]]}


def questions(setting):
    # Those of drone3 have arguments, which older programs do not read.
    text = (ROOT / "examples" / "nav2.ltl").read_text()
    yield "nav2, all its rules", "examples/nav2.btf", text, ()
    for name in EXAMPLES[:3] if setting.quick else EXAMPLES:
        yield f"{name}, default report", f"examples/{name}.btf", None, ()
    if setting.quick:
        return
    for words, has_rules, _ in REPORTS[:2]:
        text = rules(words).read_text() if has_rules else None
        yield (f"`{words}`, {'its LTL rule' if has_rules else 'default report'}",
               words, text, ())
    words, name = RESPONSE
    yield (f"`{words}`, `{name}`", words,
           alone(rules(words).read_text())[name],
           ("--reduce", "none", "--threads", "1"))


def question_rows(setting):
    for what, words, text, more in questions(setting):
        ours, theirs = pair(
            setting, lambda one: asked(one, words, text, *more, limit=300))
        setting.expect(ours["verdict"] == theirs["verdict"],
                       f"{what}: verdicts")
        yield {"what": what, "ours": ours["wall"], "theirs": theirs["wall"],
               "states": [ours["explored"], theirs["explored"]]}


def measure(setting):
    if not setting.beside:
        raise SystemExit("name the other program: --beside PROGRAM")
    return {"rates": list(rate_rows(setting)),
            "questions": list(question_rows(setting))}


def cells(row):
    states = [count(number) if number else "" for number in row["states"]]
    is_small = max(row["ours"], row["theirs"]) < SMALL
    return [row["what"], states[0] if states[0] == states[1] else
            " / ".join(states), seconds(row["theirs"]), seconds(row["ours"]),
            "" if is_small else times(row["ours"] / row["theirs"])]


def text(figures):
    head = ["what", "states", "s, other", "s, this", "ratio"]
    return (table(head, map(cells, figures["rates"])) + "\n" +
            table(head, map(cells, figures["questions"])))
