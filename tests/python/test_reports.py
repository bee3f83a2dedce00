# SPDX-License-Identifier: MIT
"""What goes in, and what comes out."""

import dataclasses
import json
import os
import pickle
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import btcheck
import pytest
from btcheck import Outcome, RequestError
from trees import NAV2, SMALL, SOURCES, comparable, tree_of


def test_a_rule_that_is_violated_has_a_run():
    report = btcheck.check(SMALL, ["never CloseDoor.failure", "never Unlock.skipped"])
    assert report.outcome is Outcome.MISSED and not report.ok
    broken, holds = report.verdicts
    assert (broken.verdict, broken.met) == ("VIOLATED", False)
    assert (holds.verdict, holds.met, holds.run) == ("HOLDS", True, None)
    assert broken.rule == "never CloseDoor.failure"
    assert broken.run.steps[-2].text == "CloseDoor -> failure"
    assert broken.run.steps[-2].chosen
    assert broken.run.steps[-2].place.file == "<tree>"
    assert report.run(broken.name) == broken.run
    assert report.run("nothing") is None
    assert report.states > 10 and report.node_count == 10
    assert "1 of 2 rules not met" in repr(report)
    assert "CloseDoor -> failure" in str(broken.run)


def test_a_rule_is_told_by_its_finding_with_the_same_run():
    report = btcheck.check(SMALL, "never CloseDoor.failure")
    finding = next(of for of in report.findings if of.code == "BT2001")
    assert finding.run == report.verdicts[0].run


def test_findings_have_places_runs_and_repairs():
    report = btcheck.check(tree_of(
        "<ReactiveSequence><IsOpen/>\n<OpenDoor/>\n"
        "<Sequence><Go/></Sequence></ReactiveSequence>",
        '<TreeNodesModel><Condition ID="IsOpen"/></TreeNodesModel>'))
    finding = next(of for of in report.findings if of.code == "BT2211")
    assert (finding.place.line, finding.place.column) == (2, 2)
    assert str(finding).startswith("<tree>:2:2: warning [BT2211] ")
    assert "Help" not in finding.message and finding.help
    assert any(step.text == "OpenDoor -> success" for step in finding.run.steps)
    assert finding.repair[0].line == 2 and finding.repair[0].replacement
    # Diagnostics come first, and have no run of a finding behind them.
    assert report.findings[0].code == "BT1620" and report.findings[0].run is None
    with pytest.raises(dataclasses.FrozenInstanceError):
        finding.code = "BT0000"


def test_pages_of_runs():
    report = btcheck.check(SMALL, "never CloseDoor.failure")
    page = report.html(report.verdicts[0].name)
    assert page.startswith("<!doctype html>") and "CloseDoor" in page
    assert report.html("nothing") == "" and report.html("") == ""
    shown = report._repr_html_()
    assert "<iframe" in shown and "srcdoc=" in shown
    assert "<!doctype" not in shown  # escaped
    answers = btcheck.check(SMALL)
    assert answers.run("can_succeed") and answers.html("can_succeed")
    assert {of.key for of in answers.answers} >= {"can_succeed", "never_stuck"}
    assert answers.nodes[0].ticked == "HOLDS"


def test_the_kinds_of_trees():
    alike = comparable(btcheck.check(SMALL).json())
    for tree in (SMALL.encode(), " \n" + SMALL):
        assert btcheck.check(tree).node_count == 10
    root = ElementTree.fromstring(SMALL)
    for tree in (root, ElementTree.ElementTree(root)):
        assert btcheck.check(tree).states == btcheck.check(SMALL).states
    assert btcheck.check("a.xml", files={"a.xml": SMALL}).node_count == 10
    assert alike["trees"][0]["nodes"] == 10
    btf = (SOURCES / "examples/drone3.btf")
    if btf.exists():
        assert btcheck.check(btf.read_text()).node_count == btcheck.check(btf).node_count


def test_a_tree_of_py_trees(monkeypatch):
    try:
        import py_trees
    except ImportError:
        pytest.skip("py_trees is not there")
    root = py_trees.composites.Selector(name="Root", memory=False)
    root.add_children([py_trees.behaviours.Success(name="Fine")])
    assert btcheck.check(root).ok


