#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# The image of contrib/container: built by buildah, looked at, and run on trees
# that it may not write to. Where buildah is not there or may not work, what the
# image holds is run by chroot, as the image's user, and the test says so.
#   container_test.sh PROGRAM    a static btcheck for this machine
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
program=$(realpath "$1")
recipe=$root/contrib/container/Containerfile
[ "$(id -u)" -eq 0 ] || {
  echo "container_test.sh: it takes root: skipped"
  exit 77
}
folder=$(mktemp -d)
# Of trees that are mounted, only the mount goes.
trap 'umount "$folder/image/trees" 2>/dev/null || true; rm -rf --one-file-system "$folder"' EXIT
cd "$folder"

fail() {
  echo "container_test.sh: $*" >&2
  exit 1
}

version=$("$program" --version)
mkdir -p context/bin trees
install -m 755 "$program" context/bin/btcheck
cp "$root"/examples/{drone3,recovery}.{btf,ltl} trees
chmod -R a+rX .

buildah_with_storage() {
  buildah --storage-driver vfs --root "$folder/storage" --runroot "$folder/running" "$@"
}

how=
if ! command -v buildah >/dev/null; then
  how="buildah is not installed"
elif ! buildah_with_storage build --isolation chroot --quiet --build-arg "VERSION=${version#* }" \
  -t btcheck -f "$recipe" context >log 2>&1 ||
  ! container=$(buildah_with_storage from --pull-never btcheck 2>>log) ||
  ! buildah_with_storage run --isolation chroot "$container" -- /btcheck --version >>log 2>&1; then
  cat log >&2
  # Its own complaint: it may not mount here, and the like.
  grep -qiE 'operation not permitted|permission denied|user namespace' log ||
    fail "buildah does not build or run the image"
  how="buildah may not work here"
fi

if [ -z "$how" ]; then
  buildah_with_storage inspect --type image btcheck >image.json
  python3 - "${version#* }" <<'EOF' || fail "what the image says of itself"
import json, sys
of = json.load(open("image.json"))["OCIv1"]
config = of["config"]
labels = {key.rsplit(".", 1)[1]: value for key, value in config["Labels"].items()
          if key.startswith("org.opencontainers.image.")}
assert config["Entrypoint"] == ["/btcheck"], config
assert config["WorkingDir"] == "/trees" and config["User"] == "65534:65534", config
assert labels["title"] == "btcheck" and labels["licenses"] == "MIT", labels
assert labels["version"] == sys.argv[1], labels
EOF
  # The one that has run has files of buildah's as well.
  mounted=$(buildah_with_storage mount "$(buildah_with_storage from --pull-never btcheck)")
  held=$(cd "$mounted" && find . -type f | sort | tr '\n' ' ')
  [ "$held" = "./btcheck " ] || fail "the image holds $held"
  run() {
    buildah_with_storage run --isolation chroot --volume "$folder/trees:/trees:ro" \
      "$container" -- /btcheck "$@"
  }
else
  echo "container_test.sh: $how: the files of the image are run by chroot"
  mkdir -p image/trees
  read -ra files < <(sed -n 's,^COPY \(.*\) /$,\1,p' "$recipe")
  (cd context && cp "${files[@]}" ../image)
  mount --bind trees image/trees
  mount -o remount,bind,ro image/trees
  run() {
    chroot --userspec 65534:65534 image /btcheck "$@"
  }
fi

# ends CODE WORDS…
ends() {
  local code=0 expected=$1
  shift
  run "$@" >told 2>&1 || code=$?
  [ "$code" -eq "$expected" ] || {
    cat told >&2
    fail "exit code $code, not $expected, of btcheck $*"
  }
}

ends 0 --version
grep -qx "$version" told || fail "another version: $(cat told)"
ends 0 batch /trees -q
grep -q '^MET .*drone3.ltl' told || fail "a rule was not checked: $(cat told)"
ends 1 /trees/drone3.btf --deny warnings
ends 2 /trees/drone3.btf --format json=/trees/no/r.json
[ -n "$how" ] || ends 0 drone3.btf  # in the working directory of the image
ends 0 demo
[ "$(find trees -type f | wc -l)" -eq 4 ] || fail "it has written to the trees"
echo "container_test.sh: passed${how:+, by chroot}"
