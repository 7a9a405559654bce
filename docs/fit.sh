#!/bin/sh
# Prints the tables of docs/fit.md again. The bunny in its box is a mesh of your own; SIZE is the image's side.
# Run it at the root of the checkout: docs/fit.sh BUNNY_BOX [SIZE] [PROGRAM]
set -eu
bunny_box=${1:?give the bunny in its box, a mesh file}
size=${2:-128}
program=${3:-build/hitpipe}
out=out/fit
mkdir -p "$out"

# fit FILE SCENE OPTION...: appends a row for each design, with the area of the whole design at the bits that the
# fit chose, as column `whole`. Columns are found by their names; those used stand before any that may hold a comma.
fit() {
  file=$1
  shift
  "$program" fit --scene "$@" --width "$size" --height "$size" --out "$out" --format csv >"$out/rows.csv"
  tail -n +2 "$out/rows.csv" | while IFS=, read -r design bits _; do
    "$program" area "$design" --bits "${bits#n}" --format csv |
      awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i } NR == 2 { print $at["area_mm2"] }'
  done >"$out/whole.csv"
  awk 'FNR == 1 && NR == 1 { print "whole," $0 }' "$out/rows.csv" >"$out/head.csv"
  tail -n +2 "$out/rows.csv" | paste -d, "$out/whole.csv" - | cat "$out/head.csv" - >>"$out/$file"
}

# The rows of FILE through an awk program that knows each column's place.
table() {
  awk -F, '
    function dropped() { return $at["design"] ~ /^int_(slabs|plucker)/ ? $at["dropped_bits"] : "" }
    function of(name, digits, text) { text = sprintf("%.*f", digits, $at[name]); return text + 0 == 0 ? sprintf("%.*f", digits, 0) : text }
    function pruned(saved) { saved = 100 - 100 * $at["area_after_mm2"] / $at["whole"]; return sprintf("%.1f", saved < 0.05 ? 0 : saved) }
    $1 == "whole" { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    { sub(/^n/, "", $at["bits"]); sub(/^n/, "", $at["bits_before"]) }
    '"$2" "$out/$1"
}

rm -f "$out/limit.csv" "$out/cost.csv"
for scene in "spheres --no-shadows" plant_slice "$bunny_box" waves; do
  # shellcheck disable=SC2086
  fit limit.csv $scene --overhead 2 fp_slabs int_slabs fp_plucker int_plucker fp_slabs_safe int_major int_major_pair
  # shellcheck disable=SC2086
  fit cost.csv $scene int_slabs fp_slabs_safe int_major int_major_pair
done

echo "| scene | design | bits | dropped | mm² before | after | saved % | pruned % | stages | node | extra tests % |"
echo "|---|---|---|---|---|---|---|---|---|---|---|"
table limit.csv '{ printf "| %s | %s | %s | %s | %s | %s | %s | %s | %d to %d | %d | %s |\n", $at["scene"], $at["design"],
  $at["bits"], dropped(), of("area_before_mm2", 4), of("area_after_mm2", 4), of("area_saved_pct", 1), pruned(),
  $at["stages_before"], $at["stages"], $at["bytes_per_node"], of("extra_box_tests_pct", 2) }'
echo
echo "| scene | design | before | cost | bits | dropped | cost | mm² | pruned % | extra box % | triangle % |"
echo "|---|---|---|--:|---|---|--:|--:|--:|--:|--:|"
table cost.csv '{ printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", $at["scene"], $at["design"],
  $at["bits_before"], of("search_cost_before", 3), $at["bits"], dropped(), of("search_cost", 3),
  of("area_after_mm2", 4), pruned(), of("extra_box_tests_pct", 2), of("extra_triangle_tests_pct", 2) }'
echo
echo "By \`docs/fit.sh bunny_box.ply\`, $("$program" --version | head -n 1 | cut -d" " -f1,2)."
