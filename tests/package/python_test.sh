#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# A Python wheel as a user has it: installed into a fresh environment without a
# network; the programs of the documentation, the tests of the package, pytest
# --btcheck; how many checks a second one core makes, and what memory they take.
#   python_test.sh WHEEL [--long]
# --long: 100,000 checks instead of 1,000. Needs `script/setup wheel`.
set -euo pipefail
wheel=$(realpath "${1:?python_test.sh WHEEL [--long]}")
checks=1000
[ "${2:-}" != --long ] || checks=100000
sources=$(cd "$(dirname "$0")/../.." && pwd)
python=/usr/bin/python3
[ -x $python ] || python=python3
$python -c 'import ensurepip, pytest' 2>/dev/null || {
  echo "python_test: skipped: $python has no venv or no pytest; script/setup wheel"
  exit 77
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() {
  echo "python_test: $*" >&2
  [ ! -f "$folder/log" ] || tail -40 "$folder/log" >&2
  exit 1
}
unset BTCHECK_LIBRARY BTCHECK_PROGRAM PYTHONPATH
cd "$folder"
# pytest is the system's.
$python -m venv --system-site-packages "$folder/venv" >log 2>&1 || fail "venv"
bin=$folder/venv/bin
"$bin/pip" install --quiet --disable-pip-version-check --no-index --no-deps "$wheel" \
  >log 2>&1 || fail "installation"
"$bin/python" - <<'END' >log 2>&1 || fail "what is in the wheel"
from importlib.metadata import files, version
import btcheck
assert version("btcheck") == btcheck.__version__, version("btcheck")
names = {str(name) for name in files("btcheck")}
for name in ("btcheck/libbtcheck.so", "btcheck/program", "btcheck/py.typed",
             "btcheck/py_trees_to_xml.py"):
    assert name in names, name
assert any(name.endswith("LICENSE") for name in names), names
END
version=$("$bin/python" -c 'import btcheck; print(btcheck.__version__)')
for program in "$bin/btcheck" "$bin/python -m btcheck"; do
  $program --version 2>&1 | grep -qF "$version" || fail "$program"
done

# The tests of the package, those of the documentation among them.
export BTCHECK_SOURCES=$sources TESTED_PROGRAM=$bin/btcheck
timeout 300 "$bin/python" -B -m pytest -q -p no:cacheprovider -p pytester --rootdir "$folder" \
  "$sources/tests/python" >log 2>&1 || fail "tests/python"
tail -1 log

# The plugin is found without a word.
mkdir trees
cp "$sources"/examples/nav2/main/navigate_to_pose_w_replanning_and_recovery.* trees
timeout 300 "$bin/python" -B -m pytest -q -p no:cacheprovider --btcheck trees >log 2>&1 ||
  fail "pytest --btcheck"
grep -qE '^[0-9]+ passed' log || fail "pytest --btcheck has found nothing"

"$bin/python" -B "$sources/tests/package/python_rates.py" $checks || fail "rates"
