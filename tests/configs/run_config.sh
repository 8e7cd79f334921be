#!/usr/bin/env bash
# run_config.sh SWARMANOID EXPERIMENT: checks an experiment, then runs its first 20 ticks.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" check "$2"
# 1: the experiment says that 20 ticks were too few for its goal.
"$1" run "$2" --single-process --ticks 20 --output "$folder/run" | tee "$folder/output.txt" || [ $? -eq 1 ]
tail -n 1 "$folder/output.txt" | grep -qE '^finished: 20 ticks, '
