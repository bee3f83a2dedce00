#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# `cmake --install` after a build of the program alone, without its man page and
# without the library, and after one with the page; and a project that finds
# what was installed and has its trees tested (robot). Builds nothing.
#   install_test.sh BTCHECK SOURCES
set -euo pipefail
program=$1
sources=$2
here=$sources/tests/install
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() {
  echo "install_test: $*" >&2
  [ ! -f log ] || tail -30 log >&2
  exit 1
}

cmake -S "$sources" -B build -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DBTCHECK_TESTS=OFF >log 2>&1 || fail "configure"
cp "$program" build/btcheck  # as `cmake --build build --target btcheck` leaves it

cmake --install build --prefix "$folder/alone" >log 2>&1 ||
  fail "a program without its man page is not installed"
grep -q "Left out: no man page" log || fail "nothing says that there is no man page"
grep -q "Left out: no library" log || fail "nothing says that there is no library"
[ ! -e alone/share/man/man1/btcheck.1.gz ] || fail "where does this man page come from?"
alone/bin/btcheck --version >/dev/null || fail "what is installed does not run"

"$program" man | gzip -9n >build/pages/btcheck.1.gz  # as btcheck_pages does
cmake --install build --prefix "$folder/prefix" >log 2>&1 || fail "installation"
[ -s prefix/share/man/man1/btcheck.1.gz ] || fail "no man page"
for file in neovim/lua/btcheck.lua helix/languages.toml emacs/btcheck.el; do
  [ -s "prefix/share/btcheck/editors/$file" ] || fail "no editors/$file"
done
! grep -q "no man page" log || fail "the man page is said to be left out"

configure() {  # configure BUILD WORD…: the package robot against `alone`
  local build=$1
  shift
  cmake -S "$here/robot" -B "$build" -DCMAKE_PREFIX_PATH="$folder/alone" "$@" \
    >log 2>&1
}
counts() {  # counts FILE TESTS FAILURES: as `colcon test-result` reads them
  [ -f "$1" ] || fail "no results in $1"
  grep -qE "<testsuites [^>]*tests=\"$2\" failures=\"$3\"" "$1" ||
    fail "$1 has other counts: $(grep '<testsuites' "$1")"
}

configure robot || fail "the package does not find btcheck"
ctest --test-dir robot -E '^broken$' --output-on-failure >log 2>&1 ||
  fail "the package's tests do not pass"
! ctest --test-dir robot -R '^broken$' >/dev/null 2>&1 || fail "broken passes"
counts robot/test_results/robot/btcheck.missions.xunit.xml 3 0
counts robot/test_results/robot/broken.xunit.xml 3 2

# Without the library it is said that there are no such targets, and why.
mkdir asks
ask() {  # ask WORD…: a project that looks for btcheck with these words
  printf 'cmake_minimum_required(VERSION 3.16)\nproject(asks CXX)\n%s\n' \
    "find_package(btcheck $*)" >asks/CMakeLists.txt
  rm -rf asks-build
  cmake -S asks -B asks-build -DCMAKE_PREFIX_PATH="$folder/alone" \
    -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF >log 2>&1
}
why="there is no $folder/alone/lib.*/libbtcheck.a and .*libbtcheck_run.a"
ask REQUIRED COMPONENTS observer && fail "an observer without an engine"
tr -s ' \n' ' ' <log | grep -q "no btcheck::observer: BehaviorTree.CPP is not found" ||
  fail "nothing says that there is no engine"
# With one: a stand-in, as far as the header hears it.
mkdir -p engine/lib/cmake/behaviortree_cpp
printf 'add_library(BT::behaviortree_cpp INTERFACE IMPORTED)\n%s\n' \
  "target_include_directories(BT::behaviortree_cpp INTERFACE $sources/tests/observer/engine)" \
  >engine/lib/cmake/behaviortree_cpp/behaviortree_cppConfig.cmake
cat >asks/observed.cpp <<'END'
#include <btcheck/observer.hpp>
int main() {
  BT::Tree tree;
  try {
    btcheck::Observer observer(tree, "");
  } catch (const btcheck::WrongTable&) {
    return 0;
  }
  return 1;
}
END
cat >asks/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.16)
project(asks CXX)
find_package(btcheck REQUIRED COMPONENTS observer)
add_executable(observed observed.cpp)
target_link_libraries(observed PRIVATE btcheck::observer)
END
rm -rf asks-build
cmake -S asks -B asks-build -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF \
  "-DCMAKE_PREFIX_PATH=$folder/alone;$folder/engine" >log 2>&1 &&
  cmake --build asks-build >log 2>&1 && asks-build/observed ||
  fail "the observer is not found, or not built"
ask REQUIRED || fail "the program alone is not found"
tr -s ' \n' ' ' <log | grep -q "the program alone; no btcheck::btcheck.*$why" ||
  fail "the library is missing, and nothing says so"
ask QUIET REQUIRED && ! grep -q "program alone" log || fail "QUIET is not quiet"
! ask REQUIRED COMPONENTS library || fail "a library is found where none is"
tr -s ' \n' ' ' <log | grep -q "$why" || fail "no reason why there is no library"
ask COMPONENTS library || fail "what is not required ends the configuration"
tr -s ' \n' ' ' <log | grep -q "$why" || fail "no reason, where it is not required"

configure ament -DAMENT_TEST_RESULTS_DIR="$folder/ament/results" || fail "ament"
ctest --test-dir ament -R missions >log 2>&1 || fail "with ament's folder"
counts ament/results/robot/btcheck.missions.xunit.xml 3 0

# Each word counts: without it, the test fails or is another one.
for word in "MAIN_TREE Dock" "MODELS models/robot.xml" "LEAVES robot.leaves"; do
  rm -rf less less-build
  cp -r "$here/robot" less
  sed -i "s|$word||" less/trees/CMakeLists.txt
  cmake -S less -B less-build -DCMAKE_PREFIX_PATH="$folder/alone" >log 2>&1 ||
    fail "without $word"
  ! ctest --test-dir less-build -R '^btcheck.missions$' >/dev/null 2>&1 ||
    fail "$word makes no difference"
done
sed -i 's|PROFILE btcpp-4|PROFILE btcpp-3.8|' less/trees/CMakeLists.txt
cmake -S less -B less-build >log 2>&1 || fail "another profile"
grep -q 'btcpp-3.8' less-build/trees/CTestTestfile.cmake || fail "PROFILE is lost"

refused() {  # refused TEXT WORD…: the words of btcheck_add_test, and what is said
  printf 'btcheck_add_test(%s)\n' "${*:2}" >less/trees/CMakeLists.txt
  ! cmake -S less -B less-build >log 2>&1 || fail "taken: ${*:2}"
  tr -s ' \n' ' ' <log | grep -qF "$1" || fail "not said: $1"
}
refused "there is no file $folder/less/trees/gone.leaves" \
  TREE missions.xml LEAVES gone.leaves
refused "nothing follows PROFILE" TREE missions.xml PROFILE
refused "unknown words: PROFILES;btcpp-4" TREE missions.xml PROFILES btcpp-4
echo "installed and used: program alone, with its man page, and by a package"
