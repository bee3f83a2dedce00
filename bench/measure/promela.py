# SPDX-License-Identifier: MIT
"""The model that `btcheck export --to promela --tick none` prints, made ready
for being timed. Two things are changed; neither changes a state.

`without_standing_still` takes out the option by which a run that has ended
stands still: SPIN would count a step from each such state to itself.

`process_by_process` tells the same edges once more, as someone would write
them for SPIN by hand: the export is one process whose loop tries every edge of
every automaton in every state, and SPIN is several times faster where each
automaton is a process, its location the place in its text. This is also the
form that -DCOLLAPSE is made for.
"""
import re

STANDS_STILL = re.compile(
    r" */\* (?:a step of time|a fault has ended the run) \*/\n *:: .*\n")
URGENT = re.compile(r"#define \w*is_urgent(?:.*\\\n)+.*\n")
OPTION = re.compile(r"  /\* (.*?) \*/\n  :: (.*?)(?=\n  /\*|\n  od)", re.DOTALL)
LOOP = re.compile(r"active proctype network\(\) \{\n  do\n")


def without_standing_still(model):
    model, found = STANDS_STILL.subn("", model)
    assert found in (1, 2), "the export has changed"
    return model


def edge_of(name, step):
    """Source, line of text and target of one option: the location leaves the
    guard and the updates."""
    guard, updates = re.match(r"d_step \{(.*?)->(.*)\}", step,
                              re.DOTALL).groups()
    place = rf"{name}_location ==? {name}_at_(\w+)"
    source, target = (re.search(place, part)[1] for part in (guard, updates))
    tests = [test.strip() for test in guard.split("&&")]
    tests = [test for test in tests if not re.fullmatch(place, test)]
    changes = [change.strip() for change in updates.split(";")]
    changes = [change for change in changes
               if change and not re.fullmatch(place, change)]
    return source, (f"  :: d_step {{ {' && '.join(tests) or 'true'} -> "
                    f"{'; '.join(changes) or 'skip'} }}; goto at_{target}\n"
                    ), target


def process(name, steps, first):
    """A process with a label for each location, the first one first."""
    edges = [edge_of(name, step) for step in steps]
    places = [first] + sorted({place for source, _, target in edges
                               for place in (source, target)} - {first})
    text = f"active proctype {name}() {{\n"
    for place in places:
        lines = [line for source, line, _ in edges if source == place]
        text += (f"at_{place}:\n  if\n{''.join(lines)}  fi;\n" if lines
                 else f"at_{place}:\n  false;\n")
    return text + "}\n"


def loop(name, steps):
    """A process that stays what it was: a loop over all its edges."""
    options = "".join(f"  :: {step}\n" for step in steps)
    return f"active proctype {name}() {{\n  do\n{options}  od\n}}\n"


def process_by_process(model):
    """For a model without standing still."""
    declarations, edges = LOOP.split(model)
    declarations = URGENT.sub("", declarations)
    automata = {}
    for label, step in OPTION.findall(edges):
        automata.setdefault(label.split(":")[0], []).append(step)
    text = ""
    for i, (name, steps) in enumerate(automata.items()):
        place = re.search(rf"byte {name}_location = {name}_at_(\w+);\n",
                          declarations)
        elsewhere = any(f"{name}_location" in step
                        for other in automata if other != name
                        for step in automata[other])
        if not place or elsewhere:  # a variable; a timer that its node sets
            text += loop(f"automaton_{i}", steps)
            continue
        declarations = declarations.replace(place[0], "")
        text += process(name, steps, place[1])
    return declarations + text
