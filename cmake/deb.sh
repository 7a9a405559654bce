#!/bin/bash
# deb.sh FOLDER: Debian packages of the last commit, in FOLDER with lintian's words.
set -euo pipefail
rm -rf "$1"
mkdir -p "$1/source"
folder=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
cmake/install-packages.sh --groups build simulate
cmake/install-packages.sh debhelper dh-python lintian
git archive HEAD | tar -x -C "$folder/source"
cd "$folder/source"
dpkg-buildpackage -us -uc -b > "$folder/build.log" 2>&1 || {
  tail -n 20 "$folder/build.log" >&2
  exit 1
}
cd "$folder"
rm -rf source
lintian --fail-on error --tag-display-limit 0 "$folder"/*.changes | tee "$folder/lintian.log"
ls "$folder"/*.deb
