# SPDX-License-Identifier: MIT
import sys
import time


class _Value:
    def __init__(self, value):
        self.value = value


class _Log:
    def error(self, text):
        print("error:", text, flush=True)

    def warning(self, text):
        print("warning:", text, flush=True)


class _Time:
    nanoseconds = time.time_ns()


class _Clock:
    def now(self):
        return _Time()


class _Publisher:
    def __init__(self, topic):
        self.topic = topic

    def publish(self, message):
        print(f"{self.topic}: {message.data}", flush=True)


class Node:
    def __init__(self, name):
        self.name = name
        self.subscriptions = []
        # -p name:=value
        words = [word.split(":=", 1) for word in sys.argv if ":=" in word]
        self._values = dict(words)

    def declare_parameter(self, name, preset):
        return _Value(self._values.get(name, preset))

    def create_publisher(self, kind, topic, depth):
        return _Publisher(topic)

    def create_subscription(self, kind, topic, callback, depth):
        self.subscriptions.append((topic, kind, callback))

    def get_logger(self):
        return _Log()

    def get_clock(self):
        return _Clock()
