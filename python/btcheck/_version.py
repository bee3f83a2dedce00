# SPDX-License-Identifier: MIT
"""The version, as the sources of the project say it; a wheel has it written."""

from pathlib import Path
import re


def _version() -> str:
    text = Path(__file__).parents[2].joinpath("CMakeLists.txt").read_text()
    found = re.search(r"project\(btcheck VERSION ([0-9.]+)", text)
    if found is None:
        raise RuntimeError("CMakeLists.txt names no version of btcheck")
    return found.group(1)


VERSION = _version()
