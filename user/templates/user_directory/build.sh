#!/usr/bin/env bash
# build.sh [simulation|real_robot|all] [options of CMake]: builds this directory for the simulator into simulation_build/
# (the default), for the robots into real_robot_build/, or both. It builds against the Swarmanoid that made the directory; for
# another one name its place: ./build.sh -DCMAKE_PREFIX_PATH=/opt/swarmanoid
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

what=simulation
case ${1:-} in
  simulation | real_robot | all) what=$1; shift ;;
  -h | --help) sed -n '2,4s/^# //p' "${BASH_SOURCE[0]}"; exit 0 ;;
  "" | -*) ;;
  *) echo "build.sh: there is nothing called '$1' to build; it is simulation, real_robot or all" >&2; exit 2 ;;
esac

# Where Swarmanoid is: the one that made this directory, else the one whose programs are on the PATH.
place=$(cat .swarmanoid 2>/dev/null || true)
if [ ! -d "$place" ]; then
  program=$(command -v swarmanoid || true)
  place=${program:+$(dirname "$(dirname "$(realpath "$program")")")}
fi
export CMAKE_PREFIX_PATH=${place:-}${CMAKE_PREFIX_PATH:+:$CMAKE_PREFIX_PATH}
if command -v ninja >/dev/null; then export CMAKE_GENERATOR=Ninja; fi
# The second of two builds of the same files comes from the cache.
if command -v ccache >/dev/null; then export CMAKE_CXX_COMPILER_LAUNCHER=ccache; fi

Build()
{
  local folder=$1 log=$1/cmake.log
  shift
  mkdir -p "$folder"
  if ! cmake -S . -B "$folder" -DCMAKE_BUILD_TYPE=Release "$@" >"$log" 2>&1; then
    cat "$log" >&2
    if grep -q 'SwarmanoidConfig.cmake' "$log"; then
      echo "build.sh: Swarmanoid was not found. Put its programs on the PATH, or name the folder where it is installed:" >&2
      echo "  ./build.sh -DCMAKE_PREFIX_PATH=/opt/swarmanoid" >&2
    fi
    exit 1
  fi
  cmake --build "$folder" -j "$(nproc)"
}

if [ "$what" != real_robot ]; then Build simulation_build "$@"; fi
if [ "$what" != simulation ]; then Build real_robot_build -DREAL_ROBOT=ON "$@"; fi
