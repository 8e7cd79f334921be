# Included by the scripts that ask: where the program is, and questions whose answers may be given as options instead.

Program()
{
  local user
  user=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
  for folder in "$user/../../../bin" "$user/../build/bin"; do
    if [ -x "$folder/swarmanoid" ]; then realpath "$folder/swarmanoid"; return; fi
  done
  command -v swarmanoid || { echo "$0: there is no program swarmanoid; build it first, or put it on the PATH" >&2; exit 1; }
}

# Rules for answers: a pattern, and what it means.
NAME=('^[a-z][a-z0-9_]*$' "small letters, digits and '_', starting with a letter")
CLASS=('^[A-Z][A-Za-z0-9_]*$' "letters, digits and '_', starting with a capital letter")
ROBOT=('^(footbot|handbot|eyebot)$' "footbot, handbot or eyebot")
YES_NO=('^(yes|no|y|n)$' "yes or no")

# Ask VARIABLE OPTION QUESTION DEFAULT RULE: leaves what an option has set; otherwise asks, an empty answer is the default. On a
# terminal a wrong answer is asked for again.
Ask()
{
  local -n variable=$1 rule=$5
  local given=$variable
  while true; do
    if [ -z "$given" ]; then
      if [ -t 0 ]; then printf '%s%s: ' "$3" "${4:+ [$4]}" >&2; fi
      variable="" # if the input has ended
      read -r variable || true
      variable=${variable:-$4}
      [ -n "$variable" ] || { echo "$0: no answer to: $3 (or give $2)" >&2; exit 2; }
    fi
    if [[ $variable =~ ${rule[0]} ]]; then return; fi
    echo "$0: '$variable' cannot be taken: it must be ${rule[1]}" >&2
    [ -z "$given" ] && [ -t 0 ] || exit 2
  done
}

# RequireUserDirectory: before anything is asked.
RequireUserDirectory()
{
  local folder=$PWD
  until [ -d "$folder/controllers" ] && [ -e "$folder/build.sh" ]; do
    if [ "$folder" = / ]; then
      echo "$0: this is no user directory; go to the folder controllers of one, or make one by: swarmanoid new user my_robots" >&2
      exit 2
    fi
    folder=$(dirname "$folder")
  done
}

# Camel "bt_wall_follower": BtWallFollower
Camel() { sed -E 's/(^|_)([a-z0-9])/\U\2/g' <<<"$1"; }
