#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes a tree of py_trees as XML for btcheck (docs/pytrees.md).

On the command line, with a function that returns the root of the tree, or a
py_trees.trees.BehaviourTree:

    python3 py_trees_to_xml.py robot.trees:create_root >robot.xml

or in a program:

    import py_trees_to_xml
    text = py_trees_to_xml.to_xml(root)
"""

import argparse
import functools
import importlib
import math
import os
import re
import sys
import xml.sax.saxutils

import py_trees
from py_trees import behaviours, composites, decorators, timers
from py_trees.common import OneShotPolicy, ParallelPolicy, Status


class ExportError(Exception):
    """What the tree has that cannot be written. One line for each."""


# What decides the answers of a node. A class of the user's that inherits all of
# them from a class of py_trees does what that does.
_DECIDING = ("tick", "update", "stop", "initialise", "terminate")
# A composite calls its initialise, terminate and update for the user alone.
_OF_COMPOSITES = ("tick", "stop")

_COMPOSITES = (composites.Sequence, composites.Selector, composites.Parallel)
_PLAIN = tuple(
    getattr(decorators, name)
    for name in (
        "Inverter",
        "FailureIsSuccess",
        "FailureIsRunning",
        "SuccessIsFailure",
        "SuccessIsRunning",
        "RunningIsFailure",
        "RunningIsSuccess",
        "PassThrough",
        "Count",
    )
    if hasattr(decorators, name)
)


def _boolean(value):
    return "true" if value else "false"


def _answer(status):
    if status not in (Status.SUCCESS, Status.FAILURE, Status.RUNNING):
        raise ExportError("a behaviour that answers %s is not modelled" % status)
    return status.value


def _seconds(value):
    if not math.isfinite(value):
        raise ExportError("a duration of %s cannot be written" % value)
    return repr(float(value))


def _whole(value):
    if int(value) != value:
        raise ExportError("%s is no whole number" % value)
    return str(int(value))


def _check_text(check):
    word = getattr(check.operator, "__name__", "compares")
    return "%s %s %s" % (check.variable, word, check.value)


def _policy_of_oneshot(node):
    for policy in (OneShotPolicy.ON_COMPLETION, OneShotPolicy.ON_SUCCESSFUL_COMPLETION):
        if node.policy == policy:
            return policy.name
    raise ExportError("its policy is none of py_trees'")


def _queue(node):
    attributes = {"queue": ";".join(_answer(status) for status in node.queue)}
    if node.eventually is not None:
        attributes["eventually"] = _answer(node.eventually)
    return attributes


# The attributes of each class that has some.
_ATTRIBUTES = {
    composites.Sequence: lambda node: {"memory": _boolean(node.memory)},
    composites.Selector: lambda node: {"memory": _boolean(node.memory)},
    decorators.Repeat: lambda node: {"num_success": _whole(node.num_success)},
    decorators.Retry: lambda node: {"num_failures": _whole(node.num_failures)},
    decorators.Timeout: lambda node: {"duration": _seconds(node.duration)},
    decorators.OneShot: lambda node: {"policy": _policy_of_oneshot(node)},
    decorators.Condition: lambda node: {"status": node.succeed_status.value},
    decorators.StatusToBlackboard: lambda node: {"variable_name": node.variable_name},
    behaviours.TickCounter: lambda node: {
        "duration": _whole(max(0, node.duration)),
        "completion_status": _answer(node.completion_status),
    },
    behaviours.StatusQueue: _queue,
    behaviours.Periodic: lambda node: {"n": _whole(node.period)},
    behaviours.SuccessEveryN: lambda node: {"n": _whole(node.every_n)},
    timers.Timer: lambda node: {"duration": _seconds(node.duration)},
    behaviours.CheckBlackboardVariableExists: lambda node: {
        "variable_name": node.variable_name
    },
    behaviours.WaitForBlackboardVariable: lambda node: {
        "variable_name": node.variable_name
    },
    behaviours.UnsetBlackboardVariable: lambda node: {"variable_name": node.key},
    behaviours.BlackboardToStatus: lambda node: {"variable_name": node.variable_name},
    behaviours.SetBlackboardVariable: lambda node: {
        "variable_name": node.variable_name,
        "overwrite": _boolean(node.overwrite),
    },
    behaviours.CheckBlackboardVariableValue: lambda node: {
        "check": _check_text(node.check)
    },
    behaviours.WaitForBlackboardVariableValue: lambda node: {
        "check": _check_text(node.check)
    },
    behaviours.CheckBlackboardVariableValues: lambda node: {
        "check": "; ".join(_check_text(check) for check in node.checks)
    },
}
if hasattr(behaviours, "ProbabilisticBehaviour"):
    _ATTRIBUTES[behaviours.ProbabilisticBehaviour] = lambda node: {
        "weights": ";".join(repr(float(weight)) for weight in node._weights)
    }

_LEAVES = tuple(
    kind
    for kind in _ATTRIBUTES
    if not issubclass(kind, (composites.Composite, decorators.Decorator))
) + (behaviours.Success, behaviours.Failure, behaviours.Running, behaviours.Dummy)
_DECORATORS = _PLAIN + tuple(
    kind for kind in _ATTRIBUTES if issubclass(kind, decorators.Decorator)
)
_KNOWN = _COMPOSITES + _DECORATORS + _LEAVES + (decorators.EternalGuard,)
# Names that mean something in the XML, whatever class has them in Python.
_TAKEN = {kind.__name__ for kind in _KNOWN} | {
    "Action",
    "Condition",
    "Control",
    "Decorator",
    "SubTree",
}


def _behaves_as(node, kind, methods):
    return isinstance(node, kind) and all(
        getattr(type(node), method) is getattr(kind, method) for method in methods
    )


def _kind_of(node):
    """The class of py_trees that says what the node does, or None."""
    for kind in _COMPOSITES:
        if _behaves_as(node, kind, _OF_COMPOSITES):
            return kind
    # The most derived first: a WaitForBlackboardVariable is a Check, too.
    found = [kind for kind in _KNOWN if _behaves_as(node, kind, _DECIDING)]
    return max(found, key=lambda kind: len(kind.__mro__), default=None)


def _plain_name(text):
    """Without line breaks and other control characters, as one line of text."""
    return re.sub(r"[\x00-\x20\x7f]+", " ", text).strip()


def _identifier(text):
    return re.sub(r"\W+", "_", text) or "_"


class _Writer:
    def __init__(self, conditions):
        self.conditions = conditions
        self.lines = []
        self.problems = []
        self.path = []

    def write(self, node, depth):
        self.path.append(node.name)
        try:
            self._write(node, depth)
        except ExportError as error:
            self.problems.append(
                "%s (%s): %s"
                % (
                    " / ".join(_plain_name(name) for name in self.path),
                    type(node).__name__,
                    error,
                )
            )
        self.path.pop()

    def _write(self, node, depth):
        if node.status != Status.INVALID:
            raise ExportError("it has been ticked: write the tree before its first tick")
        kind = _kind_of(node)
        if kind is None:
            self._write_own(node, depth)
        elif kind in _COMPOSITES and not node.children:
            # It answers at once, and always the same.
            never = kind is composites.Selector
            self._element(depth, "Failure" if never else "Success", node.name, {})
        else:
            self._write_known(kind, node, depth)

    def _write_known(self, kind, node, depth):
        if kind is composites.Parallel:
            attributes = self._policy(node)
        else:
            attributes = _ATTRIBUTES.get(kind, lambda _: {})(node)
        word = kind.__name__
        if kind is decorators.Condition:
            word = "Decorator"
            attributes = {"ID": "Condition", **attributes}
        self._element(depth, word, node.name, attributes, bool(node.children))
        if kind is decorators.EternalGuard:
            self._write_condition(node, depth + 1)
        for child in node.children:
            self.write(child, depth + 1)
        if node.children:
            self.lines.append("%s</%s>" % ("  " * depth, word))

    def _write_condition(self, guard, depth):
        condition = guard.condition
        while isinstance(condition, functools.partial):
            condition = condition.func
        name = getattr(condition, "__name__", type(condition).__name__)
        if name == "<lambda>":
            name = "check"
        self._element(depth, "Condition", name, {"ID": self._id(name, condition)})

    def _policy(self, node):
        policy = node.policy
        attributes = {"policy": type(policy).__name__}
        if type(policy) is ParallelPolicy.SuccessOnSelected:
            places = [
                place
                for selected in policy.children
                for place, child in enumerate(node.children, 1)
                if child is selected
            ]
            if not places or len(places) != len(policy.children):
                raise ExportError("its policy selects what is not its child")
            attributes["selected"] = ";".join(map(str, places))
        elif type(policy) not in (
            ParallelPolicy.SuccessOnAll,
            ParallelPolicy.SuccessOnOne,
        ):
            raise ExportError(
                "its policy %s is none of py_trees'" % type(policy).__name__
            )
        attributes["synchronise"] = _boolean(policy.synchronise)
        return attributes

    def _write_own(self, node, depth):
        """A behaviour of the user's."""
        if node.children or isinstance(node, (composites.Composite, decorators.Decorator)):
            raise ExportError("what this composite or decorator does is not known")
        if not _behaves_as(node, py_trees.behaviour.Behaviour, ("tick", "stop")):
            raise ExportError("a behaviour with its own tick or stop is not known")
        is_condition = type(node).__name__ in self.conditions
        self._element(
            depth,
            "Condition" if is_condition else "Action",
            node.name,
            {"ID": self._id(type(node).__name__, type(node))},
        )

    @staticmethod
    def _id(name, of):
        if name in _TAKEN:
            name = "%s_%s" % (of.__module__, name)
        return _identifier(name)

    def _element(self, depth, word, name, attributes, is_open=False):
        text = "".join(
            " %s=%s" % (key, xml.sax.saxutils.quoteattr(_plain_name(value)))
            for key, value in {"name": name, **attributes}.items()
        )
        self.lines.append(
            "%s<%s%s%s>" % ("  " * depth, word, text, "" if is_open else "/")
        )


