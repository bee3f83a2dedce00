# SPDX-License-Identifier: MIT
"""What comes out of a call: JSON of the library as frozen dataclasses, made when
somebody asks for them."""

from __future__ import annotations

import html
import json
import threading
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Any, Callable, Dict, List, Mapping, Optional, Tuple

from ._library import library


class InternalError(RuntimeError):
    """A mistake of btcheck, or no memory."""


class Outcome(IntEnum):
    """As the exit codes of the program."""

    MET = 0
    MISSED = 1
    BAD_INPUT = 2
    UNDECIDED = 3
    INTERNAL = 4


@dataclass(frozen=True)
class Place:
    """Lines and columns count from 1, in characters. Line 0: the whole file."""

    file: str
    line: int = 0
    column: int = 0
    length: int = 0

    def __str__(self) -> str:
        if not self.line:
            return self.file
        return "%s:%d:%d" % (self.file, self.line, self.column)


@dataclass(frozen=True)
class Step:
    """`chosen`: by the world outside, not by the tree."""

    text: str
    time: int
    chosen: bool
    place: Optional[Place]


@dataclass(frozen=True)
class Run:
    """`loop`: of an endless run the number of the step with which its loop
    begins. `name`: for `Report.html`."""

    name: str
    steps: Tuple[Step, ...] = field(repr=False)
    loop: Optional[int] = None

    def __str__(self) -> str:
        lines = []
        for number, step in enumerate(self.steps):
            if number == self.loop:
                lines.append("the loop begins")
            lines.append(step.text)
        if self.loop is not None:
            lines.append("and so on, for ever")
        return "\n".join(lines)


@dataclass(frozen=True)
class Change:
    """Lines from `line` up to, but not with, `end_line` become `replacement`."""

    file: str
    line: int
    end_line: int
    replacement: str


@dataclass(frozen=True)
class Related:
    text: str
    place: Place


@dataclass(frozen=True)
class Reply:
    """What a question can be answered with."""

    words: str
    contracts: Tuple[str, ...]
    comment: Optional[str]


# Of a report, and made when it is asked for.
_Lazy = Callable[[], Optional[Run]]


def _nothing() -> Optional[Run]:
    return None


@dataclass(frozen=True)
class Finding:
    """`level`: "error", "warning" or "note". `repair` was checked: with it made
    the finding is gone."""

    code: str
    level: str
    message: str
    help: str
    place: Place
    node: str
    title: str = field(default="", repr=False)
    fingerprint: str = field(default="", repr=False)
    related: Tuple[Related, ...] = field(default=(), repr=False)
    repair: Tuple[Change, ...] = field(default=(), repr=False)
    replies: Tuple[Reply, ...] = field(default=(), repr=False)
    _run: _Lazy = field(default=_nothing, repr=False, compare=False)

    @property
    def run(self) -> Optional[Run]:
        return self._run()

    @property
    def is_question(self) -> bool:
        """One that the owner of the tree can answer."""
        return self.code.startswith("BT25") and self.level == "note"

    def __str__(self) -> str:
        return "%s: %s [%s] %s" % (self.place, self.level, self.code,
                                   self.message.split("\n", 1)[0])


@dataclass(frozen=True)
class Verdict:
    """Of a rule. `verdict`: "HOLDS", "VIOLATED", "UNDECIDED", or None after an
    internal error. `met`: it is what the rule expects; None where it is open."""

    name: str
    rule: str
    verdict: Optional[str]
    met: Optional[bool]
    vacuous: bool
    place: Place
    title: str = field(default="", repr=False)
    tags: Tuple[str, ...] = field(default=(), repr=False)
    expected: Optional[str] = field(default=None, repr=False)
    note: str = field(default="", repr=False)
    why: str = field(default="", repr=False)
    stopped: str = field(default="", repr=False)
    error: str = field(default="", repr=False)
    states: int = field(default=0, repr=False)
    transitions: int = field(default=0, repr=False)
    _run: _Lazy = field(default=_nothing, repr=False, compare=False)

    @property
    def run(self) -> Optional[Run]:
        """The counterexample or witness."""
        return self._run()

    def __str__(self) -> str:
        note = " (%s)" % self.note if self.note else ""
        return "%s %s%s: %s" % (self.name, (self.verdict or "ERROR").lower(), note,
                                self.title or self.rule)


