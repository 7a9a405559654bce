#!/usr/bin/env bash
# kept_figures.sh PROGRAM DOCS: makes figures again and compares them with what is kept: docs/stiffness.md with its plot, and the
# table of docs/designs.md.
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

# Of every design whether it can miss a box, and its stages, "5 (24/24), 4 (20/24)" or those of its own format.
rows=$(sed -n 's/^| `\([a-z0-9_]*\)` | \[.* | \([0-9][^|]*\) | \(yes\|no\) |$/\1|\2|\3/p' "$docs/designs.md")
wrong=$(echo "$rows" | sed 's/|.*|yes$/,no/; s/|.*|no$/,yes/' | grep -vxF -f <("$program" designs --format csv | cut -d, -f1,3)) &&
  { echo "docs/designs.md: $wrong: wrong about missing boxes, or no design"; exit 1; }
[ "$(echo "$rows" | wc -l)" -ge 8 ] || { echo "docs/designs.md: its table is not read"; exit 1; }
echo "$rows" | while IFS='|' read -r design stages _; do
  echo "$stages" | sed 's/, /\n/g' | while read -r count format; do
    format=${format//[()]/}
    now=$("$program" area "$design" ${format:+--bits "$format"} --format csv | tail -n 1 | cut -d, -f3)
    [ "$count" = "$now" ] || { echo "docs/designs.md: $design $format has $now stages, not $count"; exit 1; }
  done
done