def _name_of_tree(root):
    """One that no node has, so that every node is called by its name alone."""
    names = {node.name for node in root.iterate()}
    name = "MainTree"
    while name in names:
        name += "_"
    return name


def to_xml(root, conditions=()):
    """The tree below `root`, which is a behaviour or a BehaviourTree.

    `conditions` are names of classes whose behaviours never answer RUNNING.
    Raises an ExportError where something cannot be written.
    """
    if isinstance(root, py_trees.trees.BehaviourTree):
        root = root.root
    release = py_trees.version.__version__
    if not release.startswith("2.") or not hasattr(decorators, "Retry"):
        raise ExportError("py_trees %s is too old: 2.2 is needed" % release)
    writer = _Writer(set(conditions))
    writer.write(root, 2)
    if writer.problems:
        raise ExportError("\n".join(writer.problems))
    return "\n".join(
        [
            '<root BTCPP_format="4" py_trees="%s">' % release,
            '  <BehaviorTree ID="%s">' % _name_of_tree(root),
            *writer.lines,
            "  </BehaviorTree>",
            "</root>",
            "",
        ]
    )


def _tree_of(place):
    module, _, function = place.partition(":")
    if not function:
        raise ExportError("%s: MODULE:FUNCTION is expected" % place)
    sys.path.insert(0, os.getcwd())
    made = getattr(importlib.import_module(module), function)
    return made() if callable(made) else made


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "tree", metavar="MODULE:FUNCTION", help="returns the tree; or a variable with it"
    )
    parser.add_argument(
        "--condition",
        metavar="CLASS",
        action="append",
        default=[],
        help="behaviours of this class never answer RUNNING",
    )
    options = parser.parse_args()
    try:
        sys.stdout.write(to_xml(_tree_of(options.tree), options.condition))
    except (ExportError, ImportError, AttributeError) as error:
        sys.exit("\n".join("error: " + line for line in str(error).splitlines()))


if __name__ == "__main__":
    main()
