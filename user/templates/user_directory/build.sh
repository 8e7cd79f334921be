#!/usr/bin/env bash
# Builds the controllers of this directory into simulation_build/controllers. Options go to CMake: where Swarmanoid is neither
# in the folder above nor installed where CMake looks, name its place: ./build.sh -DCMAKE_PREFIX_PATH=/opt/swarmanoid
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source_tree_build=$PWD/../../build
if [ -f "$source_tree_build/SwarmanoidConfig.cmake" ]; then set -- -DSwarmanoid_DIR="$source_tree_build" "$@"; fi
if command -v ninja >/dev/null; then export CMAKE_GENERATOR=Ninja; fi
cmake -S . -B simulation_build -DCMAKE_BUILD_TYPE=Release "$@"
cmake --build simulation_build -j "$(nproc)"
