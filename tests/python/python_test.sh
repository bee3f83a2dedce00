#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# The Python package from the sources, over the library of a build: its tests by
# pytest, and its types by mypy.
#   python_test.sh LIBRARY PROGRAM SOURCES
set -euo pipefail
sources=$3
export BTCHECK_LIBRARY=$1 BTCHECK_PROGRAM=$2 BTCHECK_SOURCES=$3 TESTED_PROGRAM=$2
export PYTHONPATH=$sources/python PYTHONDONTWRITEBYTECODE=1
python=/usr/bin/python3
[ -x $python ] || python=python3
$python -c 'import pytest' 2>/dev/null || {
  echo "python_test: skipped: $python has no pytest; script/setup installs it"
  exit 77
}
if $python -m mypy --version >/dev/null 2>&1; then
  (cd "$sources/python" && $python -m mypy --cache-dir /dev/null btcheck)
else
  echo "python_test: the types are not looked at: $python has no mypy"
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
timeout 300 $python -m pytest -q -p no:cacheprovider -p btcheck.pytest_plugin -p pytester \
  --rootdir "$folder" "$sources/tests/python" || exit 1
