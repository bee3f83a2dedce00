#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
#
# The action: action.yml is read, and its script run as GitHub's runner does it,
# with the environment that action.yml gives it, on inputs that are good, wrong
# and hostile. That GitHub takes it is not tested here.
#   action_test.py BTCHECK SOURCES
import json
import os
import re
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

program, sources = (Path(each).resolve() for each in sys.argv[1:])
script = sources / "action/run"
text = (sources / "action/action.yml").read_text()
action = yaml.safe_load(text)
steps = {step.get("id", step["name"]): step for step in action["runs"]["steps"]}
TREE = "(BehaviorTree :name t (Sequence (Action :ID a) (Action :ID b)))\n"
RACE = ('<root BTCPP_format="4"><BehaviorTree ID="T"><Parallel name="{}" success_count="1">'
        '<A/><B/></Parallel></BehaviorTree></root>\n')
HOSTILE = ["a b", "it's", 'say "so"', "a;touch pwned", "$(touch pwned)", "`touch pwned`",
           "${HOME}", "*", "::error::pwned", "##[error]pwned", "%0A::error::pwned",
           "%%{init: {'theme': 'pwned'}}%%", "-q", "--help"]
runs = 0


def fail(told):
    sys.exit(f"action: {told}")


def expect(is_so, told):
    if not is_so:
        fail(told)


def check_shape():
    """What GitHub asks of a composite action, and that nothing is left over."""
    expect(set(action) == {"name", "description", "branding", "inputs", "outputs", "runs"}, "keys")
    expect(action["runs"]["using"] == "composite", "it is not composite")
    expect(os.access(script, os.X_OK), "action/run cannot be run")
    for name, of in action["inputs"].items():
        expect(set(of) == {"description", "default"} and isinstance(of["default"], str), name)
        expect(re.search(rf"\binputs\.{name}\b", text), f"the input `{name}` is not used")
    for name, of in action["outputs"].items():
        step, output = re.fullmatch(r"\$\{\{ steps\.(\w+)\.outputs\.(\w+) \}\}", of["value"]).groups()
        expect(step in steps, f"the output `{name}` is of no step")
        expect(f"set_output {output} " in script.read_text(), f"nothing sets `{output}`")
    for expression in re.findall(r"\$\{\{ (.*?) \}\}", text) + [
            step["if"] for step in action["runs"]["steps"] if "if" in step]:
        for name in re.findall(r"inputs\.([\w-]+)", expression):
            expect(name in action["inputs"], f"`{name}` is no input")
        for step, output in re.findall(r"steps\.(\w+)\.outputs\.(\w+)", expression):
            expect(step in steps and f"set_output {output} " in script.read_text(),
                   f"no step `{step}` has the output `{output}`")
    for step in action["runs"]["steps"]:
        expect(("uses" in step) != ("run" in step), "a step either uses or runs")
        if "uses" in step:
            expect(re.fullmatch(r"[\w-]+(/[\w-]+)+@[0-9a-f]{40}", step["uses"]),
                   f"`{step['uses']}` is not pinned to a commit")
            expect(re.search(re.escape(step["uses"]) + r" # v\d+\.\d+\.\d+\n", text),
                   f"no version is told of `{step['uses']}`")
        else:
            expect(step["shell"] == "bash", "a step has another shell")
            # What a stranger may have written is in variables, never in the line.
            expect("${{" not in step["run"], "an expression in a line of shell")
    # Where a stranger's change may be checked out, `github.ref` may be the
    # default branch; only of a push it is what is checked out.
    saved = next(step for step in action["runs"]["steps"] if "cache/save" in step.get("uses", ""))
    for condition in ("github.event_name == 'push'", "github.ref == format('refs/heads/{0}', "
                      "github.event.repository.default_branch)"):
        expect(condition in saved["if"] and "||" not in saved["if"], "whose results are kept?")


