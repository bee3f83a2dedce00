# SPDX-License-Identifier: MIT
"""The files around a tree, read as the command line reads them.

What a user names is read wherever it lies. What a tree asks for may be a
stranger's: it is read in the repository of the tree and nowhere else, where
there is one.
"""

from __future__ import annotations

import os
import re
import stat
from typing import (
    Callable,
    Dict,
    Iterable,
    Iterator,
    List,
    Optional,
    Sequence,
    Set,
    Tuple,
)

_SETTINGS = "btcheck.toml"
_MOST_BYTES = 64 << 20  # of a file
_MOST_BESIDE = 1 << 20  # a tree is smaller
_MOST_FILES = 1000  # of one folder
_MOST_LOOKS = 20_000  # at names of files and folders
_FOLDERS_UP = 3  # from a tree to the folder of all packages
_FOLDERS_DOWN = 3  # and down to a package.xml
_FOLDERS_TO_TREES = 6  # from that folder to a tree

# The ID of a tree.
_TREE = re.compile(rb"<BehaviorTree\b[^>]*?\bID\s*=\s*[\"']([^\"']*)[\"']")


class ReadError(OSError):
    """Says in a sentence why a file cannot be read."""


def read_file(name: str, most: int = _MOST_BYTES) -> bytes:
    """All of a regular file. Raises FileNotFoundError, or a ReadError."""
    flags = os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC
    try:
        descriptor = os.open(name, flags)
        with os.fdopen(descriptor, "rb") as file:
            if not stat.S_ISREG(os.fstat(descriptor).st_mode):
                raise ReadError("`%s` is a pipe or a device; name a file" % name)
            text = file.read(most + 1)
    except IsADirectoryError:
        raise ReadError("`%s` is a directory; name a file in it" % name) from None
    except (FileNotFoundError, NotADirectoryError):
        raise FileNotFoundError(name) from None
    except ReadError:
        raise
    except OSError as error:
        raise ReadError("cannot read `%s`: %s" % (name, error.strerror)) from None
    if len(text) > most:
        raise ReadError("`%s` is larger than %d MiB, the most that is read of a file"
                        % (name, most >> 20))
    return text


def _is_xml(name: str) -> bool:
    return name.endswith((".xml", ".btproj"))


def _parts_below(root: str, file: str) -> Optional[List[str]]:
    """The names from the root down to the file; None where it is not below."""
    root, file = os.path.realpath(root), os.path.realpath(file)
    if root == file:
        return []
    root = root.rstrip("/") + "/"
    return file[len(root):].split("/") if file.startswith(root) else None


def _is_inside(root: str, file: str) -> bool:
    parts = _parts_below(root, file)
    return parts is not None and not any(part.startswith(".") for part in parts)


def _surroundings(folder: str) -> Tuple[str, str]:
    """The next folder with a btcheck.toml up to the repository, and that."""
    settings = repository = ""
    while not repository:
        if not settings and os.path.lexists(os.path.join(folder, _SETTINGS)):
            settings = folder
        if os.path.exists(os.path.join(folder, ".git")):
            repository = folder
        above = os.path.dirname(folder)
        if above == folder:
            break
        folder = above
    return settings, repository


def _holds_too_much(folder: str) -> bool:
    """Dotfiles are kept in a repository as well: it holds everything."""
    home = os.environ.get("HOME")
    return folder == "/" or bool(
        home and os.path.exists(home) and os.path.samefile(folder, home)
    )


def _repository(folder: str) -> str:
    settings, repository = _surroundings(os.path.realpath(folder))
    for root in (repository, settings):
        if root and not _holds_too_much(root):
            return root
    return ""


def _is_top(folder: str) -> bool:
    """Nothing above it is of the same workspace."""
    return os.path.basename(folder) == "src" or os.path.dirname(folder) == folder


def _has_package(folder: str) -> bool:
    return os.path.isfile(os.path.join(folder, "package.xml"))


def _package_name(folder: str) -> str:
    try:
        text = read_file(os.path.join(folder, "package.xml"))
    except OSError:
        return ""
    found = re.search(rb"<name>\s*(.*?)\s*</name>", text, re.DOTALL)
    return os.fsdecode(found.group(1)) if found else ""


def _folders_below(
    top: str, depth: int, looks: List[int], goes_below: Callable[[str], bool]
) -> Iterator[str]:
    """Folders at or below `top`, those nearer to it first."""
    folders = [(top, 0)]
    for folder, down in folders:
        yield folder
        if down == depth or not goes_below(folder):
            continue
        try:
            entries = list(os.scandir(folder))
        except OSError:
            continue
        for entry in entries:
            looks[0] -= 1
            if looks[0] < 0:
                return
            if not entry.name.startswith(".") and entry.is_dir(follow_symlinks=False):
                folders.append((entry.path, down + 1))


class Named:
    """The files that a user names, and no others."""

    def __init__(self, named: Iterable[str]) -> None:
        self._named = set(named)

    def text(self, name: str) -> Optional[bytes]:
        """None where there is no such file, or where it may not be read."""
        try:
            return read_file(name) if name in self._named else None
        except FileNotFoundError:
            return None

    def package(self, name: str) -> str:
        """The share folder of a ROS package; "" where there is none."""
        return ""

    def file_with_tree(self, name: str) -> str:
        """The name of the file that has a tree; "" where there is none."""
        return ""


