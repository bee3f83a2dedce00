#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How soon an editor is told: edits of one tree in a workspace of 40 files.

    bench/lsp.py PROGRAM [--seconds N] [--rate N] [--edits N]

Prints, in milliseconds from an edit on: what reading tells of the new text
(lint), and what its search finds. Between the edits everything else that an
editor asks is asked in turn. `--edits N` makes N edits as fast as the server
takes them and prints the memory before and after.
"""
import argparse
import os
import shutil
import statistics
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "lsp"))
from client import Editor  # noqa: E402

TREE = "navigate_to_pose_w_replanning_and_recovery.xml"


def workspace(folder):
    """40 files of the examples, Nav2's first."""
    count = 0
    examples = os.path.join(ROOT, "examples")
    for base, _, names in sorted(
            os.walk(examples), key=lambda each: ("nav2/main" not in each[0], each)):
        for name in sorted(names):
            if count == 40 or not name.endswith((".xml", ".ltl", ".btf")):
                continue
            to = os.path.join(folder, os.path.relpath(base, examples))
            os.makedirs(to, exist_ok=True)
            shutil.copy(os.path.join(base, name), to)
            count += 1
    return count


QUESTIONS = [
    "hover", "completion", "definition", "references", "documentHighlight",
    "prepareRename", "rename", "codeAction", "codeLens", "inlayHint",
    "documentSymbol", "foldingRange", "selectionRange", "formatting",
    "semanticTokens/full"]


def ask(editor, name, question):
    text = editor.texts[name]
    place = editor.position(name, text.index("{path}") + 2)
    whole = {"start": {"line": 0, "character": 0},
             "end": editor.position(name, len(text))}
    return editor.begin(
        "textDocument/" + question, **editor.of(name), position=place,
        range=whole, positions=[place], newName="way", options={"tabSize": 2},
        context={"includeDeclaration": True, "diagnostics": []})


def figures(name, values):
    values = sorted(values)
    if not values:
        return f"{name}: none"
    return (f"{name}: median {statistics.median(values):.1f} ms, "
            f"p95 {values[int(len(values) * 0.95)]:.1f}, "
            f"most {values[-1]:.1f} ({len(values)})")


def memory(editor):
    with open(f"/proc/{editor.process.pid}/status", encoding="ascii") as file:
        for line in file:
            if line.startswith("VmRSS"):
                return int(line.split()[1]) / 1024


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--rate", type=float, default=5)
    parser.add_argument("--edits", type=int, default=0)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        count = workspace(folder)
        name = "nav2/main/" + TREE
        with Editor(os.path.abspath(asked.program), folder) as editor:
            editor.open(name)
            print(f"{count} files; {editor.checked(name, 60)}")
            if asked.edits:
                many(editor, name, asked.edits)
                return
            lint, found, asked_for = [], [], {}
            number = 0
            end = time.monotonic() + asked.seconds
            while time.monotonic() < end:
                number += 1
                # An edit that makes another tree of it: a name that no other
                # text before had.
                old = editor.texts[name]
                at = old.index('name="RecoveryActions') + len('name="')
                stop = old.index('"', at)
                begun = time.monotonic()
                editor.change(name, at, stop, f"RecoveryActions{number}")
                version = editor.versions[name]
                seen_lint = seen_found = None
                question = QUESTIONS[number % len(QUESTIONS)]
                asking = None
                until = begun + 1 / asked.rate
                while time.monotonic() < until:
                    count = len(editor.history)
                    if asking is None and seen_lint:
                        asking = time.monotonic(), ask(editor, name, question)
                    editor.take(until - time.monotonic())
                    if asking and asking[1] in editor.answers:
                        assert "result" in editor.answers[asking[1]]
                        asked_for[question] = max(
                            asked_for.get(question, 0),
                            (time.monotonic() - asking[0]) * 1000)
                        editor.answers.clear()
                    for when, uri, told, said in editor.history[count:]:
                        if uri != editor.uri(name) or told != version:
                            continue
                        seen_lint = seen_lint or when
                        # Only the search of this text knows the new name.
                        if any(f"`RecoveryActions{number}`" in each["message"]
                               for each in said):
                            seen_found = seen_found or when
                if seen_lint:
                    lint.append((seen_lint - begun) * 1000)
                if seen_found:
                    found.append((seen_found - begun) * 1000)
            print(f"{number} edits, {asked.rate} a second")
            print(figures("edit to lint", lint))
            print(figures("edit to findings", found))
            print("the longest of each question, in ms: " + ", ".join(
                f"{name} {value:.0f}"
                for name, value in sorted(asked_for.items())))
            print(f"memory {memory(editor):.1f} MiB")


def many(editor, name, edits):
    before = None
    for number in range(edits):
        old = editor.texts[name]
        at = old.index('name="RecoveryActions') + len('name="')
        stop = old.index('"', at)
        editor.change(name, at, stop, f"RecoveryActions{number % 1000}")
        version = editor.versions[name]
        editor.until(lambda: editor.diagnostics[editor.uri(name)][1] == version)
        editor.history.clear()
        if number == edits // 10:
            editor.checked(name)
            before = memory(editor)
    print(editor.checked(name))
    print(f"memory after {edits // 10} edits {before:.1f} MiB, "
          f"after {edits} {memory(editor):.1f} MiB")


if __name__ == "__main__":
    main()