class Job:
    """A checkout, and what the runner gives each step."""

    def __init__(self):
        self.place = Path(tempfile.mkdtemp(prefix="btcheck action "))
        self.checkout = self.place / "checkout"
        self.temp = self.place / "temp"
        self.summary = self.place / "summary"
        (self.checkout / "trees").mkdir(parents=True)
        (self.checkout / ".git").mkdir()
        self.temp.mkdir()
        (self.checkout / "trees/a.btf").write_text(TREE)
        (self.checkout / "trees/a.ltl").write_text("property p: possible root.success\n")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        expect(not list(self.place.rglob("pwned")), "a text was taken for an order")
        shutil.rmtree(self.place)

    def step(self, name, inputs, outputs):
        """A step that runs a line: its code, what it printed, its outputs."""
        def value(written):
            def meant(found):
                kind, _, key = found[1].partition(".")
                return inputs[key] if kind == "inputs" else outputs[key.split(".")[-1]]
            return re.sub(r"\$\{\{ (.*?) \}\}", meant, written)

        file = self.place / "output"
        file.write_text("")
        given = {key: value(of) for key, of in steps[name]["env"].items()}
        environment = {"PATH": os.environ["PATH"], "HOME": str(self.place), **given,
                       "GITHUB_ACTION_PATH": str(script.parent), "GITHUB_OUTPUT": str(file),
                       "GITHUB_STEP_SUMMARY": str(self.summary), "RUNNER_TEMP": str(self.temp),
                       "GITHUB_WORKSPACE": str(self.checkout)}
        done = subprocess.run(["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c",
                               steps[name]["run"]], cwd=self.checkout, env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120)
        return done.returncode, done.stdout, dict(
            line.split("=", 1) for line in file.read_text().splitlines())

    def runs(self, **inputs):
        """Both steps, until one fails."""
        global runs
        runs += 1
        all_inputs = {name: of["default"] for name, of in action["inputs"].items()}
        all_inputs.update({"paths": "trees", "binary": str(program)} | inputs)
        code, printed, outputs = self.step("find", all_inputs, {})
        if code == 0:
            code, more, others = self.step("check", all_inputs, outputs)
            printed += more
            outputs |= others
        # Each command is one that btcheck or the script gives.
        for line in printed.splitlines():
            expect(not re.match(r"\s*(::|##\[)", line) or
                   re.match(r"::(error|warning|notice) (file=[^:]*,title=|title=btcheck::)", line),
                   f"an order to the runner: {line}")
        return code, printed, outputs


def refused(words, **inputs):
    with Job() as job:
        code, printed, outputs = job.runs(**inputs)
        expect(code == 2, f"exit code {code}, not 2, of {inputs}:\n{printed}")
        errors = re.findall(r"^::error title=btcheck::(.*)", printed, re.M)
        expect(len(errors) == 1 and words in errors[0] and "; " in errors[0],
               f"{inputs}: not refused with `{words}` and a hint:\n{printed}")
        expect("outcome" not in outputs, "refused, and with an outcome")


def check_outcomes():
    with Job() as job:
        code, printed, outputs = job.runs()
        expect((code, outputs["outcome"], outputs["findings"]) == (0, "met", "0"), printed)
        expect(json.loads(Path(outputs["sarif"]).read_text())["version"] == "2.1.0", "SARIF")
        expect("a.ltl" in Path(outputs["report"]).read_text(), "no page")
        expect("### btcheck: 1 entry: 1 met" in job.summary.read_text(), "no summary")
        expect(job.temp in Path(outputs["results"]).parents, "results are kept in the checkout")

        # A rule that is broken, shown with its run as a picture.
        (job.checkout / "trees/a.ltl").write_text("property p: never root.success\n")
        code, printed, outputs = job.runs()
        expect((code, outputs["outcome"], outputs["findings"]) == (1, "missed", "1"), printed)
        expect(re.search(r"^::error file=trees/a\.btf,line=1,.*\[BT2001\]", printed, re.M), printed)
        page = job.summary.read_text()
        expect("VIOLATED p</summary>\n\n```mermaid\nflowchart LR\n" in page, page)
        run = next((Path(outputs["folder"]) / "runs").rglob("*.html"))
        link = os.path.relpath(run, Path(outputs["report"]).parent)
        expect(f'href="{link}"' in Path(outputs["report"]).read_text(), "no link to the run")

        job.summary.unlink()
        code, printed, outputs = job.runs(report="false")
        expect(code == 1 and "report" not in outputs, "a page that nobody wants")
        expect("mermaid" not in job.summary.read_text(), "a picture that nobody wants")

        code, printed, outputs = job.runs(args="--max-states 1")
        expect((code, outputs["outcome"]) == (3, "undecided"), printed)
        (job.checkout / "trees/b.btf").write_text("(BehaviorTree")
        code, printed, outputs = job.runs()
        expect((code, outputs["outcome"]) == (2, "broken"), printed)
        code, printed, outputs = job.runs(paths="trees/a.btf\n\n  \ntrees/no.btf\n")
        expect((code, outputs["outcome"]) == (2, "broken"), printed)
        code, printed, outputs = job.runs(args="--no-such-option")
        expect((code, outputs["outcome"], outputs["findings"]) == (2, "broken", ""), printed)
        expect("sarif" not in outputs, "a report of nothing")


