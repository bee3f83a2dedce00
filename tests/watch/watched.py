# SPDX-License-Identifier: MIT
"""A `btcheck --watch` that goes on, as its user sees it."""
import re
import signal
import subprocess
import threading
import time


class Watched:
    WAITING = "waiting for changes; Ctrl-C ends\n"

    def __init__(self, program, *words, cwd, waits=True, before=(), **popen):
        self.process = subprocess.Popen(
            [*before, program, "--watch", *words], cwd=cwd,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, **popen)
        self.text = ""
        self.last = time.monotonic()
        self.news = threading.Condition()
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()
        self.first = self.until(re.escape(self.WAITING)) if waits else ""

    def read(self):
        while block := self.process.stdout.read1():
            with self.news:
                self.text += block.decode()
                self.last = time.monotonic()
                self.news.notify_all()
        with self.news:
            self.news.notify_all()

    def until(self, wanted, patience=30, quiet=0.4):
        """What is printed until that is, and nothing more comes for a moment;
        it is taken."""
        end = time.monotonic() + patience
        with self.news:
            while not re.search(wanted, self.text):
                left = end - time.monotonic()
                if left <= 0 or not self.news.wait(left):
                    raise AssertionError(
                        f"nothing like {wanted!r} in:\n{self.text}")
            while (left := self.last + quiet - time.monotonic()) > 0:
                self.news.wait(left)
            text, self.text = self.text, ""
        return text

    def silence(self, seconds=1.0):
        """What is printed in that time: nothing, it is hoped."""
        time.sleep(seconds)
        with self.news:
            text, self.text = self.text, ""
        return text

    def end(self, how=signal.SIGINT):
        """Its exit code, and how long it took to end."""
        begin = time.monotonic()
        self.process.send_signal(how)
        code = self.process.wait(20)
        seconds = time.monotonic() - begin
        self.close()
        return code, seconds

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.reader.join(5)
        self.process.stdout.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
