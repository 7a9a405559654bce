#!/usr/bin/env bash
# Prints what the memory of `hitpipe rtl --ray-slots` becomes in Yosys, as a Markdown table: docs/ray_slots.sh [SLOTS...]
# Without numbers it is the table of docs/measured/ray_slots.md. The unit is a black box here.
set -euo pipefail
cd "$(dirname "$0")/.."
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# memories MODULE TARGET UNTIL: what holds the rays after a target's steps.
memories() {
  yosys -q -p "read_verilog -lib $out/$1.v; read_verilog $out/$1_slots.v; synth_$2 -run :$3 -top $1_slots; tee -q -o $out/stat stat" >/dev/null
  awk '$1 ~ /^(SB_RAM|DP16|PDPW|RAMB|TRELLIS_DPR|RAM[0-9])/ { printf "%s%d %s", n++ ? ", " : "", $2, $1 } END { if (!n) printf "registers" }' "$out/stat"
}

echo '| unit | slots | bits of memory | iCE40 | ECP5 | 7-series |'
echo '|---|--:|--:|---|---|---|'
for unit in 'int_slabs 20/24' 'int_plucker 20/24' 'int_major 20+1/13' 'int_major_pair 20+1/13' 'fp_slabs fp32' 'fp_plucker fp32'; do
  read -r design format <<<"$unit"
  [[ $design == int_slabs ]] && usual='16 64 256 1024' || usual=256
  for slots in ${*:-$usual}; do
    build/hitpipe rtl "$design" --bits "$format" --ray-slots "$slots" --out "$out" --format json >/dev/null
    bits=$(python3 -c 'import json, sys; print(sum(m["bits"] for m in json.load(open(sys.argv[1]))["ray_slots"]["memories"]))' "$out/$design.json")
    printf '| %s | %d | %d | %s | %s | %s |\n' "$unit" "$slots" "$bits" "$(memories "$design" ice40 map_gates)" \
      "$(memories "$design" ecp5 map_gates)" "$(memories "$design" xilinx fine)"
  done
done
echo
echo "By \`docs/ray_slots.sh\`, $(build/hitpipe --version | head -n 1 | cut -d" " -f1,2)."