@dataclass(frozen=True)
class Answer:
    """Of a tree without rules: about the mission as a whole."""

    key: str
    question: str
    answer: str
    verdict: str
    fault: bool
    _run: _Lazy = field(default=_nothing, repr=False, compare=False)

    @property
    def run(self) -> Optional[Run]:
        return self._run()


@dataclass(frozen=True)
class NodeFacts:
    """Of a tree without rules: what is proven of a node, each as a verdict; None
    where nodes of its type can never do it."""

    name: str
    label: str
    type: str
    place: Place
    ticked: Optional[str]
    success: Optional[str]
    failure: Optional[str]
    running: Optional[str]
    halted: Optional[str]
    skipped: Optional[str]


@dataclass(frozen=True)
class Port:
    """`value`: as written; `preset`: what it is where nothing is written."""

    name: str
    direction: str
    type: str
    value: Optional[str]
    preset: Optional[str]
    about: str
    entry: str
    place: Optional[Place]


@dataclass(frozen=True)
class Node:
    """`parent`, `reads` and `writes` are numbers in `nodes` and `entries`."""

    name: str
    label: str
    type: str
    kind: str
    about: str
    place: Optional[Place]
    parent: int
    ports: Tuple[Port, ...]
    reads: Tuple[int, ...]
    writes: Tuple[int, ...]


@dataclass(frozen=True)
class Entry:
    """Of a blackboard. `writers` and `readers` are numbers in `nodes`."""

    name: str
    values: Tuple[str, ...]
    writers: Tuple[int, ...]
    readers: Tuple[int, ...]


@dataclass(frozen=True)
class Explanation:
    code: str
    summary: str
    description: str
    help: str


# --- From JSON ----------------------------------------------------------------

_Json = Mapping[str, Any]


def _place(at: _Json) -> Place:
    numbers = (at.get(name, 0) for name in ("line", "column", "length"))
    return Place(at["file"], *numbers)


def _where(at: Optional[_Json]) -> Optional[Place]:
    return None if at is None else _place(at)


def _steps(steps: List[_Json]) -> Tuple[Step, ...]:
    return tuple(
        Step(at["text"], at["time"], at["is_chosen"], _where(at["where"]))
        for at in steps
    )


def _changes(repair: Optional[_Json]) -> Tuple[Change, ...]:
    return tuple(Change(**each) for each in repair["changes"]) if repair else ()


def _finding(of: _Json, run: _Lazy) -> Finding:
    message, _, advice = of["message"].partition("\nHelp: ")
    return Finding(
        of["code"],
        of["severity"],
        message,
        advice,
        _place(of),
        of["node"] or "",
        of["title"],
        of["fingerprint"],
        tuple(Related(each["text"], _place(each)) for each in of["related"]),
        _changes(of["repair"]),
        tuple(
            Reply(each["words"], tuple(each["contracts"]), each["comment"])
            for each in of["answers"]
        ),
        run,
    )


def _finding_of_input(of: _Json) -> Finding:
    message = of["message"] + (": " + of["label"] if of["label"] else "")
    message += "" if message.endswith((".", "?", "!")) else "."
    return Finding(of["code"], of["severity"], message, of["help"] or "",
                   _place(of), "", repair=_changes(of["repair"]))


def _finding_of_reading(of: _Json) -> Finding:
    return Finding(of["code"], of["level"], of["message"], of["help"],
                   _where(of["where"]) or Place(""), of["node"])


# --- Reports --------------------------------------------------------------------


