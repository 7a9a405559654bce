#!/bin/sh
# Every design through Yosys: `synth` to generic gates and `synth_xilinx` to a 7-series FPGA. Cells by kind and
# seconds; the full reports stay in the folder. Usage: bench/synth.sh [folder] [n/t]
set -eu
cd "$(dirname "$0")/.."
out=${1:-build/synth}
bits=${2:-20/24}
mkdir -p "$out"
for design in int_slabs int_plucker fp_slabs fp_plucker; do
  case $design in fp_*) format=fp32 ;; *) format=$bits ;; esac
  build/hitpipe rtl "$design" --bits "$format" --name "$design" --out "$out/$design" >/dev/null
  for command in synth synth_xilinx; do
    report=$out/$design.$command.txt
    begin=$(date +%s)
    yosys -q -p "read_verilog $out/$design/$design.v; $command -top $design; check -assert; tee -q -o $report stat"
    end=$(date +%s)
    # Of the last module in the report, the whole design.
    awk -v head="$design $format $command" -v seconds=$((end - begin)) '
      /Number of cells:/ { cells = $NF; ff = lut = dsp = srl = carry = 0; next }
      /DFF|FDRE|FDSE/ { ff += $NF }
      /LUT[1-6] / { lut += $NF }
      /DSP48/ { dsp += $NF }
      /SRL/ { srl += $NF }
      /CARRY4/ { carry += $NF }
      END { printf "%-28s %6d cells %5d flip-flops %5d LUTs %4d SRLs %4d CARRY4 %3d DSPs %3d s\n", head, cells, ff, lut,
                   srl, carry, dsp, seconds }' "$report"
  done
done