def check_inputs():
    with Job() as job:
        (job.checkout / "trees/race.xml").write_text(RACE.format("race"))
        code, printed, outputs = job.runs(paths="trees/race.xml", profile="btcpp-4")
        expect(code == 0 and int(outputs["findings"]) > 0, printed)
        for deny in ("warnings", "BT2214", "BT2208, BT2214", "BT2208\nBT2214\n"):
            code, printed, _ = job.runs(paths="trees/race.xml", profile="btcpp-4", deny=deny)
            expect(code == 1 and "::error file=trees/race.xml" in printed, f"{deny}: {printed}")
        subprocess.run([program, "trees/race.xml", "--profile", "btcpp-4", "-q",
                        "--write-baseline", "known.json"], cwd=job.checkout, check=True,
                       capture_output=True)
        code, printed, _ = job.runs(paths="trees/race.xml", profile="btcpp-4", deny="warnings", baseline="known.json")
        expect(code == 0, printed)
        code, printed, _ = job.runs(paths="trees/race.xml", profile="no-such")
        expect(code == 2 and "no-such" in printed, printed)
        # Quotes hold words together; two parts are the whole.
        code, printed, outputs = job.runs(args="--shard '1/2'  \"--timeout\" 60\n--no-repairs")
        expect(code == 0, printed)
        expect("1 entry:" in job.summary.read_text().split("###")[-1], "no shard")


def check_cache():
    """What is kept is taken; a stranger's file in the checkout is not."""
    def entry_of(outputs):
        return sorted(Path(outputs["results"]).glob("*.result"))

    with Job() as job:
        (job.checkout / "trees/.btcheck-results").write_text("of a stranger\n")
        _, printed, outputs = job.runs()
        expect(len(entry_of(outputs)) == 1, "nothing is kept")
        expect("BT1508" not in printed, "the stranger's results were read")
        kept = job.place / "kept"
        shutil.copytree(outputs["results"], kept)
        (kept / "x.1.lease").write_text("of a job that was cancelled")
        (kept / "old.result").write_text("old")
        os.utime(kept / "old.result", (0, 0))
        # The restored folder stands between the two steps.
        inputs = {name: of["default"] for name, of in action["inputs"].items()}
        inputs |= {"paths": "trees", "binary": str(program)}
        _, _, found = job.step("find", inputs, {})
        shutil.copytree(kept, found["results"], dirs_exist_ok=True)
        _, _, outputs = job.step("check", inputs, found)
        left = {file.name for file in Path(found["results"]).iterdir()}
        expect(left == {entry_of(found)[0].name}, f"left in the folder: {left}")
        told = subprocess.run([program, "batch", "trees", "-q", "--join", found["results"],
                               "--trace-dir", Path(found["folder"]) / "runs"], cwd=job.checkout,
                              capture_output=True, text=True)
        expect(told.returncode == 0, f"what is kept cannot be taken: {told.stdout}{told.stderr}")
        _, _, outputs = job.runs(cache="false")
        expect(not entry_of(outputs), "results are kept that nobody wants")


