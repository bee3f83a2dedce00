#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# examples/check as somebody else's project: against what is installed, with
# each compiler that is there and all warnings.
#   outside_test.sh BUILD SOURCES
set -euo pipefail
build=$1
sources=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() {
  echo "outside_test: $*" >&2
  [ ! -f "$folder/log" ] || tail -30 "$folder/log" >&2
  exit 1
}
# Configured anew, for another prefix than that of the build; nothing is built.
cmake -S "$sources" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DBTCHECK_TESTS=OFF >"$folder/log" 2>&1 || fail "configuration"
mkdir -p "$folder/build/engine"
cp "$build/btcheck" "$build/libbtcheck.a" "$folder/build"
cp "$build/engine/libbtcheck_run.a" "$folder/build/engine"
cmake --install "$folder/build" --prefix "$folder/prefix" >"$folder/log" 2>&1 ||
  fail "installation"
tree=$sources/examples/nav2/jazzy/navigate_to_pose_w_replanning_and_recovery.xml
for compiler in g++ clang++-14; do
  command -v $compiler >/dev/null || continue
  cmake -S "$sources/examples/check" -B "$folder/$compiler" \
    -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_CXX_COMPILER=$compiler \
    -DCMAKE_CXX_STANDARD=20 -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" \
    >"$folder/log" 2>&1 || fail "$compiler: configuration"
  cmake --build "$folder/$compiler" >"$folder/log" 2>&1 || fail "$compiler: build"
  "$folder/$compiler/checker" "$tree" >"$folder/told" || fail "$compiler: checker"
  grep -qE "nodes, [0-9]+ states$" "$folder/told" || fail "$compiler: $(cat "$folder/told")"
  "$folder/$compiler/hover" 22 "$tree" | grep -q "number_of_retries (int) = 1" || fail "$compiler: hover"
  ! "$folder/$compiler/checker" "$tree" "$folder/gone" 2>/dev/null || fail "a file that is not there"
done
cat "$folder/told"
