#!/usr/bin/env bash
# Makes a behaviour controller: a controller class, its root behaviour, and if wanted an experiment with it. To be called in
# the folder controllers/ of a user directory. It asks for what no option tells:
#   --name NAME            files of the controller: small letters, digits and '_'
#   --class CLASS          class of the controller
#   --behavior NAME        files of the root behaviour
#   --behavior-class CLASS class of the root behaviour
#   --robot ROBOT          footbot, handbot or eyebot
#   --experiment, --no-experiment
#   --yes                  take the suggestions for all that is left
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/questions.sh"

name="" class="" behavior="" behavior_class="" robot="" experiment="" suggestions=""
while [ $# -gt 0 ]; do
  case $1 in
    --name | --class | --behavior | --behavior-class | --robot)
      [ $# -ge 2 ] || { echo "$0: $1 needs a value" >&2; exit 2; }
      variable=${1#--}
      printf -v "${variable//-/_}" %s "$2"
      shift 2
      ;;
    --experiment) experiment=yes; shift ;;
    --no-experiment) experiment=no; shift ;;
    --yes) suggestions=yes; shift ;;
    -h | --help) sed -n '2,11s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
    *) echo "$0: no option '$1'; --help lists them" >&2; exit 2 ;;
  esac
done

program=$(Program)
RequireUserDirectory
Ask name --name "File name of the controller, such as wall_follower" "" NAME
if [ -n "$suggestions" ]; then exec </dev/null; fi
Ask robot --robot "Robot: footbot, handbot or eyebot" footbot ROBOT
Ask class --class "Class name of the controller" "C$(Camel "$name")" CLASS
Ask behavior --behavior "File name of its root behaviour" "bt_${robot}_$name" NAME
Ask behavior_class --behavior-class "Class name of its root behaviour" "CBT$(Camel "${behavior#bt_}")" CLASS
Ask experiment --experiment "Make an experiment XML with it? (yes, no)" yes YES_NO
options=()
if [[ $experiment = n* ]]; then options=(--no-experiment); fi
exec "$program" new behavior-controller "$name" --robot "$robot" --class "$class" --behavior "$behavior" \
  --behavior-class "$behavior_class" "${options[@]}"
