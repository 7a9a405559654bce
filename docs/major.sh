#!/usr/bin/env bash
# Prints the tables of docs/major.md as Markdown: docs/major.sh SIZE [MESH]. Images have SIZE x SIZE pixels, 256 in the document.
# Every box test is answered by the Verilog. The program is build/hitpipe.
set -euo pipefail
cd "$(dirname "$0")/.."
size=${1:-256}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# run DESIGN FORMAT SCENE: one row of figures under their names.
run() {
  build/hitpipe cosim "$1" --bits "$2" --scene "$3" --width "$size" --height "$size" --out "$out" --format csv 2>/dev/null
}
# field NAME
field() {
  awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) at = i } NR == 2 { print $at }'
}

units=('int_slabs 16/16' 'int_slabs 20/24' 'int_slabs 24/24' 'int_major 20+1/13' 'int_major_pair 20+1/13')
echo "Extra triangle tests, % more than the conservative software traversal ($size x $size, all rays):"
echo
printf '| scene |'
printf ' %s |' "${units[@]}"
printf '\n|---|'
printf -- '--:|%.0s' "${units[@]}"
echo
for scene in spheres plant_front plant_north plant_boiler poppy branch statue city city_oblique terrain ${2:+"$2"}; do
  printf '| %s |' "$(basename "$scene")"
  for unit in "${units[@]}"; do
    read -r design format <<<"$unit"
    result=$(run "$design" "$format" "$scene")
    [[ $(field rtl_mismatches <<<"$result") == 0 && $(field different_triangles <<<"$result") == 0 ]] || exit 1
    printf ' %.2f |' "$(field extra_triangle_tests_pct <<<"$result")"
  done
  echo
done
