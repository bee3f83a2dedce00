# SPDX-License-Identifier: MIT
"""libbtcheck.so by ctypes: btcheck/check.h, and nothing else of it."""

from __future__ import annotations

import ctypes
import os
import platform
import threading
from ctypes import c_char_p, c_int, c_size_t, c_void_p
from pathlib import Path
from typing import Any, List, Optional, Sequence, Tuple

from ._version import VERSION


class LibraryError(RuntimeError):
    """The library cannot be used here; says why in a sentence."""


# To: the name that is asked for, and where the answer goes.
Source = ctypes.CFUNCTYPE(c_int, c_void_p, c_char_p, c_void_p)

_REQUEST = [c_void_p]
# Name, what it returns, what it takes. Texts that are returned are copied.
_FUNCTIONS: Sequence[Tuple[str, Any, List[Any]]] = (
    ("version", c_char_p, []),
    ("request_new", c_void_p, []),
    ("request_free", None, _REQUEST),
    ("set", c_int, [c_void_p, c_char_p, c_char_p]),
    ("add_file", c_int, [c_void_p, c_char_p, c_char_p, c_size_t]),
    ("add_package", c_int, [c_void_p, c_char_p, c_char_p]),
    ("text_set", None, [c_void_p, c_char_p, c_size_t]),
    ("set_source", None, [c_void_p, Source, c_void_p]),
    ("set_packages", None, [c_void_p, Source, c_void_p]),
    ("set_trees", None, [c_void_p, Source, c_void_p]),
    ("cancel", None, _REQUEST),
    ("request_error", c_char_p, _REQUEST),
    ("check", c_void_p, _REQUEST),
    ("lint", c_void_p, _REQUEST),
    ("describe", c_void_p, _REQUEST),
    ("simulate", c_void_p, _REQUEST),
    ("explain", c_void_p, [c_char_p]),
    ("report_free", None, _REQUEST),
    ("report_outcome", c_int, _REQUEST),
    ("report_json", c_char_p, _REQUEST),
    ("report_sarif", c_char_p, _REQUEST),
    ("report_itf", c_char_p, _REQUEST),
    ("report_runs", c_char_p, _REQUEST),
    ("report_html", c_char_p, [c_void_p, c_char_p]),
    ("report_error", c_char_p, _REQUEST),
)

_loaded: Optional[ctypes.CDLL] = None
_loading = threading.Lock()


def _place() -> str:
    """BTCHECK_LIBRARY, for those who build their own; else that of the wheel."""
    return os.environ.get("BTCHECK_LIBRARY") or str(
        Path(__file__).with_name("libbtcheck.so")
    )


def _reason(place: str, error: OSError) -> str:
    if not os.path.exists(place):
        return (
            "there is no library %s; install btcheck's wheel, or set BTCHECK_LIBRARY"
            % place
        )
    if "GLIBC_" in str(error):
        needed = str(error).split("GLIBC_")[1].split("'")[0]
        return "btcheck needs glibc %s or later, and this system has %s" % (
            needed,
            platform.libc_ver()[1] or "another C library",
        )
    return "the library %s cannot be loaded: %s" % (place, error)


def _load() -> ctypes.CDLL:
    place = _place()
    try:
        loaded = ctypes.CDLL(place)
    except OSError as error:
        raise LibraryError(_reason(place, error)) from None
    for name, returns, takes in _FUNCTIONS:
        try:
            function = getattr(loaded, "btcheck_" + name)
        except AttributeError:
            raise LibraryError(
                "the library %s has no btcheck_%s: it is of another version than"
                " the package, %s" % (place, name, VERSION)
            ) from None
        function.restype = returns
        function.argtypes = takes
    found = loaded.btcheck_version().decode()
    if found != VERSION:
        raise LibraryError(
            "the library %s is version %s, and the package is %s"
            % (place, found, VERSION)
        )
    return loaded


def library() -> ctypes.CDLL:
    """Loaded when it is first needed."""
    global _loaded
    if _loaded is None:
        with _loading:
            if _loaded is None:
                _loaded = _load()
    return _loaded
