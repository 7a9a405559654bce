#!/usr/bin/env python3
"""Makes the tables of docs/measured/core_memory.md again: docs/core_memory.py [PROGRAM]. It takes some minutes, and Yosys."""
import concurrent.futures
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

page = pathlib.Path(__file__).parent / "measured/core_memory.md"
program = sys.argv[1] if len(sys.argv) > 1 else "build/hitpipe"
SCENES = ["spheres", "terrain", "plant_front", "statue", "city", "reading_room"]
# Name, and the bus that fits its port.
MEMORIES = {"dram": [], "litedram-128": ["--in-order", "--data-bits", "128"], "axi-256": []}
CACHES = [0, 4, 16, 64]
RAYS = [8, 32, 128]


def run(*command):
    return subprocess.run([program, *command], check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout


def cache_options(kib):
    return ["--cache", str(kib)] if kib else []


def cycles(memory, kib, scene):
    """Cycles a ray by rays in flight. Every answer is compared, or the command fails."""
    rows = json.loads(run("core", "trace", "--native", "--scene", scene, "--width", "64", "--height", "64", "--rays-in-flight",
                          ",".join(map(str, RAYS)), "--memory", memory, *MEMORIES[memory], *cache_options(kib), "--format", "json"))
    return {row["rays_in_flight"]: row["cycles_a_ray"] for row in rows}


def mapped(rays, kib):
    """LUTs and block RAMs of 36 Kbit of the core behind AXI, on an Artix-7."""
    with tempfile.TemporaryDirectory() as folder:
        rows = json.loads(run("core", "implement", "--triangle-ii", "8", "--target", "xc7", "--rays", str(rays), *cache_options(kib), "--out",
                              folder, "--format", "json"))
    return rows[1]["luts"], rows[1]["rams"] / 2


def size_of(kib):
    return f"{kib} KiB" if kib else "none"


def table(head, rows):
    text = "| " + " | ".join(head) + " |\n|" + "|".join(["---", "---"] + ["--:"] * (len(head) - 2)) + "|\n"
    return text + "".join("| " + " | ".join(row) + " |\n" for row in rows)


with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
    traced = {(memory, kib): {scene: pool.submit(cycles, memory, kib, scene) for scene in SCENES} for memory in MEMORIES for kib in CACHES}
    chips = {(rays, kib): pool.submit(mapped, rays, kib) for kib in CACHES for rays in RAYS}
all_cycles = {key: {scene: one.result() for scene, one in of.items()} for key, of in traced.items()}
chips = {key: one.result() for key, one in chips.items()}
which, each = [], []
for (memory, kib), of in all_cycles.items():
    means = [f"{statistics.geometric_mean(of[scene][rays] for scene in SCENES):.1f}" for rays in RAYS]
    which.append([memory, size_of(kib), *means])
    for rays in RAYS:
        each.append([memory, size_of(kib), str(rays), *[f"{of[scene][rays]:.1f}" for scene in SCENES]])
luts = [[size_of(kib), "RAM of 36 Kbit: " + ", ".join(f"{chips[rays, kib][1]:g}" for rays in RAYS), *[f"{chips[rays, kib][0]:,}" for rays in RAYS]]
        for kib in CACHES]
tables = {"which": table(["memory", "cache", *[f"{rays} rays" for rays in RAYS]], which),
          "chips": table(["cache", "block RAMs", *[f"{rays} rays: LUTs" for rays in RAYS]], luts),
          "scenes": table(["memory", "cache", "rays", *SCENES], each)}
text = page.read_text()
for name, made in tables.items():
    before, rest = text.split(f"<!-- {name} -->\n", 1)
    text = f"{before}<!-- {name} -->\n\n{made}\n<!-- end -->" + rest.split("<!-- end -->", 1)[1]
page.write_text(text)