class _Handle:
    """A report of the library, or what was kept of one."""

    def __init__(self, pointer: int) -> None:
        self._pointer: Optional[int] = pointer
        self._free = library().btcheck_report_free
        self._kept: Dict[str, str] = {}
        self._runs: Optional[List[Tuple[Optional[int], Run]]] = None
        self._making = threading.Lock()
        self.outcome = Outcome(library().btcheck_report_outcome(pointer))

    def __del__(self) -> None:
        if self._pointer is not None:
            self._free(self._pointer)

    def text(self, form: str) -> str:
        """"json", "sarif", "itf", "runs"."""
        if form not in self._kept:
            if self._pointer is None:
                return ""
            made: bytes = getattr(library(), "btcheck_report_" + form)(self._pointer)
            if form == "json" and not made:
                raise InternalError("btcheck: there is no memory for the report")
            self._kept[form] = made.decode("utf-8", "replace")
        return self._kept[form]

    def page(self, name: str) -> str:
        if self._pointer is None:
            return self._kept.get("page of " + name, "")
        made: bytes = library().btcheck_report_html(self._pointer, name.encode())
        return made.decode("utf-8", "replace")

    def error(self) -> str:
        said: bytes = library().btcheck_report_error(self._pointer)
        return said.decode("utf-8", "replace")

    def runs(self) -> List[Tuple[Optional[int], Run]]:
        """With the number of their finding, where they have one."""
        with self._making:
            if self._runs is None:
                told = json.loads(self.text("runs") or '{"runs": []}')
                self._runs = [
                    (at["finding"], Run(at["name"], _steps(at["steps"]), at["loop"]))
                    for at in told["runs"]
                ]
        return self._runs

    def run_of(self, number: int) -> Optional[Run]:
        return next((run for of, run in self.runs() if of == number), None)

    def run_named(self, name: str) -> Optional[Run]:
        return next((run for _, run in self.runs() if run.name == name), None)

    # A copy in another process has the texts, and no pages but those of today.
    def __getstate__(self) -> Dict[str, Any]:
        kept = {form: self.text(form) for form in ("json", "sarif", "itf", "runs")}
        return {"outcome": int(self.outcome), "kept": kept}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self._pointer = None
        self._kept = state["kept"]
        self._runs = None
        self._making = threading.Lock()
        self.outcome = Outcome(state["outcome"])


class _Told:
    """What all that comes out has in common."""

    def __init__(self, handle: _Handle) -> None:
        self._handle = handle
        self._whole: Optional[Dict[str, Any]] = None

    @property
    def outcome(self) -> Outcome:
        return self._handle.outcome

    @property
    def ok(self) -> bool:
        """The program would end with 0."""
        return self.outcome is Outcome.MET

    def json(self) -> str:
        return self._handle.text("json")

    @property
    def _document(self) -> Dict[str, Any]:
        if self._whole is None:
            self._whole = json.loads(self.json())
        return self._whole

    @property
    def tree(self) -> str:
        return str(self._document["tree"])

    @property
    def profile(self) -> str:
        return str(self._document["profile"])


def _counted(count: int, one: str, many: str) -> str:
    return "%s %s" % (format(count, ","), one if count == 1 else many)


def _frame(page: str, title: str) -> str:
    """A page of its own in one of a notebook."""
    if not page:
        return ""
    return (
        '<iframe title="%s" srcdoc="%s" sandbox="allow-scripts" '
        'style="width:100%%;height:600px;border:1px solid #ccc"></iframe>'
        % (html.escape(title), html.escape(page))
    )


