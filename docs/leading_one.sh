#!/usr/bin/env bash
# Prints the area of a product of 21 by 12 bits with the choice of its bound, in two forms (docs/never_misses.md): docs/leading_one.sh
# It takes Yosys and the Debian package qflow-tech-osu018.
set -euo pipefail
cells=/usr/share/qflow/tech/osu018/osu018_stdcells.lib
[[ -f $cells ]] || { echo "docs/leading_one.sh: $cells is missing; apt-get install qflow-tech-osu018" >&2; exit 2; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

cat >"$out/product.v" <<'END'
module two_mantissas(input signed [20:0] d, input [11:0] low, high, input upper, output signed [20:0] t);
  wire [11:0] mantissa = upper ? high : low;
  wire signed [33:0] product = d * $signed({1'b0, mantissa});
  assign t = product[32:12];
endmodule

module inexact_bit(input signed [20:0] d, input [10:0] fraction, input inexact, input upper, output signed [20:0] t);
  wire signed [33:0] product = d * $signed({1'b0, fraction}) + (d <<< 11) + (upper & inexact ? d : 21'sd0);
  assign t = product[32:12];
endmodule
END
for module in two_mantissas inexact_bit; do
  yosys -q -p "read_verilog $out/product.v; synth -flatten -top $module; abc -liberty $cells; tee -o $out/stat stat -liberty $cells" >/dev/null
  awk -v m="$module" '/Chip area/ { printf "%-13s %6.0f um2\n", m, $NF }' "$out/stat"
done
