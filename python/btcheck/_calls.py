# SPDX-License-Identifier: MIT
"""A request is made of Python's values, given to the library, and answered."""

from __future__ import annotations

import _thread
import itertools
import os
import re
import threading
import xml.etree.ElementTree as ElementTree
from typing import (
    Any,
    Callable,
    Dict,
    Iterable,
    List,
    Mapping,
    Optional,
    Set,
    Tuple,
    Union,
)

from ._disk import Disk, Named, ReadError
from ._library import Source, library
from ._report import (
    Description,
    Explanation,
    InternalError,
    Outcome,
    Report,
    Simulation,
    _Handle,
)

Path = Union[str, "os.PathLike[str]"]
Text = Union[str, bytes]


class RequestError(ValueError):
    """What was asked for cannot be meant; a mistake in a tree is a finding."""


class Cancellation:
    """Given to calls, ends them within a tenth of a second from any thread."""

    def __init__(self) -> None:
        self._lock = threading.RLock()  # a signal may come in between
        self._requests: Set[_Request] = set()
        self.is_cancelled = False

    def cancel(self) -> None:
        with self._lock:
            self.is_cancelled = True
            for request in self._requests:
                request.cancel()

    def _add(self, request: _Request) -> None:
        with self._lock:
            self._requests.add(request)
            if self.is_cancelled:
                request.cancel()

    def _remove(self, request: _Request) -> None:
        with self._lock:
            self._requests.discard(request)


# --- What the library asks for --------------------------------------------------

# By the context of a callback: the request that goes on.
_asking: Dict[int, _Request] = {}
_numbers = itertools.count(1)


def _answer(key: int, to: int, ask: Callable[[Named], Optional[bytes]]) -> int:
    request = _asking[key]
    try:
        found = ask(request.disk) if request.disk else None
    except BaseException as error:  # it goes on in the thread that called
        request.error = error
        request.cancel()
        return 0
    if found is None:
        return 0
    library().btcheck_text_set(to, found, len(found))
    return 1


def _text(key: int, name: bytes, to: int) -> int:
    return _answer(key, to, lambda disk: disk.text(os.fsdecode(name)))


def _package(key: int, name: bytes, to: int) -> int:
    return _answer(key, to, lambda disk: os.fsencode(disk.package(os.fsdecode(name))))


def _tree(key: int, name: bytes, to: int) -> int:
    return _answer(
        key, to, lambda disk: os.fsencode(disk.file_with_tree(os.fsdecode(name)))
    )


_SOURCES = {
    "source": Source(_text),
    "packages": Source(_package),
    "trees": Source(_tree),
}


# --- Requests -------------------------------------------------------------------


def _utf8(text: Text, what: str) -> bytes:
    if isinstance(text, bytes):
        return text
    try:
        return text.encode()
    except UnicodeEncodeError as error:
        raise RequestError(
            "%s has a lone surrogate, which UTF-8 cannot hold, at character %d"
            % (what, error.start + 1)
        ) from None


def _encoded(path: Path) -> bytes:
    try:
        return os.fsencode(path)
    except UnicodeEncodeError:
        raise RequestError("%r is no name of a file" % (path,)) from None


