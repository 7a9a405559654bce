#!/usr/bin/env bash
# Prints the tables of docs/measured/scenes.md as Markdown: docs/scenes.sh [SIZE [MESH...]]. Images have
# SIZE x SIZE pixels, 96 in the document. Every built-in scene and every mesh goes through every unit below, by a surface-area tree
# and by the median split of the thesis; the Verilog answers each box test. Rows that out/scenes-SIZE already holds are not measured
# again. The program is build/hitpipe.
set -euo pipefail
cd "$(dirname "$0")/.."
size=${1:-128}
shift || true
out=out/scenes-$size
mkdir -p "$out"

units=(fp_slabs=fp32 int_slabs=24/24 int_slabs=20/24 int_slabs=16/16 int_slabs=12/12 int_plucker=20/24 int_plucker=16/16
  int_major=20+1/13 int_major_pair=20+1/13 fp_slabs_safe=e8m23 fp_slabs_safe=e8m15 fp_slabs_safe=e8m7 fp_slabs_safe=e5m10)
designs=$(printf '%s\n' "${units[@]%%=*}" | sort -u | paste -sd,)
formats=$(IFS=,; echo "${units[*]}")

# The scene plant is another name for plant_front.
scenes=$(build/hitpipe list scenes --format csv | awk -F, 'NR > 1 && $1 != "plant" { print $1 }')
for scene in $scenes "$@"; do
  name=$(basename "${scene%.*}")
  for tree in "sah 2" "median 6"; do
    read -r builder most <<<"$tree"
    build/hitpipe sweep --scene "$scene" --width "$size" --height "$size" "$designs" --bits "$formats" \
      --builder "$builder" --max-triangles "$most" --out "$out/$name.$builder.csv" >/dev/null
  done
  [[ -s $out/$name.rays.csv ]] ||
    build/hitpipe render --scene "$scene" --width "$size" --height "$size" --format csv >"$out/$name.rays.csv"
  names+=("$name")
done

python3 - "$out" "${names[@]}" <<'END'
import csv, sys

folder, scenes = sys.argv[1], sys.argv[2:]

def rows(file):
    return list(csv.DictReader(open(file)))

trees = {"surface-area tree, at most 2 triangles a leaf": "sah", "median split, at most 6 triangles a leaf": "median"}
of_tree = {tree: {scene: rows(f"{folder}/{scene}.{builder}.csv") for scene in scenes} for tree, builder in trees.items()}
unit = lambda row: (row["design"], row["bits"].removeprefix("n"))
units = [unit(row) for row in of_tree[next(iter(trees))][scenes[0]]]
every_row = [(scene, row) for measured in of_tree.values() for scene in scenes for row in measured[scene]]
for scene, row in every_row:
    wrong = [name for name in ("rtl_mismatches", "different_triangles", "different_pixels") if row[name] != "0"]
    if wrong: sys.exit(f"docs/scenes.sh: {scene}, {unit(row)}: {wrong[0]} is {row[wrong[0]]}; it must be 0")

def percent(row, work):
    base = int(row[f"reference_{work}_tests"])
    extra = 100 * (int(row[f"{work}_tests"]) - base) / base
    return f"{extra:.0f}" if extra >= 99.5 else f"{extra:.1f}" if extra >= 9.95 else f"{extra:.2f}".replace("-0.00", "0.00")

def table(title, tree, cell):
    measured = of_tree[tree]
    print(f"\n{title}, {tree}:\n")
    print("| scene | stiff rays % | " + " | ".join(f"{design} {bits}" for design, bits in units) + " |")
    print("|---|--:|" + "--:|" * len(units))
    for scene in scenes:
        of = {unit(row): row for row in measured[scene]}
        stiff = float(rows(f"{folder}/{scene}.rays.csv")[0]["stiff_rays_pct"])
        print(f"| {scene} | {stiff:.1f} | " + " | ".join(cell(of[each]) for each in units) + " |")

for tree in trees:
    table("Extra box tests / extra triangle tests, %", tree, lambda row: percent(row, "box") + " / " + percent(row, "triangle"))
    table("False hits in a million box tests", tree, lambda row: f"{float(row['false_hits_per_million']):.0f}")
print("\nFalse misses of units that promise none: 0; of the others in a million box tests:", end=" ")
loose = [(u, sum(int(row["false_misses"]) for _, row in every_row if unit(row) == u),
          sum(int(row["box_tests"]) for _, row in every_row if unit(row) == u)) for u in units]
print(", ".join(f"{u[0]} {u[1]} {1e6 * misses / tests:.3g}" for u, misses, tests in loose if misses) + ".")
END
