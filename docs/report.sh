#!/bin/sh
# Makes the report of docs/choosing.md again: its diagrams in docs/report/, and its table between the marks of
# docs/measured/spheres.md.
# Run it at the root of the checkout: docs/report.sh [PROGRAM]
set -eu
program=${1:-build/hitpipe}
out=out/report
"$program" report --scene spheres --width 64 --height 64 \
  --bits 24/32,24/28,24/24,20/28,20/24,20/20,16/24,16/20,16/16,12/12,10/12,8/8,20+1/13,16+1/12,12+1/10,e8m23,e8m15,e8m7,e5m10 \
  --without images,pipelines,stability,stiff,world,core,schematics --out "$out"
mkdir -p docs/report
# The diagrams that the page shows.
grep -o 'report/[a-z_]*\.svg' docs/choosing.md | sort -u | while read -r diagram; do cp "$out/${diagram#report/}" "docs/$diagram"; done

# Of rows.csv, with 32 rays in flight.
python3 - "$out/rows.csv" >"$out/table.md" <<'END'
import csv, sys

print("| unit | area per box, mm² | extra box tests, % | extra triangle tests, % | run time, ms | whole | "
      "area × run time, mm² ms | whole | bytes a ray | behind 16 KiB | nJ a ray |")
print("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|")
for row in csv.DictReader(open(sys.argv[1])):
    if row["rays_in_flight"] != "32": continue
    number = lambda column: float(row[column])
    bits = row["bits"].removeprefix("n")
    unit = row["design"] if bits == "fp32" else f"{row['design']} {bits}"
    print(f"| {unit} | {number('area_per_box_mm2'):.4f} | {number('extra_box_tests_pct') + 0:.3f} | "
          f"{number('extra_triangle_tests_pct') + 0:.2f} | {number('run_time_ms'):.3f} | "
          f"{number('whole_run_time_ms'):.3f} | {number('area_run_time_mm2_ms'):.3f} | "
          f"{number('whole_area_run_time_mm2_ms'):.3f} | {number('bytes_per_ray'):.0f} | "
          f"{number('bytes_per_ray_16kib'):.0f} | {number('energy_nj_per_ray'):.1f} |")
END

awk -v table="$out/table.md" '
  /<!-- table -->/ { print; print ""; while ((getline line < table) > 0) print line; print ""; skip = 1; next }
  /<!-- end of table -->/ { skip = 0 }
  !skip { print }' docs/measured/spheres.md >"$out/spheres.md"
mv "$out/spheres.md" docs/measured/spheres.md
rm "$out/table.md"
