# SPDX-License-Identifier: MIT
"""An editor, as far as `btcheck lsp` sees one."""
import json
import os
import queue
import subprocess
import threading
import time
from urllib.parse import quote


def uri_of(path):
    return "file://" + quote(os.path.abspath(path))


def utf16(text):
    return len(text.encode("utf-16-le")) // 2


class Editor:
    def __init__(self, program, folder, *words, capabilities=None,
                 options=None, **popen):
        self.folder = os.path.realpath(folder)
        self.process = subprocess.Popen(
            [program, "lsp", *words], stdin=subprocess.PIPE,
            stdout=subprocess.PIPE, cwd=self.folder, **popen)
        self.messages = queue.Queue()
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()
        self.count = 0
        self.answers = {}
        self.diagnostics = {}  # by URI: (seconds, version, list)
        self.history = []  # (seconds, URI, version, list)
        self.notices = []
        self.demands = []
        self.texts = {}
        self.versions = {}
        self.initialized = self.result(
            "initialize", processId=os.getpid(), rootUri=uri_of(self.folder),
            workspaceFolders=[{"uri": uri_of(self.folder), "name": "w"}],
            initializationOptions=options or {},
            capabilities=capabilities if capabilities is not None else {
                "textDocument": {"completion": {"completionItem": {
                    "snippetSupport": True}}},
                "workspace": {"codeLens": {"refreshSupport": True}}})
        self.notify("initialized")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()

    def end(self):
        self.process.kill()
        self.process.wait()
        self.reader.join()
        self.process.stdout.close()
        try:
            self.process.stdin.close()
        except OSError:
            pass

    # --- Messages ---------------------------------------------------------

    def _read(self):
        stream = self.process.stdout
        while True:
            length = None
            while True:
                line = stream.readline()
                if not line:
                    self.messages.put((time.monotonic(), None))
                    return
                if not line.strip():
                    break
                name, value = line.split(b":")
                assert name == b"Content-Length", line
                length = int(value)
            data = stream.read(length)
            self.messages.put((time.monotonic(), json.loads(data)))

    def send(self, message):
        data = json.dumps(message).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n%s" %
                                 (len(data), data))
        self.process.stdin.flush()

    def notify(self, method, **params):
        self.send({"jsonrpc": "2.0", "method": method, "params": params})

    def begin(self, method, **params):
        self.count += 1
        self.send({"jsonrpc": "2.0", "id": self.count, "method": method,
                   "params": params})
        return self.count

    def take(self, seconds):
        """One message, or False where none comes in time."""
        try:
            at, message = self.messages.get(timeout=max(seconds, 0.0001))
        except queue.Empty:
            return False
        assert message is not None, "the server has gone"
        if "method" not in message:
            self.answers[message["id"]] = message
        elif message["method"] == "textDocument/publishDiagnostics":
            said = message["params"]
            entry = (at, said.get("version"), said["diagnostics"])
            self.diagnostics[said["uri"]] = entry
            self.history.append((at, said["uri"], *entry[1:]))
        elif "id" in message:
            self.demands.append(message)
            self.send({"jsonrpc": "2.0", "id": message["id"], "result": None})
        else:
            self.notices.append(message)
        return True

    def until(self, is_so, seconds=20, what="what is waited for"):
        end = time.monotonic() + seconds
        while not is_so():
            left = end - time.monotonic()
            assert left > 0, f"{what} has not come in {seconds} s"
            self.take(left)

    def answer(self, number, seconds=30):
        self.until(lambda: number in self.answers, seconds, "an answer")
        return self.answers.pop(number)

    def ask(self, method, **params):
        return self.answer(self.begin(method, **params))

    def result(self, method, **params):
        answer = self.ask(method, **params)
        assert "result" in answer, answer
        return answer["result"]

    # --- Documents --------------------------------------------------------

    def path(self, name):
        return os.path.join(self.folder, name)

    def uri(self, name):
        return uri_of(self.path(name))

    def open(self, name, text=None):
        if text is None:
            with open(self.path(name), encoding="utf-8", newline="") as file:
                text = file.read()
        self.texts[name] = text
        self.versions[name] = 1
        self.notify("textDocument/didOpen", textDocument={
            "uri": self.uri(name), "languageId": "xml", "version": 1,
            "text": text})

    def close(self, name):
        del self.texts[name]
        self.notify("textDocument/didClose",
                    textDocument={"uri": self.uri(name)})

    def position(self, name, offset):
        before = self.texts[name][:offset]
        line = before.count("\n")
        return {"line": line,
                "character": utf16(before[before.rfind("\n") + 1:])}

    def offset(self, name, place):
        lines = self.texts[name].split("\n")
        before = sum(len(line) + 1 for line in lines[:place["line"]])
        line = lines[place["line"]] if place["line"] < len(lines) else ""
        units = 0
        for i, letter in enumerate(line):
            if units >= place["character"]:
                return before + i
            units += utf16(letter)
        return min(before + len(line), len(self.texts[name]))

    def change(self, name, begin, end, text):
        """Replaces characters [begin, end) of the text."""
        edit = {"range": {"start": self.position(name, begin),
                          "end": self.position(name, end)}, "text": text}
        old = self.texts[name]
        self.texts[name] = old[:begin] + text + old[end:]
        self.versions[name] += 1
        self.notify("textDocument/didChange", textDocument={
            "uri": self.uri(name), "version": self.versions[name]},
            contentChanges=[edit])

    def replace(self, name, old, new):
        at = self.texts[name].index(old)
        self.change(name, at, at + len(old), new)

    def set(self, name, text):
        self.change(name, 0, len(self.texts[name]), text)

    def at(self, name, word, plus=0):
        """The place of a word, as parameters of a request."""
        return {"textDocument": {"uri": self.uri(name)},
                "position": self.position(
                    name, self.texts[name].index(word) + plus)}

    def of(self, name):
        return {"textDocument": {"uri": self.uri(name)}}

    def apply(self, edit):
        """Makes a WorkspaceEdit in the open documents; the names of others."""
        changes = dict(edit.get("changes") or {})
        for each in edit.get("documentChanges") or []:
            if "edits" in each:
                changes.setdefault(each["textDocument"]["uri"],
                                   []).extend(each["edits"])
        names = {self.uri(name): name for name in self.texts}
        others = {}
        for uri, edits in changes.items():
            if uri not in names:
                others[uri] = edits
                continue
            name = names[uri]
            for each in sorted(edits, reverse=True, key=lambda each: (
                    each["range"]["start"]["line"],
                    each["range"]["start"]["character"])):
                self.change(name, self.offset(name, each["range"]["start"]),
                            self.offset(name, each["range"]["end"]),
                            each["newText"])
        return others

    # --- What is said -------------------------------------------------------

    def said(self, name):
        """The diagnostics of the newest version; None before."""
        entry = self.diagnostics.get(self.uri(name))
        if entry is None:
            return None
        return entry[2]

    def codes(self, name):
        return sorted(each["code"] for each in self.said(name) or [])

    def checked(self, name, seconds=30):
        """What a whole check of the text as it is now has come to."""
        summary = self.answer(
            self.begin("btcheck/check", **self.of(name)), seconds)
        while self.take(0.05):
            pass
        return summary["result"]["summary"]

    def range_text(self, name, where):
        return self.texts[name][self.offset(name, where["start"]):
                                self.offset(name, where["end"])]
