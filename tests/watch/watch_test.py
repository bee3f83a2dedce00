# SPDX-License-Identifier: MIT
"""`btcheck --watch` beside an editor: files are saved in all the ways in which
editors save them, and what is printed is read.

    python3 watch_test.py BTCHECK SOURCES
"""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True
from watched import Watched  # noqa: E402

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
SOURCES = pathlib.Path(sys.argv[2]).resolve()
NAV2 = (SOURCES / "examples/nav2/jazzy/"
        "navigate_to_pose_w_replanning_and_recovery.xml")

# A condition that never interrupts: BT2209; and one that does.
BAD = NAV2.read_text()
GOOD = BAD.replace("<GoalUpdated/>", "<GlobalUpdatedGoal/>")
GONE = ("gone:\n  warning[BT2209] line 36: `GoalUpdated` never interrupts "
        "`RecoveryActions`\n")
NEW = ("new:\nwarning[BT2209]: `GoalUpdated` never interrupts "
       "`RecoveryActions`\n")


def tree(body, name="T", more=""):
    return (f'<root BTCPP_format="4"><BehaviorTree ID="{name}">{body}'
            f"</BehaviorTree>{more}</root>\n")


def large(width=18):
    """More states than are searched while a test lasts."""
    return tree("<ParallelAll>" +
                "".join(f'<Act name="a{i}"/>' for i in range(width)) +
                "</ParallelAll>", "L")


PLAIN = tree("<Sequence><Act/><Move/></Sequence>")


