#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
#
# Every format of a report says the same: what failed, of which code, and
# whether the exit code is right. Trees by themselves and folders of them, with
# rules and without, denied, allowed, known, left open, broken.
#   agree.py BTCHECK SOURCES
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
from collections import Counter
from pathlib import Path

program, sources = (Path(each).resolve() for each in sys.argv[1:])
FILES = {"json": "r.json", "jsonl": "r.jsonl", "sarif": "r.sarif", "junit": "r.xml",
         "github": "r.txt", "gitlab": "r.lab"}
complaints = []

RACE = """<root BTCPP_format="4"><BehaviorTree ID="T">
<Parallel name="race" success_count="1"><A/><B/></Parallel></BehaviorTree>
<TreeNodesModel><Action ID="A"/><Action ID="B"/></TreeNodesModel></root>
"""
MISSPELT = """<root BTCPP_format="4"><BehaviorTree ID="T">
<Sequence><Make goal="{goal}"/><Drive goal="{gaol}"/></Sequence></BehaviorTree>
<TreeNodesModel><Action ID="Make"><output_port name="goal"/></Action>
<Action ID="Drive"><input_port name="goal"/></Action></TreeNodesModel></root>
"""
NEVER = "(BehaviorTree :name t (ForceFailure (Action :ID a)))\n"
FAULT = ("(defsv k :max 1)\n(BehaviorTree :name t (Sequence (SetSV :ID look :sv k)\n"
         " (Eval (:= k (+ k 1)))))\n")
OPEN = "(BehaviorTree :name t (Sequence (Action :ID a) (Action :ID b)))\n"
WIDE = "(BehaviorTree :name t (ParallelAll {}))\n".format(
    " ".join(f"(Action :ID a{i} :duration [1,9])" for i in range(12)))
TREES = {"wide.btf": WIDE, "wide.ltl": 'tree "wide.btf"\nproperty p: never a0.halted\n'
                                       "property q: never a1.halted\n",
         "race.xml": RACE, "misspelt.xml": MISSPELT, "never.btf": NEVER, "fault.btf": FAULT,
         "fault.rule.ltl": 'tree "fault.btf"\nproperty p: possible look.success\n',
         "open.btf": OPEN, "broken.btf": "(BehaviorTree :name t (Sequence",
         "bad.ltl": 'tree "open.btf"\nproperty p: never a.failure\nproperty q: never b.halted\n',
         "meant.ltl": 'tree "open.btf"\nproperty p expect violated: never a.failure\n',
         "empty.ltl": 'tree "open.btf"\nproperty p: a.halted leadsto b.ticked\n'}
KNOWN = {"some.json": ["race.xml"]}

OPTIONS = ["", "--deny warnings", "--deny BT2214", "--deny BT2101", "--deny BT2105",
           "--deny BT1628", "--max-states 3", "--max-states 3 --deny warnings",
           "--baseline some.json --deny warnings", "--no-repairs"]


def read(folder, words):
    for name in FILES.values():
        (folder / name).unlink(missing_ok=True)
    formats = " ".join(f"--format {each}={name}" for each, name in FILES.items())
    done = subprocess.run(f"{program} {words} --format text {formats}", cwd=folder, text=True,
                          shell=True, capture_output=True, timeout=120)
    return done, {each: (folder / name).read_text() for each, name in FILES.items()}


# The codes of what is an error, as each format has them. In a suite of JUnit
# whose inputs are broken one case stands for all of them.
def of_json(text):
    report = json.loads(text)
    found = Counter()
    for tree in report["trees"]:
        found.update(each["code"] for each in tree["diagnostics"] + tree["findings"]
                     if each["severity"] == "error")
    return found, report["exit_code"]


def of_lines(text):
    found = Counter()
    for line in map(json.loads, text.splitlines()):
        if line["event"] in ("diagnostic", "finding") and line["severity"] == "error":
            found[line["code"]] += 1
    return found, line["exit_code"]


def of_sarif(text):
    run = json.loads(text)["runs"][0]
    found = Counter(each["ruleId"] for each in run["results"] if each["level"] == "error")
    return found, run["invocations"][0]["exitCode"]


def of_github(text):
    found = Counter(re.findall(r"^::error [^\n]*?title=[^:\n]*\[(BT\d+)\]::", text, re.M))
    return found, int(re.search(r"^btcheck: (\d+) error", text, re.M)[1])


def of_gitlab(text):
    issues = json.loads(text)
    return Counter(each["check_name"] for each in issues if each["severity"] == "major")


