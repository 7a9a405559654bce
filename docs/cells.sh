#!/usr/bin/env bash
# Area of whole units in OSU 0.18 um cells, without back-pressure: docs/cells.sh, or docs/cells.sh DESIGN FORMAT for one.
# It takes Yosys and the Debian package qflow-tech-osu018.
set -euo pipefail
cd "$(dirname "$0")/.."
cells=/usr/share/qflow/tech/osu018/osu018_stdcells.lib
[[ -f $cells ]] || { echo "docs/cells.sh: $cells is missing; apt-get install qflow-tech-osu018" >&2; exit 2; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# area DESIGN FORMAT: "um2 registers"
area() {
  build/hitpipe rtl "$1" --bits "$2" --name unit --out "$out" >/dev/null
  yosys -q -p "read_verilog $out/unit.v; hierarchy -top unit; proc; flatten; connect -set out_ready 1'b1; synth -flatten -top unit;
    dfflibmap -liberty $cells; abc -liberty $cells; opt_clean; tee -o $out/stat stat -liberty $cells" >/dev/null
  awk '/Chip area/ { area = $NF } /DFF/ { registers += $2 } END { printf "%.0f %d\n", area, registers }' "$out/stat"
}

if [[ $# == 2 ]]; then
  area "$1" "$2"
  exit
fi
read -r yardstick _ < <(area fp_slabs fp32)
echo '| unit | mm² | registers | boxes a test | mm² a box | of fp_slabs |'
echo '|---|--:|--:|--:|--:|--:|'
for unit in 'fp_slabs fp32 1' 'int_slabs 24/24 1' 'int_slabs 20/24 1' 'int_slabs 16/16 1' 'int_major 20+1/13 1' 'int_major_pair 20+1/13 2' 'int_major_pair 20+1/12 2'; do
  read -r design format boxes <<<"$unit"
  read -r um2 registers < <(area "$design" "$format")
  awk -v u="$design $format" -v a="$um2" -v r="$registers" -v b="$boxes" -v y="$yardstick" \
    'BEGIN { printf "| %s | %.3f | %d | %d | %.3f | %.1f %% |\n", u, a / 1e6, r, b, a / b / 1e6, 100 * a / b / y }'
done