class _Request:
    """Of the library; freed with the last who refers to it."""

    def __init__(self) -> None:
        pointer = library().btcheck_request_new()
        if not pointer:
            raise MemoryError
        self.pointer: int = pointer
        self._free = library().btcheck_request_free
        self.disk: Optional[Named] = None
        self.error: Optional[BaseException] = None
        self._texts = 0

    def __del__(self) -> None:
        if hasattr(self, "_free"):
            self._free(self.pointer)

    def cancel(self) -> None:
        library().btcheck_cancel(self.pointer)

    def set(self, name: str, value: Text, what: str = "") -> None:
        word = _utf8(value, what or "`%s`" % name)
        if b"\0" in word:
            raise RequestError(
                "%s has a zero character in it" % (what or "`%s`" % name)
            )
        if library().btcheck_set(self.pointer, name.encode(), word) != 0:
            self._refuse()

    def add_file(self, name: bytes, text: bytes) -> None:
        if library().btcheck_add_file(self.pointer, name, text, len(text)) != 0:
            self._refuse()

    def add_package(self, name: str, folder: Path) -> None:
        given = _utf8(name, "the name of a package"), _encoded(folder)
        if library().btcheck_add_package(self.pointer, *given) != 0:
            self._refuse()

    def add_text(self, what: str, text: Text, ending: str = "") -> bytes:
        """A text without a file. Returns the name that it has from now on."""
        self._texts += 1
        number = "" if self._texts == 1 else " %d" % self._texts
        name = ("<%s%s>%s" % (what, number, ending)).encode()
        self.add_file(name, _utf8(text, "the " + what))
        return name

    def _refuse(self) -> None:
        said: bytes = library().btcheck_request_error(self.pointer)
        raise RequestError(said.decode("utf-8", "replace") or "there is no memory")


def _is_text(value: object, begins: str) -> bool:
    if isinstance(value, bytes):
        return True
    return isinstance(value, str) and value.lstrip()[:1] in tuple(begins)


def _is_of_py_trees(tree: object) -> bool:
    return any(kind.__module__.startswith("py_trees.") for kind in type(tree).__mro__)


def _from_py_trees(tree: object, conditions: Iterable[str]) -> str:
    from . import py_trees_to_xml

    try:
        return str(py_trees_to_xml.to_xml(tree, conditions))  # type: ignore
    except py_trees_to_xml.ExportError as error:
        raise RequestError(str(error)) from None


def _several(values: object) -> List[Any]:
    if isinstance(values, (str, bytes, os.PathLike)):
        return [values]
    try:
        return list(values)  # type: ignore
    except TypeError:
        raise RequestError(
            "%r is neither a text nor the name of a file, nor a list" % (values,)
        ) from None


def _size(value: Union[int, str]) -> str:
    """Of bytes: 1000, "512M", "4G"."""
    found = re.fullmatch(r"([0-9]+)([KMGT]?)", str(value))
    if found is None or isinstance(value, bool):
        raise RequestError('`%s` is no size; write bytes, or "4G"' % value)
    return str(int(found.group(1)) << 10 * " KMGT".index(found.group(2) or " "))


class _Builder:
    """Makes the request of one call."""

    def __init__(self) -> None:
        self.request = _Request()
        self._files: Mapping[str, Text] = {}
        self._named: List[str] = []

    def add_files(self, files: Optional[Mapping[str, Text]]) -> None:
        self._files = files or {}
        for name, text in self._files.items():
            if "\0" in name or not name:
                raise RequestError("`%s` is no name of a file" % name)
            self.request.add_file(
                _utf8(name, "the name of a file"), _utf8(text, "`%s`" % name)
            )

    def name(self, what: str, file: Path) -> None:
        try:
            name = os.fspath(file)
        except TypeError:
            raise RequestError(
                "%r is neither a text nor the path of a file" % (file,)
            ) from None
        if not name or not isinstance(name, str):
            raise RequestError("%r is no name of a file for `%s`" % (file, what))
        self._named.append(name)
        self.request.set(what, _encoded(name), "`%s`" % name)

    def add(self, what: str, values: object, begins: str) -> None:
        """Files, or texts that begin so."""
        for value in _several(values):
            if _is_text(value, begins):
                self.request.set(what, self.request.add_text(what, value))
            else:
                self.name(what, value)

    def add_rules(self, values: object) -> None:
        """A rule has blanks in it, and the name of a file of rules has not."""
        for value in _several(values):
            if not isinstance(value, (str, bytes)):
                self.name("rules", value)
            elif isinstance(value, bytes) or "\n" in value.strip():
                self.request.set("rules", self.request.add_text("rules", value))
            elif re.search(r"\s", value.strip()) or not _is_rule_file(value):
                self.request.set("typed_rules", value.strip(), "a rule")
            else:
                self.name("rules", value)

    def set_tree(
        self,
        tree: object,
        conditions: Iterable[str],
        settings: Union[None, bool, Path],
        has_contracts: bool,
    ) -> None:
        if isinstance(tree, ElementTree.ElementTree):
            tree = tree.getroot()
        if isinstance(tree, ElementTree.Element):
            tree = ElementTree.tostring(tree, encoding="unicode")
        elif _is_of_py_trees(tree):
            tree = _from_py_trees(tree, conditions)
        if _is_text(tree, "<("):
            text: Any = tree
            self.request.set("tree", self.request.add_text("tree", text))
            self.request.disk = Named(self._named)
            return
        self.name("tree", tree)  # type: ignore
        if self._named[-1] in self._files:
            self.request.disk = Named(self._named)
        else:
            self._read_around(settings, has_contracts)

    def _read_around(self, settings: Union[None, bool, Path], has_contracts: bool) -> None:
        request = self.request
        tree, named = self._named[-1], self._named[:-1]
        if isinstance(settings, (str, os.PathLike)):
            named.append(os.fspath(settings))
        request.disk = disk = Disk(tree, named)
        request.set("directory", os.fsencode(os.getcwd()))
        request.set("one_program", "false")
        found = disk.settings() if settings is None or settings is True else ""
        if isinstance(settings, (str, os.PathLike)):
            found = os.fspath(settings)
        if found:
            request.set("settings", _encoded(found))
        if not tree.endswith(".btf"):
            for name, text in disk.beside(has_contracts or bool(found)).items():
                if name not in self._files:
                    request.add_file(os.fsencode(name), text)


