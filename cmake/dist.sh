#!/bin/bash
# dist.sh FOLDER: the last commit as FOLDER/hitpipe-VERSION.tar.gz. It builds and tests without git. The file SOURCES in it is the first
# line of `hitpipe --version` of what is built from it.
set -euo pipefail
mkdir -p "$1"
folder=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
version=$(git show HEAD:CMakeLists.txt | sed -n 's/^project(hitpipe VERSION \([0-9.]*\).*/\1/p')
name=hitpipe-$version
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
git archive HEAD | tar -x -C "$tree"
folders=$(sed -n 's/^hitpipe_sources_hash([^ ]* \(.*\))/\1/p' "$tree/cli/CMakeLists.txt")
hash=$(cmake -DSOURCE="$tree" -DFOLDERS="$folders" -P "$tree/cmake/HitpipeSourcesHash.cmake" 2>&1)
git archive --format=tar --prefix="$name/" --add-virtual-file="$name/SOURCES:hitpipe $version ($hash)" HEAD | gzip -9n > "$folder/$name.tar.gz"
echo "$folder/$name.tar.gz: hitpipe $version ($hash)"
