#!/usr/bin/env python3
"""Prints the table of docs/designs.md: Bambu's Verilog beside hitpipe's, from one C++ source. docs/bambu.py [VECTORS]

It takes bambu and what `hitpipe implement --target xc7` takes. VECTORS, 6,000 unless given, are replayed through Bambu's
Verilog; a wrong answer ends the run. Both are mapped by the target's commands; a unit's clock period is 5 ns in both.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

UNITS = [
    ("int_slabs", "12/12"), ("int_slabs", "20/24"), ("int_plucker", "20/24"), ("int_major", "20+1/13"),
    ("int_major_pair", "20+1/13"), ("int_triangle", "20+1s20"), ("int_ray", "20+1/11s20"), ("fp_slabs", "fp32"),
    ("fp_slabs_safe", "e5m10"), ("fp_slabs_safe", "e8m23"), ("fp_plucker", "fp32"), ("fp_plucker_direct", "fp32"),
]
ROOT = pathlib.Path(__file__).resolve().parent.parent
HITPIPE = str(ROOT / "build/hitpipe")
TARGET = json.loads((ROOT / "sim/implement/targets/xc7.json").read_text())


def output_of(command):
    ran = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if ran.returncode != 0:
        sys.exit(f"{ran.stdout}{ran.stderr}\ndocs/bambu.py: {' '.join(command)} ended with {ran.returncode}")
    return ran.stdout


def by_bambu(out, design, bits, vectors):
    """The row's cells of Bambu, and what the test program of the vectors printed."""
    rtl = [HITPIPE, "rtl", design, "--bits", bits, "--name", design, "--hls", "--vectors", vectors, "--out", str(out)]
    output_of(rtl)
    printed = output_of(["env", f"PROJECT={out}/project", f"{out}/hls/{design}_bambu.sh"])
    cycles = re.search(r"Average execution *: (\d+) cycles", printed).group(1)
    commands = [command.format(top="hitpipe_" + design) for command in TARGET["synthesis"]]
    script = "; ".join([f"read_verilog {out}/project/hitpipe_{design}.v", *commands, f"tee -q -o {out}/stat stat"])
    output_of(["yosys", "-q", "-p", script])
    cells = dict(re.findall(r"^ +([A-Z]\w+) +(\d+)$", (out / "stat").read_text(), re.M))
    counts = [
        sum(int(number) * factor for kind, factor in TARGET["resources"][resource]["cells"].items()
            for cell, number in cells.items() if re.fullmatch(kind.replace("*", ".*"), cell))
        for resource in ("luts", "dsps", "registers")
    ]
    return [*counts, cycles], printed.splitlines()[-1]


def by_hitpipe(out, design, bits):
    mapped = json.loads(output_of([HITPIPE, "implement", design, "--bits", bits, "--clock-ps", "5000", "--target", "xc7",
                                   "--format", "json", "--out", str(out)]))
    return [mapped[key] for key in ("luts", "dsps", "registers", "latency")]


def main():
    vectors = sys.argv[1] if len(sys.argv) > 1 else "6000"
    print("| unit | vectors through Bambu's Verilog | by Bambu | by hitpipe |\n|---|---|---|---|")
    for design, bits in UNITS:
        with tempfile.TemporaryDirectory() as folder:
            bambu, answer = by_bambu(pathlib.Path(folder), design, bits, vectors)
            ours = by_hitpipe(pathlib.Path(folder) / "ours", design, bits)
        answer = answer.split(": ")[-1]
        print(f"| `{design}` {bits} | {answer} | {' / '.join(map(str, bambu))} | {' / '.join(map(str, ours))} |", flush=True)


main()
