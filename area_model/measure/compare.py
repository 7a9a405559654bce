#!/usr/bin/env python3
"""Whole units in OSU 0.18 um cells, and what the area model says of them.

  area_model/measure/compare                  the tables of docs/chips.md, docs/measured/chips.md
                                              and docs/never_misses.md, from units.csv
  area_model/measure/compare --plan           lists the units that the tables need, and which of them units.csv has
  area_model/measure/compare --run            synthesises all units that units.csv does not have, and adds them
  area_model/measure/compare DESIGN FORMAT    synthesises one unit and prints its line of units.csv
"""

import argparse
import csv
import re
import functools
import json
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
import osu018
import program
from program import ROOT, hitpipe

UNITS = Path(__file__).with_name("units.csv")
OSU018 = "rtl_gen/component/libraries/osu018.json"
THESIS = "rtl_gen/component/libraries/thesis_250nm.json"
FIELDS = ["library", "recipe", "design", "bits", "stages", "registers", "um2", "period_ps"]

# The units of one page: those that it compares.
DOCS_MAJOR = [("fp_slabs", "fp32"), ("int_slabs", "24/24"), ("int_slabs", "20/24"), ("int_slabs", "16/16"),
              ("int_major", "20+1/13"), ("int_major_pair", "20+1/13"), ("int_major_pair", "20+1/12")]
# Six formats of a family, by how it writes them. A design of another family is taken in its own format.
FORMATS = {"n/t": ["12/12", "16/16", "16/20", "20/24", "24/24", "32/32"],
           "n+g/p": ["12+1/8", "16+0/8", "16+1/12", "20+1/12", "20+1/13", "24+1/16"],
           "eEmM": ["e5m7", "e5m10", "e8m7", "e8m11", "e8m15", "e8m23"]}
TABLE_7_1 = [("fp_subtract", 32), ("fp_multiply", 32), ("fp_compare", 32), ("int_subtract", 24), ("int_multiply", 24),
             ("int_compare", 24), ("mux2", 24), ("latch", 24)]

def rows_of(*arguments):
    rows = list(csv.DictReader(hitpipe(*arguments, "--format", "csv").splitlines()))
    for row in rows:
        if "bits" in row: row["bits"] = re.sub(r"^n(?=\d)", "", row["bits"])  # CSV has n20/24 for 20/24
    return rows


@functools.cache
def table_7_2():
    """The units of Table 7.2; the first is what it compares the others with."""
    return [(row["design"], row["bits"]) for row in rows_of("area")]


@functools.cache
def modelled():
    """Every design that hitpipe has, family by family and format by format."""
    families = {}
    for row in rows_of("list", "designs"):
        formats = FORMATS.get(row["formats"].split()[0], [row["bits"]])
        families.setdefault(tuple(formats), []).append(row["design"])
    return [(design, bits) for formats, designs in families.items() for bits in formats for design in designs]


def plan():
    """Everything that the tables need, as (library, recipe, design, bits)."""
    return [*[(THESIS, "small", *unit) for unit in DOCS_MAJOR],
            *[(THESIS, "timed", *unit) for unit in table_7_2()],
            *[(OSU018, "timed", *unit) for unit in modelled()]]


def measured(library, recipe, design, bits):
    """A line of units.csv."""
    with tempfile.TemporaryDirectory() as folder:
        hitpipe("rtl", design, "--bits", bits, "--library", library, "--name", "unit", "--vectors", "1", "--out", folder)
        stages = json.loads((Path(folder) / "unit.json").read_text())["stages"]
        um2, registers = osu018.synthesise(folder, "unit.v", "unit", tied=["out_ready"], recipe=recipe)
        return dict(zip(FIELDS, [Path(library).stem, recipe, design, bits, stages, registers, um2,
                                 osu018.period_ps(folder, "unit")]))


def known():
    if not UNITS.exists():
        return {}
    with UNITS.open() as lines:
        return {(row["library"], row["recipe"], row["design"], row["bits"]): row for row in csv.DictReader(lines)}


def run_missing():
    for library, recipe, design, bits in plan():
        if (Path(library).stem, recipe, design, bits) in known():
            continue
        row = measured(library, recipe, design, bits)
        new = not UNITS.exists()
        with UNITS.open("a") as out:
            writer = csv.DictWriter(out, FIELDS, lineterminator="\n")
            if new:
                writer.writeheader()
            writer.writerow(row)
        print(*row.values(), flush=True)


@functools.cache
def without_back_pressure():
    """As the units are synthesised: the option of a hitpipe that has a choice."""
    return ["--flow-control", "none"] if "--flow-control" in hitpipe("area", "--help") else []


def priced(library, design, bits, account="built"):
    """The line of `hitpipe area` for a unit: area in mm2, period in ns, percent of fp_slabs in the same account."""
    flow = without_back_pressure() if account == "built" else []
    return rows_of("area", design, "--bits", bits, "--library", library, "--account", account, *flow)[0]


def departure(model, cells):
    return f"{100 * (float(model) / cells - 1):+.1f} %"


