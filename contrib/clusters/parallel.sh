#!/bin/bash
# SPDX-License-Identifier: MIT
#
# All that lies in TREES, on the machines that are named in HOSTS, one a line
# (`:` is this one), into RESULTS; then one report. Both folders are seen under
# the same names everywhere.
#   parallel.sh TREES RESULTS HOSTS [OPTION...]
parallel --nonall --sshloginfile "$3" --workdir "$PWD" \
  btcheck batch "$1" --results "$2" --no-wait "${@:4}"
btcheck batch "$1" --join "$2" "${@:4}"
