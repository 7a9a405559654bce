#!/usr/bin/env bash
# kept_figures.sh PROGRAM DOCS: makes the figures of docs/stiffness.md and its plot again and compares them with what is kept.
set -euo pipefail
program=$1
docs=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$docs/stiffness.md" "$folder"
"$docs/stiffness.sh" "$program" "$folder"
for file in stiffness.md stiffness.svg; do
  diff "$docs/$file" "$folder/$file" || { echo "docs/$file is stale; run docs/stiffness.sh"; exit 1; }
done
