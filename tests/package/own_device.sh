#!/usr/bin/env bash
# own_device.sh PREFIX: the sensor that `swarmanoid new device` makes, built against the installed package and used by a controller.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
PATH=$1/bin:$PATH
export SWARMANOID_SHARED_FOLDER=/dev/shm/swarmanoid-test-$$
swarmanoid new user "$folder/mine"
rm -r "$folder"/mine/controllers/* "$folder"/mine/functions/*
cd "$folder/mine"
swarmanoid new device compass
./build.sh

echo "== it is listed, checked and refused like the others"
listed=$(swarmanoid list plugins simulation_build/devices/libcompass.so)
grep -q 'compass / pose_compass .*the heading in the arena (generic)' <<<"$listed"
swarmanoid check experiments/compass.xml
sed '/<noise_kind>/d' experiments/compass.xml >experiments/wrong.xml
wrong=$(swarmanoid check experiments/wrong.xml 2>&1) && exit 1
grep -q "wrong.xml:.*'noise_deviation' of <compass> has no effect without 'noise_kind'" <<<"$wrong"
sed 's/<implementation>pose_/<implementation>pos_/' experiments/compass.xml >experiments/wrong.xml
wrong=$(swarmanoid check experiments/wrong.xml 2>&1) && exit 1
grep -q "did you mean 'pose_compass'" <<<"$wrong"

echo "== the robots go north by it, the same ways in one process and as a cluster with two hosts"
swarmanoid run experiments/compass.xml --single-process --output one | tee one.txt
swarmanoid run experiments/compass.xml --controller-hosts 2 --output two | tee two.txt
[ "$(grep -oE 'hash [0-9a-f]{16}' one.txt)" = "$(grep -oE 'hash [0-9a-f]{16}' two.txt)" ]
awk '$1 == 200 && $2 == "Footbot" { n++; if ($NF < 80 || $NF > 100) bad = 1 } END { exit n != 4 || bad }' one/compass.txt
