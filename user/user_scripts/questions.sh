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

# Ask VARIABLE OPTION QUESTION DEFAULT: leaves what an option has set; otherwise asks, an empty answer is the default.
Ask()
{
  local -n variable=$1
  [ -z "$variable" ] || return 0
  if [ -t 0 ]; then printf '%s%s: ' "$3" "${4:+ [$4]}" >&2; fi
  read -r variable || true
  variable=${variable:-$4}
  [ -n "$variable" ] || { echo "$0: no answer to: $3 (or give $2)" >&2; exit 2; }
}

# Camel "bt_wall_follower": BtWallFollower
Camel() { sed -E 's/(^|_)([a-z0-9])/\U\2/g' <<<"$1"; }
