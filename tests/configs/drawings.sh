#!/usr/bin/env bash
# What experiment functions draw is the same in one process and as a cluster, keys change it, and no hash depends on it.
# drawings.sh SWARMANOID CONFIGS
set -euo pipefail
swarmanoid=$1 configs=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
sed 's|<image_render .*|<figure_render id="plan" file="plan.svg" ticks="200"/>|' "$configs/drawn_swarm.xml" > drawn_swarm.xml
hash_of() { "$swarmanoid" run "$@" --quiet --ticks 200 | grep -o 'hash [0-9a-f]*'; }
same() { [[ $1 == "$2" ]] || { echo "$3: $1 and $2"; exit 1; }; }
differ() { ! cmp -s "$1/plan.svg" "$2/plan.svg" || { echo "the plans of $1 and $2 are the same"; exit 1; }; }

one=$(hash_of drawn_swarm.xml --single-process --output one)
same "$one" "$(hash_of drawn_swarm.xml --controller-hosts 2 --output cluster)" 'one process and a cluster'
cmp one/plan.svg cluster/plan.svg

sed '/<experiment_functions>/,/<\/experiment_functions>/d' drawn_swarm.xml > plain.xml
same "$one" "$(hash_of plain.xml --single-process --output plain)" 'with drawings and without'
differ one plain

printf '150,press,C,\n160,select,fb_3,\n' > events.csv
same "$one" "$(hash_of drawn_swarm.xml --events events.csv --output keys)" 'with keys and without'
differ one keys
same "$one" "$(hash_of drawn_swarm.xml --single-process --events events.csv --output again)" 'with keys in one process'
cmp keys/plan.svg again/plan.svg

# Those who restore a checkpoint get no drawings of before.
hash_of drawn_swarm.xml --single-process --checkpoint-every 100 --output saved > saved.txt
same "$one" "$(hash_of drawn_swarm.xml --single-process --restore saved/checkpoint-00000100 --output restored)" 'restored'
