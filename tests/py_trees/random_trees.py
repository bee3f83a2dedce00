#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Random trees of py_trees, and what py_trees itself does with them.

    random_trees.py COUNT [SEED [TICKS]]

writes records of the kind that tests/btcpp_random/recorded has, one for each
tree: its XML (contrib/py_trees writes it), the script of its leaves, a line for
each tick as `btcheck simulate --script` has it, and a line with the statuses of
all nodes behind that tick. docs/engine_comparison.md tells more. Exit code 77
without py_trees.
"""

import pathlib
import random
import sys

try:
    import py_trees
except ImportError as missing:
    print("skipped: %s" % missing, file=sys.stderr)
    sys.exit(77)

sys.path.insert(
    0, str(pathlib.Path(__file__).resolve().parents[2] / "contrib" / "py_trees")
)
import py_trees_to_xml  # noqa: E402
from py_trees import behaviours, common, composites, decorators, timers  # noqa: E402
from py_trees.common import ParallelPolicy, Status  # noqa: E402

ENDS = (Status.SUCCESS, Status.FAILURE)
ANSWERS = ENDS + (Status.RUNNING,)
SECONDS_A_TICK = 0.1


class Clock:
    """In place of the module `time`. Within a tick it goes on a little."""

    def __init__(self):
        self.now = 0.0

    def time(self):
        self.now += 1e-7
        return self.now

    monotonic = time

    def begin(self, tick):
        self.now = tick * SECONDS_A_TICK


class Played:
    """The answers of one leaf; the last one repeats."""

    def __init__(self, answers):
        self.answers = answers
        self.next = 0

    def take(self):
        answer = self.answers[min(self.next, len(self.answers) - 1)]
        self.next += 1
        return answer


class Scripted(py_trees.behaviour.Behaviour):
    def __init__(self, name, played):
        super().__init__(name)
        self.played = played

    def update(self):
        return self.played.take()


class Maker:
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.script = {}
        self.inner = 0
        self.conditions = {}  # by the name of their guard

    def name(self):
        self.inner += 1
        return "n%d" % self.inner

    def answers(self, of):
        style = self.random.random()
        count = self.random.randint(1, 8)
        if style < 0.2:
            return [self.random.choice(of)]
        if style < 0.5 and Status.RUNNING in of:
            return [Status.RUNNING] * self.random.randint(1, 5) + [
                self.random.choice(ENDS)
            ]
        return [self.random.choice(of) for _ in range(count)]

    def played(self, letter, of):
        name = "%s%d" % (letter, len(self.script) + 1)
        played = Played(self.answers(of))
        self.script[name] = list(played.answers)
        return name, played

    def duration(self):
        """None, or half a tick more than some: no matter when a tick begins."""
        whole = self.random.randint(0, 5)
        return (whole - 0.5) * SECONDS_A_TICK if whole else 0.0

    def leaf(self):
        choice = self.random.random()
        if choice < 0.72:
            return Scripted(*self.played("a", ANSWERS))
        name = self.name()
        makers = [
            lambda: behaviours.Success(name),
            lambda: behaviours.Failure(name),
            lambda: behaviours.Running(name),
            lambda: behaviours.Dummy(name),
            lambda: behaviours.TickCounter(
                name, self.random.randint(0, 4), self.random.choice(ANSWERS)
            ),
            lambda: behaviours.StatusQueue(
                name,
                [self.random.choice(ANSWERS) for _ in range(self.random.randint(1, 5))],
                self.random.choice(ANSWERS + (None,)),
            ),
            lambda: behaviours.Periodic(name, self.random.randint(1, 3)),
            lambda: behaviours.SuccessEveryN(name, self.random.randint(1, 4)),
            lambda: timers.Timer(name, self.duration()),
        ]
        return self.random.choice(makers)()

    def composite(self, depth):
        name = self.name()
        count = self.random.choice((0, 1, 2, 2, 2, 3, 3, 4))
        if count == 0 and self.random.random() < 0.8:
            count = 2
        kind = self.random.random()
        memory = self.random.random() < 0.5
        children = [self.node(depth - 1) for _ in range(count)]
        if kind < 0.33:
            return composites.Sequence(name, memory, children)
        if kind < 0.66:
            return composites.Selector(name, memory, children)
        synchronise = self.random.random() < 0.5
        policies = [
            lambda: ParallelPolicy.SuccessOnAll(synchronise),
            ParallelPolicy.SuccessOnOne,
        ]
        if children:
            selected = self.random.sample(children, self.random.randint(1, count))
            policies.append(lambda: ParallelPolicy.SuccessOnSelected(selected, synchronise))
        return composites.Parallel(name, self.random.choice(policies)(), children)

    def guard(self, name, child):
        condition, played = self.played("c", ENDS)

        def ask():
            answer = played.take()
            self.log(condition, answer.value.lower())
            return answer if self.random.random() < 0.5 else answer == Status.SUCCESS

        ask.__name__ = condition
        self.conditions[name] = condition
        return decorators.EternalGuard(name, child, ask)

    def decorator(self, depth):
        name = self.name()
        child = self.node(depth - 1)
        plain = [
            decorators.Inverter,
            decorators.FailureIsSuccess,
            decorators.FailureIsRunning,
            decorators.SuccessIsFailure,
            decorators.SuccessIsRunning,
            decorators.RunningIsFailure,
            decorators.RunningIsSuccess,
            decorators.PassThrough,
            decorators.Count,
        ]
        makers = [lambda kind=kind: kind(name=name, child=child) for kind in plain] + [
            lambda: decorators.Repeat(name, child, self.random.randint(-1, 4)),
            lambda: decorators.Repeat(name, child, self.random.randint(1, 3)),
            lambda: decorators.Retry(name, child, self.random.randint(0, 4)),
            lambda: decorators.Retry(name, child, self.random.randint(2, 3)),
            lambda: decorators.Timeout(name, child, self.duration()),
            lambda: decorators.Timeout(name, child, self.duration()),
            lambda: decorators.OneShot(
                name, child, self.random.choice(list(common.OneShotPolicy))
            ),
            lambda: decorators.OneShot(
                name, child, self.random.choice(list(common.OneShotPolicy))
            ),
            lambda: decorators.Condition(name, child, self.random.choice(list(Status))),
            lambda: decorators.StatusToBlackboard(name, child, "status_of_" + name),
            lambda: self.guard(name, child),
            lambda: self.guard(name, child),
        ]
        return self.random.choice(makers)()

    def node(self, depth):
        if depth == 0:
            return self.leaf()
        choice = self.random.random()
        if choice < 0.45:
            return self.composite(depth)
        return self.decorator(depth) if choice < 0.8 else self.leaf()

    def log(self, name, answer):
        self.happened.setdefault(name, []).append(answer)

    def watch(self, node):
        """Has every stop of a node that runs logged."""
        stop = node.stop

        def watched(new_status):
            if new_status == Status.INVALID and node.status == Status.RUNNING:
                self.log(node.name, "halted")
            stop(new_status)

        node.stop = watched

    def pre_order(self, node):
        yield node.name, node
        if node.name in self.conditions:
            yield self.conditions[node.name], None
        for child in node.children:
            yield from self.pre_order(child)

    def run(self, root, ticks, clock):
        nodes = list(self.pre_order(root))
        for _, node in nodes:
            if node is not None:
                self.watch(node)
        lines, statuses = [], []
        for tick in range(1, ticks + 1):
            clock.begin(tick)
            self.happened = {}
            for node in root.tick():
                self.log(node.name, node.status.value.lower())
            lines.append(
                "tick %d: root=%s%s"
                % (
                    tick,
                    root.status.value.lower(),
                    "".join(
                        " %s=%s" % (name, ",".join(self.happened[name]))
                        for name, _ in nodes
                        if name in self.happened
                    ),
                )
            )
            statuses.append(
                "".join("?" if node is None else node.status.value[0] for _, node in nodes)
            )
        return lines, statuses


def record(seed, ticks):
    maker = Maker(seed)
    root = maker.composite(maker.random.randint(2, 4))
    text = py_trees_to_xml.to_xml(root)
    clock = Clock()
    decorators.time = timers.time = clock
    lines, statuses = maker.run(root, ticks, clock)
    script = [
        "%s: %s" % (name, " ".join(answer.value.lower() for answer in answers))
        for name, answers in maker.script.items()
    ]
    parts = {"xml": [text.rstrip()], "script": script, "engine": lines, "status": statuses}
    return "=== t%d py_trees\n" % seed + "".join(
        "--- %s\n%s" % (part, "".join(line + "\n" for line in of))
        for part, of in parts.items()
    )


def main():
    count = int(sys.argv[1])
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    ticks = int(sys.argv[3]) if len(sys.argv) > 3 else 20
    print(
        "# SPDX-License-Identifier: MIT\n#\n# Recorded from py_trees %s by "
        "tests/py_trees/random_trees.py." % py_trees.version.__version__
    )
    for seed in range(first, first + count):
        sys.stdout.write(record(seed, ticks))


if __name__ == "__main__":
    main()
