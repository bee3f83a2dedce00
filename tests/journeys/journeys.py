#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
#
# Three first hours: an engineer of Nav2, a student with a drone, a tech lead with
# the eight trees of a fleet. Each step is a line that such a person types, and
# what has to be seen then: not a text to the letter, but what they came for.
#   journeys.py BTCHECK SOURCES
import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml
from pathlib import Path

program, sources = (Path(each).resolve() for each in sys.argv[1:])
COLUMNS = 80
stumbles = []
steps = 0


class Seen:
    """What a line has printed, and what the person who typed it looks for."""

    def __init__(self, who, line, done, seconds):
        self.where = f"{who}: `{line}`"
        self.out, self.err, self.code = done.stdout, done.stderr, done.returncode
        self.all = self.out + self.err
        self.seconds = seconds

    def so(self, is_so, wanted):
        if not is_so:
            stumbles.append(f"{self.where}\n  {wanted}\n" + re.sub(r"(?m)^", "  | ", self.all[-3000:]))
        return self

    def ends(self, code):
        return self.so(self.code == code, f"ends with exit code {code}, not {self.code}")

    def shows(self, *patterns):
        for each in patterns:
            self.so(re.search(each, self.all, re.M), f"shows /{each}/")
        return self

    def hides(self, *patterns):
        for each in patterns:
            self.so(not re.search(each, self.all, re.M), f"does not show /{each}/")
        return self

    def has_lines(self, most):
        return self.so(len(self.all.splitlines()) <= most, f"has at most {most} lines")

    # The lines below an entry of a folder.
    def below(self, name):
        found = re.search(rf"^\S.*{re.escape(name)}\n((  .*\n)*)", self.out, re.M)
        return found[1] if found else ""

    # Names of files may be longer than a line.
    def fits(self):
        wide = [line for line in self.out.splitlines() if len(line) > COLUMNS and
                not re.search(r"\S+/\S+$", line)]
        return self.so(not wide, f"fits into {COLUMNS} columns: {wide[:1]}")

    def takes(self, seconds):
        return self.so(self.seconds < seconds, f"takes {seconds} s at most, not {self.seconds:.0f}")


class Desk:
    """A folder in which somebody works."""

    def __init__(self, who, folder):
        self.who, self.folder = who, folder
        self.environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}"}
        self.environment.pop("GITHUB_WORKSPACE", None)
        self.environment.pop("CI_PROJECT_DIR", None)

    def types(self, line, **variables):
        global steps
        steps += 1
        begun = time.monotonic()
        done = subprocess.run(["bash", "-c", line], cwd=self.folder, text=True,
                              env={**self.environment, **variables}, capture_output=True,
                              stdin=subprocess.DEVNULL, timeout=300)
        return Seen(self.who, line, done, time.monotonic() - begun)

    def text(self, name):
        file = self.folder / name
        return file.read_text() if file.exists() else ""

    def edits(self, name, before, after):
        file = self.folder / name
        text = file.read_text()
        assert before in text, (name, before)
        file.write_text(text.replace(before, after, 1))

    # Names and bytes of what stands in a folder.
    def files(self, name):
        return {str(each.relative_to(self.folder / name)): each.stat().st_size
                for each in (self.folder / name).rglob("*") if each.is_file()}


