#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# btcheck/check.h in C99 with each compiler that is there and all warnings, as
# C++, and by ctypes; the names that the library exports.
#   c_door_test.sh LIBRARY SOURCES
set -euo pipefail
library=$1
sources=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() {
  echo "c_door_test: $*" >&2
  exit 1
}
strict="-Wall -Wextra -Werror -pedantic -I$sources/src"
for compiler in gcc clang clang-14; do
  command -v $compiler >/dev/null || continue
  $compiler -std=c99 $strict "$sources/tests/api/c_door_test.c" -o "$folder/door" \
    "$library" -Wl,-rpath,"$(dirname "$library")" || fail "$compiler"
  "$folder/door" >"$folder/told" || fail "$compiler: the calls"
  grep -q '"exit_code": *1' "$folder/told" || fail "$compiler: $(cat "$folder/told")"
done
[ -f "$folder/door" ] || fail "no compiler of C"
echo '#include <btcheck/check.h>' >"$folder/door.cpp"
for compiler in g++ clang++-14; do
  ! command -v $compiler >/dev/null ||
    $compiler -std=c++11 $strict -fsyntax-only "$folder/door.cpp" || fail "$compiler"
done
# The header's names, with the version of the library, and no others.
told=$(nm -D --with-symbol-versions --defined-only "$library")
names=$(sed -nE 's/.* T (btcheck_[a-z_]+)@@BTCHECK_1$/\1/p' <<<"$told" | sort)
wanted=$(grep -oE '\bbtcheck_[a-z_]+\(' "$sources/src/btcheck/check.h" | tr -d '(' | sort -u)
for name in $wanted; do
  grep -qx "$name" <<<"$names" || fail "$name is not exported"
done
! grep -vE ' T btcheck_[a-z_]+@@BTCHECK_1$| A BTCHECK_1(@@BTCHECK_1)?$' <<<"$told" ||
  fail "other names are exported"
readelf -dW "$library" | grep -q 'SONAME.*\[libbtcheck\.so\.1\]' ||
  fail "another soname than libbtcheck.so.1"
! command -v python3 >/dev/null ||
  python3 -B "$sources/tests/api/c_door_test.py" "$library" \
    "$sources/examples/nav2/jazzy/navigate_to_pose_w_replanning_and_recovery.xml" ||
  fail "ctypes"
