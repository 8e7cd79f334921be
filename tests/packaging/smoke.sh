#!/usr/bin/env bash
# smoke.sh README: what somebody does first with the installed packages; `swarmanoid` is on the PATH. README holds the hash of the
# sample. SWARMANOID_PREFIX: where the packages are, if not in /usr.
set -euo pipefail
readme=$(realpath "$1")
prefix=${SWARMANOID_PREFIX:-/usr}
samples=$prefix/share/swarmanoid/configs
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

echo "== the version, and which programs are there"
swarmanoid --version
for program in space_server engine_worker controller_host visualiser; do "$prefix/libexec/swarmanoid/$program" --version; done

echo "== a sample is valid, and ends with the hash of the README as a cluster"
swarmanoid check "$samples/prey_retrieval.xml"
swarmanoid run "$samples/prey_retrieval.xml" --output run | tee run.txt
[ "$(grep -oE 'hash [0-9a-f]{16}' run.txt)" = "$(grep -m1 -oE 'hash [0-9a-f]{16}' "$readme")" ]
grep -q '"revision"' run/manifest.json

echo "== a controller of one's own, by CMake"
swarmanoid new user mine
(
  cd mine
  rm -r controllers/* functions/*
  swarmanoid new controller first_steps
  ./build.sh >build.txt 2>&1 || { cat build.txt; exit 1; }
)
by_cmake=$(swarmanoid run mine/experiments/first_steps.xml --ticks 50 --quiet --output by_cmake | grep -oE 'hash [0-9a-f]{16}')

echo "== and by pkg-config"
rm mine/simulation_build/controllers/libfirst_steps.so
# shellcheck disable=SC2046
${CXX:-c++} -shared -fPIC -O2 -Imine mine/controllers/first_steps/*.cpp -o mine/simulation_build/controllers/libfirst_steps.so \
  $(pkg-config --cflags --libs swarmanoid)
by_pkg_config=$(swarmanoid run mine/experiments/first_steps.xml --ticks 50 --quiet --output by_pkg_config | grep -oE 'hash [0-9a-f]{16}')
[ "$by_cmake" = "$by_pkg_config" ]

module=$prefix/lib/python3/dist-packages
if [ -d "$module/swarmanoid" ]; then
  echo "== the module of Python: the same bits, and the folder of a run"
  [ "$prefix" = /usr ] || export PYTHONPATH=$module PYTHONDONTWRITEBYTECODE=1
  by_python=$(/usr/bin/python3 -c "
import swarmanoid
assert swarmanoid.__file__.startswith('$module/'), swarmanoid.__file__
assert len(swarmanoid.Run('by_cmake').journal(['x'])) > 0
print('hash', swarmanoid.Simulation('mine/experiments/first_steps.xml', {'framework.maxclock': 50}).run().hash)")
  [ "$by_cmake" = "$by_python" ]
fi

echo "== the packages are good"
