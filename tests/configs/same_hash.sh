#!/usr/bin/env bash
# same_hash.sh SWARMANOID EXPERIMENT [WORD]: the same hash in one process, as a cluster, and from a checkpoint on. The WORD stands in the
# table of positions.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" run "$2" --single-process --ticks 200 --checkpoint-every 100 --output "$folder/one" | tee "$folder/one.txt"
hash=$(grep -oE 'hash [0-9a-f]{16}' "$folder/one.txt" | tail -n 1 | cut -d' ' -f2)
"$1" run "$2" --ticks 200 --controller-hosts 2 --expect-hash "$hash" --output "$folder/cluster"
"$1" run "$2" --single-process --ticks 200 --restore "$folder/one/checkpoint-00000100" --expect-hash "$hash" --output "$folder/restored"
[ $# -lt 3 ] || grep -qw "$3" "$folder/cluster/positions.txt"
