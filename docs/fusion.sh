#!/bin/bash
# Makes the figures of "Fusion" in docs/safe_floats.md: area and delay of a plane's distance in each form, in OSU
# cells, then extra tests and judged tests. Give a part to make only that: area, scenes or judged.
#   cmake --build build --target slab_forms && docs/fusion.sh
set -eu
cd "$(dirname "$0")/.."
build=${BUILD:-build}
forms=$build/bench/slab_forms
latch_ps=321

area() {
  echo "format,form,stages,area_um2,period_ps"
  scratch=$(mktemp -d)
  trap 'rm -r "$scratch"' EXIT
  # Whole, then in as many stages as the two operators of the plain form have in osu018.json.
  for format in "8 7 1" "8 23 1" "5 10 1" "8 15 1" "8 23 4" "8 7 4" "8 15 4" "5 10 4"; do
    read -r exponent fraction stages <<< "$format"
    for form in plain exact short_product fused separate separate_fused; do
      "$forms" verilog "$form" "$exponent" "$fraction" "$stages" > "$scratch/unit.v"
      sed -n '/^module unit_distance /,/^endmodule/p' "$scratch/unit.v" > "$scratch/distance.v"
      figures=$(area_model/measure/measure --verilog "$scratch/distance.v" unit_distance)
      area=$(sed 's/area_um2 \([0-9]*\),.*/\1/' <<< "$figures")
      period=$(($(sed 's/.*delay_ps //' <<< "$figures") + latch_ps))
      echo "e${exponent}m$fraction,$form,$stages,$area,$period"
    done
  done
}

scenes() {
  for scene in spheres plant_slice city; do "$forms" scene "$scene" 64; done
  "$forms" scene terrain 64 100000
}

case ${1:-all} in
  area) area ;;
  scenes) scenes ;;
  judged) "$forms" judge 2000 ;;
  all) area; scenes; "$forms" judge 2000 ;;
  *) echo "fusion.sh: $1: allowed are area, scenes, judged" >&2; exit 2 ;;
esac
