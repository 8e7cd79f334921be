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
mkdir -p "$1/controllers"
cp -r "$user/templates/user_directory/." "$1/"
cp -r "$user/controllers/sample_footbot_controller" "$1/controllers/"
program=$user/../build/bin/swarmanoid
if [ -x "$program" ]; then program=$(realpath "$program"); else program=swarmanoid; fi
cat >&2 <<EOF
Made $1. Next:
  $1/build.sh
  $program run $1/experiments/sample_footbot.xml
EOF
