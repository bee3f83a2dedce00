# SPDX-License-Identifier: MIT
"""`btcheck diff --git`: a tree beside what it was, with all that it needs from
then; the working copy and its index stay as they are.

    python3 revision_test.py BTCHECK
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
OTHERS = {name: value for name, value in os.environ.items()
          if not name.startswith("GIT_")}
PLACE = {**OTHERS, "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}


def tree(body, name="T", more=""):
    return (f'<root BTCPP_format="4">{more}<BehaviorTree ID="{name}">{body}'
            "</BehaviorTree></root>\n")


OLD = tree('<Sequence><Condition ID="Ready"/><SubTree ID="Part"/></Sequence>',
           more='<include path="parts/part.xml"/>')
PART = tree('<Sequence><Action ID="Go"/><Action ID="Look"/></Sequence>', "Part")
TURNED = tree('<Sequence><Action ID="Look"/><Action ID="Go"/></Sequence>', "Part")


@unittest.skipIf(shutil.which("git") is None, "no git")
class Revisions(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="btcheck-git-"))
        self.addCleanup(shutil.rmtree, self.folder, True)
        self.temporary = self.folder / "temporary"
        self.temporary.mkdir()
        self.project = self.folder / "a project"
        (self.project / "trees/parts").mkdir(parents=True)
        self.tree = self.project / "trees/main.xml"
        self.part = self.project / "trees/parts/part.xml"
        self.tree.write_text(OLD)
        self.part.write_text(PART)
        (self.project / "btcheck.toml").write_text('profile = "btcpp-4.10"\n')
        self.git("init", "-q")
        self.git("add", ".")
        self.git("-c", "user.name=t", "-c", "user.email=t@example.org", "commit",
                 "-q", "-m", "first")

    def git(self, *words):
        return subprocess.run(["git", *words], cwd=self.project, env=PLACE, check=True,
                              capture_output=True, text=True).stdout

    def diff(self, code, *words, cwd=None):
        before = self.git("status", "--porcelain"), self.git("ls-files", "-s")
        ran = subprocess.run(
            [PROGRAM, "diff", "-q", *words], cwd=cwd or self.project,
            env={**PLACE, "TMPDIR": str(self.temporary)}, capture_output=True,
            text=True, timeout=60)
        self.assertEqual(ran.returncode, code, ran.stdout + ran.stderr)
        self.assertEqual(
            (self.git("status", "--porcelain"), self.git("ls-files", "-s")), before)
        self.assertEqual(list(self.temporary.iterdir()), [])
        return ran.stdout + ran.stderr

    def test_nothing_has_changed(self):
        told = self.diff(0, "--git", "HEAD", "trees/main.xml")
        self.assertIn("HEAD:trees/main.xml beside trees/main.xml", told)
        self.assertIn("equivalent", told)

    def test_what_it_includes_is_that_of_then(self):
        self.part.write_text(TURNED)
        told = self.diff(1, "--git", "HEAD", "trees/main.xml")
        self.assertIn("`Go` is ticked", told)
        self.assertIn("`Look` is ticked", told)
        # From a folder of the project as well, and by a name of its own.
        for cwd, name in ((self.tree.parent, "main.xml"),
                          (self.folder, str(self.tree))):
            self.assertIn("different", self.diff(1, "--git", "HEAD", name, cwd=cwd))

    def test_what_is_staged_stays_so(self):
        self.part.write_text(TURNED)
        self.git("add", ".")
        self.part.write_text(PART)
        self.diff(0, "--git", "HEAD", "trees/main.xml")

    def test_a_folder(self):
        (self.tree.parent / "other.xml").write_text(tree('<Action ID="New"/>', "O"))
        told = self.diff(1, "--git", "HEAD", "trees")
        self.assertIn("other.xml: in trees only", told)
        self.assertIn("equivalent", told)

    def test_settings_of_then(self):
        settings = self.project / "btcheck.toml"
        settings.write_text('profil = "nav2-main"\n')
        self.git("-c", "user.name=t", "-c", "user.email=t@example.org", "commit",
                 "-qam", "broken")
        settings.write_text('profile = "btcpp-4.10"\n')
        told = self.diff(2, "--git", "HEAD", "trees/main.xml")
        self.assertIn("unknown key `profil`", told)
        self.assertIn("--> HEAD:btcheck.toml:1:1", told)
        self.diff(0, "--git", "HEAD~1", "trees/main.xml")

    def test_what_is_not_there(self):
        new = self.project / "new.xml"
        new.write_text(OLD)
        self.assertIn("revision `HEAD` has it not",
                      self.diff(2, "--git", "HEAD", "new.xml"))
        self.assertIn("git knows no revision `nowhere`",
                      self.diff(2, "--git", "nowhere", "trees/main.xml"))
        outside = self.folder / "outside.xml"
        outside.write_text(PART)
        self.assertIn("in no repository", self.diff(2, "--git", "HEAD", str(outside)))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