class Report(_Told):
    """Of `check` and `lint`."""

    _findings: Optional[Tuple[Finding, ...]] = None
    _verdicts: Optional[Tuple[Verdict, ...]] = None

    @property
    def _tree(self) -> Dict[str, Any]:
        return self._document["trees"][0]  # type: ignore[no-any-return]

    @property
    def tree(self) -> str:
        return str(self._tree["tree"])

    @property
    def profile(self) -> str:
        """That was used; "" where nothing was checked."""
        files = self._tree["files"]
        return str(files[0]["profile"]) if files else ""

    @property
    def findings(self) -> Tuple[Finding, ...]:
        """Mistakes in the inputs, and what is suspicious in the tree."""
        if self._findings is None:
            told = [_finding_of_input(of) for of in self._tree["diagnostics"]]
            for of in self._tree["findings"]:
                told.append(_finding(of, self._of(len(told))))
            self._findings = tuple(told)
        return self._findings

    @property
    def verdicts(self) -> Tuple[Verdict, ...]:
        """One for each rule."""
        if self._verdicts is None:
            self._verdicts = tuple(
                self._verdict(of)
                for file in self._tree["files"]
                for of in file.get("verdicts", ())
            )
        return self._verdicts

    def _verdict(self, of: _Json) -> Verdict:
        return Verdict(
            of["name"], of["property"], of["verdict"], of["met"], of["vacuous"],
            _place(of), of["title"] or "", tuple(of["tags"]), of["expected"],
            of["note"] or "", of["why"] or "", of["stopped"] or "", of["error"] or "",
            of["states"], of["transitions"], self._named(of["name"], of["run"]),
        )

    def _of(self, number: int) -> _Lazy:
        handle = self._handle
        return lambda: handle.run_of(number)

    def _named(self, name: str, told: Optional[_Json]) -> _Lazy:
        handle = self._handle
        return (lambda: handle.run_named(name)) if told else _nothing

    @property
    def answers(self) -> Tuple[Answer, ...]:
        """Without rules: about the mission as a whole."""
        return tuple(
            Answer(of["key"], of["question"], of["answer"], of["verdict"], of["fault"],
                   self._named(of["key"], of["run"]))
            for file in self._tree["files"]
            for of in file.get("answers", ())
        )

    @property
    def nodes(self) -> Tuple[NodeFacts, ...]:
        """Without rules: what each node is proven to do."""
        return tuple(
            NodeFacts(of["key"], of["name"], of["type"], _place(of),
                      *(of.get(what, {}).get("verdict") for what in
                        ("ticked", "success", "failure", "running", "halted",
                         "skipped")))
            for file in self._tree["files"]
            for of in file.get("nodes", ())
        )

    @property
    def states(self) -> int:
        """The most that a search has stored."""
        counts = [0]
        for file in self._tree["files"]:
            counts += [of["states"] for of in (file, *file.get("verdicts", ()))
                       if "states" in of]
        return max(counts)

    @property
    def node_count(self) -> int:
        return int(self._tree["nodes"])

    @property
    def stopped(self) -> str:
        """The limit that ended a search: "timeout", "max-states"; "" for none."""
        for file in self._tree["files"]:
            for of in (file, *file.get("verdicts", ())):
                if of.get("stopped"):
                    return str(of["stopped"])
        return ""

    @property
    def allowed(self) -> int:
        """Findings that are not told: a comment or the settings allow them."""
        return int(self._tree["allowed"])

    @property
    def seconds(self) -> float:
        return float(self._tree["timing"]["seconds"])

    @property
    def runs(self) -> Tuple[Run, ...]:
        return tuple(run for _, run in self._handle.runs())

    def run(self, name: str) -> Optional[Run]:
        """By the name of a rule, the key of an answer, or as --trace-dir names
        that of a finding: "BT2208-RecoveryActions"."""
        return self._handle.run_named(name)

    def html(self, name: str) -> str:
        """The page of that run, one file for any browser; "" where there is none."""
        return self._handle.page(name)

    def sarif(self) -> str:
        return self._handle.text("sarif")

    def _counts(self) -> List[str]:
        missed = [of for of in self.verdicts if of.met is not True]
        parts = []
        if missed:
            parts.append("%d of %s not met" % (
                len(missed), _counted(len(self.verdicts), "rule", "rules")))
        elif self.verdicts:
            parts.append(_counted(len(self.verdicts), "rule", "rules") + " met")
        parts.append(_counted(len(self.findings), "finding", "findings"))
        if self.states:
            parts.append(_counted(self.states, "state", "states"))
        return parts

    def __repr__(self) -> str:
        return "<btcheck.Report %s: %s, %s>" % (
            self.tree, self.outcome.name, ", ".join(self._counts()))

    def __str__(self) -> str:
        counts = ", ".join(self._counts())
        lines = ["%s: %s, %s" % (self.tree, self.outcome.name, counts)]
        lines += [str(of) for of in (*self.verdicts, *self.findings)]
        return "\n".join(lines)

    def _page_to_show(self) -> str:
        shown = [of.run for of in self.verdicts if of.met is False]
        shown += [of.run for of in self.findings]
        return next((run.name for run in shown if run is not None and run.name), "")

    def _repr_html_(self) -> str:
        name = self._page_to_show()
        return "<pre>%s</pre>%s" % (html.escape(str(self)),
                                    _frame(self.html(name) if name else "", name))


