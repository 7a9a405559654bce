#!/usr/bin/env python3
"""bench/pieces.py [PROGRAM [FOLDER]]: what it costs to cut work into 1, 8, 64 and 512 pieces, on one core. Prints the
table of docs/many_machines.md. Takes about half an hour; FOLDER keeps what is done, so that a second run goes on."""
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
    "trace --native, 10^6 rays of spheres": "trace --scene spheres --width 736 --height 736 --parts 512 --native",
    "trace --native, 10^6 rays of terrain": "trace --scene terrain --width 736 --height 736 --parts 512 --native",
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
print("| work | seconds in one piece | 8 pieces | 64 | 512 | a piece costs | so that it is 1 %: seconds a piece |")
print("|---|--:|--:|--:|--:|--:|--:|")
for name, words in WORKS.items():
    times = []
    for cut in CUTS:
        key = f"{name}, {cut}"
        if key not in known:
            if cut == 1:
                seconds(words, 8)  # models are made
            known[key] = str(seconds(words, cut))
            kept.write_text("".join(f"{k}: {v}\n" for k, v in known.items()))
        times.append(float(known[key]))
    one = times[0]
    shares = " | ".join(f"{100 * (each / one - 1):+.1f} %" for each in times[1:])
    cost = (times[-1] - one) / (CUTS[-1] - 1)
    print(f"| {name} | {one:.0f} | {shares} | {1000 * cost:.0f} ms | {100 * cost:.0f} |", flush=True)
