#!/bin/sh
# Makes the report of docs/choosing.md again: its diagrams in docs/report/, and its table between the marks of
# docs/measured/spheres.md.
# Run it at the root of the checkout: docs/report.sh [PROGRAM]
set -eu
program=${1:-build/hitpipe}
out=out/report
"$program" report --scene spheres --width 64 --height 64 \
  --bits 24/32,24/28,24/24,20/28,20/24,20/20,16/24,16/20,16/16,12/12,10/12,8/8,20+1/13,16+1/12,12+1/10,e8m23,e8m15,e8m7,e5m10 --out "$out"
mkdir -p docs/report
# The diagrams that the page shows.
grep -o 'report/[a-z_]*\.svg' docs/choosing.md | sort -u | while read -r diagram; do cp "$out/${diagram#report/}" "docs/$diagram"; done

# Of rows.csv, with 32 rays in flight; the columns by their names.
awk -F, '
  /^#/ { next }
  $1 == "scene" { for (i = 1; i <= NF; ++i) at[$i] = i
    print "| unit | area per box, mm² | extra box tests, % | extra triangle tests, % | run time, ms | whole | area × run time, mm² ms | whole | bytes a ray |"
    print "|---|--:|--:|--:|--:|--:|--:|--:|--:|"
    next }
  $at["rays_in_flight"] == 32 {
    unit = $at["bits"] == "fp32" ? $at["design"] : $at["design"] " " $at["bits"]
    printf "| %s | %.4f | %.3f | %.2f | %.3f | %.3f | %.3f | %.3f | %.0f |\n", unit, $at["area_per_box_mm2"],
      $at["extra_box_tests_pct"] + 0, $at["extra_triangle_tests_pct"] + 0, $at["run_time_ms"], $at["whole_run_time_ms"],
      $at["area_run_time_mm2_ms"], $at["whole_area_run_time_mm2_ms"], $at["bytes_per_ray"]
  }' "$out/rows.csv" >"$out/table.md"

awk -v table="$out/table.md" '
  /<!-- table -->/ { print; print ""; while ((getline line < table) > 0) print line; print ""; skip = 1; next }
  /<!-- end of table -->/ { skip = 0 }
  !skip { print }' docs/measured/spheres.md >"$out/spheres.md"
mv "$out/spheres.md" docs/measured/spheres.md
rm "$out/table.md"
