#!/usr/bin/env bash
# outside_controller.sh CMAKE BUILD_FOLDER BIN: a newcomer's way from the installed package to a running controller.
set -euo pipefail
cmake=$1 build=$2 bin=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

echo "== install, and move: nothing may remember where it was built or installed"
"$cmake" --install "$build" --prefix "$folder/first" >/dev/null
mv "$folder/first" "$folder/prefix"

echo "== a user directory elsewhere builds against it"
"$folder/prefix/share/swarmanoid/user/user_scripts/create_user_directory.sh" "$folder/user"
"$folder/user/build.sh" -DCMAKE_PREFIX_PATH="$folder/prefix"
grep -q SWARMANOID_VERSION "$folder/user/config.h"

echo "== its experiment is valid and runs"
cd "$folder"
"prefix/$bin/swarmanoid" check user/experiments/sample_footbot.xml
"prefix/$bin/swarmanoid" run user/experiments/sample_footbot.xml --single-process --output run | tee output.txt
tail -n 1 output.txt | grep -qE '^finished: 962 ticks, 1 entities, hash [0-9a-f]{16}, '

echo "== so does an installed sample, as a cluster of the installed programs"
"prefix/$bin/swarmanoid" run prefix/share/swarmanoid/configs/sample_footbot.xml --output cluster | tee cluster.txt
[ "$(grep -oE 'hash [0-9a-f]{16}' cluster.txt)" = "$(grep -oE 'hash [0-9a-f]{16}' output.txt)" ]
