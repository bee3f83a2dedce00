#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
#
# The recipes of contrib/clusters: their files are read, what they name has to
# be there, and the lines that call btcheck are run in a folder with trees, as
# those who start them would.
#   clusters_test.py BTCHECK SOURCES
# That a cluster takes them is not tested here; script/test-slurm does for Slurm.
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

program, sources = (Path(each).resolve() for each in sys.argv[1:])
recipes = sources / "contrib/clusters"
TREE = "(BehaviorTree :name t (Sequence (Action :ID a) (Action :ID b)))\n"
RULE = "property p: possible root.success\n"


def fail(text):
    sys.exit(f"contrib/clusters: {text}")


def expect(is_so, text):
    if not is_so:
        fail(text)


# One tree is not as expected in all that is checked: no line fails for that but
# those that join.
def run(words, folder, code=0, **variables):
    environment = {**os.environ, **variables,
                   "PATH": f"{folder}/bin:{os.environ['PATH']}"}
    done = subprocess.run(words, cwd=folder, env=environment, text=True,
                          capture_output=True, timeout=300)
    expect(done.returncode == code, f"exit code {done.returncode} of {words}\n"
           f"{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


# A folder with six trees and the program on its path.
def filled(folder):
    (folder / "bin").mkdir()
    (folder / "bin/btcheck").symlink_to(program)
    (folder / "trees").mkdir()
    for i in range(6):
        (folder / f"trees/{i}.btf").write_text(TREE)
        (folder / f"trees/{i}.ltl").write_text(RULE)
    (folder / "trees/5.ltl").write_text(RULE.replace("possible", "never"))
    return folder


def results(folder):
    return len(list((folder / "results").glob("*.result")))


def check_join(folder, told):
    expect("6 entries: 5 met, 1 missed" in told, f"not all were told:\n{told}")
    expect(results(folder) == 6, "results are missing")
    expect(not list((folder / "results").glob("*.lease")), "a lease is left")


def only(mapping, *keys):
    expect(set(mapping) <= set(keys), f"not a key here: {set(mapping) - set(keys)}")


# The fields of a batch/v1 Job that is Indexed, as the API has them; no others.
def check_kubernetes(folder):
    job = yaml.safe_load((recipes / "kubernetes.yaml").read_text())
    only(job, "apiVersion", "kind", "metadata", "spec")
    expect((job["apiVersion"], job["kind"]) == ("batch/v1", "Job"), "no Job")
    name = job["metadata"]["name"]
    expect(re.fullmatch(r"[a-z0-9]([-a-z0-9]*[a-z0-9])?", name), f"name {name}")
    spec = job["spec"]
    only(spec, "completionMode", "completions", "parallelism",
         "backoffLimitPerIndex", "template")
    expect(spec["completionMode"] == "Indexed", "pods without numbers")
    expect(0 < spec["parallelism"] <= spec["completions"], "how many pods?")
    expect(spec["backoffLimitPerIndex"] > 0, "a lost node ends the job")
    pod = spec["template"]["spec"]
    only(pod, "restartPolicy", "containers", "volumes")
    # backoffLimitPerIndex asks for it.
    expect(pod["restartPolicy"] == "Never", "restartPolicy has to be Never")
    (container,) = pod["containers"]
    only(container, "name", "image", "workingDir", "command", "resources",
         "volumeMounts")
    volumes = {each["name"] for each in pod["volumes"]}
    for mount in container["volumeMounts"]:
        only(mount, "name", "mountPath")
        expect(mount["name"] in volumes, f"no volume {mount['name']}")
        expect(container["workingDir"] == mount["mountPath"],
               "it works where nobody sees it")
    for kind, sizes in container["resources"].items():
        expect(kind in ("requests", "limits"), f"resources: {kind}")
        for size in sizes.values():
            expect(re.fullmatch(r"\d+(m|[KMG]i)?", size), f"size {size}")
    command = container["command"]
    expect(all(isinstance(word, str) for word in command), "words, not numbers")
    expect(f"--jobs {sizes['cpu']} " in command[-1], "--jobs")
    pods = [subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, text=True,
        stderr=subprocess.STDOUT,
        env={**os.environ, "PATH": f"{folder}/bin:{os.environ['PATH']}"})
        for _ in range(3)]
    for each in pods:
        told, _ = each.communicate(timeout=300)
        expect(each.returncode == 0, f"exit code {each.returncode}: {told}")
    check_join(folder, run(["btcheck", "batch", "trees", "--join", "results"],
                           folder, code=1))