def nav2_engineer(folder):
    (folder / "behavior_trees").mkdir()
    for name in ("follow_point", "navigate_to_pose_w_bounds_check", "navigate_w_replanning_speed",
                 "navigate_to_pose_w_replanning_and_recovery", "odometry_calibration"):
        shutil.copy(sources / f"examples/nav2/main/{name}.xml", folder / "behavior_trees")
    me = Desk("Nav2 engineer", folder)
    tree = "behavior_trees/navigate_to_pose_w_replanning_and_recovery.xml"

    me.types("btcheck --help").ends(0).has_lines(40).shows("btcheck TREE|btcheck FILE|TREE")

    me.types(f"btcheck {tree}").ends(0).shows(
        r"^warning\[BT2208\]: `RecoveryActions` fails although `BackUp` succeeds",
        r"repair, checked", r"tick 1 .*BackUp -> success")

    # The folder says of each tree what the tree alone says, in a line.
    seen = me.types("btcheck behavior_trees").ends(0).fits()
    seen.shows(r"navigate_to_pose_w_replanning_and_recovery\.xml\n"
               r"(  .*\n)*  warning\[BT2208\] line 50: `RecoveryActions` fails",
               r"^\d+ entries: .*; (\d+ errors?, )?\d+ warnings?")
    seen.hides("7 of 7", r"\bMET\b")  # there is no rule that could be met
    alone = me.types(f"btcheck {tree}")
    told = re.findall(r"^(warning\[BT22\d\d\]): (.*)", alone.out, re.M)
    alone.so(len(told) >= 3, "tells three things of that tree")
    for code, words in told[:5]:
        seen.so(f"  {code} line " in seen.below(tree), f"has `{words}` below the tree")
    me.types("btcheck behavior_trees -v").ends(0).shows(
        r"repair, checked", r"tick 1 .*BackUp -> success")

    # The runs of what was found, and no others.
    seen = me.types(f"btcheck {tree} --trace-dir runs -q").ends(0).takes(60)
    files = me.files("runs")
    seen.so(any(re.search(r"BT2208-RecoveryActions\.html$", each) for each in files),
            f"keeps the run of RecoveryActions, not {sorted(files)[:5]}")
    seen.so(all(re.search(r"BT2\d\d\d", each) for each in files), "keeps runs of findings alone")
    seen.so(len(files) <= 12 and sum(files.values()) < 8e6, "keeps few and small files")

    # A rule of one's own: misspelt, then right, and its run.
    me.types(f"btcheck {tree} -e 'never BackUpp.success and root.failure'").ends(2).shows(
        r"did you mean `BackUp`")
    # Two nodes are never there in one instant: what was meant is said.
    me.types(f"btcheck {tree} -e 'never BackUp.success and RecoveryActions.failure'").shows(
        r"vacuously", r"did you mean: in no tick: ")
    rule = "-e 'in no tick: BackUp.answer == success and RecoveryActions.answer == failure'"
    me.types(f"btcheck {tree} {rule} --trace-dir rule").ends(1).shows(
        r"^VIOLATED", r"why: ", r"BackUp -> success")
    seen.so(any(each.endswith(".html") for each in me.files("rule")), "keeps the run of a rule")

    # It is meant: said once, at the node.
    me.edits(tree, '<RoundRobin name="RecoveryActions">',
             '<!-- btcheck: allow BT2208: the last resort -->\n<RoundRobin name="RecoveryActions">')
    me.types(f"btcheck {tree}").ends(0).hides(r"\[BT2208\]").shows("1 allowed")
    me.types("btcheck behavior_trees").hides(r"BT2208\] line 5\d").shows("1 allowed")


def drone_student(folder):
    shutil.copy(sources / "tests/journeys/drone/mission.xml", folder)
    me = Desk("drone student", folder)

    me.types("btcheck mision.xml").ends(2).has_lines(6).shows("mision.xml")
    me.edits("mission.xml", '<Land name="land"/>', '<Land name="land">')
    me.types("btcheck mission.xml").ends(2).shows(r"mission\.xml:14", "not closed")
    me.edits("mission.xml", '<Land name="land">', '<Land name="land"/>')

    me.types("btcheck mission.xml").ends(0).shows(
        r"warning\[BT1628\]: .*`wayponit`", r"mission\.xml:10", "did you mean `waypoint`")
    me.types("btcheck .").ends(0).fits().shows(
        r"mission\.xml\n  warning\[BT1628\] line 10: .*wayponit", r"1 warning")
    me.types("btcheck explain BT1628").ends(0).shows("BT1628")
    me.edits("mission.xml", "wayponit", "waypoint")
    me.types("btcheck mission.xml").hides("BT1628")

    # What must never be: the drone stays up.
    seen = me.types("btcheck mission.xml -e 'take_off.success leadsto land.ticked'").ends(1)
    seen.fits().shows(r"^VIOLATED", r"battery_ok -> failure", "why: ")
    me.edits("mission.xml", '<ReactiveSequence name="survey">',
             '<ForceSuccess><ReactiveSequence name="survey">')
    me.edits("mission.xml", "</ReactiveSequence>", "</ReactiveSequence></ForceSuccess>")
    me.types("btcheck mission.xml -e 'in no tick: battery_ok.failure and fly_leg.running'").ends(0)
    me.types("btcheck mission.xml -e 'take_off.success leadsto land.ticked' --assume actions-end"
             ).ends(0).shows(r"^HOLDS")
    me.types("btcheck simulate mission.xml --seed 3 --ticks 4").ends(0).shows("tick 1")
    me.types("btcheck init mission.xml").ends(0).shows("property")


