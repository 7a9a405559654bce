#!/usr/bin/env bash
# The tables of docs/measured/flow_control.md: a unit that stalls, one without flow control, and the AXI4-Stream wrapper around either, in OSU 0.18 um
# cells, on iCE40 and on 7-series: docs/flow_control.sh, or docs/flow_control.sh DESIGN FORMAT for one.
# It takes Yosys and the Debian package qflow-tech-osu018.
set -euo pipefail
cd "$(dirname "$0")/.."
cells=/usr/share/qflow/tech/osu018/osu018_stdcells.lib
[[ -f $cells ]] || { echo "docs/flow_control.sh: $cells is missing; apt-get install qflow-tech-osu018" >&2; exit 2; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# run SCRIPT: Yosys reads the unit and its wrapper, and the statistics go to $out/stat.
run() {
  yosys -q -p "read_verilog $out/*.v; $1; tee -o $out/stat stat ${2:-}" >/dev/null
}

# emit DESIGN FORMAT OPTION...
emit() {
  local design=$1 format=$2
  shift 2
  rm -rf "${out:?}"/*
  build/hitpipe rtl "$design" --bits "$format" --name unit --vectors 1 "$@" --out "$out" >/dev/null
}

# in_cells TOP: "mm2 | cells | registers"
in_cells() {
  run "hierarchy -top $1; proc; flatten; synth -flatten -top $1; dfflibmap -liberty $cells; abc -liberty $cells; opt_clean" \
    "-liberty $cells"
  awk '/Chip area/ { area = $NF } /Number of cells/ { cells = $NF } /DFF/ { registers += $2 }
    END { printf "%.4f | %d | %d", area / 1e6, cells, registers }' "$out/stat"
}

# on_ice40 TOP: "LUT | FF"
on_ice40() {
  run "synth_ice40 -dsp -top $1"
  awk '/SB_LUT4/ { luts += $2 } /SB_DFF/ { ffs += $2 } END { printf "%d | %d", luts, ffs }' "$out/stat"
}

# on_xc7 TOP: "LUT | FF | SRL"
on_xc7() {
  run "synth_xilinx -family xc7 -noiopad -noclkbuf -flatten -top $1"
  awk '/ LUT[1-6] / { luts += $2 } / FD[A-Z]*E / { ffs += $2 } / SRL/ { srls += $2 }
    END { printf "%d | %d | %d", luts, ffs, srls }' "$out/stat"
}

# rows DESIGN FORMAT FUNCTION...: a row for each unit and wrapper.
rows() {
  local design=$1 format=$2 variant what top options function
  shift 2
  for variant in 'stall:unit:--flow-control stall' 'none:unit:--flow-control none' \
    'AXI4-Stream around stall:unit_axis:--flow-control stall --axi-stream' \
    'AXI4-Stream around none:unit_axis:--flow-control none --axi-stream'; do
    IFS=: read -r what top options <<<"$variant"
    # shellcheck disable=SC2086
    emit "$design" "$format" $options
    printf '| %s %s | %s' "$design" "$format" "$what"
    for function in "$@"; do printf ' | %s' "$("$function" "$top")"; done
    echo ' |'
  done
}

units=('int_slabs 20/24' 'int_slabs 16/16' 'int_major_pair 20+1/13' 'fp_slabs fp32')
[[ $# == 2 ]] && units=("$1 $2")
echo '| unit | flow control | mm² | cells | registers |'
echo '|---|---|--:|--:|--:|'
for unit in "${units[@]}"; do
  # shellcheck disable=SC2086
  rows $unit in_cells
done
echo
echo '| unit | flow control | iCE40 LUT | FF | 7-series LUT | FF | SRL |'
echo '|---|---|--:|--:|--:|--:|--:|'
for unit in "${units[@]}"; do
  # shellcheck disable=SC2086
  rows $unit on_ice40 on_xc7
done
echo
echo "By \`docs/flow_control.sh\`, $(build/hitpipe --version | head -n 1 | cut -d" " -f1,2)."