def of_junit(text):
    root = xml.fromstring(text)
    failed, broken, skipped = Counter(), Counter(), 0
    for case in root.iter("testcase"):
        for outcome in case:
            if outcome.tag == "failure":
                failed[outcome.get("type").split()[0]] += 1
            elif outcome.tag == "error":
                broken[outcome.get("type").split()[0]] += 1
            skipped += outcome.tag == "skipped"
    for name, count in (("failures", failed.total()), ("errors", broken.total()),
                        ("skipped", skipped)):
        if int(root.get(name)) != count:
            complaints.append(f"JUnit counts {root.get(name)} {name}, and has {count}")
    return failed, broken, skipped


def agree(folder, words):
    done, texts = read(folder, words)
    wrong = []

    def expect(is_so, text):
        if not is_so:
            wrong.append(text)

    errors, code = of_json(texts["json"])
    expect(code == done.returncode, f"JSON says exit code {code}")
    expect(of_lines(texts["jsonl"]) == (errors, code), f"JSON Lines: {of_lines(texts['jsonl'])}")
    expect(of_sarif(texts["sarif"]) == (errors, code), f"SARIF: {of_sarif(texts['sarif'])}")
    annotated, count = of_github(texts["github"])
    expect(count == errors.total(), f"GitHub counts {count} errors")
    expect(count > 10 or annotated == errors, f"GitHub: {annotated}")
    expect(of_gitlab(texts["gitlab"]) == errors, f"GitLab: {of_gitlab(texts['gitlab'])}")
    failed, broken, skipped = of_junit(texts["junit"])
    expect(bool(errors) == (code in (1, 2, 4)), f"exit code with these errors: {errors}")
    expect(failed <= errors and broken <= errors, f"JUnit: {failed} {broken}, not {errors}")
    expect(broken or failed == errors, f"JUnit has failed {failed}, not {errors}")
    expect(bool(failed) == (code == 1) or code == 2, f"JUnit has {failed} failed")
    expect(bool(broken) == (code in (2, 4)), f"JUnit has {broken} errors")
    expect(code != 3 or skipped, "JUnit skips nothing")
    # And people are told of each code, if not of each run.
    said = done.stdout + done.stderr
    for error in errors - Counter(["BT2001", "BT2002"] * 99):
        expect(f"error[{error}]" in said or "FAULT" in said or "NO, see below" in said,
               f"nobody is told of {error}")
    expect("BT2001" not in errors or "VIOLATED" in said, "nobody is told of a violation")
    for text in wrong:
        complaints.append(f"btcheck {words} (exit code {done.returncode}): {text}")
    return code


with tempfile.TemporaryDirectory() as name:
    place = Path(name)
    for file, text in TREES.items():
        (place / file).write_text(text)
    shutil.copytree(sources / "tests/journeys/fleet/trees", place / "fleet")
    for file in ("drone3.btf", "drone3.ltl", "recovery.btf"):
        shutil.copy(sources / "examples" / file, place)
    for file, trees in KNOWN.items():
        subprocess.run([program, *trees, "--write-baseline", file, "-q"], cwd=place,
                       capture_output=True, timeout=60)
    seen = Counter()
    for tree in sorted(TREES):
        for options in OPTIONS:
            # Twelve actions at a time are more than anybody waits for here.
            if tree.startswith("wide") and "--max-states" not in options:
                options += " --max-states 2000"
            seen[agree(place, f"{tree} {options}")] += 1
    (place / "wide.btf").unlink()
    (place / "wide.ltl").unlink()
    for words in ("drone3.btf", "drone3.btf --prop drone3.ltl", "recovery.btf --deny warnings",
                  "fleet", "fleet --deny warnings", "fleet --deny BT2206", ".",
                  ". --deny warnings --max-states 200", "race.xml open.btf --deny warnings",
                  "fleet/elevator.xml fleet/greet.xml --max-states 500"):
        seen[agree(place, words)] += 1
    # Runs that cannot be written.
    seen[agree(place, "fleet --trace-dir runs")] += 1
    shutil.rmtree(place / "runs")
    (place / "runs").mkdir()
    for each in (place / "fleet").iterdir():
        (place / "runs" / f"fleet_{each.name.replace('.', '_')}").write_text("no folder")
    seen[agree(place, "fleet --trace-dir runs")] += 1
    for code in (0, 1, 2, 3):
        if seen[code] == 0:
            complaints.append(f"no command has ended with {code}: the samples are too tame")

print(*complaints, sep="\n")
print(f"{seen.total()} reports in seven formats, {len(complaints)} disagreements")
sys.exit(bool(complaints))
