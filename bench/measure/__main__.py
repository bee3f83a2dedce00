# SPDX-License-Identifier: MIT
"""The figures of docs/performance.md: python3 bench/measure [quick] [PART…].

Each part has `measure`, which runs programs and returns figures, and `text`,
which prints them as Markdown. The figures are kept as JSON in build/bench; the
targets are read off them. Without `quick` the part's section of the page is
written anew. The exit code is 1 when something that must be equal is not.
"""
import argparse
import datetime
import json
import os
import sys
import time

import beside
import chains
import equal
import growth
import properties
import rates
import reductions
import scaling
import spin
import tables
import targets
from runs import FOLDER, ROOT, Setting

PARTS = {"rates": rates, "spin": spin, "reductions": reductions,
         "properties": properties, "growth": growth, "chains": chains,
         "targets": targets}
BESIDE = {"equal": equal, "beside": beside,
          "scaling": scaling}  # only when asked for


def machine():
    with open("/proc/cpuinfo", encoding="ascii") as lines:
        names = [line.split(":")[1].strip() for line in lines
                 if line.startswith("model name")]
    return f"{len(names)} × {names[0]}"


def main():
    parser = argparse.ArgumentParser(prog="script/bench")
    parser.add_argument("words", nargs="*", metavar="PART",
                        help="quick; " + ", ".join(PARTS | BESIDE))
    parser.add_argument("--program",
                        default=str(ROOT / "build" / "release" / "btcheck"))
    parser.add_argument("--beside", help="another btcheck, for `beside`")
    parser.add_argument("--runs", type=int, default=3)
    words = parser.parse_args()
    quick = "quick" in words.words
    names = [word for word in words.words if word != "quick"]
    known = PARTS | BESIDE
    if set(names) - set(known):
        parser.error(f"parts are {', '.join(known)}")
    FOLDER.mkdir(parents=True, exist_ok=True)
    setting = Setting(words.program, quick, 1 if quick else words.runs,
                      beside=words.beside)
    for name in names or list(PARTS):
        print(f"== {name}", file=sys.stderr)
        start = time.time()
        figures = known[name].measure(setting)
        kept = FOLDER / f"{name}{'-quick' if quick else ''}.json"
        kept.write_text(json.dumps(figures, indent=1))
        text = (f"Of {datetime.date.today()}, {machine()}, median of up to "
                f"{setting.rounds} runs; load before: "
                f"{os.getloadavg()[0]:.1f}.\n\n" + known[name].text(figures))
        print(f"## {name}, in {time.time() - start:.0f} s\n\n{text}")
        if not quick:
            tables.write_section(name, text,
                                 getattr(known[name], "PAGE", tables.PAGE))
    for complaint in setting.complaints:
        print("NOT EQUAL:", complaint)
    sys.exit(1 if setting.complaints else 0)


if __name__ == "__main__":
    main()
