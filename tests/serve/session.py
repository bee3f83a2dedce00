# SPDX-License-Identifier: MIT
"""A client of `btcheck serve` and `btcheck mcp`, as small as one can be."""
import json
import subprocess


class Session:
    def __init__(self, program, *words, cwd=".", framed=True, **popen):
        self.framed = framed
        self.count = 0
        self.others = []  # what was read beside an answer
        self.process = subprocess.Popen(
            [program, *words], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            cwd=cwd, **popen)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()
        try:
            self.process.stdin.close()
        except OSError:
            pass

    def write(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, message):
        data = message if isinstance(message, bytes) else json.dumps(
            message).encode()
        self.write(b"Content-Length: %d\r\n\r\n%s" % (len(data), data)
                   if self.framed else data + b"\n")

    def begin(self, method, **params):
        self.count += 1
        self.send({"jsonrpc": "2.0", "id": self.count, "method": method,
                   "params": params})
        return self.count

    def notify(self, method, **params):
        self.send({"jsonrpc": "2.0", "method": method, "params": params})

    def read(self):
        """The next message, None at the end."""
        if not self.framed:
            line = self.process.stdout.readline()
            return json.loads(line) if line else None
        length = None
        while True:
            line = self.process.stdout.readline()
            if not line:
                return None
            if not line.strip():
                return json.loads(self.process.stdout.read(length))
            name, value = line.split(b":")
            assert name == b"Content-Length", line
            length = int(value)

    def answer(self, number):
        for i, message in enumerate(self.others):
            if message.get("id") == number:
                return self.others.pop(i)
        while True:
            message = self.read()
            assert message is not None, "the server has gone"
            if message.get("id") == number:
                return message
            self.others.append(message)

    def ask(self, method, **params):
        return self.answer(self.begin(method, **params))

    def result(self, method, **params):
        answer = self.ask(method, **params)
        assert "result" in answer, answer
        return answer["result"]

    def error(self, method, **params):
        answer = self.ask(method, **params)
        assert "error" in answer, answer
        return answer["error"]

    def end(self):
        self.process.stdin.close()
        return self.process.wait(timeout=60)
