#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The door from Python, by ctypes: eight threads with one request.

    c_door_test.py LIBRARY TREE
"""
import ctypes
import json
import sys
import threading

library = ctypes.CDLL(sys.argv[1])
for name in ("request_new", "check", "lint", "describe", "simulate", "explain"):
    getattr(library, "btcheck_" + name).restype = ctypes.c_void_p
library.btcheck_report_json.restype = ctypes.c_char_p
library.btcheck_request_error.restype = ctypes.c_char_p
SOURCE = ctypes.CFUNCTYPE(
    ctypes.c_int, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p)


def handle(pointer):
    return ctypes.c_void_p(pointer)


def read(_, name, to):
    try:
        with open(name, "rb") as file:
            text = file.read()
    except OSError:
        return 0
    library.btcheck_text_set(handle(to), text, ctypes.c_size_t(len(text)))
    return 1


def told(call, request):
    report = handle(getattr(library, "btcheck_" + call)(request))
    answer = json.loads(library.btcheck_report_json(report))
    answer.pop("timing", None)
    for tree in answer.get("trees", []):
        tree.pop("timing", None)
    library.btcheck_report_free(report)
    return answer


def main():
    request = handle(library.btcheck_request_new())
    source = SOURCE(read)
    library.btcheck_set_source(request, source, None)
    for name, value in (("tree", sys.argv[2]), ("seed", "3"), ("states", "5000")):
        if library.btcheck_set(request, name.encode(), value.encode()) != 0:
            sys.exit(library.btcheck_request_error(request))
    calls = ("check", "lint", "describe", "simulate")
    alone = {call: told(call, request) for call in calls}
    assert alone["check"]["trees"][0]["nodes"] or alone["check"]["trees"], "no tree"
    assert len(alone["describe"]["nodes"]) > 3, "no nodes"
    assert alone["simulate"]["lines"], "no run"
    different = []

    def work(number):
        for i in range(4):
            call = calls[(number + i) % len(calls)]
            if told(call, request) != alone[call]:
                different.append(call)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    library.btcheck_request_free(request)
    assert not different, different


main()
