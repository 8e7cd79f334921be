#!/usr/bin/env bash
# Makes a behaviour. To be called in the folder of a behaviour controller (controllers/NAME of a user directory); the robot is
# that controller's. It asks for what no option tells:
#   --name NAME    files of the behaviour: small letters, digits and '_'
#   --class CLASS  its class
#   --yes          take the suggestions for all that is left
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/questions.sh"

name="" class="" suggestions=""
while [ $# -gt 0 ]; do
  case $1 in
    --name | --class)
      [ $# -ge 2 ] || { echo "$0: $1 needs a value" >&2; exit 2; }
      printf -v "${1#--}" %s "$2"
      shift 2
      ;;
    --yes) suggestions=yes; shift ;;
    -h | --help) sed -n '2,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
    *) echo "$0: no option '$1'; --help lists them" >&2; exit 2 ;;
  esac
done

program=$(Program)
if ! grep -qs 'CCI_BehaviorController<' ./*.h; then
  echo "$0: there is no behaviour controller in this folder; go to the folder controllers/NAME of one, or make one by create_behavior_controller.sh" >&2
  exit 2
fi
Ask name --name "File name of the behaviour, such as bt_footbot_stop" "" NAME
if [ -n "$suggestions" ]; then exec </dev/null; fi
Ask class --class "Its class name" "CBT$(Camel "${name#bt_}")" CLASS
exec "$program" new behavior "$name" --class "$class"
