#!/usr/bin/env bash
# prey_retrieval.sh SWARMANOID EXPERIMENT: the sample experiment reaches its goal, in one process and as a cluster alike, and says so if it does not.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" run "$2" --single-process --seed 3 --output "$folder/one" | tee "$folder/one.txt"
hash=$(grep -oE 'hash [0-9a-f]{16}' "$folder/one.txt" | tail -n 1 | cut -d' ' -f2)
"$1" run "$2" --seed 3 --controller-hosts 2 --expect-hash "$hash" --output "$folder/cluster"
# The prey's last distance to the nest, from the metrics of the functions: inside the square of 1 m.
tail -n 1 "$folder/cluster/retrieval.csv" | tr , '\n' | awk 'NR > 1 && $1 < 0.71 { found = 1 } END { exit !found }'
# The other prey in the nest is a failure: the run again, in which somebody puts it there once the chosen one has been moved.
other=$(awk -F, 'NR == 1 { for (i = 2; i <= 3; ++i) { sub("_m$", "", $i); id[i] = $i } }
                 NR == 2 { for (i = 2; i <= 3; ++i) start[i] = $i }
                 NR > 2 && !tick { for (i = 2; i <= 3; ++i) if ($i < start[i] - 0.2) { tick = $1; chosen = i } }
                 END { print tick "," "move," id[5 - chosen] ",4 4 0," }' "$folder/one/retrieval.csv")
printf 'tick,request,entity,numbers,from\n%s\n' "$other" >"$folder/events.csv"
status=0
"$1" run "$2" --single-process --seed 3 --events "$folder/events.csv" --output "$folder/other" | tee "$folder/other.txt" || status=$?
[ "$status" -eq 1 ]
grep -q "^finished: $((${other%%,*} + 1)) ticks" "$folder/other.txt"
status=0
"$1" run "$2" --single-process --ticks 50 --output "$folder/short" || status=$?
[ "$status" -eq 1 ]