def check_slurm(folder):
    told = run(["bash", recipes / "slurm.sh", "trees", "results", "--tick", "root"],
               folder, SLURM_CPUS_PER_TASK="2")
    check_join(folder, told)
    text = (recipes / "slurm.sh").read_text()
    for option in ("--array=", "--cpus-per-task=", "--requeue"):
        expect(f"#SBATCH {option}" in text, f"no {option}")


def check_parallel(folder):
    if not shutil.which("parallel"):
        print("parallel.sh: not run: GNU parallel is not installed")
        return
    (folder / "hosts").write_text(":\n")
    check_join(folder, run(["bash", recipes / "parallel.sh", "trees", "results",
                            "hosts", "-q"], folder, code=1))


def check_actions(folder):
    jobs = yaml.safe_load((recipes / "github-actions.yml").read_text())["jobs"]
    expect(list(jobs) == ["check", "report"], "two jobs")
    parts = jobs["check"]["strategy"]["matrix"]["part"]
    check, report = jobs["check"]["steps"], jobs["report"]["steps"]
    expect(jobs["report"]["needs"] == "check", "the report waits for nothing")
    expect(jobs["report"]["if"] == "always()", "no report of what is broken")
    for step in check + report:
        only(step, "uses", "run", "if", "with", "name", "env")
    (line,) = [step["run"] for step in check if "btcheck batch" in step.get("run", "")]
    (upload,) = [step for step in check if "upload" in step.get("uses", "")]
    expect(upload["if"] == "always()", "results of what is broken are lost")
    expect(upload["with"] == {"name": "results-${{ matrix.part }}",
                              "path": "results"}, "what is handed over")
    (download,) = [step for step in report if "download" in step.get("uses", "")]
    expect(download["with"] == {"pattern": "results-*", "path": "results",
                                "merge-multiple": True}, "what is taken over")
    # Each machine has a folder of its own, and the last has what was in all.
    for part in parts:
        expect(f"/{len(parts)}" in line, "not as many parts as machines")
        own = folder / f"machine{part}"
        shutil.copytree(folder / "trees", own / "trees")
        (own / "bin").symlink_to(folder / "bin")
        run(["bash", "-c", line.replace("${{ matrix.part }}", str(part))], own)
        shutil.copytree(own / "results", folder / "results", dirs_exist_ok=True)
    (joins,) = [step["run"] for step in report if "btcheck batch" in step.get("run", "")]
    run(["bash", "-c", joins], folder, code=1,
        GITHUB_STEP_SUMMARY=str(folder / "page"))
    expect((folder / "report.html").exists(), "no report")
    check_join(folder, run(["btcheck", "batch", "trees", "--join", "results"],
                           folder, code=1))


# The page shows the recipes as they are, and names all of them.
def check_page():
    page = (sources / "docs/clusters.md").read_text()
    for file in recipes.iterdir():
        expect(f"contrib/clusters/{file.name}" in page,
               f"docs/clusters.md does not name {file.name}")
    for block in re.findall(r"^```(?:yaml|bash)\n(.*?)^```$", page, re.S | re.M):
        expect(any(block in file.read_text() for file in recipes.iterdir()),
               f"in docs/clusters.md, and in no recipe:\n{block}")


check_page()
for check in (check_kubernetes, check_slurm, check_parallel, check_actions):
    with tempfile.TemporaryDirectory() as name:
        check(filled(Path(name)))
print("contrib/clusters: as it should be")
