# SPDX-License-Identifier: MIT
"""Trees as tests: `pytest --btcheck trees/`.

Each tree is a file of items: that it can be read and was checked, each rule of
the files of rules beside it, and each finding.
"""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any, Dict, Iterator, List, Optional, Tuple

import pytest

from . import Finding, LibraryError, Outcome, Report, RequestError, Run, Verdict, check

# Findings that say of a rule what its own item says.
_OF_RULES = ("BT2001", "BT2002", "BT2003")


def pytest_addoption(parser: Any) -> None:
    group = parser.getgroup("btcheck", "trees checked by btcheck")
    group.addoption("--btcheck", action="store_true",
                    help="check the Behavior Trees in the folders that are named")
    group.addoption("--btcheck-deny", choices=("warnings", "notes"), default=None,
                    help="these findings fail, too; questions never do")
    group.addoption("--btcheck-timeout", type=float, default=0, metavar="SECONDS",
                    help="for each tree; without it there is no limit")


def pytest_collect_file(file_path: Path, parent: Any) -> Optional[pytest.File]:
    if not parent.config.getoption("--btcheck") or not _is_tree(file_path):
        return None
    return TreeFile.from_parent(parent, path=file_path)  # type: ignore


if int(pytest.__version__.split(".")[0]) < 7:
    # It knows no `file_path`, and would refuse to begin.
    del pytest_collect_file


def pytest_configure(config: Any) -> None:
    if config.getoption("--btcheck") and "pytest_collect_file" not in globals():
        raise pytest.UsageError("--btcheck needs pytest 7 or later")


def _is_tree(path: Path) -> bool:
    """Not each XML file is one."""
    if path.suffix == ".btf":
        return True
    if path.suffix != ".xml":
        return False
    try:
        text = path.read_bytes()
    except OSError:
        return False
    return b"<BehaviorTree" in text


def _rules_for(tree: Path) -> List[str]:
    """Files of rules beside the tree: those that name it, and that of its name."""
    chosen = []
    for file in sorted(tree.parent.iterdir()):
        if file.suffix not in (".ltl", ".btp"):
            continue
        named = re.search(r'^\s*tree\s+"([^"]*)"', file.read_text(errors="replace"),
                          re.MULTILINE)
        is_ours = (file.parent / named.group(1)).resolve() == tree.resolve() \
            if named else file.stem == tree.stem
        if is_ours:
            chosen.append(os.path.relpath(file))
    return chosen


class TreeFile(pytest.File):
    """One tree, checked when it is collected: its findings are its items."""

    def collect(self) -> Iterator[pytest.Item]:
        name = os.path.relpath(self.path)
        report, error = None, ""
        try:
            report = check(name, _rules_for(self.path),
                           timeout=self.config.getoption("--btcheck-timeout"))
        except (RequestError, LibraryError) as wrong:
            error = str(wrong)
        names: Dict[str, int] = {}

        def item(kind: Any, name: str, **more: Any) -> pytest.Item:
            names[name] = names.get(name, 0) + 1
            if names[name] > 1:
                name = "%s #%d" % (name, names[name])
            return kind.from_parent(self, name=name, **more)  # type: ignore

        yield item(TreeItem, "tree", report=report, error=error)
        if report is None:
            return
        for verdict in report.verdicts:
            yield item(RuleItem, verdict.name, verdict=verdict)
        for finding in report.findings:
            if finding.code not in _OF_RULES and not _is_of_reading(report, finding):
                name = "%s %s" % (finding.code, finding.node.split("/")[-1])
                yield item(FindingItem, name.strip(), finding=finding)


def _is_of_reading(report: Report, finding: Finding) -> bool:
    """What keeps a tree from being checked is told by its first item."""
    return report.outcome is Outcome.BAD_INPUT and finding.level == "error"


class Failed(Exception):
    """Its text is what the user sees; no line of Python has a part in it."""


class _Item(pytest.Item):
    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        if isinstance(excinfo.value, Failed):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> Tuple[Any, Optional[int], str]:
        where = os.path.relpath(self.path)
        return self.path, self._line(), "%s: %s" % (where, self.name)

    def _line(self) -> Optional[int]:
        return None


class TreeItem(_Item):
    """Fails where the tree was not checked, or a question was left open."""

    def __init__(self, *, report: Optional[Report], error: str, **more: Any) -> None:
        super().__init__(**more)
        self._report, self._error = report, error

    def runtest(self) -> None:
        report = self._report
        if report is None:
            raise Failed(self._error)
        if report.outcome is Outcome.BAD_INPUT:
            raise Failed("\n".join(map(_text, (of for of in report.findings
                                               if of.level == "error"))))
        if report.outcome is Outcome.INTERNAL:
            raise Failed("btcheck has made a mistake:\n%s" % report)
        is_open = [of for of in report.findings if of.code in ("BT2003", "BT9003")]
        if is_open and not report.verdicts:
            raise Failed("UNDECIDED: " + "\n".join(map(_text, is_open)))


class RuleItem(_Item):
    def __init__(self, *, verdict: Verdict, **more: Any) -> None:
        super().__init__(**more)
        self._verdict = verdict

    def _line(self) -> Optional[int]:
        return self._verdict.place.line - 1 if self._verdict.place.line else None

    def runtest(self) -> None:
        of = self._verdict
        if of.met:
            return
        lines = ["%s: %s" % (of.place, of)]
        if of.title:
            lines.append(of.rule)
        if of.error:
            lines.append(of.error)
        elif of.verdict == "UNDECIDED":
            lines[0] = "UNDECIDED: " + lines[0]
            lines.append("stopped by: %s" % (of.stopped or of.note))
        if of.why:
            lines.append("Why: " + of.why)
        raise Failed("\n".join(lines) + _run_text(of.run))


class FindingItem(_Item):
    def __init__(self, *, finding: Finding, **more: Any) -> None:
        super().__init__(**more)
        self._finding = finding

    def _line(self) -> Optional[int]:
        return self._finding.place.line - 1 if self._finding.place.line else None

    def runtest(self) -> None:
        of = self._finding
        deny = self.config.getoption("--btcheck-deny")
        failing = {None: ("error",), "warnings": ("error", "warning"),
                   "notes": ("error", "warning", "note")}[deny]
        if of.level in failing and not of.is_question and of.code != "BT9003":
            raise Failed(_text(of))
        self.add_report_section("call", "btcheck", _text(of))


def _text(of: Finding) -> str:
    """All of a finding, with the run that shows it."""
    text = "%s: %s [%s] %s" % (of.place, of.level, of.code, of.message)
    if of.help:
        text += "\nHelp: " + of.help
    return text + _run_text(of.run)


def _run_text(run: Optional[Run]) -> str:
    return "\nThe run:\n  " + str(run).replace("\n", "\n  ") if run else ""
