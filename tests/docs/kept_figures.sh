#!/usr/bin/env bash
# kept_figures.sh PROGRAM DOCS: makes the tables of docs/measured/stiffness.md and their plot again and compares.
set -euo pipefail
program=$1
docs=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$docs/measured/stiffness.md" "$folder"
"$docs/stiffness.sh" "$program" "$folder"
for file in stiffness.md stiffness.svg; do
  diff "$docs/measured/$file" "$folder/$file" || { echo "docs/measured/$file is stale; run docs/stiffness.sh"; exit 1; }
done
for part in boxes traversals; do
  rows=$(sed -n "/^<!-- $part -->/,/^<!-- end of $part -->/p" "$docs/measured/stiffness.md" | grep -c '^| 2^') || true
  [ "$rows" -ge 10 ] || { echo "docs/measured/stiffness.md: its table of $part is not read"; exit 1; }
done
