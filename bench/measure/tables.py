# SPDX-License-Identifier: MIT
"""Tables in Markdown, and their places in docs/performance.md: what stands
between `<!-- bench:NAME -->` and `<!-- end of bench:NAME -->` is made here,
the rest of the page by people.
"""
import re
import sys

from runs import ROOT

PAGE = ROOT / "docs" / "performance.md"


def table(head, rows, left=1, last=0):
    """Lists of cells; the first `left` and the `last` columns are words, those
    between are numbers."""
    rule = ["---" if i < left or i >= len(head) - last else "--:"
            for i in range(len(head))]
    lines = [head, rule, *rows]
    return "".join("| " + " | ".join(map(str, line)) + " |\n"
                   for line in lines)


def count(number):
    return f"{number:,}"


def millions(number):
    return f"{number / 1e6:.3g}"


def seconds(value):
    if value < 0.01:
        return "< 0.01"
    return f"{value:.2f}" if value < 10 else f"{value:.1f}"


def times(value):
    return f"{value:.2f}" if value < 10 else f"{value:.0f}"


def mebibytes(size):
    size /= 2 ** 20
    return f"{size:.1f}" if size < 10 else f"{size:,.0f}"


def write_section(name, text, file=PAGE):
    """Replaces a section of a page; the markers must be there."""
    start, end = f"<!-- bench:{name} -->\n", f"<!-- end of bench:{name} -->"
    page = file.read_text()
    section = re.compile(re.escape(start) + ".*?" + re.escape(end), re.DOTALL)
    if not section.search(page):
        sys.exit(f"{file}: no place for the section `{name}`")
    file.write_text(section.sub(lambda _: start + "\n" + text + "\n" + end,
                                page))