class Watch(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="btcheck-watch-"))
        self.addCleanup(shutil.rmtree, self.folder, True)
        self.trees = self.folder / "trees"
        self.trees.mkdir()
        self.nav = self.trees / "nav.xml"
        self.nav.write_text(BAD)

    def watched(self, *words, **more):
        watched = Watched(PROGRAM, *words, cwd=self.folder, **more)
        self.addCleanup(watched.close)
        return watched

    def beside(self, name, text):
        file = self.trees / name
        file.parent.mkdir(exist_ok=True)
        file.write_text(text)
        return file

    # --- The ways of saving ------------------------------------------------

    def test_written_in_place(self):
        self.beside("other.xml", PLAIN)
        watched = self.watched("trees")
        self.assertIn("NO FAULT   no rules       22,485", watched.first)
        self.assertIn("2 entries: 2 without a fault; 1 warning", watched.first)
        self.nav.write_text(GOOD)
        text = watched.until(r"\n2 entries: ")
        self.assertRegex(text, r"^\n-- \d\d:\d\d:\d\d  trees/nav\.xml -+\n"
                               "NO FAULT  trees/nav.xml: no rules, ")
        self.assertIn(GONE, text)
        self.assertIn("as before:\nnote[BT2208]: on Nav2 main", text)
        self.assertIn("2 entries: 2 without a fault; ", text)
        self.assertNotIn("BT2209]:", text)
        self.assertNotIn("other.xml", text)
        self.nav.write_text(BAD)
        text = watched.until(r"\n2 entries: ")
        self.assertIn(NEW, text)
        self.assertIn("   --> trees/nav.xml:36:12\n", text)
        self.assertIn("tick 2   GoalUpdated -> failure", text)  # its run

    def test_written_piece_by_piece(self):
        watched = self.watched("trees/nav.xml")
        with self.nav.open("w") as file:
            for at in range(0, len(GOOD), 500):
                file.write(GOOD[at:at + 500])
                file.flush()
                time.sleep(0.04)
        text = watched.until("gone:")
        self.assertIn(GONE, text)
        self.assertNotIn("BROKEN", text)
        self.assertEqual(text.count("\n-- "), 1, text)

    def test_renamed_over(self):
        watched = self.watched("trees")
        for text, wanted in ((GOOD, GONE), (BAD, NEW), (GOOD, GONE)):
            beside = self.trees / ".nav.xml.tmp"
            beside.write_text(text)
            beside.rename(self.nav)
            self.assertIn(wanted, watched.until("BT2209"))

    def test_as_vim_does(self):
        """A probe, a copy of what was, the text under its name, the copy
        away; and the file of what is typed beside it."""
        watched = self.watched("trees")
        for text, wanted in ((GOOD, GONE), (BAD, NEW)):
            (self.trees / ".nav.xml.swp").write_text("b0VIM")
            (self.trees / "4913").write_text("")
            (self.trees / "4913").unlink()
            self.nav.rename(self.trees / "nav.xml~")
            self.nav.write_text(text)
            (self.trees / "nav.xml~").unlink()
            (self.trees / ".nav.xml.swp").unlink()
            told = watched.until("BT2209")
            self.assertIn(wanted, told)
            self.assertEqual(told.count("\n-- "), 1, told)

    def test_deleted_and_made_again(self):
        watched = self.watched("trees/nav.xml")
        self.nav.unlink()
        text = watched.until("BROKEN")
        self.assertIn("trees/nav.xml (gone) --", text)
        self.assertIn("BROKEN  trees/nav.xml\n", text)
        self.assertIn("error[BT0002]: cannot find `trees/nav.xml`", text)
        self.nav.write_text(GOOD)
        text = watched.until("NO FAULT")
        self.assertIn("gone:\n  error[BT0002]: cannot find `trees/nav.xml`",
                      text)
        self.assertIn("new:\nnote[BT2208]", text)

    def test_a_burst_is_one_save(self):
        self.beside("a.xml", PLAIN)
        self.beside("b.xml", PLAIN)
        watched = self.watched("trees")
        for i in range(5):
            for name in ("a", "b", "nav"):
                self.beside(f"{name}.xml", PLAIN if name != "nav" else GOOD)
        text = watched.until(r"\n3 entries: ")
        self.assertRegex(
            text, "^\n-- .*  trees/a.xml, trees/b.xml, trees/nav.xml -+\n")
        self.assertEqual(text.count("\n-- "), 1, text)

    def test_what_editors_leave_is_no_change(self):
        watched = self.watched("trees")
        for name in ("nav.xml~", ".nav.xml.swp", "#nav.xml#", "4913", ".#nav",
                     "notes.txt", "nav.xml.bak"):
            self.beside(name, BAD)
        self.assertEqual(watched.silence(), "")
        self.nav.write_text(GOOD)
        self.assertIn(GONE, watched.until("gone:"))

    def test_saved_without_a_change(self):
        watched = self.watched("trees")
        self.nav.write_text(BAD)
        text = watched.until("as before")
        self.assertIn("as before:\nwarning[BT2209]", text)
        self.assertNotIn("new:", text)
        self.assertNotIn("gone:", text)

    # --- Folders -----------------------------------------------------------

    def test_new_file_in_a_new_folder(self):
        watched = self.watched("trees")
        self.beside("docking/dock.xml", BAD)
        text = watched.until(r"\n2 entries: ")
        self.assertIn("NO FAULT  trees/docking/dock.xml: no rules", text)
        self.assertIn("   --> trees/docking/dock.xml:36:12\n", text)
        self.beside("docking/dock.xml", GOOD)
        self.assertIn(GONE, watched.until("gone:"))

    def test_folder_moved_in_and_out(self):
        watched = self.watched("trees")
        (self.folder / "ready").mkdir()
        (self.folder / "ready/more.xml").write_text(PLAIN)
        (self.folder / "ready").rename(self.trees / "ready")
        self.assertIn("trees/ready/more.xml: no rules",
                      watched.until(r"\n2 entries: "))
        (self.trees / "ready").rename(self.folder / "away")
        self.assertIn("no longer checked: trees/ready/more.xml\n",
                      watched.until("no longer"))
        (self.folder / "away/more.xml").write_text(BAD)
        self.assertEqual(watched.silence(), "")

    def test_the_folder_itself_is_replaced(self):
        watched = self.watched("trees")
        self.trees.rename(self.folder / "old")
        text = watched.until("(gone)")
        self.assertIn("no longer checked: trees/nav.xml\n", text)
        self.trees.mkdir()
        self.nav.write_text(GOOD)
        self.assertIn("NO FAULT  trees/nav.xml", watched.until("NO FAULT"))
        (self.folder / "old/nav.xml").write_text(GOOD)
        self.assertEqual(watched.silence(), "")

    def test_links(self):
        """A file that is a link, a folder that is one, and what they lead
        to."""
        (self.folder / "real").mkdir()
        (self.folder / "real/nav.xml").write_text(BAD)
        (self.folder / "real2").mkdir()
        (self.folder / "real2/nav.xml").write_text(GOOD)
        self.nav.unlink()
        self.nav.symlink_to("../real/nav.xml")
        watched = self.watched("trees", "--root", ".")
        (self.folder / "real/nav.xml").write_text(GOOD)
        self.assertIn(GONE, watched.until("gone:"))
        (self.folder / "real/nav.xml").write_text(BAD)
        self.assertIn(NEW, watched.until("new:"))
        self.nav.unlink()
        self.nav.symlink_to("../real2/nav.xml")
        self.assertIn(GONE, watched.until("gone:"))
        (self.folder / "now").symlink_to("real")
        watched = self.watched("now")
        self.assertIn("BT2209", watched.first)
        (self.folder / "real/nav.xml").write_text(GOOD)
        self.assertIn(GONE, watched.until("gone:"))

    @unittest.skipIf(os.geteuid() == 0, "root reads everything")
    def test_a_folder_that_cannot_be_read(self):
        self.beside("shut/other.xml", PLAIN)
        (self.trees / "shut").chmod(0)
        self.addCleanup((self.trees / "shut").chmod, 0o755)
        watched = self.watched("trees")
        self.assertIn("cannot read the folder `trees/shut`: Permission denied",
                      watched.first)
        self.nav.write_text(GOOD)
        self.assertIn(GONE, watched.until("gone:"))
        (self.trees / "shut").chmod(0o755)
        self.assertIn("trees/shut/other.xml: no rules",
                      watched.until("other.xml"))

    def test_too_many_folders(self):
        """The limit of watches, in a namespace of its own."""
        limited = ["unshare", "-r", "sh", "-c",
                   'echo 4 >/proc/sys/user/max_inotify_watches && exec "$@"',
                   "sh"]
        if subprocess.run([*limited, "true"], capture_output=True,
                          check=False).returncode != 0:
            self.skipTest("no namespaces")
        for i in range(12):
            self.beside(f"f{i:02}/t.xml", PLAIN)
        watched = self.watched("trees", before=limited)
        self.assertRegex(
            watched.first,
            r"warning\[BT1514\]: `.*` cannot be watched: more than "
            r"fs.inotify.max_user_watches, \d+, are in use; nor \d+ more "
            "folders\n")
        self.assertIn("13 entries", watched.first)
        self.nav.write_text(GOOD)
        self.beside("f11/t.xml", BAD)

    def test_lost_events(self):
        """More happens at once than the queue of the kernel holds."""
        with open("/proc/sys/fs/inotify/max_queued_events",
                  encoding="ascii") as file:
            most = int(file.read())
        if most > 100_000:
            self.skipTest("a long queue")
        other = self.beside("other.xml", PLAIN)
        watched = self.watched("trees")
        watched.process.send_signal(signal.SIGSTOP)
        for _ in range(most // 2 + 10):
            os.utime(self.nav)
            os.utime(other)
        self.nav.write_text(GOOD)
        self.beside("last/last.xml", PLAIN)
        watched.process.send_signal(signal.SIGCONT)
        text = watched.until(r"\n3 entries: ")
        self.assertIn(GONE, text)
        self.assertIn("trees/last/last.xml: no rules", text)
        self.beside("last/last.xml", BAD)
        self.assertIn(NEW, watched.until("BT2209"))

    # --- What a tree depends on --------------------------------------------

    def test_included_file(self):
        inner = self.folder / "shared/inner.xml"
        inner.parent.mkdir()
        inner.write_text(tree("<Act/>", "In"))
        for name in ("one", "two"):
            self.beside(f"{name}.xml", '<root BTCPP_format="4" '
                        'main_tree_to_execute="T">'
                        '<include path="../shared/inner.xml"/>'
                        '<BehaviorTree ID="T"><Sequence><Fallback>'
                        '<SubTree ID="In"/><Other/></Fallback><Act/>'
                        "</Sequence></BehaviorTree></root>")
        watched = self.watched("trees", "--root", ".")
        self.assertNotIn("BT2202", watched.first)
        inner.write_text(tree("<AlwaysSuccess/>", "In"))
        text = watched.until(r"\n3 entries: ")
        self.assertRegex(text, "^\n-- .*  shared/inner.xml -+\n")
        self.assertRegex(text, r"trees/one.xml: no rules.*\n\n?new:\n"
                               r"(.|\n)*trees/two.xml: no rules")
        self.assertIn("`Other` is never ticked", text)
        self.assertNotIn("nav.xml", text)
        inner.unlink()
        text = watched.until(r"\n3 entries: ")
        self.assertIn("shared/inner.xml (gone)", text)
        self.assertIn("BROKEN  trees/one.xml\n", text)
        self.assertIn("BROKEN  trees/two.xml\n", text)
        inner.write_text(tree("<Act/>", "In"))
        text = watched.until(r"\n3 entries: ")
        self.assertIn("NO FAULT  trees/one.xml", text)
        self.assertIn("3 entries: 3 without a fault", text)

    def test_rules(self):
        self.beside("rules.ltl", 'tree "plain.xml"\n'
                                 "property can: possible root.success\n")
        self.beside("plain.xml", PLAIN)
        watched = self.watched("trees/rules.ltl")
        self.assertIn("MET  trees/rules.ltl: 1 of 1 rule met", watched.first)
        self.beside("rules.ltl", 'tree "plain.xml"\n'
                                 "property can: possible root.success\n"
                                 "property no: never Act.success\n")
        text = watched.until("VIOLATED")
        self.assertIn("MISSED  trees/rules.ltl: 1 of 2 rules met", text)
        self.assertIn("new:\nVIOLATED   no", text)
        self.assertIn("Act -> success", text)
        self.beside("plain.xml", tree("<Sequence><AlwaysFailure/><Act/>"
                                      "</Sequence>"))
        text = watched.until("gone:")
        self.assertIn("plain.xml --", text)
        self.assertIn("error[BT2001]", text)
        self.assertIn("VIOLATED   can", text)
        self.assertEqual(watched.end()[0], 1)

    def test_typed_rules_and_a_file_of_rules(self):
        (self.folder / "own.ltl").write_text("property p: possible "
                                             "root.success\n")
        watched = self.watched("trees/nav.xml", "--prop", "own.ltl",
                               "-e", "never root.failure and root.success")
        self.assertIn("MET  trees/nav.xml: 2 of 2 rules met", watched.first)
        (self.folder / "own.ltl").write_text("property p: never "
                                             "root.success\n")
        text = watched.until("VIOLATED")
        self.assertIn("1 of 2 rules met", text)
        self.assertRegex(text, "own.ltl -+\n")

    def test_settings(self):
        watched = self.watched("trees")
        (self.trees / "btcheck.toml").write_text('[levels]\n'
                                                 'BT2209 = "error"\n')
        text = watched.until("FAULT")
        self.assertIn("trees/btcheck.toml --", text)
        self.assertIn("FAULT  trees/nav.xml", text)
        self.assertIn("new:\nerror[BT2209]", text)
        (self.trees / "btcheck.toml").write_text("[levels]\nBT2209 = 7\n")
        text = watched.until("BROKEN")
        self.assertIn("--> trees/btcheck.toml:2:10\n", text)
        (self.trees / "btcheck.toml").unlink()
        self.assertIn("new:\nwarning[BT2209]", watched.until("NO FAULT"))
        # One above, which was not there.
        (self.folder / "btcheck.toml").write_text('[levels]\n'
                                                  'BT2209 = "allow"\n')
        self.assertIn(GONE, watched.until("gone:"))

    def test_models_and_contracts(self):
        self.beside("plain.xml", PLAIN)
        leaves = self.folder / "robot.leaves"
        leaves.write_text("(defaction Act :returns (success failure))\n")
        watched = self.watched("trees/plain.xml", "--leaves", "robot.leaves")
        leaves.write_text("(defaction Act :returns (failure))\n")
        text = watched.until("new:")
        self.assertIn("robot.leaves --", text)
        self.assertIn("BT21", text)
        leaves.write_text("(defaction Act :returns")
        self.assertIn("--> robot.leaves:1:", watched.until("BROKEN"))

    def test_baseline(self):
        subprocess.run([PROGRAM, "trees", "-q", "--write-baseline",
                        "base.json"], cwd=self.folder, check=True,
                       capture_output=True)
        watched = self.watched("trees", "--baseline", "base.json")
        self.assertNotIn("BT2209", watched.first)
        base = self.folder / "base.json"
        kept = base.read_text()
        base.write_text(re.sub(r'\n\{"code":"BT2209".*', "", kept))
        self.assertIn(NEW, watched.until("BT2209"))
        base.write_text("{")
        self.assertIn("error[BT1511]", watched.until("BT1511"))
        self.assertEqual(watched.end()[0], 2)

    def test_manifest(self):
        self.beside("batch.toml", '[[entry]]\ntree = "nav.xml"\n')
        self.beside("other.xml", PLAIN)
        watched = self.watched("trees")
        self.beside("batch.toml", '[[entry]]\ntree = "nav.xml"\n'
                                  '[[entry]]\ntree = "other.xml"\n')
        self.assertIn("trees/other.xml: no rules", watched.until(r"\n2 entries: "))

    # --- Broken, and mended ------------------------------------------------

    def test_broken_and_mended(self):
        watched = self.watched("trees")
        self.nav.write_text(BAD.replace("</root>", ""))
        text = watched.until("BROKEN")
        self.assertIn("BROKEN  trees/nav.xml\n", text)
        self.assertIn("new:\nerror[", text)
        self.assertRegex(text, r"--> trees/nav.xml:\d+:\d+\n")
        self.nav.write_text(GOOD)
        text = watched.until("NO FAULT")
        self.assertIn("gone:\n  error[", text)
        self.assertIn("new:\nnote[BT2208]", text)
        self.assertEqual(watched.end()[0], 0)

    # --- While a check runs ------------------------------------------------

    def test_a_save_cancels_what_runs(self):
        self.beside("large.xml", large())
        watched = self.watched("trees/large.xml", waits=False)
        time.sleep(1.5)
        begin = time.monotonic()
        self.beside("large.xml", PLAIN)
        text = watched.until("NO FAULT", quiet=0)
        self.assertLess(time.monotonic() - begin, 3)
        self.assertNotIn("UNDECIDED", text)
        self.assertEqual(watched.end()[0], 0)

    def test_what_was_saved_comes_first(self):
        self.beside("a_large.xml", large())
        watched = self.watched("trees", "--timeout", "4", "--jobs", "1")
        self.assertIn("UNDECIDED", watched.first)
        self.beside("a_large.xml", large(19))
        watched.until("a_large.xml -", quiet=0)
        time.sleep(0.3)
        # The other tree need not wait for it, and it is not forgotten.
        begin = time.monotonic()
        self.nav.write_text(GOOD)
        text = watched.until("gone:", quiet=0)
        self.assertLess(time.monotonic() - begin, 3.5)
        self.assertIn(GONE, text + watched.until(r"\n2 entries: "))

    # --- The end -----------------------------------------------------------

    def test_interrupts(self):
        for how in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            watched = self.watched("trees", "--deny", "warnings")
            code, seconds = watched.end(how)
            self.assertEqual(code, 1)
            self.assertLess(seconds, 1)
        self.beside("large.xml", large())
        watched = self.watched("trees", waits=False)
        time.sleep(1.5)
        code, seconds = watched.end()
        self.assertEqual(code, 3)
        self.assertLess(seconds, 3)

    def test_the_code_is_that_of_the_last_state(self):
        watched = self.watched("trees", "--deny", "BT2209")
        self.nav.write_text(GOOD)
        watched.until("gone:")
        self.assertEqual(watched.end()[0], 0)

    def test_waiting_costs_nothing(self):
        # Folders above are heard as well, and in that of temporary files
        # others are at work.
        quiet = tempfile.mkdtemp(prefix="quiet-", dir=os.path.dirname(PROGRAM))
        self.addCleanup(shutil.rmtree, quiet, True)
        self.folder = pathlib.Path(quiet)
        shutil.copytree(self.trees, self.folder / "trees")
        watched = self.watched("trees")

        def spent():
            with open(f"/proc/{watched.process.pid}/stat",
                      encoding="ascii") as file:
                fields = file.read().rsplit(")", 1)[1].split()
            with open(f"/proc/{watched.process.pid}/status",
                      encoding="ascii") as file:
                switches = [line for line in file if "ctxt_switches" in line]
            return fields[11:13], switches

        time.sleep(1)
        before = spent()
        time.sleep(2)
        self.assertEqual(spent(), before)

    # --- Options -----------------------------------------------------------

    def test_reports_for_programs(self):
        watched = self.watched("trees", "--format", "jsonl", "-q",
                               waits=False)
        first = watched.until('"end"')
        kinds = [json.loads(line)["event"] for line in first.splitlines()]
        self.assertEqual(kinds[0], "batch")
        self.assertEqual(kinds[-1], "end")
        self.nav.write_text(GOOD)
        lines = [json.loads(line)
                 for line in watched.until('"end"').splitlines()]
        self.assertEqual(lines[0]["event"], "batch")
        self.assertNotIn("BT2209", [line.get("code") for line in lines])
        watched = self.watched("trees", "--format", "json", "-q",
                               "--format", "sarif=found.sarif",
                               "--report", "found.html", waits=False)
        json.loads(watched.until("\n$"))
        sarif = self.folder / "found.sarif"
        self.assertNotIn("BT2209", [each["ruleId"] for each in json.loads(
            sarif.read_text())["runs"][0]["results"]])
        self.nav.write_text(BAD)
        codes = [each["code"] for each in json.loads(
            watched.until("\n$"))["trees"][0]["findings"]]
        self.assertIn("BT2209", codes)
        self.assertIn("BT2209", [each["ruleId"] for each in json.loads(
            sarif.read_text())["runs"][0]["results"]])
        self.assertIn("BT2209", (self.folder / "found.html").read_text())

    def test_runs_are_kept(self):
        watched = self.watched("trees/nav.xml", "--trace-dir", "trees/runs")
        page = self.trees / "runs/nav.BT2209-GoalUpdated.html"
        self.assertTrue(page.exists())
        page.unlink()
        self.nav.write_text(BAD + "<!-- -->\n")
        watched.until("as before")
        self.assertTrue(page.exists())
        self.assertEqual(watched.silence(), "")  # by what it writes itself

    def test_what_has_no_meaning_is_refused(self):
        for words in (["--against", "nav2-main"], ["--from", "run.itf.json"],
                      ["--write-baseline", "b.json"]):
            self.refused(f"--watch and {words[0]} do not go together",
                         "trees/nav.xml", *words)
        for words in (["--fail-fast"], ["--results", "d"], ["--join", "d"]):
            self.refused(f"--watch and {words[0]} do not go together",
                         "trees", *words)
        for name in ("sarif", "junit", "github", "gitlab"):
            self.refused(f"--watch and --format {name} on standard output",
                         "trees", "--format", name)
        self.refused("is no file that is saved again", "-")
        self.refused("cannot find `none.xml`", "none.xml")
        self.refused("no tree")

    def refused(self, why, *words):
        done = subprocess.run([PROGRAM, "--watch", *words], cwd=self.folder,
                              capture_output=True, text=True, check=False,
                              timeout=20, stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn(why, done.stderr)
        self.assertEqual(done.stdout, "")

    # --- How fast ----------------------------------------------------------

    def test_latency(self):
        """From the save of Nav2's default tree to its findings."""
        watched = self.watched("trees/nav.xml")
        seconds = []
        for i in range(20):
            text = GOOD if i % 2 == 0 else BAD
            begin = time.monotonic()
            self.nav.write_text(f"{text}<!-- {i} -->\n")
            watched.until("BT2209[^\0]*\n$", quiet=0)
            seconds.append(time.monotonic() - begin)
            watched.silence(0.3)
        seconds.sort()
        print(f"save to findings, {NAV2.name}: median "
              f"{seconds[10] * 1000:.0f} ms, {seconds[0] * 1000:.0f} to "
              f"{seconds[-1] * 1000:.0f} ms", file=sys.stderr)
        self.assertLess(seconds[10], 5)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