class Disk(Named):
    """What one tree of the file system asks for."""

    def __init__(self, tree: str, named: Sequence[str]) -> None:
        """`named` are the other files of the request."""
        self.tree = tree
        self._here = os.getcwd()
        self._folder = os.path.dirname(os.path.join(self._here, tree))
        super().__init__((tree, *named))
        repository = _repository(self._folder)
        self._roots = [repository, self._folder, *named] if repository else []
        workspace = self._workspace() if repository else ""
        if workspace:
            self._roots.append(workspace)

    # --- What the library asks for -------------------------------------------

    def text(self, name: str) -> Optional[bytes]:
        if name in self._named:
            return super().text(name)
        return self._asked(name, _MOST_BYTES)

    def beside(self, has_contracts: bool) -> Dict[str, bytes]:
        """The XML files in the folder of the tree that can count for it, with
        that of the tree: those with models, those that may have a tree that is
        used, and beside contracts all. To parse the others would take longer
        than to check a small tree."""
        folder = os.path.dirname(self.tree)
        names = [name for name in os.listdir(folder or ".") if _is_xml(name)]
        files = {}
        for name in sorted(names) if len(names) <= _MOST_FILES else ():
            file = os.path.normpath(os.path.join(folder, name))
            text = self._asked(file, _MOST_BESIDE)
            if text is not None:
                files[file] = text
        own = files.get(os.path.normpath(self.tree), b"")
        if has_contracts or b"<include" in own:
            return files
        trees = {file: set(_TREE.findall(text)) for file, text in files.items()}
        chosen = {file for file, text in files.items() if b"TreeNodesModel" in text}
        chosen.add(os.path.normpath(self.tree))
        known: Set[bytes] = set()
        grows = True
        while grows:
            known.update(*(trees.get(file, ()) for file in chosen))
            words = b"\n".join(files.get(file, b"") for file in chosen)
            more = {
                file
                for file, has in trees.items()
                if any(tree in words or b"&" in tree for tree in has - known)
            }
            grows = not more <= chosen
            chosen |= more
        return {file: text for file, text in files.items() if file in chosen}

    def settings(self) -> str:
        """The name of the btcheck.toml that holds for the tree, or ""."""
        folder = _surroundings(os.path.normpath(self._folder))[0]
        if not folder:
            return ""
        file = os.path.join(folder, _SETTINGS)
        name = file if os.path.isabs(self.tree) else os.path.relpath(file, self._here)
        # It may lie outside of the roots, but not lead out of its folder.
        if not self._roots or _is_inside(folder, file):
            self._named.add(name)
        return name

    def package(self, name: str) -> str:
        """The share folder of a ROS package: installed, or in the workspace."""
        if "/" in name or name.startswith("."):
            return ""
        for prefix in os.environ.get("AMENT_PREFIX_PATH", "").split(":"):
            folder = os.path.join(prefix, "share", name)
            if prefix and os.path.isdir(folder):
                if self._roots:
                    self._roots.append(folder)
                return folder
        return self._package_in_workspace(name)

    def file_with_tree(self, name: str) -> str:
        """In the ROS package of the tree, and then more and more around it."""
        pattern = re.compile(rb"<BehaviorTree\b[^>]*\bID\s*=\s*[\"']%s[\"']"
                             % re.escape(name.encode()))
        looks = [_MOST_LOOKS]
        for folder in self._levels():
            found = []
            for at in _folders_below(folder, _FOLDERS_TO_TREES, looks, lambda _: True):
                for file in sorted(os.listdir(at)):
                    if file.endswith(".xml"):
                        path = self._as_asked(os.path.join(at, file))
                        if pattern.search(self._asked(path, _MOST_BESIDE) or b""):
                            found.append(path)
            if found:
                return min(found, key=self._distance)
        return ""

    # --- Where things lie -----------------------------------------------------

    def _asked(self, name: str, most: int) -> Optional[bytes]:
        if self._roots and not any(_is_inside(root, name) for root in self._roots):
            return None
        try:
            return read_file(name, most)
        except OSError:
            return None

    def _as_asked(self, path: str) -> str:
        if os.path.isabs(self.tree):
            return path
        return os.path.relpath(path, self._here)

    def _distance(self, file: str) -> int:
        way = os.path.relpath(os.path.dirname(file) or ".", self._folder)
        return len(way.split("/"))

    def _package_around(self) -> str:
        folder = os.path.normpath(self._folder)
        while not _has_package(folder):
            if _is_top(folder):
                return ""
            folder = os.path.dirname(folder)
        return folder

    def _workspace(self) -> str:
        """The `src` in which repositories lie beside each other."""
        folder = self._package_around()
        for _ in range(_FOLDERS_UP + 1 if folder else 0):
            if os.path.basename(folder) == "src":
                return folder
            folder = os.path.dirname(folder)
        return ""

    def _levels(self) -> Iterator[str]:
        folder = self._package_around()
        end = self._workspace() or _surroundings(folder or "/")[1]
        for _ in range(_FOLDERS_UP + 1 if folder else 0):
            yield folder
            if folder == end or _is_top(folder):
                return
            folder = os.path.dirname(folder)

    def _package_in_workspace(self, name: str) -> str:
        looks = [_MOST_LOOKS]
        folder = os.path.normpath(self._folder)
        for _ in range(_FOLDERS_UP + 1):
            # Packages do not lie in each other.
            for at in _folders_below(
                folder, _FOLDERS_DOWN, looks, lambda at: not _has_package(at)
            ):
                if _has_package(at) and _package_name(at) == name:
                    return self._as_asked(at)
            if _is_top(folder):
                break
            folder = os.path.dirname(folder)
        return ""
