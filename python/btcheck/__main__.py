# SPDX-License-Identifier: MIT
"""The program that the wheel carries: `btcheck`, and `python -m btcheck`."""

import os
import sys
from pathlib import Path


def main() -> None:
    """Becomes the program: signals, output and exit code are its own."""
    # Taken once: it may well name this very script.
    program = os.environ.pop("BTCHECK_PROGRAM", "") or str(
        Path(__file__).with_name("program")
    )
    try:
        os.execv(program, ["btcheck", *sys.argv[1:]])
    except OSError as error:
        sys.stderr.write("btcheck: cannot start %s: %s\n" % (program, error.strerror))
        sys.exit(2)


if __name__ == "__main__":
    main()
