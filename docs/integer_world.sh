#!/usr/bin/env bash
# Prints the table of docs/measured/integer_world.md as Markdown: docs/integer_world.sh SIZE. Images have SIZE x SIZE pixels, 128
# in the document. The program is build/hitpipe.
set -euo pipefail
cd "$(dirname "$0")/.."
size=${1:-128}
rows=$(mktemp --suffix=.csv)
trap 'rm -f "$rows"' EXIT

echo '| scene | format | triangles lost | largest movement | other rays, % | other pixels | extra boxes, %: p = 9 | 11 | 13 | extra triangles, %: p = 9 | 11 | 13 |'
echo '|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|'
for scene in $(build/hitpipe list scenes --format csv | tail -n +2 | cut -d, -f1); do
  build/hitpipe sweep int_triangle --scene "$scene" --width "$size" --height "$size" --out "$rows" >/dev/null
  awk -F, '
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    {
      boxes = boxes sprintf(" %.2f |", $at["extra_box_tests_pct"])
      triangles = triangles sprintf(" %.2f |", $at["extra_triangle_tests_pct"])
    }
    NR % 3 == 1 {
      printf "| %s | %s | %d | %.2g | %.4f | %d |%s%s\n", $at["scene"], $at["bits"], $at["lost_to_rounding"],
             $at["largest_movement"], $at["different_rays_pct"], $at["different_pixels"], boxes, triangles
      boxes = triangles = ""
    }' "$rows"
done
echo
echo "By \`docs/integer_world.sh $size\`, $(build/hitpipe --version | head -n 1 | cut -d" " -f1,2)."
