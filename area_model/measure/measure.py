#!/usr/bin/env python3
"""Measures the components of a library in OSU 0.18 um cells.

  area_model/measure/measure.py                          writes rtl_gen/component/libraries/osu018.json
  area_model/measure/measure.py --check                  measures again; exit code 1 if a figure of that file differs
  area_model/measure/measure.py --check mux2 int_subtract:16
                                                      only these components, or this width of one
  area_model/measure/measure.py --estimate               the rows of thesis_250nm.json for operators that round toward zero
  area_model/measure/measure.py --verilog FILE MODULE    area and delay of a module of your own, in the form that
                                                      hitpipe writes (inputs and outputs, clk and en if clocked)

A component stands between registers. Its area is what the cells take beyond those registers, and its delay is the
period from register to register less the period of two registers alone (the latch's delay). So the slowest component
and a latch make the clock, as the scheduler counts. Multipliers and float operators are the modules that hitpipe
writes, in the fewest stages that reach CLOCK_PS; all else is one line of Verilog. """

import argparse
import csv
import json
import math
import re
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
import osu018
import program
from harness import REGISTER_UM2, between_registers

LIBRARIES = program.ROOT / "rtl_gen/component/libraries"
LIBRARY = LIBRARIES / "osu018.json"
CLOCK_PS = 4000  # what binary32 multiplication reaches; a stage more does not make it faster
MOST_STAGES = 8

# Component: law above the widest row, law of the area, widths.
FAMILIES = {
    "latch": ("same", "linear", [1, 8, 12, 16, 20, 24, 32, 64]),
    "latch_enable": ("same", "linear", [1, 8, 16, 24, 32, 64]),
    "mux2": ("same", "linear", [1, 4, 8, 12, 16, 20, 24, 32, 48, 64]),
    "int_subtract": ("tree", "linear", [4, 8, 12, 16, 20, 24, 28, 32, 40, 53]),
    "int_multiply": ("stages", "quadratic", [8, 12, 16, 20, 24, 28, 32]),
    "int_compare": ("tree", "linear", [4, 8, 12, 16, 20, 24, 28, 32, 40, 53]),
    "fp_subtract": ("same", "linear", [32]),
    "fp_multiply": ("same", "quadratic", [32]),
    "fp_compare": ("same", "linear", [32]),
    "fp_subtract_rz": ("same", "linear", [16, 24, 32]),
    "fp_multiply_rz": ("same", "quadratic", [8, 11, 16, 24]),
}
# Out of which unit a component is taken: design, formats by width, and the beginning of its module's name. Of several
# formats the larger area and the longer delay count: e8m7 and e5m10 both have 16 bits.
INTEGERS = {bits: [f"{bits}/{bits}"] for bits in FAMILIES["int_multiply"][2]}
BINARY32 = {32: ["fp32"]}
SOURCES = {
    "int_multiply": ("int_slabs", INTEGERS, "unit_mul_"),
    "fp_subtract": ("fp_slabs", BINARY32, "unit_fp_subtract_"),
    "fp_multiply": ("fp_slabs", BINARY32, "unit_fp_multiply_"),
    "fp_compare": ("fp_slabs", BINARY32, "unit_fp_compare_"),
    "fp_subtract_rz": ("fp_slabs_safe", {16: ["e8m7", "e5m10"], 24: ["e8m15"], 32: ["e8m23"]}, "unit_fp_subtract_rz_"),
    "fp_multiply_rz": ("fp_slabs_safe", {8: ["e8m7"], 11: ["e5m10"], 16: ["e8m15"], 24: ["e8m23"]}, "unit_fp_multiply_rz_"),
}
ONE_LINE = {
    "latch": ("input wire [{high}:0] a", "assign y = a;"),
    "mux2": ("input wire [0:0] s,\n  input wire [{high}:0] a,\n  input wire [{high}:0] b", "assign y = s ? a : b;"),
    "int_subtract": ("input wire [{high}:0] a,\n  input wire [{high}:0] b", "assign y = a - b;"),
    "int_compare": ("input wire [{high}:0] a,\n  input wire [{high}:0] b", "assign y = $signed(a) < $signed(b);"),
    "gate_and": ("input wire [{high}:0] a,\n  input wire [{high}:0] b", "assign y = a & b;"),
    "gate_or": ("input wire [{high}:0] a,\n  input wire [{high}:0] b", "assign y = a | b;"),
    "gate_xor": ("input wire [{high}:0] a,\n  input wire [{high}:0] b", "assign y = a ^ b;"),
}
LATCH_ENABLE = """module component_of_library (
  input wire clk,
  input wire en,
  input wire [{high}:0] d,
  output reg [{high}:0] q
);
  always @(posedge clk) if (en) q <= d;
endmodule
"""


