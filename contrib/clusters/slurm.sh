#!/bin/bash
# SPDX-License-Identifier: MIT
#
# All that lies in TREES, by the tasks of an array, into RESULTS, a folder that
# all nodes see:
#   sbatch slurm.sh TREES RESULTS [OPTION...]
#SBATCH --job-name=btcheck
#SBATCH --array=1-8
#SBATCH --cpus-per-task=4
#SBATCH --requeue
btcheck batch "$1" --results "$2" --no-wait \
  --jobs "$SLURM_CPUS_PER_TASK" "${@:3}"
[ $? -le 3 ]  # verdicts are for --join to tell