def _is_rule_file(name: str) -> bool:
    return name.endswith((".ltl", ".btp")) or os.path.isfile(name)


# --- Calls ------------------------------------------------------------------------

_MOST_WAIT = 2.0  # seconds, for a call that was cancelled
_MOST_IDLE = 0.1


def _call(function: Callable[[int], int], request: _Request) -> _Handle:
    pointer = function(request.pointer)
    if not pointer:
        raise MemoryError
    return _Handle(pointer)


def _open(lock: Any) -> None:
    """Also one that an interrupt has left open."""
    try:
        lock.release()
    except RuntimeError:
        pass


class _Worker:
    """A thread that calls for the main thread. It ends when nobody has needed it
    for a moment; to begin one for each call takes a tenth of a small check."""

    def __init__(self) -> None:
        self._begin, self._end = _thread.allocate_lock(), _thread.allocate_lock()
        self._begin.acquire()
        self._end.acquire()
        self._job: Optional[Tuple[Callable[[int], int], _Request]] = None
        self._answers: List[Union[_Handle, BaseException]] = []
        self._is_dismissed = False
        _thread.start_new_thread(self._run, ())

    def call(
        self, function: Callable[[int], int], request: _Request
    ) -> Union[_Handle, BaseException]:
        self._job = (function, request)
        self._begin.release()
        self._end.acquire()
        return self._answers.pop()

    def wait(self, seconds: float) -> None:
        """Until the call has ended, or so long."""
        if not self._answers:
            self._end.acquire(timeout=seconds)

    def dismiss(self) -> None:
        self._is_dismissed = True
        _open(self._begin)

    def _run(self) -> None:
        while not self._is_dismissed or self._job:
            if self._begin.acquire(timeout=_MOST_IDLE):
                self._work()
            elif self in _idle:
                try:
                    _idle.remove(self)
                    break
                except ValueError:  # it has just been taken
                    pass
        _open(self._end)

    def _work(self) -> None:
        job, self._job = self._job, None
        if job is None:
            return
        try:
            self._answers.append(_call(*job))
        except BaseException as error:
            self._answers.append(error)
        del job
        self._end.release()


_idle: List[_Worker] = []


def _dismiss_all() -> None:
    """A fork has one thread, and some Pythons warn where it had more."""
    while _idle:
        worker = _idle.pop()
        worker.dismiss()
        worker.wait(_MOST_IDLE)


