#!/usr/bin/env python3
"""bench/pieces.py [PROGRAM [FOLDER]]: what it costs to cut work into 1, 8, 64 and 512 pieces, on one core. Prints the
tables of docs/choosing.md. Takes about half an hour; FOLDER keeps what is done, so that a second run goes on."""
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import time

program = str(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/hitpipe").resolve())
folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "out/pieces")
CUTS = (1, 8, 64, 512)
ALL_RAYS = ",".join(str(k) for k in range(1, 65))
FORMATS = "8/8,10/10,12/12,14/14,16/16,18/18,20/20,24/24"
WORKS = {
    "check, 10^9 tests in C++": "check int_slabs --bits 20/24 --tests 1000000000",
    "check --rtl, 2 · 10^7 tests": "check int_slabs --bits 20/24 --tests 20000000 --rtl",
    "sweep, 512 rows of spheres": f"sweep int_slabs --bits {FORMATS} --rays-in-flight {ALL_RAYS} --scene spheres "
                                  "--width 48 --height 48",
    "trace --native, 736 x 736 pixels of spheres": "core trace --scene spheres --width 736 --height 736 --parts 512 --native",
    "trace --native, 736 x 736 pixels of terrain": "core trace --scene terrain --width 736 --height 736 --parts 512 --native",
}


def lines_of(words):
    made = subprocess.run([program, *shlex.split(words)], cwd=folder, capture_output=True, text=True, check=True)
    return made.stdout.splitlines()


def seconds(words, pieces):
    """Of all pieces, one after the other."""
    place = folder / "p"
    shutil.rmtree(place, ignore_errors=True)
    commands = lines_of(f"{words} --pieces {pieces} --out p")
    begin = time.monotonic()
    for command in commands:
        subprocess.run(["sh", "-c", command], cwd=folder, check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
    return time.monotonic() - begin


folder.mkdir(parents=True, exist_ok=True)
kept = folder / "seconds.txt"
known = dict(line.rsplit(": ", 1) for line in kept.read_text().splitlines()) if kept.exists() else {}
print("| work | in one piece, s | 8 pieces | 64 | 512 | a piece costs, ms | to cost 1 %, a piece takes, s |")
print("|---|--:|--:|--:|--:|--:|--:|")
for name, words in WORKS.items():
    times = []
    for cut in CUTS:
        if times and times[-1] > 5 * times[0]:
            break  # more pieces only take longer
        key = f"{name}, {cut}"
        if key not in known:
            if cut == 1 and "core trace" not in words:
                seconds(words, 8)  # models are made
            known[key] = str(seconds(words, cut))
            kept.write_text("".join(f"{k}: {v}\n" for k, v in known.items()))
        times.append(float(known[key]))
    one = times[0]
    shares = [f"{round(100 * (each / one - 1))} %" for each in times[1:]] + ["-"] * (len(CUTS) - len(times))
    cost = (times[-1] - one) / (CUTS[len(times) - 1] - 1)
    print(f"| {name} | {one:.0f} | {' | '.join(shares)} | {1000 * cost:.0f} | {100 * cost:.0f} |", flush=True)


def fastest(words, runs=5, **more):
    """In milliseconds."""
    best = float("inf")
    for _ in range(runs):
        begin = time.monotonic()
        subprocess.run([program, *shlex.split(words)], cwd=folder, check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, env={**os.environ, **more})
        best = min(best, time.monotonic() - begin)
    return 1000 * best


start = fastest("list designs")
print("\n| what a piece does first | ms |\n|---|--:|")
print(f"| start of the program | {start:.0f} |")
for scene in ("spheres", "terrain", "terrain --triangles 1000000"):
    took = fastest(f"bvh --scene {scene} --builder sah --max-triangles 2 --threads 1") - start
    print(f"| {scene}: scene and hierarchy | {took:.0f} |")
    if scene == "spheres":
        spheres = took
took = fastest("core trace --scene spheres --width 8 --height 8 --native --threads 1") - start - spheres
print(f"| a core: its schedule and its machine in C++ | {took:.0f} |")
judged = "check int_slabs --bits 20/24 --tests 1 --threads 1"
in_cpp = fastest(judged)
print(f"| a model from the cache | {fastest(f'{judged} --rtl') - in_cpp:.0f} |")
empty = folder / "cache"
shutil.rmtree(empty, ignore_errors=True)
fastest("check int_slabs --bits 8/8 --tests 1 --rtl", 1, HITPIPE_CACHE=str(empty))  # Verilator's own code
took = fastest(f"{judged} --rtl", 1, HITPIPE_CACHE=str(empty)) - in_cpp
print(f"| a model that no piece of the machine has made yet | {took:.0f} |")
