#!/usr/bin/env python3
"""Every CSV file that hitpipe writes, and every table that it prints as CSV, is one that others read: the first
line is the header, each name is there once, every row has as many cells, a number stays a number, and no cell is
one that a spreadsheet takes for a date."""
import csv
import io
import json
import pathlib
import re
import subprocess
import sys
import tempfile

hitpipe, report = sys.argv[1], pathlib.Path(sys.argv[2])
wrong = []


def run(words):
    made = subprocess.run([hitpipe, *words.split()], capture_output=True, text=True, check=False)
    if made.returncode != 0:
        sys.exit(f"hitpipe {words}: exit code {made.returncode}: {made.stderr}")
    return made.stdout


def check(name, text):
    """The table in the text, by name of column."""
    rows = list(csv.reader(io.StringIO(text), strict=True))
    header = rows[0]
    if len(rows) < 2:
        wrong.append(f"{name}: no rows")
    for column in header:
        if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", column) or header.count(column) > 1:
            wrong.append(f"{name}: column {column!r}")
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(header):
            wrong.append(f"{name}: line {number} has {len(row)} cells, the header {len(header)}")
        for column, cell in zip(header, row):
            if re.fullmatch(r"\d+/\d+", cell):
                wrong.append(f"{name}: line {number}: {column} is {cell!r}, a date to a spreadsheet")
            if re.search(r"_(pct|ms|ns|mm2|mhz|low|high|ratio|tests|hits|misses)$", column):
                try:
                    float(cell or "nan")
                except ValueError:
                    wrong.append(f"{name}: line {number}: {column} is {cell!r}, which is no number")
    return [dict(zip(header, row)) for row in rows[1:]]


def check_notes(file, tables):
    made = json.loads(file.read_text())
    if made["@context"] != "http://www.w3.org/ns/csvw":
        wrong.append(f"{file.name}: not CSV on the Web")
    described = [made] if "url" in made else made["tables"]
    named = [table["url"] for table in described]
    for table in described:
        columns = table["tableSchema"]["columns"]
        with open(file.parent / table["url"], newline="") as text:
            header = next(csv.reader(text))
        if [column["name"] for column in columns] != header:
            wrong.append(f"{file.name}: columns {columns} of {table['url']}, whose header is {header}")
        for column in columns:
            unit = {"ms": "ms", "ns": "ns", "mm2": "mm2", "pct": "%", "mhz": "MHz"}.get(column["name"].split("_")[-1])
            said = column.get("schema:unitText", "")
            if unit and not said.endswith(unit):
                wrong.append(f"{file.name}: {column} without its unit")
    if sorted(named) != sorted(tables):
        wrong.append(f"{file.name}: names {named}, beside it are {tables}")
    notes = made["notes"][0]
    if not notes["program"].startswith("hitpipe ") or not notes["command"].startswith("hitpipe "):
        wrong.append(f"{file.name}: {notes}")
    return notes


with tempfile.TemporaryDirectory() as name:
    out = pathlib.Path(name)
    small = "--scene spheres --width 8 --height 8"
    (out / "rays.csv").write_text("ox,oy,oz,dx,dy,dz,length\n-1,0,0,1,0,0,2\n0,0,0,0,1,0,inf\n")
    (out / "boxes.csv").write_text("min_x,min_y,min_z,max_x,max_y,max_z\n0,0,0,.5,.5,.5\n0,.5,0,1,1,1\n")
    boxes = f"--rays {out}/rays.csv --boxes {out}/boxes.csv"

    run(f"sweep {small} int_slabs,fp_slabs --bits int_slabs=12/12 --out {out}/sweep.csv")
    rows = check("sweep.csv", (out / "sweep.csv").read_text())
    if any("," in cell for row in rows for cell in row.values()):
        wrong.append("sweep.csv: a cell has a comma")
    if min(float(row["area_mm2"]) for row in rows if row["design"] == "int_slabs") <= 0:
        wrong.append("sweep.csv: no area")
    notes = check_notes(out / "sweep.csv-metadata.json", ["sweep.csv"])
    if notes["scene"] != "spheres" or len(notes["camera_in_cube"]["eye"]) != 3:
        wrong.append(f"sweep.csv-metadata.json: {notes}")
    # What it prints is what it wrote, and formats are read as they are written.
    bits = next(row["bits"] for row in rows if row["design"] == "int_slabs")
    again = run(f"sweep {small} int_slabs,fp_slabs --bits int_slabs={bits} --out {out}/sweep.csv --format csv")
    if again != (out / "sweep.csv").read_text():
        wrong.append("sweep --format csv differs from sweep.csv")

    run(f"sweep int_triangle {small} --bits 20+1s20 --mantissas 11 --out {out}/world.csv")
    check("world.csv", (out / "world.csv").read_text())
    check_notes(out / "world.csv-metadata.json", ["world.csv"])

    run(f"operands int_slabs {boxes} --with-input --out {out}/operands.csv")
    check("operands.csv", (out / "operands.csv").read_text())
    check_notes(out / "operands.csv-metadata.json", ["operands.csv"])
    check("operands to standard output", run(f"operands int_slabs {boxes} --out -"))

    run(f"sweep int_slabs --bits 12/12 --scene spheres --rays {out}/rays.csv --answers {out}/answers.csv --out {out}/listed.csv")
    check("answers.csv", (out / "answers.csv").read_text())
    check_notes(out / "answers.csv-metadata.json", ["answers.csv"])

    run(f"check --stiff int_slabs --bits 12/12 --tests 60 --scene spheres --rays 20 --out {out}/stiff")
    ratios = {row["log2_ratio"] for row in check("stiffness.csv", (out / "stiff/stiffness.csv").read_text())}
    if not all(float(ratio) >= 0 for ratio in ratios):
        wrong.append(f"stiffness.csv: log2_ratio is one of {ratios}")
    check_notes(out / "stiff/stiffness.csv-metadata.json", ["stiffness.csv"])

    tables = sorted(report.glob("*.csv"))
    if not tables:
        wrong.append(f"{report}: no tables")
    for table in tables:
        check(f"report/{table.name}", table.read_text())
    check_notes(report / "csv-metadata.json", [table.name for table in tables])

    for words in [
            "check int_slabs --bits 12/12 --tests 4096", "check int_triangle --tests 4096", "list designs", "list scenes",
            "area int_slabs --bits 12/12", f"cosim int_slabs --bits 12/12 {small} --referee", f"render {small}",
            f"bvh --scene spheres --sweep", f"core image {small} --stack 0,8",
            f"core trace {small} --native --rays-in-flight 8,16", f"fit int_slabs {small} --vectors 100 --out {out}/fit",
            "table 7.2"
    ]:
        check(words, run(f"{words} --format csv"))

for line in wrong:
    print(line)
print(f"{'wrong' if wrong else 'every table is read'}")
sys.exit(1 if wrong else 0)
