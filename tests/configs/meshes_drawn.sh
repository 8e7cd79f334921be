#!/usr/bin/env bash
# Meshes of users are drawn by the visualisers of a cluster and change nothing else: neither the hash nor what a checkpoint may be
# restored with. A file that cannot be read is named.
# meshes_drawn.sh SWARMANOID CONFIGS
set -euo pipefail
swarmanoid=$1 configs=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp -r "$configs/meshes.xml" "$configs/meshes" "$configs/urdf" "$folder"
cd "$folder"
run() { "$swarmanoid" run "$@" --quiet --ticks 200; }
hash_of() { grep -o 'hash [0-9a-f]*'; }
sed -i 's|<text_render .*|<figure_render id="plan" file="plan.svg" ticks="200"/>|' meshes.xml

drawn=$(run meshes.xml --output drawn --checkpoint-every 100 | hash_of)
plan=$(find drawn -name 'plan*.svg' | tail -n 1)
[ -s "$plan" ] || { echo 'no plan was drawn'; exit 1; }

sed -E 's| mesh="[^"]*"||' meshes.xml > plain.xml
plain=$(run plain.xml --output plain --single-process | hash_of)
[[ $drawn == "$plain" ]] || { echo "$drawn with meshes, $plain without"; exit 1; }
! cmp -s "$plan" "$(find plain -name 'plan*.svg' | tail -n 1)" || { echo 'the plan shows no meshes'; exit 1; }

cp meshes/rock.glb whole.glb
head -c 200 whole.glb > meshes/rock.glb
if run meshes.xml --output bad --single-process 2> errors; then echo 'half a mesh was drawn'; exit 1; fi
grep -q "meshes.xml:[0-9]*:[0-9]*: '.*meshes/rock.glb': .*cut off" errors || { cat errors; exit 1; }
rm meshes/rock.glb
if "$swarmanoid" check meshes.xml 2> errors; then echo 'a mesh that is not there was not missed'; exit 1; fi
grep -q "meshes/rock.glb': there is no such file" errors || { cat errors; exit 1; }

# Another mesh is another picture of the same run.
cp urdf/scout.glb meshes/rock.glb
restored=$(run meshes.xml --output restored --single-process --restore drawn/checkpoint-00000100 | hash_of)
[[ $drawn == "$restored" ]] || { echo "restored to another $restored than $drawn"; exit 1; }
