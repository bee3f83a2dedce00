#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
#
# What the program writes as JSON, against schemas/: recorded trees of
# tests/regress checked, linted and measured, runs in each form of JSON, the
# lines that leaves and monitors exchange. Each member of a schema must have
# been written by something here, and none may be missing or new. A third of the
# trees is looked at, and more for as long as a member was written by none.
#   schemas_test.py BTCHECK LIBRARY SOURCES
import copy
import ctypes
import itertools
import json
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

try:
    from jsonschema import Draft202012Validator
    from jsonschema.exceptions import best_match
except ImportError:
    sys.exit("python3-jsonschema is missing: script/setup installs it")

program, library, sources = (Path(word).resolve() for word in sys.argv[1:])
regress = sources / "tests/regress"
validators = {}
documents = defaultdict(list)  # by schema
seen = defaultdict(set)  # by schema, the names of their members
faults = []
run_number = itertools.count()

for file in sorted((sources / "schemas").glob("*.schema.json")):
    schema = json.loads(file.read_text())
    Draft202012Validator.check_schema(schema)
    validators[file.name.removesuffix(".schema.json")] = Draft202012Validator(schema)


def written(schema, text, what):
    """Takes one document for a kind of JSON, if it is one."""
    document = json.loads(text)
    documents[schema].append(document)
    seen[schema] |= names_in(document)
    error = best_match(validators[schema].iter_errors(document))
    if error:
        place = "/".join(map(str, error.absolute_path))
        faults.append(f"{what}: {schema}: {place}: {error.message[:300]}")


def btcheck(folder, *words, stdin=""):
    return subprocess.run([program, *map(str, words)], cwd=folder, input=stdin,
                          capture_output=True, text=True, timeout=120).stdout


def lines(schema, text, what):
    for line in text.splitlines():
        written(schema, line, what)


def issues(text, what):
    """GitLab keeps one issue of each fingerprint."""
    written("gitlab-code-quality", text, what)
    prints = [each["fingerprint"] for each in json.loads(text)]
    if len(set(prints)) < len(prints):
        faults.append(f"{what}: two issues have one fingerprint")


def look_at_tree(folder, tree, out):
    what = f"{folder.name}/{tree}"
    runs = out / "runs" / folder.name
    limits = ("-q", "--max-states", 3000)
    rules = [word for file in sorted(folder.glob("*.ltl")) for word in ("--prop", file.name)]
    for asked in ([], rules) if rules else ([],):
        report = btcheck(folder, "check", tree, *asked, *limits, "--format", "json",
                         "--format", f"jsonl={out}/lines", "--format", f"gitlab={out}/issues",
                         "--trace-dir", runs, "--write-baseline", out / "baseline.json")
        written("report", report, what)
        issues((out / "issues").read_text(), what)
        lines("report-line", (out / "lines").read_text(), what)
        if (out / "baseline.json").exists():
            written("baseline", (out / "baseline.json").read_text(), what)
    written("report", btcheck(folder, "lint", tree, *rules, "--format", "json",
                              "--format", f"gitlab={out}/issues"), what)
    issues((out / "issues").read_text(), f"lint {what}")
    for reduce in ("none", "bisimulation", "strong"):
        space = btcheck(folder, "space", tree, *limits, "--reduce", reduce,
                        "--stats", "json")
        if space:  # a tree that can be read
            written("space", space, f"{what}, {reduce}")
    for file in sorted(runs.glob("*.itf.json")):
        if next(run_number) % 4:
            continue
        written("run", file.read_text(), file.name)
        for form, schema in (("itf", "run"), ("substitution", "substitution"),
                             ("chrome", "chrome"), ("chrome-stack", "chrome")):
            written(schema, btcheck(runs, "trace", file, "--to", form), f"{what} {form}")


def look_at_leaves(out):
    """Both sides of the conversation of a mission, overheard by tee."""
    command = (f"tee {out}/asked | python3 {sources}/examples/run/drone.py | "
               f"tee {out}/said")
    for seed in range(1, 4):
        btcheck(sources, "run", "examples/drone3-fixed.btf", "-q", "--no-wait", "--ticks", 40,
                "--seed", seed, "--leaves-exec", command)
        lines("leaf-question", (out / "asked").read_text(), "leaves are asked")
        lines("leaf-answer", (out / "said").read_text(), "leaves say")
    # And of a process that sets and gets variables.
    folder = regress / "run_process"
    leaves = (folder / "leaves.sh").read_text().replace(
        "echo '{\"set\"", "echo '{\"get\":\"battery\"}'; read -r value; echo '{\"set\"")
    (out / "leaves.sh").write_text(leaves)
    btcheck(folder, "run", "tree.btf", "-q", "--no-wait", "--ticks", 4, "--leaves-exec",
            f"tee {out}/asked | sh {out}/leaves.sh | tee {out}/said")
    lines("leaf-question", (out / "asked").read_text(), "leaves are asked")
    lines("leaf-answer", (out / "said").read_text(), "leaves say")


