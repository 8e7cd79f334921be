#!/usr/bin/env bash
# run_config.sh SWARMANOID EXPERIMENT HASHES: checks an experiment, then runs its first 200 ticks, and compares the hash of the state with
# the row of its name in the table HASHES.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
name=$(basename "$2" .xml)
expected=$(sed -n "s/^$name = \"\([0-9a-f]*\)\"$/\1/p" "$3")
if [ -z "$expected" ]; then
  echo "$3 has no row '$name'; tests/results/update $name adds it" >&2
  exit 1
fi
"$1" check "$2"
# Exit code 1: the experiment says that 200 ticks are too few for its goal.
"$1" run "$2" --single-process --ticks 200 --output "$folder/run" | tee "$folder/output.txt" || [ $? -eq 1 ]
tail -n 1 "$folder/output.txt" | grep -qE '^finished: 200 ticks, '
hash=$(sed -n 's/^finished: .* hash \([0-9a-f]*\),.*/\1/p' "$folder/output.txt")
if [ "$hash" != "$expected" ]; then
  echo "the result of $name changed: hash $hash, and $expected in $3. If that is meant, tests/results/update $name writes it" >&2
  exit 1
fi
