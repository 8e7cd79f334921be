#!/usr/bin/env bash
# user_directory_inside.sh SOURCE BUILD: a user directory in the folder user/ of the source tree, as build_framework makes it.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/user_directory.sh"
directory=$1/user/test_$$
trap 'rm -rf "$directory"' EXIT
PATH=$2/bin:$PATH
"$2/share/swarmanoid/user/user_scripts/create_user_directory.sh" "$directory"
TryUserDirectory "$directory" "$1/user/user_scripts"