def look_at_explanations(out):
    """Runs that ended well, badly and not at all, and a log of another run."""
    folder = regress / "explain_log"
    run = out / "run.itf.json"
    words = ("--tree", "tree.xml", "--leaves", "tree.leaves", "--format", "json")
    for script in sorted(folder.glob("*.script")):
        btcheck(folder, "simulate", "tree.xml", "--leaves", "tree.leaves", "--script",
                script.name, "--ticks", 20, "-o", run)
        written("run-explanation", btcheck(folder, "explain", run, *words),
                f"explain {script.name}")
    for log in sorted(folder.glob("*.btlog")):
        written("run-explanation", btcheck(folder, "explain", log.name, *words),
                f"explain {log.name}")
    # Another contract than the leaf's, and a finding that the run shows.
    written("run-explanation", btcheck(
        regress / "conform_answer_left", "explain", "run.btlog", "--tree", "tree.xml",
        "--leaves", "recover.leaves", "--format", "json"), "explain another contract")
    findings = sources / "tests/findings"
    tree = "05-guard-without-effect-bug.xml"
    btcheck(findings, "simulate", tree, "--seed", 1, "--ticks", 30, "-o", run)
    written("run-explanation", btcheck(findings, "explain", run, "--tree", tree, "--format",
                                       "json"), "explain a finding")


def look_at_included(out):
    """A run of a tree in several files has the texts of all."""
    run = out / "included.itf.json"
    btcheck(regress / "xml_included", "simulate", "main.xml", "--seed", 1, "--ticks", 3, "-o", run)
    written("run", run.read_text(), "a run of a tree in several files")


def look_at_monitors():
    for folder in sorted(regress.glob("monitor_*")):
        if not (folder / "stdin").exists():
            continue
        words = (folder / "cmd").read_text().split()
        answers = btcheck(folder, *words, stdin=(folder / "stdin").read_text())
        lines("monitor-answer", answers, folder.name)


def look_at_tests(out):
    """Suites of trees with entries, with time, and without either."""
    suites = out / "suites"
    for tree in ("world/patrol.xml", "nav2/jazzy/navigate_w_replanning_time.xml",
                 "observer/mission.xml", "drone3.btf", "mars_rover.btf"):
        btcheck(sources / "examples", "tests", tree, "-q", "-o", suites, "--to", "jsonl")
    for file in sorted(suites.glob("*.jsonl")):
        lines("tests", file.read_text(), file.name)


def look_at_library():
    """What btcheck/check.h tells and the program does not."""
    door = ctypes.CDLL(library)
    for name in ("request_new", "describe", "simulate", "check"):
        getattr(door, f"btcheck_{name}").restype = ctypes.c_void_p
    door.btcheck_report_json.restype = ctypes.c_char_p
    door.btcheck_report_runs.restype = ctypes.c_char_p
    for tree in sorted(regress.glob("*/tree.btf"))[::9] + sorted(regress.glob("*/tree.xml"))[::9]:
        request = ctypes.c_void_p(door.btcheck_request_new())
        text = tree.read_bytes()
        door.btcheck_add_file(request, tree.name.encode(), text, ctypes.c_size_t(len(text)))
        for name, value in (("tree", tree.name), ("seed", "1"), ("run_ticks", "9"),
                            ("states", "3000"), ("tries_repairs", "false")):
            door.btcheck_set(request, name.encode(), value.encode())
        for call, told, schema in (("describe", "json", "description"),
                                   ("simulate", "json", "simulation"),
                                   ("check", "runs", "runs")):
            report = ctypes.c_void_p(getattr(door, f"btcheck_{call}")(request))
            text = getattr(door, f"btcheck_report_{told}")(report)
            written(schema, text, f"{tree.parent.name} {call}")
            door.btcheck_report_free(report)
        door.btcheck_request_free(request)


def look_at_batches(out):
    for folder in (regress / "workspace", sources / "properties/action"):
        report = btcheck(folder.parent, "batch", folder.name, "-q", "--format", "json",
                         "--format", f"jsonl={out}/batch", "--format", f"gitlab={out}/issues")
        written("report", report, f"batch {folder.name}")
        lines("report-line", (out / "batch").read_text(), f"batch {folder.name}")
        issues((out / "issues").read_text(), f"batch {folder.name}")
    # Long enough for a line of progress, with a run that has a loop.
    lines("report-line", btcheck(sources / "examples", "nav2.btf", "--timeout", 2,
                                 "--format", "jsonl"), "progress")


def look_at_counts(out):
    report = btcheck(sources / "examples/diff", "before.xml", "-q", "-e", "possible root.success",
                     "--any-count", "--format", "json", "--format", f"jsonl={out}/counts")
    written("report", report, "every count")
    lines("report-line", (out / "counts").read_text(), "every count")


