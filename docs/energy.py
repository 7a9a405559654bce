#!/usr/bin/env python3
"""Makes the table of docs/measured/energy.md again: docs/energy.py [PROGRAM [SIZE]]. Images have SIZE x SIZE pixels, 96 in the
page. Rows that out/energy already holds are not measured again."""
import csv
import pathlib
import subprocess
import sys

program = sys.argv[1] if len(sys.argv) > 1 else "build/hitpipe"
size = sys.argv[2] if len(sys.argv) > 2 else "96"
scenes = ["spheres", "plant_front", "city", "terrain"]
units = ["fp_slabs=fp32", "fp_plucker=fp32", "fp_slabs_safe=e8m15", "fp_slabs_safe=e8m7", "int_slabs=24/24", "int_slabs=20/24",
         "int_slabs=16/16", "int_plucker=20/24", "int_major=20+1/13", "int_major=16+1/12", "int_major_pair=20+1/13",
         "int_major_pair=16+1/12"]
page = pathlib.Path("docs/measured/energy.md")
out = pathlib.Path("out/energy")
out.mkdir(parents=True, exist_ok=True)
designs = ",".join(dict.fromkeys(unit.split("=")[0] for unit in units))

rows = {}
for scene in scenes:
    file = out / f"{scene}.csv"
    subprocess.run([program, "sweep", "--scene", scene, "--width", size, "--height", size, designs, "--bits", ",".join(units),
                    "--library", "osu018", "--out", str(file)], check=True, stdout=subprocess.DEVNULL)
    with file.open() as text:
        for row in csv.DictReader(text):
            rows[scene, row["design"], row["bits"].removeprefix("n")] = row

lines = ["| unit | mm² a box | set-up | " + " | ".join(f"{scene}: pJ a box | nJ a ray | whole cost | of set-up, %" for scene in scenes) +
         " |", "|---|--:|---|" + "--:|" * 4 * len(scenes)]
for unit in units:
    design, bits = unit.split("=")
    of = [rows[scene, design, bits] for scene in scenes]
    first = of[0]
    divisions = f"{first['set_up_divisions']} of {first['set_up_bits']} bits" if first["set_up_divisions"] != "0" else "no division"
    cells = []
    for row in of:
        whole = float(row["whole_area_run_time_mm2_ms"])
        set_up = float(row["set_up_area_mm2"]) * float(row["set_up_run_time_ms"])
        cells += [f"{float(row['energy_pj_per_box']):.0f}", f"{float(row['energy_nj_per_ray']):.1f}", f"{whole:.2f}",
                  f"{100 * set_up / whole:.1f}"]
    name = design if bits == "fp32" else f"{design} {bits}"
    lines.append(f"| {name} | {float(first['area_per_box_mm2']):.4f} | {divisions} | " + " | ".join(cells) + " |")

text = page.read_text()
begin, end = "<!-- table -->\n", "<!-- end of table -->"
page.write_text(text[:text.index(begin) + len(begin)] + "\n" + "\n".join(lines) + "\n\n" + text[text.index(end):])
