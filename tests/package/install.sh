#!/usr/bin/env bash
# install.sh CMAKE BUILD_FOLDER PREFIX: installs, and moves what was installed: nothing may remember where it was built or installed.
# "PREFIX in a folder" is a copy whose path has spaces.
set -euo pipefail
rm -rf "$3" "$3.first" "$3 in a folder"
"$1" --install "$2" --prefix "$3.first" >/dev/null
mv "$3.first" "$3"
cp -al "$3" "$3 in a folder"