def look_at_faults(out):
    """Trees with faults that are silent, noticed, recovered from; with rules and pairs."""
    for folder, words in (("whatif_rules", ("-e", "never Charge.failure", "--order", 2)),
                          ("whatif_silent", ("--trace-dir", out / "faults", "--only", "Upload")),
                          ("whatif_silent", ("--max-states", 20, "--late", 3)),
                          ("whatif_of_btf", ("--others", "contract", "--faults", "fails-once"))):
        tree = "tree.btf" if folder.endswith("btf") else "tree.xml"
        written("whatif", btcheck(regress / folder, "whatif", tree, "-q", *words,
                                  "--format", "json"), f"whatif {folder}")
    for file in sorted((out / "faults").glob("*.itf.json"))[::4]:
        written("run", file.read_text(), file.name)


def look_at_pairs():
    """Trees that are equivalent, and that differ in each way."""
    examples = sources / "examples/diff"
    before = examples / "before.xml"
    rule = "whenever GoTo.running then BatteryOk.ticked within 1 tick"
    for other, words in (("tidied.xml", ()), ("after.xml", ("-e", rule)),
                         ("after.xml", ("--max-states", 3)),
                         ("tidied.xml", ("--observe", "Look", "--caller", "once"))):
        written("diff", btcheck(examples, "diff", before, other, "-q", *words,
                                "--format", "json"), f"diff {other}")
    for one, other, seen_nodes in (("told_before.xml", "told_after.xml", ("leaves",)),
                                   ("door_before.btf", "door_after.btf", "xyz")):
        words = [word for node in seen_nodes for word in ("--observe", node)]
        written("diff", btcheck(regress / "diff_trees", "diff", one, other, "-q", *words,
                                "--format", "json"), f"diff {one}")


def members(schema):
    """The names that a schema has for members, wherever."""
    if isinstance(schema, list):
        return set().union(*map(members, schema)) if schema else set()
    if not isinstance(schema, dict):
        return set()
    named = schema.get("properties", {})
    parts = [value for key, value in schema.items() if key not in ("properties", "enum")]
    return {name for name, of in named.items() if of is not False}.union(
        *map(members, [*named.values(), *parts]))


def names_in(document):
    if isinstance(document, list):
        return set().union(*map(names_in, document)) if document else set()
    if not isinstance(document, dict):
        return set()
    return set(document).union(*map(names_in, document.values()))


def unseen(schema):
    return members(validators[schema].schema) - seen[schema]


def refuses(schema, document):
    is_list = isinstance(documents[schema][0], list)
    return not validators[schema].is_valid([document] if is_list else document)


def required_of(schema, document):
    """The members that the document must have: of the form that it has."""
    forms = [Draft202012Validator({**schema, **form}) for form in schema.get("oneOf", [])]
    form = next((form.schema for form in forms if form.is_valid(document)), schema)
    return form["required"]


def check_schemas():
    """Each is written by something, has no member that nothing writes, and
    refuses documents that lack one or have another."""
    for schema, validator in validators.items():
        if not documents[schema]:
            faults.append(f"nothing was written for {schema}.schema.json")
            continue
        if unseen(schema):
            faults.append(f"{schema}.schema.json has members that nothing writes: "
                          f"{', '.join(sorted(unseen(schema)))}")
        own = validator.schema
        document = max(documents[schema], key=lambda one: len(json.dumps(one)))
        if isinstance(document, list):
            own, document = own["items"], document[0]
        if schema == "monitor-answer":  # an event of any form, and a verdict
            if not refuses(schema, {"topic": "/odom"}) or not refuses(schema, {"verdict": 1}):
                faults.append("monitor-answer.schema.json takes an event without a verdict")
            continue
        for name in required_of(own, document):
            without = {key: value for key, value in document.items() if key != name}
            if not refuses(schema, without):
                faults.append(f"{schema}.schema.json takes a document without `{name}`")
        if schema != "leaf-answer" and not refuses(schema, {**document, "unheard_of": 1}):
            faults.append(f"{schema}.schema.json takes a member that it does not name")
        other = copy.deepcopy(document)
        other[next(iter(other))] = {"an": "object"}
        if not refuses(schema, other) and next(iter(document)) != "TestNodeConfigs":
            faults.append(f"{schema}.schema.json takes anything for its first member")


with tempfile.TemporaryDirectory() as name:
    out = Path(name)
    look_at_leaves(out)
    look_at_monitors()
    look_at_tests(out)
    look_at_included(out)
    look_at_explanations(out)
    look_at_library()
    look_at_batches(out)
    look_at_counts(out)
    look_at_faults(out)
    look_at_pairs()
    trees = sorted(file for form in ("btf", "xml") for file in regress.glob(f"*/tree.{form}"))
    third = trees[::3]
    for tree in third:
        look_at_tree(tree.parent, tree.name, out)
    for tree in trees:
        if not any(map(unseen, validators)):
            break
        if tree not in third:
            look_at_tree(tree.parent, tree.name, out)
check_schemas()
for fault in faults[:40]:
    print(fault, file=sys.stderr)
print(", ".join(f"{len(documents[name])} {name}" for name in validators), "-",
      len(faults), "faults")
sys.exit(1 if faults else 0)