class Description(_Told):
    """Of `describe`: what the files of a tree tell of each node."""

    @property
    def findings(self) -> Tuple[Finding, ...]:
        return tuple(map(_finding_of_reading, self._document["findings"]))

    @property
    def nodes(self) -> Tuple[Node, ...]:
        """A parent before its children."""
        return tuple(
            Node(of["name"], of["label"], of["type"], of["kind"], of["about"],
                 _where(of["where"]), of["parent"],
                 tuple(Port(at["name"], at["direction"], at["type"], at["value"],
                            at["preset"], at["about"], at["entry"],
                            _where(at["where"])) for at in of["ports"]),
                 tuple(of["reads"]), tuple(of["writes"]))
            for of in self._document["nodes"]
        )

    @property
    def entries(self) -> Tuple[Entry, ...]:
        return tuple(
            Entry(of["name"], tuple(of["values"]), tuple(of["writers"]),
                  tuple(of["readers"]))
            for of in self._document["entries"]
        )

    def __repr__(self) -> str:
        return "<btcheck.Description %s: %s, %s>" % (
            self.tree, self.outcome.name, _counted(len(self.nodes), "node", "nodes"))


class Simulation(_Told):
    """Of `simulate`: one run of a tree."""

    @property
    def findings(self) -> Tuple[Finding, ...]:
        return tuple(map(_finding_of_reading, self._document["findings"]))

    @property
    def ending(self) -> str:
        """"ended", "fault", "stuck", "ticks", "stopped" or "refused"."""
        return str(self._document["ending"])

    @property
    def end(self) -> str:
        return str(self._document["end"])

    @property
    def ticks(self) -> int:
        return int(self._document["ticks"])

    @property
    def lines(self) -> Tuple[str, ...]:
        """Of ticks, as the program prints them."""
        return tuple(self._document["lines"])

    @property
    def steps(self) -> Tuple[Step, ...]:
        return _steps(self._document["steps"])

    @property
    def variables(self) -> Dict[str, str]:
        """In the last state, as declared."""
        return {of["name"]: of["value"] for of in self._document["variables"]}

    @property
    def statuses(self) -> Dict[str, str]:
        """Of the nodes, there."""
        return {of["name"]: of["value"] for of in self._document["statuses"]}

    def itf(self) -> str:
        return self._handle.text("itf")

    def html(self) -> str:
        return self._handle.page("run")

    def __repr__(self) -> str:
        return "<btcheck.Simulation %s: %s>" % (
            self.tree, self.end or self.outcome.name)

    def __str__(self) -> str:
        return "\n".join((*self.lines, self.end))

    def _repr_html_(self) -> str:
        return "<pre>%s</pre>%s" % (html.escape(str(self)),
                                    _frame(self.html(), self.tree))
