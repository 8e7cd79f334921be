#!/usr/bin/env bash
# install.sh CMAKE BUILD_FOLDER PREFIX: installs, and moves what was installed: nothing may remember where it was built or installed.
set -euo pipefail
rm -rf "$3" "$3.first"
"$1" --install "$2" --prefix "$3.first" >/dev/null
mv "$3.first" "$3"