def test_rules_and_contracts_as_texts_and_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("r.ltl").write_text("property goes: never Go.failure\n")
    Path("c.leaves").write_text("(defaction Go :returns (success))\n")
    tree = tree_of("<Sequence><Go/></Sequence>")
    rules = Path("r.ltl").read_text() + "property more: never Go.running\n"
    for given in ("r.ltl", Path("r.ltl"), rules, rules.encode()):
        assert btcheck.check(tree, given).verdicts[0].name == "goes"
    Path("t.xml").write_text(tree)
    for of in (tree, "t.xml"):
        assert not btcheck.check(of, "r.ltl").ok
        for leaves in ("c.leaves", Path("c.leaves"), Path("c.leaves").read_text()):
            assert btcheck.check(of, "r.ltl", leaves=leaves).ok


def test_a_text_reads_no_file_that_nobody_names(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "b.xml").write_text(
        '<root BTCPP_format="4"><BehaviorTree ID="B"><Go/></BehaviorTree></root>')
    tree = tree_of('<SubTree ID="B"/>', '<include path="b.xml"/>')
    assert btcheck.check(tree).outcome is Outcome.BAD_INPUT
    assert btcheck.check(tree, files={"b.xml": (tmp_path / "b.xml").read_bytes()}).ok


def test_lint_describe_simulate_and_explain():
    assert btcheck.lint(NAV2).ok
    told = btcheck.describe(NAV2)
    assert len(told.nodes) > 20 and told.nodes[0].kind == "Tree"
    assert any(port.name == "number_of_retries" for of in told.nodes for port in of.ports)
    assert "Description" in repr(told)
    one, same, other = (btcheck.simulate(SMALL, seed=seed, ticks=20) for seed in (3, 3, 4))
    assert one.lines == same.lines != other.lines
    assert one.steps and one.statuses and one.ending == "ended"
    assert json.loads(one.itf())["states"] and one.html().startswith("<!doctype")
    assert btcheck.explain("BT2208").summary
    with pytest.raises(RequestError, match="no code `BT0000`"):
        btcheck.explain("BT0000")


def test_a_report_in_another_process():
    report = btcheck.check(SMALL, "never CloseDoor.failure")
    copy = pickle.loads(pickle.dumps(report))
    assert copy.json() == report.json() and copy.outcome is report.outcome
    assert copy.verdicts == report.verdicts
    assert copy.verdicts[0].run == report.verdicts[0].run


def program(*words):
    done = subprocess.run([os.environ["TESTED_PROGRAM"], *map(str, words), "--format",
                           "json"], capture_output=True, text=True, timeout=60)
    return comparable(done.stdout)


@pytest.mark.parametrize("name", [
    "examples/nav2/main/navigate_to_pose_w_replanning_and_recovery.xml",
    "examples/nav2/own/patrol.xml",
    "tests/regress/py_trees_refused/tree.xml",
])
def test_a_file_is_read_as_the_program_reads_it(name, monkeypatch):
    monkeypatch.chdir(SOURCES)
    assert comparable(btcheck.lint(name).json()) == program("lint", name)
    assert comparable(btcheck.lint(SOURCES / name).json()) == program(
        "lint", SOURCES / name)


def test_files_around_a_tree(tmp_path, monkeypatch):
    package = tmp_path / "src/robot"
    for folder in ("trees", "parts", "models"):
        (package / folder).mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>robot</name></package>")
    (package / "btcheck.toml").write_text('profile = "nav2-humble"\n')
    (package / "trees/main.xml").write_text(tree_of(
        '<Sequence><SubTree ID="Beside"/><SubTree ID="Around"/><SubTree ID="In"/>'
        "</Sequence>", '<include ros_pkg="robot" path="models/in.xml"/>'))
    for name, tree in (("trees/beside.xml", "Beside"), ("parts/around.xml", "Around"),
                       ("models/in.xml", "In")):
        (package / name).write_text(
            '<root BTCPP_format="4"><BehaviorTree ID="%s"><%sLeaf/></BehaviorTree></root>'
            % (tree, tree))
    monkeypatch.chdir(package / "trees")
    for tree in ("main.xml", str(package / "trees/main.xml")):
        report = btcheck.check(tree)
        assert report.profile == "nav2-humble"
        assert comparable(report.json()) == program(tree)
        assert btcheck.check(tree, settings=False).profile != "nav2-humble"
    # Without them the tree is not whole.
    assert btcheck.check((package / "trees/main.xml").read_text()).outcome == 2


