#!/usr/bin/env bash
# build.sh PREFIX PLUGINS FOLDER: a user directory FOLDER with the plug-ins of this suite, built by its own build.sh.
set -euo pipefail
rm -rf "$3"
PATH=$1/bin:$PATH
swarmanoid new user "$3" >/dev/null
rm -rf "$3"/controllers/* "$3"/functions/*
cp -r "$2"/* "$3"
cd "$3"
{
  ./build.sh &&
    cmake -S drivers -B simulation_build/drivers -DCMAKE_PREFIX_PATH="$1" &&
    cmake --build simulation_build/drivers
} >build.log 2>&1 || { cat build.log; exit 1; }
