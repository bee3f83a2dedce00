# SPDX-License-Identifier: MIT
"""Leaves of a tree that btcheck runs, in Python.

    leaves = Leaves()

    @leaves.action("takeoff")           # a generator: yield is "running",
    def takeoff(call):                  # return True or False ends it
        while drone.height < call.arguments["height"]:
            yield
        return True

    @leaves.condition("localization_ok")
    def localization_ok(call):
        return gps.ok

    @leaves.measure("measure_battery")  # a SetSV: the value it finds
    def measure_battery(call):
        return "Low"

    leaves.serve()

`btcheck run TREE.btf --leaves-exec 'python3 this_file.py'` speaks to it in lines
of JSON on standard input and output (docs/run.md); print() to standard error.
An action that is halted sees GeneratorExit at its yield.
"""
import json
import sys


class Call:
    """What a leaf is called with."""

    def __init__(self, message):
        self.leaf = message["leaf"]  # the :ID
        self.node = message["node"]  # unique in the tree: "land@23"
        self.tick = message.get("tick", 0)
        self.arguments = message.get("arguments", {})
        self.variable = message.get("variable")  # of a measurement


class Leaves:
    def __init__(self):
        self.tree = {}  # what `begin` tells: tick_ms, seed, leaves, variables
        self._actions = {}
        self._conditions = {}
        self._measures = {}
        self._running = {}  # generators, by node
        self._on_begin = []
        self._waiting = []  # questions read while a leaf was answering

    # --- What answers --------------------------------------------------------

    def action(self, name):
        return self._register(self._actions, name)

    def condition(self, name):
        return self._register(self._conditions, name)

    def measure(self, name):
        return self._register(self._measures, name)

    def on_begin(self, function):
        self._on_begin.append(function)
        return function

    @staticmethod
    def _register(where, name):
        def keep(function):
            where[name] = function
            return function

        return keep

    # --- State variables -----------------------------------------------------

    def set(self, variable, value):
        """A variable that moves by itself has changed."""
        self._send({"set": variable, "value": value})

    def get(self, variable):
        """The value in the model; only while a leaf is called."""
        self._send({"get": variable})
        while True:  # other actions may be told to halt meanwhile
            message = json.loads(sys.stdin.readline())
            if message["do"] == "value":
                return message["value"]
            self._waiting.append(message)

    # --- The conversation ----------------------------------------------------

    def _questions(self):
        while True:
            if self._waiting:
                yield self._waiting.pop(0)
                continue
            line = sys.stdin.readline()
            if not line:
                return
            yield json.loads(line)

    def serve(self):
        for message in self._questions():
            if message["do"] == "end":
                break
            reply = {"id": message["id"]}
            reply.update(self._reply(message))
            self._send(reply)

    @staticmethod
    def _send(message):
        sys.stdout.write(json.dumps(message) + "\n")
        sys.stdout.flush()

    def _reply(self, message):
        what = message["do"]
        if what == "begin":
            self.tree = message
            for function in self._on_begin:
                function()
            return {"answer": "ready"}
        call = Call(message)
        if what == "measure":
            return {"value": self._measures[call.leaf](call)}
        if what == "ask":
            return {"answer": self._word(self._conditions[call.leaf](call))}
        if what == "halt":
            running = self._running.pop(call.node, None)
            if running is not None:
                running.close()
            return {"answer": "halted"}
        if what == "start":
            self._running[call.node] = self._actions[call.leaf](call)
        return {"answer": self._step(call.node)}

    def _step(self, node):
        try:
            next(self._running[node])
            return "running"
        except StopIteration as end:
            del self._running[node]
            return self._word(end.value)

    @staticmethod
    def _word(value):
        return "success" if value else "failure"
