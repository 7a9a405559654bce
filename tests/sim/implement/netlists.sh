#!/usr/bin/env bash
# Simulates the mapped netlist of every design against the C++: 10^5 vectors in Verilator, and 10^3 in Icarus, which
# knows the cells by other code. tests/sim/implement/netlists.sh [TARGET...]; it takes hours. VECTORS=N takes fewer.
set -euo pipefail
cd "$(dirname "$0")/../../.."
targets=(ice40_hx ice40_up5k osu018)
[[ $# -gt 0 ]] && targets=("$@")
vectors=${VECTORS:-100000}
out=out/netlists
units=$(build/hitpipe list designs --format csv | tail -n +2 | cut -d, -f1)
for design in $units; do
  for target in "${targets[@]}"; do
    for run in "verilator $vectors" "icarus $((vectors < 1000 ? vectors : 1000))"; do
      read -r simulator count <<<"$run"
      code=0
      said=$(build/hitpipe implement "$design" --target "$target" --seeds 0 --simulate "$count" --simulator "$simulator" \
        --format json --out "$out/$design" 2>"$out.log" | sed -n 's/^  "netlist": "\(.*\)",$/\1/p') || code=$?
      # A unit that does not fit a chip has a netlist all the same.
      if [[ $said != PASS* ]]; then
        echo "$design in $target, $simulator: ${said:-exit code $code}" >&2
        tail -n 1 "$out.log" >&2
        exit 1
      fi
      echo "$design in $target, $simulator: $said"
    done
  done
done
