#!/usr/bin/env bash
# A checkpoint of robots of a URDF file is restored with that file alone.
# urdf_changed.sh SWARMANOID CONFIGS
set -euo pipefail
swarmanoid=$1 configs=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/a"
cp -r "$configs/urdf_rover.xml" "$configs/urdf" "$folder/a"
cd "$folder"
run() { "$swarmanoid" run "$@" --single-process --quiet --ticks 200; }

whole=$(run a/urdf_rover.xml --output first --checkpoint-every 100 | grep -o 'hash [0-9a-f]*')

restored=$(run a/urdf_rover.xml --output second --restore first/checkpoint-00000100 | grep -o 'hash [0-9a-f]*')
[[ $whole == "$restored" ]] || { echo "restored to another $restored than $whole"; exit 1; }

sed -i 's|size="0.26 0.16 0.07"|size="0.28 0.16 0.07"|' a/urdf/rover.urdf
if run a/urdf_rover.xml --output third --restore first/checkpoint-00000100 2> errors; then
  echo 'restored with another URDF file'; exit 1
fi
grep -q "it was taken with .*file 'urdf/rover.urdf'" errors || { cat errors; exit 1; }

sed -i 's|<collision><geometry><box size="0.28 0.16 0.07"/>|<collision><geometry><mesh filename="a.stl"/>|' a/urdf/rover.urdf
if "$swarmanoid" check a/urdf_rover.xml > errors 2>&1; then echo 'a mesh collides that is not there'; exit 1; fi
grep -q "urdf/rover.urdf:20:26: the mesh 'a.stl': it is not there" errors || { cat errors; exit 1; }

# Meshes that collide count as well.
cp -r "$configs/stones.xml" "$configs/meshes" a
cp "$configs/urdf/"* a/urdf
run a/stones.xml --output stones --checkpoint-every 100 > log
for file in meshes/rock.glb urdf/scout.glb; do
  cp "a/$file" kept
  printf ' ' >> "a/$file"
  if run a/stones.xml --output other --restore stones/checkpoint-00000100 2> errors; then echo "restored with another $file"; exit 1; fi
  grep -q "it was taken with .*file '$file'" errors || { cat errors; exit 1; }
  cp kept "a/$file"
done
run a/stones.xml --output same --restore stones/checkpoint-00000100 > log
