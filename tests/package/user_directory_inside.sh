#!/usr/bin/env bash
# user_directory_inside.sh SOURCE BUILD: a user directory in the folder user/ of the source tree, as build_framework makes it. It uses the
# build tree; the test of a directory outside makes everything else.
set -euo pipefail
directory=$1/user/test_$$
runs=$(mktemp -d)
trap 'rm -rf "$directory" "$runs"' EXIT
export SWARMANOID_SHARED_FOLDER=/dev/shm/swarmanoid-test-$$
PATH=$2/bin:$PATH
"$2/share/swarmanoid/user/user_scripts/create_user_directory.sh" "$directory"
cd "$directory/controllers"
"$1/user/user_scripts/create_behavior_controller.sh" --name climber --robot handbot --experiment --yes
(cd climber && "$1/user/user_scripts/create_behavior.sh" --name bt_hold --yes)
swarmanoid new device compass
swarmanoid new functions spreading
swarmanoid new engine gliding
swarmanoid new renderer plan
cd "$directory"
./build.sh all >"$runs/build.txt" 2>&1 || { cat "$runs/build.txt"; exit 1; }
for experiment in climber compass gliding plan; do
  swarmanoid run "experiments/$experiment.xml" --ticks 60 --quiet --single-process --output "$runs/$experiment" | tee "$runs/command.txt"
  simulation_build/simulation "experiments/$experiment.xml" --ticks 60 --quiet --output "$runs/$experiment-own" | tee "$runs/own.txt"
  [ "$(grep -oE 'hash [0-9a-f]{16}' "$runs/command.txt")" = "$(grep -oE 'hash [0-9a-f]{16}' "$runs/own.txt")" ]
done
swarmanoid_robot experiments/climber.xml --controller controller --robot hb --controller-path real_robot_build/controllers --check