os.register_at_fork(before=_dismiss_all, after_in_child=_idle.clear)


def _call_beside(function: Callable[[int], int], request: _Request) -> _Handle:
    """In a thread of its own: signals come to the main thread, and meanwhile
    that can act on them. Handlers are the host's."""
    try:
        worker = _idle.pop() if _idle else _Worker()
    except RuntimeError:  # there are no more threads
        return _call(function, request)
    try:
        answer = worker.call(function, request)
    except BaseException:
        request.cancel()
        try:
            worker.wait(_MOST_WAIT)
        finally:
            worker.dismiss()
        raise
    _idle.append(worker)
    if isinstance(answer, BaseException):
        raise answer
    return answer


def _answered(name: str, request: _Request) -> _Handle:
    function = getattr(library(), "btcheck_" + name)
    key = 0
    if request.disk is not None:
        key = next(_numbers)
        _asking[key] = request
        for what, source in _SOURCES.items():
            getattr(library(), "btcheck_set_" + what)(request.pointer, source, key)
    is_main = threading.current_thread() is threading.main_thread()
    try:
        handle = (_call_beside if is_main else _call)(function, request)
    finally:
        _asking.pop(key, None)
    if isinstance(request.error, ReadError):
        raise RequestError(str(request.error)) from None
    if request.error is not None:
        raise request.error
    error = handle.error()
    if error:
        said = error[len("btcheck: "):] if error.startswith("btcheck: ") else error
        if handle.outcome is Outcome.INTERNAL:
            raise InternalError(said)
        raise RequestError(said)
    return handle


# As the library has them, which takes longer to say than to skip.
_DEFAULTS: Mapping[str, object] = {
    "tick_milliseconds": 0, "loops": False, "wake_ups": False, "tries_repairs": True,
    "threads": 1, "seconds": 0, "bytes": "0", "states": 0, "run_ticks": 100,
}


def _ask(
    call: str,
    tree: object,
    cancel: Optional[Cancellation],
    conditions: Iterable[str],
    files: Optional[Mapping[str, Text]],
    packages: Optional[Mapping[str, Path]],
    settings: Union[None, bool, Path],
    rules: object,
    leaves: object,
    models: object,
    script: object,
    words: Mapping[str, object],
) -> _Handle:
    made = _Builder()
    made.add_files(files)
    for name, folder in (packages or {}).items():
        made.request.add_package(name, folder)
    made.add_rules(rules)
    leaves = _several(leaves)
    made.add("leaves", leaves, "(;#")
    made.add("models", models, "<")
    if script is not None:
        if isinstance(script, str) and "\n" in script:
            made.request.set("script", made.request.add_text("script", script))
        else:
            made.name("script", script)  # type: ignore
    for name, value in words.items():
        if value is None or value == _DEFAULTS.get(name, ""):
            continue
        word = str(value).lower() if isinstance(value, bool) else str(value)
        made.request.set(name, word)
    made.set_tree(tree, conditions, settings, bool(leaves))
    if cancel is None:
        return _answered(call, made.request)
    cancel._add(made.request)
    try:
        return _answered(call, made.request)
    finally:
        cancel._remove(made.request)


def check(
    tree: object,
    rules: object = (),
    *,
    leaves: object = (),
    models: object = (),
    profile: str = "",
    main_tree: str = "",
    tick: str = "",
    tick_ms: int = 0,
    loop: bool = False,
    wake_ups: bool = False,
    repairs: bool = True,
    threads: int = 1,
    timeout: float = 0,
    memory: Union[int, str] = 0,
    states: int = 0,
    settings: Union[None, bool, Path] = None,
    files: Optional[Mapping[str, Text]] = None,
    packages: Optional[Mapping[str, Path]] = None,
    conditions: Iterable[str] = (),
    cancel: Optional[Cancellation] = None,
) -> Report:
    """Checks a tree: proves each rule, or has the run that breaks it.

    `tree` is the path of a file, a text that begins with `<` or `(`, an Element
    of ElementTree, or a tree of py_trees. `rules` are rules ("never
    dock.failure"), texts of several lines, or names of files; `leaves` and
    `models` names of files or texts. `timeout` in seconds, `memory` in bytes or
    as "4G"; 0 is no limit. What a file beside the tree or its btcheck.toml says
    counts as on the command line; `settings=False` ignores the latter. A text
    reads no file: what it includes stands in `files`.
    """
    return Report(_ask(
        "check", tree, cancel, conditions, files, packages, settings, rules, leaves,
        models, None,
        {"profile": profile, "main_tree": main_tree, "ticks": tick,
         "tick_milliseconds": tick_ms, "loops": loop, "wake_ups": wake_ups,
         "tries_repairs": repairs, "threads": threads, "seconds": timeout,
         "bytes": _size(memory), "states": states},
    ))


