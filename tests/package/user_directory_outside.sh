#!/usr/bin/env bash
# user_directory_outside.sh PREFIX: a user directory against the installed package.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/user_directory.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
PATH=$1/bin:$PATH
swarmanoid new user "$folder/mine"
TryUserDirectory "$folder/mine" "$1/share/swarmanoid/user/user_scripts"