def tech_lead(folder):
    shutil.copytree(sources / "tests/journeys/fleet/trees", folder / "trees")
    me = Desk("tech lead", folder)
    me.types("git init -q . && git -c user.name=t -c user.email=t@localhost commit -q "
             "--allow-empty -m begun").ends(0)

    # The first look: what is wrong, and where, on one screen.
    seen = me.types("btcheck trees").ends(1).fits().has_lines(60)
    seen.shows(r"^NO FAULT +no rules .*trees/greet\.xml$", r"^MISSED +1 of 2 .*inspect\.ltl$",
               r"trees/dock\.xml\n  warning\[BT2206\] line 7: `close_cover` is not ticked",
               r"^VIOLATED   lowered", r"^8 entries: 1?.*1 missed; 1 error, \d+ warnings")
    haul = seen.below("haul.xml")
    seen.so(haul.count("  warning[") == 5, "has five findings below haul.xml")
    more = re.search(r"^  2 more: (btcheck .*)$", haul, re.M)
    seen.so(more, "says how to see the other two")
    if more:
        me.types(more[1]).ends(0).shows("7 findings", "BT2211", "BT2217")

    # Settings at the root of the repository touch no tree.
    (folder / "btcheck.toml").write_text('[levels]\nBT2214 = "error"\n')
    seen = me.types("btcheck trees").ends(1).hides("BROKEN", "BT0009")
    seen.shows(r"^FAULT +no rules .*trees/clean\.xml\n  error\[BT2214\] trees/room\.xml:5: ")
    (folder / "btcheck.toml").write_text('deny = ["warnings"]\n')

    # What is there today is taken as it is, notes left alone.
    me.types("btcheck trees --write-baseline baseline.json -q").ends(1)
    kept = json.loads(me.text("baseline.json") or '{"findings": []}')["findings"]
    seen.so(kept and all(each["code"] != "BT1649" for each in kept), "keeps what may fail a check")
    seen = me.types("btcheck trees --baseline baseline.json").ends(1)
    seen.hides("BT22", "BT1628").shows(r"\d+ in the baseline$")
    me.edits("trees/inspect.ltl", "lowered expect holds", "lowered expect violated")
    me.types("btcheck trees --baseline baseline.json").ends(0)

    # A change that does harm, as the server sees it: all reports say so.
    me.edits("trees/greet.xml", '<Say name="hello" text="Good morning"/>',
             '<Parallel name="wave_race" success_count="1"><Say name="hello" text="Hi"/>'
             '<Say name="song" text="La"/></Parallel>')
    formats = "--format github --format sarif=r.sarif --format junit=r.xml --format json=r.json"
    check = f"btcheck batch trees -q --baseline baseline.json {formats} --report r.html"
    seen = me.types(check, GITHUB_STEP_SUMMARY=str(folder / "summary.md")).ends(1)
    seen.shows(r"^::error file=trees/greet\.xml,line=5,.*BT2214", "^btcheck: 1 error")
    suites = xml.fromstring(me.text("r.xml") or "<none/>")
    seen.so(suites.get("failures") == "1", "JUnit has one failure")
    failed = [case.get("name") for case in suites.iter("testcase") if case.find("failure") is not None]
    seen.so(len(failed) == 1 and "wave_race" in failed[0], f"JUnit names what failed: {failed}")
    sarif = json.loads(me.text("r.sarif") or '{"runs": [{"results": []}]}')["runs"][0]["results"]
    seen.so([each["ruleId"] for each in sarif if each["level"] == "error"] == ["BT2214"],
            "SARIF has one error")
    seen.so("wave_race" in html.unescape(me.text("summary.md")),
            "the page of the job says what is wrong")
    seen.so("wave_race" in me.text("r.html"), "the page says what is wrong")
    me.types("btcheck trees --baseline baseline.json").ends(1).shows(
        r"greet\.xml\n  error\[BT2214\] line 5: `wave_race`")

    # Runs to look at: a few, small, soon, and each finding leads to its own.
    seen = me.types("btcheck batch trees --trace-dir runs --report runs.html --no-config"
                    ).takes(60)
    files = me.files("runs")
    seen.so(sum(files.values()) < 20e6 and len(files) < 40, "keeps few and small files")
    seen.so(any(each.endswith("BT2206-open_cover.html") for each in files),
            f"keeps the run of each finding: {sorted(files)[:5]}")
    # A minute of waiting is a long run: its page is small, and all else is left out.
    seen.shows("1 run is written to .*elevator.* as a page alone")
    ride = [each for each in files if "elevator.BT2214-ride_race" in each]
    seen.so(len(ride) == 1 and ride[0].endswith(".html"), f"keeps the ride as a page: {ride}")
    pages = re.findall(r'href="(runs/[^"]*)"', me.text("runs.html"))
    seen.so(any("BT2206-open_cover" in each for each in pages), "links each finding to its run")
    seen.so(all((folder / each).exists() for each in pages), "leads to files that are there")

    # A tree that is too large today is a line or two.
    seen = me.types("btcheck trees/elevator.xml trees/greet.xml --max-states 500 --no-config")
    seen.ends(3).fits().has_lines(12).shows(r"^UNDECIDED .*elevator\.xml$",
                                            r"limit of --max-states", "1 undecided")
    me.types("btcheck trees --jobs 2 --resume --baseline baseline.json").ends(1).shows("wave_race")


with tempfile.TemporaryDirectory() as name:
    for hour in (nav2_engineer, drone_student, tech_lead):
        desk = Path(name) / hour.__name__
        desk.mkdir()
        hour(desk)

print(*stumbles, sep="\n\n")
print(f"three hours, {steps} lines typed, {len(stumbles)} stumbles")
sys.exit(bool(stumbles))
