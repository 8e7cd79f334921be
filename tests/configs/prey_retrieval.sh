#!/usr/bin/env bash
# prey_retrieval.sh SWARMANOID EXPERIMENT: the sample experiment reaches its goal, in one process and as a cluster alike, and says so where it does not.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" run "$2" --single-process --seed 3 --output "$folder/one" | tee "$folder/one.txt"
hash=$(grep -oE 'hash [0-9a-f]{16}' "$folder/one.txt" | tail -n 1 | cut -d' ' -f2)
"$1" run "$2" --seed 3 --controller-hosts 2 --expect-hash "$hash" --output "$folder/cluster"
# The prey's last distance to the nest, from the metrics of the functions: inside the square of 1 m.
tail -n 1 "$folder/cluster/retrieval.csv" | tr , '\n' | awk 'NR > 1 && $1 < 0.71 { found = 1 } END { exit !found }'
status=0
"$1" run "$2" --single-process --ticks 50 --output "$folder/short" || status=$?
[ "$status" -eq 1 ]