def check_programs():
    with Job() as job:
        archive = job.place / "btcheck-1-linux.tar.xz"
        with tarfile.open(archive, "w:xz", preset=0) as made:
            made.add(program, "btcheck-1/bin/btcheck")
        # With a colon in it tar would take it for another machine's.
        shutil.copy(archive, job.checkout / "other:1.tar.xz")
        for name in (str(archive), f"{job.place}/btcheck-*.tar.xz", "other:1.tar.xz"):
            code, printed, outputs = job.runs(binary="", archive=name)
            expect(code == 0 and outputs["program"].startswith(outputs["folder"]), printed)
        version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout
        code, printed, _ = job.runs(version=version.split()[1])
        expect(code == 0, printed)
        (job.checkout / "tools").mkdir()
        (job.checkout / "tools/the program").symlink_to(program)
        code, printed, _ = job.runs(binary="tools/the program")
        expect(code == 0, printed)
        other = job.place / "other.tar.gz"
        with tarfile.open(other, "w:gz") as made:
            made.add(script, "bin/other")
        refused("no bin/btcheck in", binary="", archive=str(other))
        (job.place / "no.tar.gz").write_text("no archive")
        refused("no bin/btcheck in", binary="", archive=f"{job.place}/no.tar.gz")
        refused("3 files are called", binary="", archive=f"{job.place}/*.tar.*")
    refused("0 files are called", binary="", archive="no-such-*.tar.gz")
    refused("0 files are called", binary="", archive="no-such.tar.gz")
    refused("there is no program no/such", binary="no/such")
    refused("there is no program check", binary="check")  # a function of the script
    refused("is not btcheck", binary="true")
    refused("version asks for 99.9.9", version="99.9.9")


def check_refusals():
    refused("cache: yes is neither", cache="yes")
    refused("sarif: True is neither", sarif="True")
    refused("report:  is neither", report="")
    for name in ("", "a b", "../out", "a\nb", "$(touch pwned)"):
        refused("has other signs", name=name)
    refused("nothing is named", paths=" \n\n")
    refused("a quote has no other end", args="--shard '1/2")


def check_hostile():
    """No input and no name in a change is an order, for a shell or the runner."""
    for word in HOSTILE:
        with Job() as job:
            code, printed, _ = job.runs(paths=f"{word}/no.btf")
            expect(code == 2, f"paths {word}: {code}\n{printed}")
            code, printed, _ = job.runs(profile=word, paths="trees")
            expect(code == 2, f"profile {word}: {code}\n{printed}")
            code, printed, _ = job.runs(baseline=f"{word}/no.json")
            expect(code == 2, f"baseline {word}: {code}\n{printed}")
            job.runs(deny=word)
            job.runs(args=word)
            job.runs(binary=f"{word}/no")
            job.runs(binary="", archive=f"{word}/no.tar.gz")
            job.runs(version=f"{word}\n::error::pwned")
            # And where it is the name of a folder with a tree, and of a node.
            folder = job.checkout / "trees" / word.replace("/", "_")
            folder.mkdir()
            escaped = word.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
            (folder / f"{word.replace('/', '_')}.xml").write_text(RACE.format(escaped))
            job.summary.unlink(missing_ok=True)
            for paths in ("trees", f"trees/{folder.name}"):
                code, printed, outputs = job.runs(paths=paths, deny="warnings")
                expect((code, outputs["outcome"]) == (1, "missed"), f"{word}: {code}\n{printed}")
                expect(set(outputs) == {"program", "folder", "results", "outcome", "findings",
                                        "sarif", "report"}, f"{word}: outputs {set(outputs)}")
            page = job.summary.read_text()
            expect("%%{" not in page, "a name directs Mermaid")
            expect(page.count("```mermaid\n") == 2 and page.count("\n```\n") == 2, page)
    with Job() as job:
        race = RACE.format("&#10;```&#10;::error::pwned")
        (job.checkout / "trees/race.xml").write_text(race)
        code, printed, _ = job.runs(deny="warnings")
        page = job.summary.read_text()
        expect(code == 1 and page.count("\n```") == 2, f"{printed}{page}")
        folder = job.checkout / "trees/a\n::error::pwned"
        folder.mkdir()
        (folder / "b\n```.xml").write_text(race)
        code, printed, _ = job.runs()
        expect(code == 2 and "has a line break in its name" in printed, printed)


check_shape()
check_outcomes()
check_inputs()
check_cache()
check_programs()
check_refusals()
check_hostile()
print(f"{len(action['inputs'])} inputs, {len(steps)} steps, {runs} runs of both steps of ours")
