#!/usr/bin/env bash
# outside_controller.sh PREFIX BIN: a newcomer's way from the installed package to a running controller, nothing on the PATH.
set -euo pipefail
prefix=$1 bin=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

echo "== a user directory elsewhere builds against it"
"$prefix/share/swarmanoid/user/user_scripts/create_user_directory.sh" "$folder/user"
"$folder/user/build.sh"
grep -q SWARMANOID_VERSION "$folder/user/config.h"

echo "== its experiment is valid and runs"
cd "$folder"
"$prefix/$bin/swarmanoid" check user/experiments/sample_footbot.xml
"$prefix/$bin/swarmanoid" run user/experiments/sample_footbot.xml --single-process --output run | tee output.txt
tail -n 1 output.txt | grep -qE '^finished: 962 ticks, 1 entities, hash [0-9a-f]{16}, '

echo "== its controller also builds by pkg-config, as docs/installing.md says for paths with spaces"
library=$folder/user/simulation_build/controllers/libsample_footbot_controller.so
rm "$library"
PKG_CONFIG_PATH=$(find "$prefix"/lib* -name pkgconfig)
export PKG_CONFIG_PATH
eval "${CXX:-c++} -shared -fPIC -O2 -Iuser user/controllers/sample_footbot_controller/*.cpp -o '$library' $(pkg-config --cflags --libs swarmanoid)"
"$prefix/$bin/swarmanoid" run user/experiments/sample_footbot.xml --single-process --output again | tail -n 1 >again.txt
[ "$(grep -oE 'hash [0-9a-f]{16}' again.txt)" = "$(grep -oE 'hash [0-9a-f]{16}' output.txt)" ]

echo "== so does an installed sample, as a cluster of the installed programs"
"$prefix/$bin/swarmanoid" run "$prefix/share/swarmanoid/configs/sample_footbot.xml" --output cluster | tee cluster.txt
[ "$(grep -oE 'hash [0-9a-f]{16}' cluster.txt)" = "$(grep -oE 'hash [0-9a-f]{16}' output.txt)" ]

echo "== without Swarmanoid the build says what to do"
echo /nowhere >user/.swarmanoid
rm -r user/simulation_build
if PATH=/usr/bin:/bin user/build.sh >missing.txt 2>&1; then exit 1; fi
grep -q 'CMAKE_PREFIX_PATH=/opt/swarmanoid' missing.txt
"$folder/user/build.sh" -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
