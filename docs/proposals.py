#!/usr/bin/env python3
"""Makes the tables of docs/measured/proposals.md again: docs/proposals.py [SIZE [PROGRAM [TABLE...]]]. Images have SIZE x SIZE pixels, 64 in the document."""
import csv
import io
import pathlib
import subprocess
import sys

page = pathlib.Path(__file__).parent / "measured/proposals.md"
size = sys.argv[1] if len(sys.argv) > 1 else "64"
# The fewest triangles that a scene can have: the tree of a larger one takes minutes.
KD_SCENES = {"spheres": 24578, "branch": 80000, "poppy": 25000, "plant_front": 300000, "statue": 10000, "two_statues": 20000,
             "plant_slice": 27962, "waves": 10000, "city": 100000, "city_oblique": 100000, "reading_room": 60000,
             "terrain": 10000}
program = sys.argv[2] if len(sys.argv) > 2 else "build/hitpipe"


def cell(figure, low, high):
    if not figure:
        return ""
    text = f"{float(figure):.2f}" if abs(float(figure)) < 1000 else f"{float(figure):.0f}"
    return f"{text} ± {(float(high) - float(low)) / 2:.2f}" if low else text


def printed(name, triangles, *options):
    """The rows of `hitpipe table NAME`, the column names first."""
    command = [program, "table", name, "--width", size, "--height", size, "--format", "csv", "--triangles", str(triangles)]
    out = subprocess.run([*command, *options], check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
    return list(csv.reader(io.StringIO(out)))


def table(name):
    """Our lines of `hitpipe table NAME`, with half the widths of their 95 % intervals."""
    if name == "kd":
        tables = [printed(name, triangles, "--only", scene) for scene, triangles in KD_SCENES.items()]
        rows = [tables[0][0], *(row for each in tables for row in each[1:])]
    else:
        rows = printed(name, 100000)
    source = rows[0].index("source")
    lines = {}
    for row in rows[1:]:
        lines.setdefault(tuple(row[:source]), []).append(row[source + 1:])
    names = rows[0][:source] + rows[0][source + 1:]
    text = "| " + " | ".join(names) + " |\n|" + "---|" * source + "--:|" * (len(names) - source) + "\n"
    for labels, kinds in lines.items():  # ours, the ends of its intervals if there are any, the thesis's
        ours = kinds[0]
        low, high = kinds[1:3] if len(kinds) == 4 else ([""] * len(ours),) * 2
        text += "| " + " | ".join(list(labels) + [cell(*three) for three in zip(ours, low, high)]) + " |\n"
    return text


text = page.read_text()
for name in sys.argv[3:] or ("adaptive", "grid", "kd"):
    before, rest = text.split(f"<!-- {name} -->\n", 1)
    after = rest.split(f"<!-- end of {name} -->", 1)[1]
    text = f"{before}<!-- {name} -->\n\n{table(name)}\n<!-- end of {name} -->{after}"
    page.write_text(text)
