#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
#
# The lines of docs/ci.md.
#   ci_lines.py BTCHECK SOURCES    runs those that need no more than the program,
#                                  in a folder with trees, and looks at what they
#                                  leave; the others have to name what there is
#   ci_lines.py --job SOURCES      prints what the job runs, for a machine with
#                                  nothing but bash: its action lies in
#                                  btcheck/action, and RUNNER_TEMP has the release
import os
import re
import shlex
import shutil
import subprocess
import sys
import tarfile
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
gitlab = next(each for each in documents if "behavior trees" in each)["behavior trees"]
hook_repository = next(each for each in documents if "repos" in each)["repos"][0]
git_hook = next(text for text in shell if text.startswith("#!"))
container = next(text for text in shell if "buildah" in text)
inputs = yaml.safe_load((sources / "action/action.yml").read_text())["inputs"]
version = re.search(r"^project\(btcheck VERSION ([\d.]+)",
                    (sources / "CMakeLists.txt").read_text(), re.M)[1]


def action_of(steps):
    """What the action is given in these steps."""
    return next(step for step in steps if step.get("uses", "").startswith("OWNER/"))["with"]


def script_of(given, part=""):
    """What the runner does of a step with the action, as lines of bash."""
    lines = ['set -eu', 'export GITHUB_ACTION_PATH="$PWD/btcheck/action" GITHUB_WORKSPACE="$PWD"',
             'export GITHUB_OUTPUT="$RUNNER_TEMP/output" GITHUB_STEP_SUMMARY="$RUNNER_TEMP/summary.md"',
             ': >"$GITHUB_OUTPUT"']
    for name, of in inputs.items():
        value = given.get(name, of["default"])
        value = str(value).lower() if isinstance(value, bool) else str(value)
        value = shlex.quote(value.replace("${{ matrix.part }}", part))
        value = value.replace("${{ runner.temp }}", "'\"$RUNNER_TEMP\"'")
        lines.append(f"export INPUT_{name.upper()}={value}")
    lines += ['"$GITHUB_ACTION_PATH/run" find',
              'export BTCHECK_PROGRAM=$(sed -n "s/^program=//p" "$GITHUB_OUTPUT")',
              'export BTCHECK_FOLDER=$(sed -n "s/^folder=//p" "$GITHUB_OUTPUT")',
              '"$GITHUB_ACTION_PATH/run" check']
    return "\n".join(lines)


if program == "--job":
    print(script_of(action_of(job["steps"])))
    sys.exit(0)
program = Path(program).resolve()


def fail(text):
    sys.exit(f"docs/ci.md: {text}")


# What stands there names something that exists.
def check_names():
    for action in re.findall(r"uses: (\S+)", page):
        if action.startswith("./btcheck/"):
            if not (sources / action.removeprefix("./btcheck/").rstrip("`.") / "action.yml").exists():
                fail(f"there is no `{action}`")
        elif not re.fullmatch(r"[a-z-]+/[a-z-]+@v\d+|OWNER/btcheck/action@v" + re.escape(version),
                              action):
            fail(f"`{action}` is no action with a version")
    for release in re.findall(r"\bv?(\d+\.\d+\.\d+)\b", page):
        if release != version:
            fail(f"{release} is not this version, {version}")
    for expression in re.findall(r"\$\{\{(.*?)\}\}", page):
        if not re.fullmatch(r"github\.token|runner\.temp|matrix\.part", expression.strip()):
            fail(f"what is `{expression.strip()}`?")
    for steps in (job["steps"], matrix["steps"]):
        for name in action_of(steps):
            if name not in inputs:
                fail(f"the action has no input `{name}`")
    table = dict(re.findall(r"^\| `(\w+)` \| (?:`(.*?)`)? ?\|", page, re.M))
    if table != {name: of["default"] for name, of in inputs.items()}:
        fail(f"the table of inputs is not that of action.yml: {table}")
    if set(re.findall(r'"(?:btcheck==)?(\d[\d.]*)"', (sources / "pyproject.toml").read_text())) != {
            version}:
        fail("pyproject.toml has another version")
    recipe = re.search(r"-f (\S+)", container)[1]
    if not (sources / recipe).exists():
        fail(f"there is no `{recipe}`")


def run(line, folder, code=0, **variables):
    environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}", **variables}
    done = subprocess.run(["bash", "-e", "-c", line], cwd=folder, env=environment,
                          capture_output=True, text=True, timeout=300)
    if done.returncode != code:
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
    (folder / "btcheck").symlink_to(sources)
    (folder / "temp").mkdir()
    with tarfile.open(folder / f"temp/btcheck-{version}-linux-x86_64.tar.xz", "w:xz", preset=0) as release:
        release.add(program, f"btcheck-{version}/bin/btcheck")


def run_job(folder):
    temp = folder / "temp"
    if "::" not in run(script_of(action_of(job["steps"])), folder, RUNNER_TEMP=str(temp)):
        fail("no annotation")
    look_for(temp, "summary.md", "btcheck/btcheck/btcheck.sarif", "btcheck/btcheck/report.html",
             "btcheck/btcheck/runs", "btcheck/btcheck/results")


def run_matrix(folder):
    for part in matrix["strategy"]["matrix"]["part"]:
        given = {"archive": action_of(job["steps"])["archive"], **action_of(matrix["steps"])}
        run(script_of(given, str(part)), folder, RUNNER_TEMP=str(folder / "temp"))
        look_for(folder / "temp/btcheck", f"btcheck-{part}/btcheck.sarif")


def run_gitlab(folder):
    for line in gitlab["script"]:
        run(line, folder, CI_PROJECT_DIR=str(folder))
    artifacts = gitlab["artifacts"]
    look_for(folder, *artifacts["paths"], *artifacts["reports"].values())


def run_hooks(folder):
    manifest = yaml.safe_load((sources / ".pre-commit-hooks.yaml").read_text())
    hooks = {each["id"]: each for each in manifest}
    for name in re.findall(r"\bbtcheck-\w+(?= takes no time)", page):
        if name not in hooks:
            fail(f"there is no hook `{name}`")
    used = hook_repository["hooks"][0]
    hook = {**hooks[used["id"]], **used}
    line = shlex.join([*hook["entry"].split(), *hook["args"]])
    for name in ("a.btf", "a.xml", "a.btproj", "a.ltl", "a.btp", "a.leaves", "batch.toml",
                 "trees/btcheck.toml"):
        if not re.search(hook["files"], name):
            fail(f"the hook passes over {name}")
    run(line, folder)
    git = "git -c user.name=t -c user.email=t@localhost "
    run(f"git init -q && {git}commit -q --allow-empty -m nothing", folder)
    run(git_hook, folder)  # nothing of interest is staged
    broken = folder / "trees/broken.btf"
    broken.write_text("(BehaviorTree :name b (Sequence")
    run(git_hook, folder)
    run("git add trees/broken.btf", folder)
    run(git_hook, folder, code=2)
    run(line, folder, code=2)
    broken.unlink()
    run("git add -A trees", folder)
    run(git_hook, folder)


check_names()
with tempfile.TemporaryDirectory() as name:
    project = Path(name)
    fill(project)
    run_job(project)
    run_matrix(project)
    run_gitlab(project)
    for text in shell:
        if text not in (git_hook, container):
            run(text, project)
    look_for(project, "btcheck.xml", "faults.json", "faults.html")
    run_hooks(project)
print(f"a job, a matrix, GitLab's job, {len(shell)} other lines and a hook")
