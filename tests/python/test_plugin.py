# SPDX-License-Identifier: MIT
"""pytest --btcheck, by pytest."""

import pytest
from trees import ENDLESS, SOURCES, tree_of

PATROL = tree_of("<Fallback><Sequence><Go/><Dock/></Sequence><Call/></Fallback>")
WARNED = tree_of(
    "<ReactiveSequence><IsOpen/>\n<OpenDoor/>\n<Sequence><Go/></Sequence>"
    "</ReactiveSequence>",
    '<TreeNodesModel><Condition ID="IsOpen"/></TreeNodesModel>')


@pytest.fixture
def run(pytester, request):
    # A wheel says of itself that it has a plugin.
    is_installed = request.config.pluginmanager.has_plugin("btcheck")
    plugin = () if is_installed else ("-p", "btcheck.pytest_plugin")

    def with_files(*words, **files):
        for name, text in files.items():
            name = name.replace("__", ".")
            pytester.path.joinpath(name).write_text(text)
        return pytester.runpytest_inprocess("-p", "no:cacheprovider", *plugin, "-v",
                                            *words)

    return with_files


def test_each_rule_is_an_item(run):
    result = run("--btcheck", ".", patrol__xml=PATROL, package__xml="<package/>",
                 patrol__ltl="property docks: never Dock.failure\n"
                             "property calls: never Call.skipped\n")
    result.stdout.fnmatch_lines([
        "*patrol.xml::tree PASSED*", "*patrol.xml::docks FAILED*",
        "*patrol.xml::calls PASSED*", "*patrol.ltl:1:10: docks violated*",
        "The run:", "*Dock -> failure*"])
    assert result.ret == 1
    assert "Traceback" not in result.stdout.str()
    assert "package.xml" not in result.stdout.str()


def test_findings_fail_by_their_level(run):
    assert run("--btcheck", ".", warned__xml=WARNED).ret == 0
    result = run("--btcheck", "--btcheck-deny", "warnings", ".")
    assert result.ret == 1
    result.stdout.fnmatch_lines(["*warned.xml::BT2211 OpenDoor FAILED*",
                                 "*warning *BT2211*", "*OpenDoor -> success*"])
    result.stdout.fnmatch_lines(["*warned.xml::BT1620 PASSED*"])
    result = run("--btcheck", "--btcheck-deny", "notes", ".")
    result.stdout.fnmatch_lines(["*warned.xml::BT1620 FAILED*"])


def test_questions_never_fail(run):
    tree = (SOURCES / "tests/findings/02-stale-guard-bug.xml").read_text()
    result = run("--btcheck", "--btcheck-deny", "notes", ".", asked__xml=tree)
    asked = [line for line in result.outlines if "::BT25" in line]
    assert asked and all("PASSED" in line for line in asked), result.stdout.str()


def test_undecided_fails_with_its_reason(run):
    result = run("--btcheck", "--btcheck-timeout", "0.3", ".", long__xml=ENDLESS,
                 long__ltl="property p: never a1.failure and b1.success\n")
    assert result.ret == 1
    result.stdout.fnmatch_lines(["*UNDECIDED: *long.ltl:1:10: p undecided*",
                                 "stopped by: timeout"])


def test_what_cannot_be_read_fails(run):
    result = run("--btcheck", ".", broken__xml="<root><BehaviorTree></root>")
    assert result.ret == 1
    result.stdout.fnmatch_lines(["*broken.xml::tree FAILED*", "*error *BT1600*"])


def test_without_the_option_nothing_is_checked(run):
    assert run(".", patrol__xml=PATROL).ret == 5  # no tests
