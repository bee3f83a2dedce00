# SPDX-License-Identifier: MIT
"""docs/python.md and python/README.md: each program in them runs, and prints
what stands behind it."""

import re
import subprocess
import sys

import pytest
from trees import SOURCES

DOCS = (SOURCES / "docs/python.md").read_text()
TREE = re.search(r"```xml\n(.*?)```", DOCS, re.DOTALL).group(1)
BLOCK = re.compile(r"```python\n(.*?)```\n(?:\n```\n(.*?)```\n)?", re.DOTALL)
BLOCKS = BLOCK.findall(DOCS) + BLOCK.findall((SOURCES / "python/README.md").read_text())


@pytest.mark.parametrize("program,printed", BLOCKS)
def test_a_program_of_the_documentation(program, printed, tmp_path):
    (tmp_path / "patrol.xml").write_text(TREE)
    program += "".join("\n%s()" % name for name in re.findall(r"^def (test_\w+)", program,
                                                              re.MULTILINE))
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, text=True,
                          capture_output=True, timeout=60)
    assert done.stderr == ""
    if printed:
        assert done.stdout == printed


def test_there_are_programs():
    assert len(BLOCKS) == 5 and sum(bool(printed) for _, printed in BLOCKS) == 3