def measurable():
    """The families of which this hitpipe writes the components."""
    designs = [row["design"] for row in csv.DictReader(program.hitpipe("list", "designs", "--format", "csv").splitlines())]
    return {name: family for name, family in FAMILIES.items() if name not in SOURCES or SOURCES[name][0] in designs}


def one_line(name, bits):
    """The Verilog of a component without stages."""
    inputs, body = ONE_LINE[name]
    result = "0" if name == "int_compare" else "{high}"
    text = f"module component_of_library (\n  {inputs},\n  output wire [{result}:0] y\n);\n  {body}\nendmodule\n"
    return text.replace("{high}", str(bits - 1))


def emitted(name, bits, stages, form):
    """The component's module out of a unit that hitpipe writes with so many stages for it, and the module's name."""
    # The integer units' product: n by n bits, of which the upper n bits below the sign are kept.
    design, _, module = SOURCES[name]
    library = json.loads((LIBRARIES / "thesis_250nm.json").read_text())
    for component in SOURCES:
        row = {"bits": bits, "area_um2": 0, "delay_ps": 1, "stages": stages}
        library["components"].setdefault(component, {"above": "same", "area": "linear"})["cells"] = [row]
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "library.json").write_text(json.dumps(library))
        program.hitpipe("rtl", design, "--bits", form, "--name", "unit", "--vectors", "1", "--library", f"{folder}/library.json", "--out", folder)
        unit = (Path(folder) / "unit.v").read_text()
    found = re.search(rf"^module ({module}\w+) .*?^endmodule\n", unit, re.MULTILINE | re.DOTALL)
    if not found:
        osu018.fail(f"{design} {form} has no module {module}...")
    return found[0], found[1]


def cell(name, bits, latch_ps):
    """A row of the library."""
    stages = 0
    if name == "latch_enable":
        area, period = between_registers(LATCH_ENABLE.replace("{high}", str(bits - 1)), "component_of_library", ["en"])
    elif name in ONE_LINE:
        area, period = between_registers(one_line(name, bits), "component_of_library")
    else:
        for stages in range(1, MOST_STAGES + 1):
            found = [between_registers(*emitted(name, bits, stages, form)) for form in SOURCES[name][1][bits]]
            area, period = map(max, zip(*found))
            if period <= CLOCK_PS:
                break
        stages = 0 if stages == 1 else stages
    if name == "latch":
        return {"bits": bits, "area_um2": REGISTER_UM2 * bits, "delay_ps": period, "stages": 0}
    delay = period if name == "latch_enable" else period - latch_ps
    return {"bits": bits, "area_um2": area, "delay_ps": delay, "stages": stages}


def gate_delay_ps(latch_ps):
    """The delay of the slowest gate of two inputs."""
    return max(between_registers(one_line(gate, 1), "component_of_library")[1] for gate in ONE_LINE if "gate" in gate) - latch_ps


def written(gate_ps, rows):
    """The file: a cell a line."""
    source = (f"Measured by area_model/measure/measure.py in OSU 0.18 um standard cells, typical corner, no wires: {', '.join(osu018.versions())}. "
              f"Multipliers and float operators have the fewest stages that reach {CLOCK_PS} ps.")
    families = []
    for name, (above, area, _) in measurable().items():
        cells = ",\n".join(f"        {json.dumps(row)}" for row in rows[name])
        families.append(f'    "{name}": {{\n      "above": "{above}",\n      "area": "{area}",\n      "cells": [\n{cells}\n      ]\n    }}')
    return (f'{{\n  "name": "osu018",\n  "source": {json.dumps(source)},\n  "gate_delay_ps": {gate_ps},\n  "components": {{\n'
            + ",\n".join(families) + "\n  }\n}\n")


