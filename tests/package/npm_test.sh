#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# The packages for npm: packed twice, installed without a network into an empty
# folder, and used there as somebody else would.
#   npm_test.sh PROGRAM    a static btcheck for this machine
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
program=$(realpath "$1")
for needed in npm node python3; do
  command -v $needed >/dev/null || {
    echo "npm_test.sh: $needed is not installed: skipped"
    exit 77
  }
done
folder=$(mktemp -d)
trap 'rm -rf --one-file-system "$folder"' EXIT
cd "$folder"

fail() {
  echo "npm_test.sh: $*" >&2
  exit 1
}

# ends CODE WORDS…: runs it; what it says is in `said`.
ends() {
  local code=0 expected=$1
  shift
  "$@" >said 2>&1 || code=$?
  [ "$code" -eq "$expected" ] || {
    cat said >&2
    fail "exit code $code, not $expected, of $*"
  }
}

says() {
  grep -qF -- "$1" said || {
    cat said >&2
    fail "it does not say: $1"
  }
}

machine=$(uname -m)
"$root/script/npm" first "$machine=$program" >made
"$root/script/npm" second "$machine=$program" >/dev/null
for file in first/*.tgz; do
  cmp "$file" "second/${file##*/}" || fail "packed twice, ${file##*/} differs"
done
ends 2 "$root/script/npm" third "riscv=$program"
says "is no program for a machine"
ends 2 "$root/script/npm" third "$machine=$root/LICENSE"
says "is for another machine"
ends 2 "$root/script/npm" third "$machine=no-such"
says "there is no program no-such"
[ ! -e third ] || fail "refused, and something is written"

echo "== installed without a network"
mkdir project
cp "$root/examples/drone3.btf" "$root/examples/demo.ltl" project
echo '{"private": true}' >project/package.json
export npm_config_cache=$folder/cache npm_config_update_notifier=false
mapfile -t made < <(sed "s,^,$folder/," made)
(cd project && npm install --offline --no-audit --no-fund --loglevel=error "${made[@]}")
cd project

btcheck=(npx --no-install btcheck)
"${btcheck[@]}" --version | cmp - <("$program" --version) || fail "another version"
[ "$("${btcheck[@]}" --version)" = "btcheck $(node -p 'require("btcheck/package.json").version')" ] ||
  fail "the version of the package is not that of the program"
rules=(drone3.btf --prop demo.ltl)
"${btcheck[@]}" "${rules[@]}" >told 2>/dev/null && fail "a broken rule passes"
{ "$program" "${rules[@]}" 2>/dev/null || true; } | cmp - told || fail "it prints something else"
ends 1 "${btcheck[@]}" "${rules[@]}"
ends 0 "${btcheck[@]}" drone3.btf
ends 1 "${btcheck[@]}" drone3.btf --deny warnings
echo '(BehaviorTree :name t (Sequence' >broken.btf
ends 2 "${btcheck[@]}" broken.btf
says "error[BT"
ends 3 "${btcheck[@]}" drone3.btf --max-states 3
"${btcheck[@]}" - <drone3.btf >/dev/null 2>&1 || fail "standard input does not reach it"

echo "== signals"
{
  echo '(BehaviorTree :name t (ParallelAll'
  for i in {1..14}; do echo "(Action :ID a$i :duration [1,9])"; done
  echo '))'
} >endless.btf
command=(node node_modules/btcheck/bin/btcheck.js batch endless.btf -q)
for signal in INT TERM HUP; do
  # A shell starts jobs in the background with SIGINT ignored; Python does not.
  python3 - "$signal" "${command[@]}" >told <<'EOF' || fail "SIG$signal"
import os, signal, subprocess, sys, time
child = subprocess.Popen(sys.argv[2:], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                         stdin=subprocess.DEVNULL, text=True)
time.sleep(2)
child.send_signal(getattr(signal, "SIG" + sys.argv[1]))
print(child.communicate(timeout=30)[0], child.returncode)
sys.exit(child.returncode != 3)
EOF
  grep -q 'NOT RUN\|UNDECIDED' told || fail "SIG$signal: what is known is not told"
done
python3 - "${command[@]}" >told <<'EOF' || fail "Ctrl-C on a terminal: $(cat told)"
import os, pty, sys, time
pid, terminal = pty.fork()
if pid == 0:
    os.execvp(sys.argv[1], sys.argv[1:])
time.sleep(2)
os.write(terminal, b"\x03")
told = b""
try:
    while piece := os.read(terminal, 4096):
        told += piece
except OSError:
    pass
code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
print(told.decode(), code)
sys.exit(code != 3)
EOF
grep -q 'NOT RUN\|UNDECIDED' told || fail "Ctrl-C: what is known is not told"
pgrep -f "$folder/project/node_modules/@btcheck" >/dev/null && fail "a program is left over"

echo "== other programs, and none"
printf '#!/bin/sh\necho "own: $2"\nexit 7\n' >own
chmod +x own
ends 7 env BTCHECK_BINARY="$PWD/own" "${btcheck[@]}" lint 'a b $(c)'
says 'own: a b $(c)'
printf '#!/bin/sh\nkill -KILL $$\n' >own
ends 137 env BTCHECK_BINARY="$PWD/own" bash -c 'node node_modules/btcheck/bin/btcheck.js; exit $?'
ends 2 env BTCHECK_BINARY="$PWD/no-such" "${btcheck[@]}" --version
says "cannot run $PWD/no-such"
says "= help: "
rm -r node_modules/@btcheck
ends 2 "${btcheck[@]}" --version
says "is not installed"
says "without --omit=optional"
echo "Object.defineProperty(process, 'platform', { value: 'plan9' });" >elsewhere.js
ends 2 node -r ./elsewhere.js node_modules/btcheck/bin/btcheck.js tree.xml
says "there is no btcheck for plan9-"
says "BTCHECK_BINARY"
echo "npm_test.sh: passed, with node $(node --version), npm $(npm --version)"
