# SPDX-License-Identifier: MIT
"""Memory of `btcheck --watch` over many saves; no part of the tests.

    python3 memory.py BTCHECK SOURCES [SAVES]
"""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from watched import Watched  # noqa: E402

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
SOURCES = pathlib.Path(sys.argv[2]).resolve()
SAVES = int(sys.argv[3]) if len(sys.argv) > 3 else 500
TEXT = (SOURCES / "examples/nav2/jazzy/follow_point.xml").read_text()


def held(process):
    with open(f"/proc/{process.pid}/status", encoding="ascii") as file:
        return next(int(line.split()[1]) for line in file
                    if line.startswith("VmRSS"))


def open_files(process):
    return len(list(pathlib.Path(f"/proc/{process.pid}/fd").iterdir()))


with tempfile.TemporaryDirectory() as folder:
    tree = pathlib.Path(folder) / "t.xml"
    tree.write_text(TEXT)
    with Watched(PROGRAM, ".", cwd=folder) as watched:
        for i in range(SAVES + 1):
            if i % (SAVES // 10) == 0:
                print(f"{i} saves: {held(watched.process)} kB, "
                      f"{open_files(watched.process)} files open", flush=True)
            tree.write_text(f"{TEXT}<!-- {i} -->\n")
            watched.until(r"-- .*\n.*states", quiet=0.05)
