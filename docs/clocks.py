#!/usr/bin/env python3
"""Prints the table of docs/chips.md that has estimated and placed figures side by side, of units that no library was fitted to.

  docs/clocks.py [SEEDS]      3 seeds unless given; the median counts

Results stay in out/clocks, and an interrupted run goes on where it was. A target whose placer is not there is left out."""
import json
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
HITPIPE = str(ROOT / "build/hitpipe")
OUT = ROOT / "out/clocks"
UNITS = [
    ("int_slabs", "12/12", 1, "none"), ("int_slabs", "16/16", 1, "none"), ("int_slabs", "16/16", 3, "none"),
    ("int_major", "14+1/10", 1, "none"), ("int_major", "16+1/12", 1, "none"), ("int_major", "16+1/12", 1, "stall"),
    ("int_major_pair", "14+0/8", 1, "none"), ("int_major_pair", "20+1/13", 1, "none"), ("int_major_pair", "20+1/13", 4, "none"),
    ("int_plucker", "10/10", 1, "none"), ("fp_slabs_safe", "e8m7", 1, "none"),
]
TARGETS = ["ice40_up5k", "ice40_hx", "ecp5"]


def json_of(command, fine=(0,)):
    ran = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if ran.returncode not in fine:
        sys.exit(f"{ran.stderr}docs/clocks.py: {' '.join(command)} ended with {ran.returncode}")
    return json.loads(ran.stdout)


def both(unit, target, seeds):
    """What `area` says of a unit, and what `implement` does."""
    design, bits, interval, flow = unit
    name = f"{design}_{bits}_{interval}_{flow}_{target}".replace("/", "_")
    kept = OUT / (name + ".json")
    if not kept.exists():
        say = [design, "--bits", bits, "--ii", str(interval), "--format", "json"]
        estimate = json_of([HITPIPE, "area", *say, "--library", target])
        placed = json_of([HITPIPE, "implement", *say, "--flow-control", flow, "--target", target, "--seeds", seeds,
                          "--out", str(OUT / name)], (0, 1))
        kept.write_text(json.dumps([estimate[0] if isinstance(estimate, list) else estimate, placed]))
    return json.loads(kept.read_text())


def main():
    seeds = sys.argv[1] if len(sys.argv) > 1 else "3"
    OUT.mkdir(parents=True, exist_ok=True)
    errors = {}
    for target in TARGETS:
        print(f"| in {target} | MHz | placed | % | LUT | mapped | % | cells | packed | % |")
        print("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|")
        for unit in UNITS:
            estimate, placed = both(unit, target, seeds)
            if placed["not_placed"] is not None:
                break
            cells = []
            pairs = [("MHz", estimate["stage_delay_ns"], placed["fmax_mhz"]), ("LUT", estimate["lut"], placed["luts"]),
                     ("logic cells", estimate["logic_cells"], placed["logic_cells"])]
            for what, guess, truth in pairs:
                if what == "MHz":
                    guess = 1000 / float(guess)
                if guess is None or truth is None:
                    cells += ["" if guess is None else f"{guess:,.0f}", "" if truth is None else f"{truth:,.0f}", ""]
                    continue
                error = 100 * (guess / truth - 1)
                errors.setdefault((target, what), []).append(abs(error))
                cells += [f"{guess:,.0f}", f"{truth:,.0f}", f"{error:+.0f}"]
            design, bits, interval, flow = unit
            name = f"{design} {bits}" + (f", `--ii {interval}`" if interval > 1 else "") + (", stalls" if flow == "stall" else "")
            print(f"| {name} | " + " | ".join(cells) + " |", flush=True)
        print()
    print("| in | of | units | median error, % | worst, % |\n|---|---|--:|--:|--:|")
    for (target, what), values in errors.items():
        print(f"| {target} | {what} | {len(values)} | {statistics.median(values):.0f} | {max(values):.0f} |")


main()