def test_a_stranger_tree_reads_in_its_repository_alone(tmp_path):
    (tmp_path / "repository/.git").mkdir(parents=True)
    (tmp_path / "secret.xml").write_text(
        '<root BTCPP_format="4"><BehaviorTree ID="Secret"><Told/></BehaviorTree></root>')
    tree = tmp_path / "repository/tree.xml"
    tree.write_text(tree_of('<SubTree ID="Secret"/>', '<include path="../secret.xml"/>'))
    report = btcheck.check(tree)
    assert report.outcome is Outcome.BAD_INPUT and "Told" not in report.json()
    (tmp_path / "repository/.git").rmdir()
    assert btcheck.check(tree).node_count > 2


BAD = [
    (lambda: btcheck.check("x\0.xml"), "has a zero character"),
    (lambda: btcheck.check(SMALL, "never a\0b"), "has a zero character"),
    (lambda: btcheck.check("<a>\ud800</a>"), "lone surrogate.*at character 4"),
    (lambda: btcheck.check("\ud800.xml"), "no name of a file"),
    (lambda: btcheck.check(""), "no name of a file"),
    (lambda: btcheck.check(3), "neither a text nor"),
    (lambda: btcheck.check(SMALL, 3), "neither a text nor"),
    (lambda: btcheck.check("/"), "is a directory; name a file in it"),
    (lambda: btcheck.check("/dev/null"), "is a pipe or a device"),
    (lambda: btcheck.check(SMALL, profile="nav3"), "there is no profile `nav3`"),
    (lambda: btcheck.check(SMALL, threads=0), "`0` does not fit `threads`"),
    (lambda: btcheck.check(SMALL, timeout=float("nan")), "does not fit `seconds`"),
    (lambda: btcheck.check(SMALL, memory="4X"), "`4X` is no size"),
    (lambda: btcheck.check(NAV2, settings="gone.toml"), "no settings `gone.toml`"),
    (lambda: btcheck.simulate(SMALL, seed=-1), "`-1` does not fit `seed`"),
]


@pytest.mark.parametrize("call,said", BAD, ids=[said for _, said in BAD])
def test_what_cannot_be_meant(call, said):
    with pytest.raises(RequestError, match=said) as told:
        call()
    assert isinstance(told.value, ValueError) and "\n" not in str(told.value)


@pytest.mark.parametrize("tree", [
    "<a\0/>", b"\xff\xfe<\x00", "<root><open>", "/gone.xml", "<" + "a" * (1 << 20)])
def test_mistakes_in_trees_are_findings(tree):
    report = btcheck.check(tree)
    assert report.outcome is Outcome.BAD_INPUT
    assert report.findings[0].level == "error" and report.findings[0].message


def python(code, **environment):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                          env={**os.environ, **environment}, timeout=60)


def test_a_library_that_does_not_fit_is_told_in_a_sentence(tmp_path):
    code = ("import btcheck\ntry: btcheck.check('<a/>')\n"
            "except btcheck.LibraryError as error: print(error)")
    assert "there is no library" in python(code, BTCHECK_LIBRARY="/gone.so").stdout
    wrong = tmp_path / "wrong.so"
    wrong.write_text("no library")
    assert "cannot be loaded" in python(code, BTCHECK_LIBRARY=str(wrong)).stdout
    old = "import btcheck._library\nbtcheck._library.VERSION = '0.0.9'\n" + code
    assert "and the package is 0.0.9" in python(old).stdout
    glibc = ("import btcheck._library as l\n"
             "print(l._reason('/', OSError(\"x: version `GLIBC_2.99' not found\")))")
    assert "btcheck needs glibc 2.99 or later, and this system has" in python(glibc).stdout


def test_the_program_is_carried():
    done = subprocess.run([sys.executable, "-m", "btcheck", "--version"],
                          capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and btcheck.__version__ in done.stdout
    # A variable that names the script itself does not go round and round.
    again = subprocess.run([os.environ["TESTED_PROGRAM"], "--version"],
                           capture_output=True, text=True, timeout=60,
                           env={**os.environ,
                                "BTCHECK_PROGRAM": os.environ["TESTED_PROGRAM"]})
    assert btcheck.__version__ in again.stdout
    gone = subprocess.run([sys.executable, "-m", "btcheck"], capture_output=True,
                          text=True, timeout=60,
                          env={**os.environ, "BTCHECK_PROGRAM": "/gone"})
    assert gone.returncode == 2 and "cannot start /gone" in gone.stderr
    assert "Traceback" not in gone.stderr
