#!/usr/bin/env python3
"""Prints the tables of docs/chips.md that have estimated and placed figures side by side, of units that no library was fitted to.

  docs/clocks.py [SEEDS [TARGET...]]      3 seeds unless given; the median counts

Results stay in out/clocks, and an interrupted run goes on where it was. A target whose placer is not there is left out. xc7 has none,
and its units are compared as mapped."""
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
LARGER_UNITS = [  # that only xc7 maps in a short time
    ("int_major", "20+1/13", 1, "none"), ("int_slabs", "20/24", 1, "none"), ("fp_slabs_safe", "e8m15", 1, "none"),
    ("int_triangle", "20+1s20", 8, "none"),
]
TARGETS = ["ice40_up5k", "ice40_hx", "ecp5", "xc7"]
MAPPED_ONLY = {"xc7"}


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


def figures(estimate, placed, is_placed):
    """What is compared, its estimate and what the tools made of it."""
    lut = ("LUT", estimate["lut"], placed["luts"])
    if not is_placed:
        return [lut, ("registers", estimate["ff"], placed["registers"]), ("blocks", estimate["dsp"], placed["dsps"])]
    return [("MHz", 1000 / float(estimate["stage_delay_ns"]), placed["fmax_mhz"]), lut,
            ("logic cells", estimate["logic_cells"], placed["logic_cells"])]


def name_of(design, bits, interval, flow):
    return f"{design} {bits}" + (f", `--ii {interval}`" if interval > 1 else "") + (", stalls" if flow == "stall" else "")


def print_target(target, seeds, errors):
    is_placed = target not in MAPPED_ONLY
    heads = ["MHz | placed", "LUT | mapped", "cells | packed"] if is_placed else ["LUT | mapped", "FF | mapped", "DSP | mapped"]
    print(f"| in {target} | " + " | ".join(head + " | %" for head in heads) + " |")
    print("|---" + "|--:" * (3 * len(heads)) + "|")
    for unit in UNITS + ([] if is_placed else LARGER_UNITS):
        estimate, placed = both(unit, target, seeds)
        if is_placed and placed["not_placed"] is not None:
            break
        cells = []
        for what, guess, truth in figures(estimate, placed, is_placed):
            if guess is None or truth is None:
                cells += ["" if guess is None else f"{guess:,.0f}", "" if truth is None else f"{truth:,.0f}", ""]
                continue
            error = 100 * (guess / truth - 1)
            errors.setdefault((target, what), []).append(abs(error))
            cells += [f"{guess:,.0f}", f"{truth:,.0f}", f"{error:+.0f}"]
        print(f"| {name_of(*unit)} | " + " | ".join(cells) + " |", flush=True)
    print()


def main():
    seeds = sys.argv[1] if len(sys.argv) > 1 else "3"
    OUT.mkdir(parents=True, exist_ok=True)
    errors = {}
    for target in sys.argv[2:] or TARGETS:
        print_target(target, seeds, errors)
    print("| in | of | units | median error, % | worst, % |\n|---|---|--:|--:|--:|")
    for (target, what), values in errors.items():
        print(f"| {target} | {what} | {len(values)} | {statistics.median(values):.0f} | {max(values):.0f} |")


main()
