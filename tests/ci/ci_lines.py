#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
#
# The lines of docs/ci.md.
#   ci_lines.py BTCHECK SOURCES    runs those that need no more than the program,
#                                  in a folder with trees, and looks at what they
#                                  leave; the others have to name what there is
#   ci_lines.py --job SOURCES      prints what the job runs, in its order, for a
#                                  machine that may be built on and installed to
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import yaml
except ImportError:
    sys.exit("python3-yaml is missing: script/setup installs it")

program, sources = sys.argv[1:]
sources = Path(sources).resolve()
page = (sources / "docs/ci.md").read_text()
blocks = re.findall(r"^```(yaml|sh)\n(.*?)^```$", page, re.S | re.M)
documents = [yaml.safe_load(text) for kind, text in blocks if kind == "yaml"]
shell = [text for kind, text in blocks if kind == "sh"]
job = next(each for each in documents if "jobs" in each)["jobs"]["check"]
matrix = next(each for each in documents if "strategy" in each)
hook = next(each for each in documents if "repos" in each)["repos"][0]["hooks"][0]
git_hook = next(text for text in shell if text.startswith("#!"))
job_lines = [step["run"] for step in job["steps"] if "run" in step]

if program == "--job":
    print("set -e")
    print("\n".join(job_lines))
    sys.exit(0)


def fail(text):
    sys.exit(f"docs/ci.md: {text}")


# What stands there names something that exists.
def check_names():
    ids = {step["id"] for step in job["steps"] if "id" in step}
    for action in re.findall(r"uses: (\S+)", page):
        if not re.fullmatch(r"[a-z-]+(/[a-z-]+)+@v\d+", action):
            fail(f"`{action}` is no action with a version")
    for expression in re.findall(r"\$\{\{(.*?)\}\}", page):
        for path in re.findall(r"'btcheck/(.*?)'", expression):
            if not list(sources.glob(path)):
                fail(f"hashFiles is asked of `{path}`, which there is not")
        known = r"github\.run_id|matrix\.part|hashFiles\(('[^']*'(, )?)+\)"
        if not re.fullmatch(known, expression.strip()):
            fail(f"what is `{expression.strip()}`?")
    for step in job["steps"]:
        for name in re.findall(r"steps\.(\w+)\.", step.get("if", "")):
            if name not in ids:
                fail(f"no step is called `{name}`")
    for line in job_lines:
        for script in re.findall(r"btcheck/(script/\w+)", line):
            if not os.access(sources / script, os.X_OK):
                fail(f"there is no `{script}`")


def run(line, folder, code=0):
    environment = {**os.environ, "PATH": f"{Path(program).parent}:{os.environ['PATH']}",
                   "GITHUB_STEP_SUMMARY": str(folder / "summary.md")}
    done = subprocess.run(["bash", "-e", "-c", line], cwd=folder, env=environment,
                          capture_output=True, text=True, timeout=300)
    if (done.returncode == 0) != (code == 0):
        fail(f"exit code {done.returncode} of\n{line}\n{done.stdout}{done.stderr}")
    return done.stdout


def look_for(folder, *names):
    for name in names:
        file = folder / name
        if not file.exists() or (file.is_dir() and not list(file.iterdir())):
            fail(f"nothing wrote `{name}`")


def fill(folder):
    (folder / "trees").mkdir()
    for name in ("drone3.btf", "drone3.ltl", "recovery.btf", "recovery.ltl"):
        shutil.copy(sources / "examples" / name, folder / "trees")
    (folder / "trees/.btcheck-results").write_text("of a stranger")


def run_job(folder):
    ours = [line for line in job_lines if "apt-get" not in line and "script/" not in line]
    if len(ours) != 2:
        fail("the job has other lines than before: which of them need no installation?")
    run(ours[0], folder)
    for _ in range(2):  # and again, with the results of the first time
        if "::" not in run(ours[1], folder):
            fail("no annotation")
    kept = next(step for step in job["steps"] if "cache/save" in step.get("uses", ""))
    uploaded = next(step for step in job["steps"] if "artifact" in step.get("uses", ""))
    sarif = next(step for step in job["steps"] if "upload-sarif" in step.get("uses", ""))
    look_for(folder, kept["with"]["path"], sarif["with"]["sarif_file"], "summary.md",
             *uploaded["with"]["path"].split())


def run_matrix(folder):
    line = next(step["run"] for step in matrix["steps"] if "run" in step)
    for part in matrix["strategy"]["matrix"]["part"]:
        run(line.replace("${{ matrix.part }}", str(part)), folder)


def run_hooks(folder):
    for name in ("a.btf", "a.xml", "a.btproj", "a.ltl", "a.btp", "a.leaves", "batch.toml",
                 "btcheck.toml"):
        if not re.search(hook["files"], name):
            fail(f"the hook passes over {name}")
    run(hook["entry"], folder)
    git = "git -c user.name=t -c user.email=t@localhost "
    run(f"git init -q && {git}commit -q --allow-empty -m nothing", folder)
    run(git_hook, folder)  # nothing of interest is staged
    broken = folder / "trees/broken.btf"
    broken.write_text("(BehaviorTree :name b (Sequence")
    run(git_hook, folder)
    run("git add trees/broken.btf", folder)
    run(git_hook, folder, code=2)
    run(hook["entry"], folder, code=2)
    broken.unlink()
    run("git add -A", folder)
    run(git_hook, folder)


check_names()
with tempfile.TemporaryDirectory() as name:
    project = Path(name)
    fill(project)
    run_job(project)
    run_matrix(project)
    for text in shell:
        if text != git_hook:
            run(text, project)
    look_for(project, "btcheck.xml")
    run_hooks(project)
print(f"{len(job_lines)} steps of the job, {len(shell)} other lines and a hook")
