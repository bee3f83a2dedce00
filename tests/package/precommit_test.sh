#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# The hooks of .pre-commit-hooks.yaml, run by pre-commit itself in a repository
# with trees, without a network: as `language: system`, with the program on the
# path, and, where a wheel is given, as they are: pre-commit makes an environment
# and installs the wheel into it, from its folder in the place of an index.
#   precommit_test.sh PROGRAM [WHEEL]
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
program=$(realpath "$1")
wheel=${2:+$(realpath "$2")}
for needed in pre-commit git; do
  command -v $needed >/dev/null || {
    echo "precommit_test.sh: $needed is not installed: skipped"
    exit 77
  }
done
folder=$(mktemp -d)
trap 'rm -rf --one-file-system "$folder"' EXIT
export HOME=$folder PRE_COMMIT_HOME=$folder/cache
# setuptools is that of the environment. (0 is what turns the isolation off.)
export PIP_NO_INDEX=1 PIP_FIND_LINKS=${wheel%/*} PIP_NO_BUILD_ISOLATION=0
export GIT_AUTHOR_NAME=t GIT_AUTHOR_EMAIL=t@localhost GIT_CONFIG_NOSYSTEM=1
export GIT_COMMITTER_NAME=t GIT_COMMITTER_EMAIL=t@localhost
mkdir "$folder/bin"
ln -s "$program" "$folder/bin/btcheck"
cd "$folder"

fail() {
  cat said >&2
  echo "precommit_test.sh: $*" >&2
  exit 1
}

# ends CODE WORDS…: what it says is in `said`.
ends() {
  local code=0 expected=$1
  shift
  "$@" >"$folder/said" 2>&1 || code=$?
  cp "$folder/said" said 2>/dev/null || true
  [ "$code" -eq "$expected" ] || fail "exit code $code, not $expected, of $*"
}

says() {
  grep -qE -- "$1" said || fail "it does not say: $1"
}

pre-commit validate-manifest "$root/.pre-commit-hooks.yaml"
git init -q hooks
cp "$root/.pre-commit-hooks.yaml" "$root/pyproject.toml" hooks
git -C hooks add -A
git -C hooks commit -q -m hooks
revision=$(git -C hooks rev-parse HEAD)

# A commit passes or not, as its trees say; one without trees is not checked.
try_hooks() {  # try_hooks NAME CONFIGURATION
  local project=$folder/$1
  git init -q "$project"
  cd "$project"
  mkdir trees
  echo '(BehaviorTree :name t (Sequence (Action :ID a) (Action :ID b)))' >trees/t.btf
  echo 'property can: possible root.success' >trees/t.ltl
  echo '<package><name>not_a_tree</name></package>' >package.xml
  printf '%s\n' '.btcheck-results*' said >.gitignore
  printf '%s\n' "$2" >.pre-commit-config.yaml
  pre-commit validate-config
  pre-commit install >/dev/null
  git add -A
  ends 0 git commit -q -m trees
  says 'behavior trees\.\.\..*Passed'
  says 'without a search\.\.\..*Passed'
  echo nothing >notes.txt
  git add -A
  ends 0 git commit -q -m notes
  says 'behavior trees\.\.\..*Skipped'
  echo '(BehaviorTree :name b (Sequence' >trees/broken.btf
  git add -A
  ends 1 git commit -q -m broken
  says 'exit code: 2'
  says 'error\[BT10'
  rm trees/broken.btf
  echo 'property worse: never a.failure' >>trees/t.ltl
  git add -A
  ends 1 git commit -q -m worse
  says 'exit code: 1'
  says 'VIOLATED +worse'
  cd "$folder"
}

PATH=$folder/bin:$PATH try_hooks installed "repos:
  - repo: file://$folder/hooks
    rev: $revision
    hooks:
      - { id: btcheck, language: system }
      - { id: btcheck-lint, language: system }"
echo "precommit_test.sh: hooks with the program that is installed: as expected"

if [ -n "$wheel" ]; then
  try_hooks wheel "repos:
  - repo: file://$folder/hooks
    rev: $revision
    hooks: [{ id: btcheck }, { id: btcheck-lint }]"
  echo "precommit_test.sh: hooks with the wheel: as expected"
else
  echo "precommit_test.sh: no wheel is given: that pre-commit installs one is not tried"
fi
echo "precommit_test.sh: passed, with $(pre-commit --version)"
