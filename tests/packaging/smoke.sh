#!/usr/bin/env bash
# smoke.sh README NOTEBOOKS_TEST: what a user does first with the installed packages; `swarmanoid` is on the PATH. README has the hash
# of the sample, and NOTEBOOKS_TEST runs the notebooks. SWARMANOID_PREFIX: where the packages are, if not in /usr.
set -euo pipefail
readme=$(realpath "$1")
notebooks_test=$(realpath "$2")
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

# Hash EXPERIMENT OUTPUT [OPTIONS]: runs 50 ticks. Some experiments have a goal that they do not reach (exit code 1).
Hash()
{
  local experiment=$1 output=$2 said
  shift 2
  said=$(swarmanoid run "$experiment" --ticks 50 --quiet --output "$output" "$@") || [ $? -eq 1 ]
  grep -oE 'hash [0-9a-f]{16}' <<<"$said"
}

echo "== the examples of the pages build, by CMake, and run as a cluster and in one process alike"
cp -r "$prefix/share/doc/swarmanoid/examples" .
cp -r examples/own_code mine
(cd mine && ./build.sh >build.txt 2>&1 || { cat build.txt; exit 1; })
for experiment in mine/experiments/*; do
  name=$(basename "${experiment%.*}")
  swarmanoid check "$experiment" >/dev/null
  [ "$(Hash "$experiment" "$name")" = "$(Hash "$experiment" "$name-one" --single-process)" ]
  echo "$name"
done

echo "== a controller builds by pkg-config, too"
by_cmake=$(Hash mine/experiments/walker.xml by_cmake)
rm mine/simulation_build/controllers/libwalker.so
# shellcheck disable=SC2046
${CXX:-c++} -shared -fPIC -O2 -Imine mine/controllers/walker/*.cpp -o mine/simulation_build/controllers/libwalker.so \
  $(pkg-config --cflags --libs swarmanoid)
[ "$by_cmake" = "$(Hash mine/experiments/walker.xml by_pkg_config)" ]

module=$prefix/lib/python3/dist-packages
if [ -d "$module/swarmanoid" ]; then
  echo "== the module of Python: the same bits, and the folder of a run"
  [ "$prefix" = /usr ] || export PYTHONPATH=$module PYTHONDONTWRITEBYTECODE=1
  by_python=$(/usr/bin/python3 -c "
import swarmanoid
assert swarmanoid.__file__.startswith('$module/'), swarmanoid.__file__
assert len(swarmanoid.Run('by_cmake').journal(['x'])) > 0
print('hash', swarmanoid.Simulation('mine/experiments/walker.xml', {'framework.maxclock': 50}).run().hash)")
  [ "$by_cmake" = "$by_python" ]

  echo "== the notebooks run"
  NOTEBOOKS=$folder/examples/notebooks /usr/bin/python3 -m unittest discover -q \
    -s "$(dirname "$notebooks_test")" -p "$(basename "$notebooks_test")"
fi

echo "== the packages are good"