def measured(wanted):
    """Rows by component: all, or those that `wanted` (pairs of component and width, None for all) names."""
    latch_ps = cell("latch", 1, 0)["delay_ps"]
    rows = {}
    for name, (_, _, widths) in measurable().items():
        for bits in widths:
            if wanted and (name, None) not in wanted and (name, bits) not in wanted:
                continue
            rows.setdefault(name, []).append(cell(name, bits, latch_ps))
            print(name, *rows[name][-1].values(), file=sys.stderr, flush=True)
    return latch_ps, rows


def check(file, wanted):
    """Compares with the file."""
    library = json.loads(file.read_text())
    latch_ps, rows = measured(wanted)
    wrong = 0
    for name, cells in rows.items():
        there = {row["bits"]: row for row in library["components"][name]["cells"]}
        for row in cells:
            if there.get(row["bits"]) != row:
                print(f"{name}_{row['bits']}: measured {row}, in the file {there.get(row['bits'])}")
                wrong += 1
    if not wanted and written(gate_delay_ps(latch_ps), rows) != file.read_text():
        print(f"{file}: not what would be written; the tools here are {', '.join(osu018.versions())}")
        wrong += 1
    print(f"{sum(map(len, rows.values()))} cells measured, {wrong} differences")
    return 1 if wrong else 0


def estimate(file):
    """Prints rows of the operators toward zero for a library that has those to nearest, which are larger and slower.

    Both are synthesised without stages, by Yosys's own recipe, which takes the fewest cells. What one takes of the other
    is its share of the library's area, and of its stages, rounded up.
    """
    library = json.loads(file.read_text())["components"]
    for name, nearest in {"fp_subtract_rz": "fp_subtract", "fp_multiply_rz": "fp_multiply"}.items():
        row = library[nearest]["cells"][-1]
        (whole,) = SOURCES[nearest][1].values()
        area, period = between_registers(*emitted(nearest, 32, 1, whole[0]), recipe="small")
        for bits, forms in SOURCES[name][1].items():
            found = [between_registers(*emitted(name, bits, 1, form), recipe="small") for form in forms]
            print(name, *(f"{form}: {um2} um2 of {area}, {ps} ps of {period};" for form, (um2, ps) in zip(forms, found)))
            um2, ps = map(max, zip(*found))
            print(json.dumps({"bits": bits, "area_um2": round(row["area_um2"] * um2 / area), "delay_ps": row["delay_ps"],
                              "stages": math.ceil(row["stages"] * ps / period), "estimated": True}))


def named(argument):
    name, _, bits = argument.partition(":")
    if name not in FAMILIES or (bits and (not bits.isdigit() or int(bits) not in FAMILIES[name][2])):
        osu018.fail(f"{argument}: allowed are {', '.join(FAMILIES)}, each with a width of the file behind it if you like, as in mux2:8")
    return name, int(bits) if bits else None


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("component", nargs="*")
    options.add_argument("--check", action="store_true")
    options.add_argument("--estimate", action="store_true")
    options.add_argument("--library", type=Path, default=LIBRARY, help="the file, in place of osu018.json in the tree")
    options.add_argument("--verilog", nargs=2, metavar=("FILE", "MODULE"))
    program.add_option(options)
    chosen = options.parse_args()
    program.path = chosen.hitpipe.resolve()
    wanted = [named(argument) for argument in chosen.component]
    if osu018.missing():
        osu018.fail(osu018.missing())
    if chosen.verilog:
        file, module = chosen.verilog
        if not Path(file).is_file():
            osu018.fail(f"{file}: no such file")
        area, period = between_registers(Path(file).read_text(), module)
        print(f"area_um2 {area}, delay_ps {period - cell('latch', 1, 0)['delay_ps']}")
        return 0
    if chosen.estimate:
        estimate(LIBRARIES / "thesis_250nm.json")
        return 0
    if chosen.check:
        return check(chosen.library, wanted)
    if wanted:
        osu018.fail("single components can be checked, not written; add --check")
    latch_ps, rows = measured([])
    chosen.library.write_text(written(gate_delay_ps(latch_ps), rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