def model_table(units):
    """The model beside the cells of the same Verilog."""
    print("| unit | stages | cells, mm² | model, mm² | model is off | cells, ns | model, ns | model is off |")
    print("|---|--:|--:|--:|--:|--:|--:|--:|")
    for design, bits in modelled():
        unit = units.get(("osu018", "timed", design, bits))
        if not unit:
            continue
        model = priced(OSU018, design, bits)
        if model["stages"] != unit["stages"]:
            osu018.fail(f"{design} {bits} has {model['stages']} stages now; delete its line of units.csv and add it with --run")
        mm2, ns = int(unit["um2"]) / 1e6, int(unit["period_ps"]) / 1e3
        print(f"| {design} {bits} | {unit['stages']} | {mm2:.4f} | {model['area_mm2']} | {departure(model['area_mm2'], mm2)} "
              f"| {ns:.3f} | {model['stage_delay_ns']} | {departure(model['stage_delay_ns'], ns)} |")


def thesis_table(units):
    """Table 7.2 beside the same units in cells, with the thesis's stages and with the stages of osu018."""
    print("| unit | Table 7.2, mm² | % | stages | cells, mm² | % | ns | area × delay, % | stages | cells, mm² | % | ns | area × delay, % |")
    print("|---|" + "--:|" * 12)
    for design, bits in table_7_2():
        printed = priced(THESIS, design, bits, "printed")
        line = f"| {design} {bits} | {printed['area_mm2']} | {printed['area_pct']} "
        for library in ("thesis_250nm", "osu018"):
            unit, slabs = units.get((library, "timed", design, bits)), units.get((library, "timed", *table_7_2()[0]))
            if not unit or not slabs:
                line += "| | | | | "
                continue
            um2, ps = int(unit["um2"]), int(unit["period_ps"])
            whole = int(slabs["um2"])
            line += (f"| {unit['stages']} | {um2 / 1e6:.4f} | {100 * um2 / whole:.0f} | {ps / 1e3:.3f} "
                     f"| {100 * um2 * ps / whole / int(slabs['period_ps']):.0f} ")
        print(line + "|")


def component_table(_units):
    """The prices of Table 7.1 beside the measured prices."""
    libraries = [json.loads((ROOT / library).read_text())["components"] for library in (THESIS, OSU018)]
    print("| component | Table 7.1, µm² | of a multiplier | stages | ns | cells, µm² | of a multiplier | stages | ns |")
    print("|---|" + "--:|" * 8)
    for name, bits in TABLE_7_1:
        line = f"| {name}_{bits} "
        for library in libraries:
            row, multiplier = ([cell for cell in library[component]["cells"] if cell["bits"] == width][0]
                               for component, width in ((name, bits), ("int_multiply", 24)))
            line += (f"| {row['area_um2']:,} | {100 * row['area_um2'] / multiplier['area_um2']:.1f} % "
                     f"| {row['stages'] or 1} | {row['delay_ps'] / 1000:.3f} ")
        print(line + "|")


def small_table(units):
    """The table of docs/never_misses.md: Yosys's own recipe, for each box."""
    slabs = units.get(("thesis_250nm", "small", *table_7_2()[0]))
    print("| unit | mm² | registers | boxes a test | mm² a box | of fp_slabs |\n|---|--:|--:|--:|--:|--:|")
    for design, bits in DOCS_MAJOR:
        unit = units.get(("thesis_250nm", "small", design, bits))
        if not unit or not slabs:
            continue
        boxes = int(priced(THESIS, design, bits)["boxes_per_test"])
        um2 = int(unit["um2"])
        print(f"| {design} {bits} | {um2 / 1e6:.3f} | {unit['registers']} | {boxes} | {um2 / boxes / 1e6:.3f} "
              f"| {100 * um2 / boxes / int(slabs['um2']):.1f} % |")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("unit", nargs="*", metavar="DESIGN FORMAT")
    options.add_argument("--plan", action="store_true")
    options.add_argument("--run", action="store_true")
    options.add_argument("--library", default=OSU018, help="the library that says where the registers are (default: %(default)s)")
    options.add_argument("--recipe", choices=osu018.RECIPES, default="timed",
                         help="timed: with buffers and sizes; small: least area, nets without buffers (default: %(default)s)")
    program.add_option(options)
    chosen = options.parse_args()
    program.path = chosen.hitpipe.resolve()
    if (chosen.unit or chosen.run) and osu018.missing():
        osu018.fail(osu018.missing())
    if chosen.plan:
        for library, recipe, design, bits in plan():
            there = (Path(library).stem, recipe, design, bits) in known()
            print(Path(library).stem, recipe, design, bits, "measured" if there else "missing")
    elif chosen.run:
        run_missing()
    elif len(chosen.unit) == 2:
        print(",".join(map(str, measured(chosen.library, chosen.recipe, *chosen.unit).values())))
    elif chosen.unit:
        osu018.fail("a unit is a design and a format, as in: compare int_slabs 20/24")
    else:
        for table in (model_table, thesis_table, component_table, small_table):
            table(known())
            print()
    return 0


if __name__ == "__main__":
    sys.exit(main())