def lint(
    tree: object,
    rules: object = (),
    *,
    leaves: object = (),
    models: object = (),
    profile: str = "",
    main_tree: str = "",
    tick: str = "",
    tick_ms: int = 0,
    timeout: float = 0,
    settings: Union[None, bool, Path] = None,
    files: Optional[Mapping[str, Text]] = None,
    packages: Optional[Mapping[str, Path]] = None,
    conditions: Iterable[str] = (),
    cancel: Optional[Cancellation] = None,
) -> Report:
    """Reads a tree and its rules as `check` does, and searches nothing."""
    return Report(_ask(
        "lint", tree, cancel, conditions, files, packages, settings, rules, leaves,
        models, None,
        {"profile": profile, "main_tree": main_tree, "ticks": tick,
         "tick_milliseconds": tick_ms, "seconds": timeout},
    ))


def describe(
    tree: object,
    *,
    leaves: object = (),
    models: object = (),
    profile: str = "",
    main_tree: str = "",
    timeout: float = 0,
    settings: Union[None, bool, Path] = None,
    files: Optional[Mapping[str, Text]] = None,
    packages: Optional[Mapping[str, Path]] = None,
    conditions: Iterable[str] = (),
    cancel: Optional[Cancellation] = None,
) -> Description:
    """What the files of a tree say of each node, its ports and its entries."""
    return Description(_ask(
        "describe", tree, cancel, conditions, files, packages, settings, (), leaves,
        models, None,
        {"profile": profile, "main_tree": main_tree, "seconds": timeout},
    ))


def simulate(
    tree: object,
    *,
    seed: Optional[int] = None,
    script: Optional[Path] = None,
    ticks: int = 100,
    leaves: object = (),
    models: object = (),
    profile: str = "",
    main_tree: str = "",
    tick: str = "",
    tick_ms: int = 0,
    loop: bool = False,
    wake_ups: bool = False,
    timeout: float = 0,
    settings: Union[None, bool, Path] = None,
    files: Optional[Mapping[str, Text]] = None,
    packages: Optional[Mapping[str, Path]] = None,
    conditions: Iterable[str] = (),
    cancel: Optional[Cancellation] = None,
) -> Simulation:
    """One run of a tree: by a seed, by a file of answers (`script`, or its text
    of several lines), or with the first answer that each leaf can give."""
    return Simulation(_ask(
        "simulate", tree, cancel, conditions, files, packages, settings, (), leaves,
        models, script,
        {"profile": profile, "main_tree": main_tree, "ticks": tick,
         "tick_milliseconds": tick_ms, "loops": loop, "wake_ups": wake_ups,
         "seconds": timeout, "seed": seed, "run_ticks": ticks},
    ))


def explain(code: str) -> Explanation:
    """What a code means, "BT2208" for instance."""
    pointer = library().btcheck_explain(_utf8(code, "the code"))
    if not pointer:
        raise RequestError("there is no code `%s`" % code)
    import json

    told = json.loads(_Handle(pointer).text("json"))
    return Explanation(told["code"], told["summary"], told["description"], told["help"])


def library_version() -> str:
    said: bytes = library().btcheck_version()
    return said.decode()
