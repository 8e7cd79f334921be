#!/usr/bin/env bash
# create_user_directory.sh DIRECTORY: makes a directory for a user's own controllers, with sample ones and an experiment.
set -euo pipefail
user=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
if [ $# -ne 1 ]; then
  echo "usage: $0 DIRECTORY" >&2
  exit 2
fi
if [ -e "$1" ]; then
  echo "$1 exists; choose another name, or remove it first" >&2
  exit 1
fi
mkdir -p "$1/controllers" "$1/functions"
cp -r "$user/templates/user_directory/." "$1/"
cp -r "$user/controllers/sample_footbot_controller" "$1/controllers/"
# What made the directory builds it: the installation that this script is part of, or the build of the source tree.
place=$user/../../..
if [ ! -x "$place/bin/swarmanoid" ]; then place=$user/../build; fi
realpath -m "$place" >"$1/.swarmanoid"
program=swarmanoid
command -v swarmanoid >/dev/null || program=$(realpath -m "$place/bin/swarmanoid")
cat >&2 <<EOM
Made $1. Next:
  $1/build.sh
  $program run $1/experiments/sample_footbot.xml
EOM
