#!/usr/bin/env python3
"""Makes the table of docs/measured/memory.md again: docs/memory.py [SIZE [PROGRAM]]. Images have SIZE x SIZE pixels, 96 in the document."""
import csv
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

page = pathlib.Path(__file__).parent / "measured/memory.md"
size = sys.argv[1] if len(sys.argv) > 1 else "96"
program = sys.argv[2] if len(sys.argv) > 2 else "build/hitpipe"
SCENES = ["spheres", "branch", "poppy", "plant_front", "statue", "city", "reading_room", "terrain"]
BY_DISTANCE = ["--traversal", "slabs-dist"]
# Name in the table, options of `hitpipe render`, and the format that has the same tree with exact boxes.
RENDERED = [("plain", [], "plain"),
            ("h8", ["--encoding", "h8"], "plain"),
            ("int_slabs 16/16", ["--arithmetic", "integer", "--bits", "16/16"], "plain"),
            ("int_slabs 20/24", ["--arithmetic", "integer", "--bits", "20/24"], "plain"),
            ("pair6", ["--encoding", "pair6"], "plain"),
            ("pair8", ["--encoding", "pair8"], "plain"),
            ("pair10", ["--encoding", "pair10"], "plain"),
            ("wide4", [*BY_DISTANCE, "--encoding", "wide4"], "wide4-float"),
            ("wide8", [*BY_DISTANCE, "--encoding", "wide8"], "wide8-float"),
            ("wide4-float", [*BY_DISTANCE, "--encoding", "wide4-float"], "wide4-float"),
            ("wide8-float", [*BY_DISTANCE, "--encoding", "wide8-float"], "wide8-float")]
MEMORY = ["", "_4kib", "_16kib", "_64kib"]
ORDER = ["plain", "h8", "int_slabs 16/16", "int_slabs 20/24", "int_major_pair 20+1/11", "core 20+1s20", "pair6", "pair8",
                "pair10", "wide4", "wide8", "wide4-float", "wide8-float"]


def run(*command):
    return subprocess.run([program, *command], check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout


def rendered(scene, options):
    """Bytes a ray without a cache and behind each, box tests and triangle tests a ray."""
    row = json.loads(run("render", "--scene", scene, "--width", size, "--height", size, "--builder", "sah", "--max-triangles", "2",
                         "--cache", "4,16,64", *options, "--format", "json"))
    return [row["bytes_per_ray" + each] for each in MEMORY], row["box_tests_per_ray"], row["triangle_tests_per_ray"]


def swept(scene):
    """The same of int_major_pair."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "rows.csv"
        run("sweep", "int_major_pair", "--bits", "20+1/11", "--scene", scene, "--width", size, "--height", size, "--out", str(out))
        row = next(csv.DictReader(out.read_text().splitlines()))
    rays = float(row["bytes_fetched"]) / float(row["bytes_per_ray"])
    return [float(row["bytes_per_ray" + each]) for each in MEMORY], float(row["box_tests"]) / rays, float(row["triangle_tests"]) / rays


def imaged(scene):
    """The same of the core."""
    row = json.loads(run("core", "image", "--scene", scene, "--width", size, "--height", size, "--stack", "8", "--cache", "4,16,64",
                         "--format", "json"))[0]
    return [row["bytes_a_ray" + each] for each in MEMORY], 2 * row["records_a_ray"], row["triangles_a_ray"]


def extra(value, exact):
    return f"{100 * (value / exact - 1):.1f}"


EXACT = {name: reference for name, _, reference in RENDERED}


def figures(scene):
    """By format: bytes, boxes and triangles a ray."""
    measured = {name: rendered(scene, options) for name, options, _ in RENDERED}
    measured["int_major_pair 20+1/11"] = swept(scene)
    measured["core 20+1s20"] = imaged(scene)
    return {name: [*measured[name][0], *measured[name][1:]] for name in ORDER}


def rows(scene, of):
    for name in ORDER:
        *bytes_a_ray, boxes, triangles = of[name]
        reference = EXACT.get(name, "plain")
        cells = [f"{each:.0f}" for each in bytes_a_ray] + [f"{boxes:.1f}", f"{triangles:.2f}"]
        cells += ["", ""] if reference == name else [extra(boxes, of[reference][4]), extra(triangles, of[reference][5])]
        yield f"| {scene} | {name} | " + " | ".join(cells) + " |\n"


def means(all_scenes):
    """By format: geometric means over the scenes, in percent of plain."""
    def mean(name, column):
        return 100 * statistics.geometric_mean(of[name][column] / of["plain"][column] for of in all_scenes)
    return {name: [mean(name, column) for column in range(6)] for name in ORDER}


text = page.read_text()
before, rest = text.split("<!-- table -->\n", 1)
after = rest.split("<!-- end of table -->", 1)[1]
table = "| scene | format | no cache | 4 KiB | 16 KiB | 64 KiB | boxes | triangles | extra boxes % | extra triangles % |\n"
table += "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|\n"
measured = {scene: figures(scene) for scene in SCENES}
for scene, of in {"mean, % of plain": means(list(measured.values())), **measured}.items():
    table += "".join(rows(scene, of))
page.write_text(f"{before}<!-- table -->\n\n{table}\n<!-- end of table -->{after}")
