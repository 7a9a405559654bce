#!/bin/sh
# Prints the table of docs/fit.md again. The bunny in its box is a mesh of your own; SIZE is the image's side.
# Run it at the root of the checkout: docs/fit.sh BUNNY_BOX [SIZE] [PROGRAM]
set -eu
bunny_box=${1:?give the bunny in its box, a mesh file}
size=${2:-128}
program=${3:-build/hitpipe}
out=out/fit
mkdir -p "$out"

echo "| scene | design | bits | dropped | mm² before | after | saved % | stages | node | extra tests % |"
echo "|---|---|---|---|---|---|---|---|---|---|"
# The columns by their names; those used stand before any that may hold a comma.
fit() {
  "$program" fit --scene "$@" --overhead 2 fp_slabs int_slabs fp_plucker \
    int_plucker fp_slabs_safe --width "$size" --height "$size" --out "$out" --format csv >"$out/rows.csv"
  awk -F, '
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    { sub(/^n/, "", $at["bits"])
      extra = sprintf("%.2f", $at["extra_box_tests_pct"])
      if (extra + 0 == 0) extra = "0.00"
      printf "| %s | %s | %s | %s | %.4f | %.4f | %.1f | %d to %d | %d | %s |\n", $at["scene"], $at["design"], $at["bits"],
        $at["design"] ~ /^fp/ ? "" : $at["dropped_bits"],
        $at["area_before_mm2"], $at["area_after_mm2"], $at["area_saved_pct"], $at["stages_before"], $at["stages"],
        $at["bytes_per_node"], extra }' "$out/rows.csv"
}
fit spheres --no-shadows
fit plant_slice
fit "$bunny_box"
fit waves
echo
echo "By \`docs/fit.sh bunny_box.ply\`, $("$program" --version | cut -d" " -f1,2)."
