#!/usr/bin/env bash
# create_user_directory.sh DIRECTORY: makes a directory for a user's own controllers, with samples to run and to change.
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
mkdir -p "$1/controllers" "$1/functions" "$1/experiments"
cp -r "$user/templates/user_directory/." "$1/"
for controller in sample_footbot_controller footbot_diffusion prey_retrieval; do
  cp -r "$user/controllers/$controller" "$1/controllers/"
done
cp -r "$user/functions/prey_retrieval_goal" "$1/functions/"
# The experiments of the samples, with the libraries that are built here.
paths='    <controller_path>../simulation_build/controllers</controller_path>\n    <plugin_path>../simulation_build/functions</plugin_path>'
for experiment in sample_footbot diffusion_10 prey_retrieval; do
  sed "s|^ *<framework>|&\n$paths|" "$user/../configs/$experiment.xml" >"$1/experiments/$experiment.xml"
done
# The installation that contains this script, or the build of the source tree, also builds the directory.
place=$user/../../..
if [ ! -x "$place/bin/swarmanoid" ]; then place=$user/../build; fi
realpath -m "$place" >"$1/.swarmanoid"
program=swarmanoid
command -v swarmanoid >/dev/null || program=$(realpath -m "$place/bin/swarmanoid")
# The lines can be pasted, also if a path has spaces.
{
  printf 'Made %s. Next:\n' "$1"
  printf '  %q\n' "$1/build.sh"
  printf '  %q run %q\n' "$program" "$1/experiments/sample_footbot.xml"
} >&2
