#!/bin/sh
# Makes the report of docs/report.md again: its diagrams in docs/report/ and its table between the marks.
# Run it at the root of the checkout: docs/report.sh [PROGRAM]
set -eu
program=${1:-build/hitpipe}
out=out/report
"$program" report --scene spheres --width 64 --height 64 \
  --bits 24/32,24/28,24/24,20/28,20/24,20/20,16/24,16/20,16/16,12/12,10/12,8/8,20+1/13,16+1/12,12+1/10 --out "$out"
mkdir -p docs/report
cp "$out"/*.svg docs/report/

# Of rows.csv, with 32 rays in flight; the columns by their names.
awk -F, '
  /^#/ { next }
  $1 == "scene" { for (i = 1; i <= NF; ++i) at[$i] = i
    print "| unit | stages | area per box, mm² | false hits in a million | extra box tests, % | occupancy, % | run time, ms | area × run time, mm² ms |"
    print "|---|--:|--:|--:|--:|--:|--:|--:|"
    next }
  $at["rays_in_flight"] == 32 {
    unit = $at["bits"] == "fp32" ? $at["design"] : $at["design"] " " $at["bits"]
    extra = 100 * ($at["box_tests"] / $at["reference_box_tests"] - 1)
    if (extra < 0) extra = 0
    printf "| %s | %d | %.4f | %.0f | %.3f | %.2f | %.3f | %.3f |\n", unit, $at["stages"], $at["area_per_box_mm2"],
      $at["false_hits_per_million"], extra, $at["occupancy_pct"], $at["run_time_ms"], $at["area_run_time_mm2_ms"]
  }' "$out/rows.csv" >"$out/table.md"

awk -v table="$out/table.md" '
  /<!-- table -->/ { print; print ""; while ((getline line < table) > 0) print line; print ""; skip = 1; next }
  /<!-- end of table -->/ { skip = 0 }
  !skip { print }' docs/report.md >"$out/report.md"
mv "$out/report.md" docs/report.md
rm "$out/table.md"
