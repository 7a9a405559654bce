#!/usr/bin/env bash
# kept_figures.sh PROGRAM SOURCE: makes the pages again that a script in docs/ makes in seconds, and compares.
set -euo pipefail
program=$1
source=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$source"
cp --parents -t "$folder" README.md docs/{core,formal}.md docs/measured/{chips,scenes,stiffness,units}.md docs/measured/stiffness.csv
"$source/docs/stiffness.sh" "$program" "$folder/docs/measured"
"$source/docs/units.py" "$program" "$folder"
"$source/docs/registers.py" "$program" "$folder"
"$source/docs/features.py" "$program" "$folder"
any_version='s/hitpipe [0-9]+\.[0-9]+\.[0-9]+/hitpipe VERSION/'
for page in README.md docs/{core,formal}.md docs/measured/{stiffness,units}.md docs/measured/stiffness.csv; do
  # The version is the one that made the page; figures alone are compared.
  diff <(sed -E "$any_version" "$source/$page") <(sed -E "$any_version" "$folder/$page") || { echo "$page is stale; run docs/stiffness.sh, docs/units.py, docs/registers.py and docs/features.py"; exit 1; }
done
for part in boxes traversals; do
  rows=$(sed -n "/^<!-- $part -->/,/^<!-- end of $part -->/p" "$folder/docs/measured/stiffness.md" | grep -c '^| 2^') || true
  [ "$rows" -ge 10 ] || { echo "docs/measured/stiffness.md: its table of $part is not read"; exit 1; }
done
rows=$(grep -cE '^\| (fp|int)_' "$folder/docs/measured/units.md")
[ "$rows" -ge 38 ] || { echo "docs/measured/units.md: only $rows rows"; exit 1; }
rows=$(grep -cE '^\| 0x[0-9a-f]+ \| `' "$folder/docs/core.md")
[ "$rows" -ge 34 ] || { echo "docs/core.md: only $rows registers"; exit 1; }
rows=$(sed -n "/^<!-- failures -->/,/^<!-- end of failures -->/p" "$folder/docs/core.md" | grep -c "^| ")
[ "$rows" -ge 21 ] || { echo "docs/core.md: only $rows faults"; exit 1; }
