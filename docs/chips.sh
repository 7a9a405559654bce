#!/usr/bin/env bash
# The tables of docs/measured/chips.md and docs/chips.md: every unit in every target. docs/chips.sh, or docs/chips.sh TARGET... for some.
# Results stay in out/chips. A unit that is there is not implemented again, so an interrupted run goes on where it was.
# Then docs/chips.sh --print only prints what is there.
set -euo pipefail
cd "$(dirname "$0")/.."
out=out/chips
units=('fp_slabs fp32' 'fp_slabs_safe e8m23' 'fp_slabs_safe e8m15' 'fp_plucker fp32' 'fp_plucker_direct fp32' 'int_slabs 24/24' 'int_slabs 20/24' 'int_slabs 16/16' 'int_plucker 24/24'
  'int_plucker 20/24' 'int_major 20+1/13' 'int_major 16+1/12' 'int_major_pair 20+1/13' 'int_major_pair 16+1/12'
  'int_major_pair 16+0/8')
targets=(ice40_up5k ice40_hx ecp5 xc7 osu018)
print=
if [[ ${1:-} == --print ]]; then
  print=yes
elif [[ $# -gt 0 ]]; then
  targets=("$@")
fi
mkdir -p "$out"
for unit in "${units[@]}"; do
  for target in "${targets[@]}"; do
    read -r design bits <<<"$unit"
    result=$out/${design}_${bits//\//_}_$target.json
    [[ -n $print || -s $result ]] && continue
    # 1 says that the unit does not fit, which is a result.
    code=0
    build/hitpipe implement "$design" --bits "$bits" --target "$target" --seeds 3 --format json \
      --out "$out/${design}_${bits//\//_}" >"$result.new" || code=$?
    [[ $code -le 1 ]] || { echo "docs/chips.sh: $design $bits in $target failed" >&2; rm -f "$result.new"; exit 2; }
    mv "$result.new" "$result"
  done
done
python3 - "$out" "${units[@]}" <<'PYTHON'
import json, os, sys

out, units, whole = sys.argv[1], sys.argv[2:], {}
print("| unit | in | LUT | FF | DSP | carry | largest part of the chip | MHz, median / best of 3 | mm² | latency, ns | million HIT a second |")
print("|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|")
for unit in units:
    for target in ("ice40_up5k", "ice40_hx", "ecp5", "xc7", "osu018"):
        file = f"{out}/{unit.replace(' ', '_').replace('/', '_')}_{target}.json"
        if not os.path.exists(file):
            continue
        with open(file, encoding="utf-8") as text:
            row = json.load(text)

        def count(key):
            return "" if row[key] is None else f"{row[key]:,}"

        def figure(key, digits, scale=1.0):
            return "" if row[key] is None else f"{row[key] * scale:,.{digits}f}"

        part = "" if row["chip_share_pct"] is None else f"{row['chip_share_pct']:.0f} % of {row['chip_share_of'].replace('_', ' ')}"
        clock = figure("fmax_mhz", 1)
        if row["fmax_best_mhz"] is not None:
            clock += " / " + figure("fmax_best_mhz", 1)
        elif row["chip_share_pct"] is not None and row["chip_share_pct"] > 100:
            clock = "does not fit"
        elif row["fmax_mhz"] is None and row["not_placed"] is None:
            clock = "not placed"
        cells = [unit.replace(" ", " ", 1), target, count("luts"), count("registers"), count("dsps"), count("carries"), part, clock,
                 figure("cell_area_um2", 3, 1e-6), figure("latency_ns", 1), figure("million_hits_per_s", 1)]
        print("| " + " | ".join(cells) + " |")
        whole[unit, target] = cells

print("\n| unit | UP5K, % of chip | MHz | HX8K, % of chip | MHz | ECP5: LUT | DSP | MHz | Artix-7: LUT | DSP | OSU: mm² | MHz |")
print("|---|" + "--:|" * 11)
for unit in units:
    if not all((unit, target) in whole for target in ("ice40_up5k", "ice40_hx", "ecp5", "xc7", "osu018")):
        continue

    def placed(target):
        share, clock = whole[unit, target][6:8]
        return [share.split(" ")[0], clock.split(" / ")[0] if clock[:1].isdigit() else ""]

    ecp5, xc7, osu = (whole[unit, target] for target in ("ecp5", "xc7", "osu018"))
    cells = [unit, *placed("ice40_up5k"), *placed("ice40_hx"), ecp5[2], ecp5[4], placed("ecp5")[1], xc7[2], xc7[4], osu[8], osu[7]]
    print("| " + " | ".join(cells) + " |")
PYTHON
