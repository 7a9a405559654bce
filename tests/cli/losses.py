#!/usr/bin/env python3
"""losses.py PROGRAM: what is lost on the way into the cube and onto the grid is counted and said; each triangle keeps the
number that it has in its file. What must be lost is computed here in rationals."""
import csv
import json
import os
import random
import re
import subprocess
import sys
import tempfile
from fractions import Fraction

program = os.path.abspath(sys.argv[1])
folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)
wrong = 0


def expect(right, what):
    global wrong
    if not right:
        wrong += 1
        print(what)


def run(*words, code=0):
    made = subprocess.run([program, *words], capture_output=True, text=True)
    expect(made.returncode == code, f"{' '.join(words)}: exit code {made.returncode}\n{made.stderr}")
    return made


def facts(*words):
    made = run(*words, "--format", "json")
    row = json.loads(made.stdout or "{}")
    row = row[0] if isinstance(row, list) else row
    return row, made.stderr


def write_obj(name, corners, offset=(0, 0, 0)):
    with open(name, "w") as file:
        for p in corners:
            file.write("v " + " ".join(repr(float(Fraction(x) + o)) for x, o in zip(p, offset)) + "\n")
        for first in range(1, len(corners) + 1, 3):
            file.write(f"f {first} {first + 1} {first + 2}\n")


def has_area(a, b, c):
    u, v = [x - y for x, y in zip(b, a)], [x - y for x, y in zip(c, a)]
    return any(u[i] * v[(i + 1) % 3] != u[(i + 1) % 3] * v[i] for i in range(3))


# The cube [-1, 1] is scene units: a camera in it, and lights.
CUBE = ["--cube", f"0,0,0,{float(1 - Fraction(1, 1024))!r}", "--eye", "0,0,0.9", "--target", "0,0,0", "--light", "0.1,0.9,0.9"]


def on_grid(corners, bits):
    """How many triangles have an area on a grid of so many bits, and what the file has."""
    scale = 2 ** (bits - 2) - 1
    rounded = [[(x * scale + Fraction(1, 2)).__floor__() for x in p] for p in corners]
    triples = [(i, i + 1, i + 2) for i in range(0, len(corners), 3)]
    return sum(has_area(*(rounded[i] for i in t)) for t in triples), sum(has_area(*(corners[i] for i in t)) for t in triples)


random.seed(54)
step = Fraction(1, 2**26)  # such numbers have an exact text, and binary32 holds them


def slivers(count):
    corners = []
    for _ in range(count):
        a = [random.randrange(-(2**24), 2**24) * step for _ in range(3)]
        along = [random.randrange(-(2**18), 2**18) * step for _ in range(3)]
        across = [random.randrange(-(2**random.randrange(1, 20)), 2**random.randrange(1, 20)) * step for _ in range(3)]
        corners += [a, [x + y for x, y in zip(a, along)], [x + y for x, y in zip(a, across)]]
    return corners


# Slivers keep fewer triangles the coarser the grid is: as many as rationals say, and the rest is counted.
corners = slivers(500)
write_obj("slivers.obj", corners)
kept_before = 0
for bits in (8, 12, 16, 20, 24):
    kept, of = on_grid(corners, bits)
    for command in ("core image", "render"):
        world = ["--world", "integer"] if command == "render" else []
        size = ["--width", "8", "--height", "8"] if command == "render" else []
        if kept == 0:
            continue
        row, said = facts(*command.split(), "--scene", "slivers.obj", "--bits", f"{bits}+1s{bits}", *CUBE, *world, *size)
        counts = row.get("triangles"), row.get("degenerate_dropped"), row.get("lost_to_rounding")
        expect(counts == (kept, 500 - of, of - kept), f"{command} at {bits} bits: {counts}, and not {kept} of {of}")
        expect((f"{of - kept} of {of} triangles lose" in said) == (of > kept), f"{command} at {bits} bits says: {said}")
        expect(said.count("\n") == (of > kept), f"{command} at {bits} bits says: {said}")
    expect(kept > kept_before, f"{bits} bits keep {kept}: the test is blind")
    kept_before = kept

# Far from the origin they are the same triangles: read, moved and scaled in double.
write_obj("near.obj", corners)
write_obj("far.obj", corners, (10**6, 2 * 10**6, -3 * 10**6))
near, far = facts("bvh", "--scene", "near.obj")[0], facts("bvh", "--scene", "far.obj")[0]
for key in ("triangles", "degenerate_dropped", "lost_to_rounding", "bvh_nodes", "leaves", "depth"):
    expect(near[key] == far[key], f"{key}: {near[key]} near the origin, {far[key]} far away")
expect(near["lost_to_rounding"] == 0, f"near the origin {near['lost_to_rounding']} are lost")
for name in ("near", "far"):
    run("bvh", "--scene", f"{name}.obj", "--out", f"{name}.bvh")
boxes = [[line.split() for line in open(f"{name}.bvh") if line.startswith(("leaf", "branch"))] for name in ("near", "far")]
moved = max(abs(float(x) - float(y)) for a, b in zip(*boxes) for x, y in zip(a[1:7], b[1:7]))
expect(moved < 2**-22, f"boxes move by {moved}")

# A needle beside a large triangle has an area in the file. It is not degenerate, and it is lost here.
with open("large.obj", "w") as file:
    file.write("v -1e9 9 -1e9\nv 1e9 9 -1e9\nv 0 9 1e9\nv 0 2 0\nv 4 -1 0\nv 0 -1 10\nf 1 2 3\nf 4 5 6\nf 1 1 2\n")
for command in ("bvh", "render", "cosim int_slabs --bits 20/24"):
    size = [] if command == "bvh" else ["--width", "4", "--height", "4"]
    row, said = facts(*command.split(), "--scene", "large.obj", *size)
    counts = row["triangles"], row["degenerate_dropped"], row["lost_to_rounding"]
    expect(counts == (1, 1, 1), f"{command} large.obj: {counts}")
    expect(re.fullmatch(r"hitpipe: large: 1 of 2 triangles loses its area in binary32, which has 24 bits: it is 4.8 thick, and the "
                        r"cube is 4.59216e\+09 wide; .*--cube.*\n", said), f"{command} large.obj says: {said}")
strict = run("bvh", "--scene", "large.obj", "--strict", code=2)
expect(strict.stderr.startswith("hitpipe: ") and strict.stderr.count("\n") == 1 and strict.stdout == "", f"--strict: {strict.stderr}")
run("core", "image", "--bits", "16+1s16", "--scene", "slivers.obj", "--strict", "--out", "none.img", code=2)
expect(not os.path.exists("none.img"), "--strict leaves an image")

# A mesh of 361 triangles beside one far away; a cube around the patch refuses the far one, and says so.
patch = [[Fraction(x, 64), Fraction(y, 64), Fraction(z, 64)] for x, y, z in ((i % 19 * 3 + k, i // 19 * 3 + (k == 1), k * k)
                                                                              for i in range(361) for k in range(3))]
write_obj("beside.obj", patch + [[10**6, 0, 0], [10**6 + 1, 0, 0], [10**6, 1, 1]])
row, said = facts("bvh", "--scene", "beside.obj")
expect(row["triangles"] + row["lost_to_rounding"] == 362 and row["lost_to_rounding"] > 100 and "of 362 triangles" in said,
       f"beside.obj: {row}\n{said}")
refused = run("bvh", "--scene", "beside.obj", "--cube", "0,0,0,4", "--eye", "0,0,1", code=2).stderr
expect(re.fullmatch(r"hitpipe: cube of 4 around \(0, 0, 0\): the mesh reaches from .*; all of it must lie in the cube\n", refused),
       f"a mesh outside the cube: {refused}")

# A cube around the mesh keeps the bits that a far camera takes. Rays that begin outside are refused by number.
shares = [facts("bvh", "--scene", "near.obj", "--eye", "0,0,50", *cube)[0]["mesh_share_of_cube_pct"]
          for cube in ([], ["--cube", "0,0,0,50"])]
expect(shares[0] < 2, f"shares of the cube: {shares}")
outside = run("bvh", "--scene", "near.obj", "--cube", "0,0,0,0.6", "--eye", "0,0,50", code=2).stderr
expect(outside == "hitpipe: cube of 0.6 around (0, 0, 0): ray 0 of the picture begins at the eye (0, 0, 50); rays must begin in the "
       "cube\n", f"an eye outside: {outside}")
wide = run("render", "--scene", "near.obj", "--cube", "0,0,0,0.6", "--eye", "0,0,0.59", "--target", "0,0,0", "--orthographic", "--fov",
           "120", "--width", "10", "--height", "10", code=2).stderr
expect(wide == "hitpipe: --cube: ray 0 of the picture begins outside; the orthographic image must begin in the cube\n", f"wide: {wide}")
with open("rays.csv", "w") as file:
    file.write("ox,oy,oz,dx,dy,dz\n0,0,0.5,0,0,-1\n0,0,0.7,0,0,-1\n")
view = ["--cube", "0,0,0,0.6", "--eye", "0,0,0.5", "--target", "0,0,0"]
listed = run("cosim", "int_slabs", "--scene", "near.obj", *view, "--rays", "rays.csv", code=2).stderr
expect(listed == "hitpipe: rays.csv: line 3: oz 0.7 lies outside the cube; a chosen cube must hold all origins\n", f"rays: {listed}")
for words in ("1,2,3", "1,2,3,0", "1,2,3,-1", "1,2,3,nan", "1,2,3,4,5", ""):
    refused = run("bvh", "--scene", "near.obj", "--cube", words, code=2).stderr
    expect("give the middle and half a side" in refused and refused.count("\n") == 1, f"--cube {words!r}: {refused}")

# Numbers have gaps where triangles are gone, and a polygon's follow each other.
with open("faces.obj", "w") as file:
    file.write("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 1.5 0\nv 9e-9 0 0\n"
               "f 1 1 2\nf 1 2 3 5 4\nf 1 2 6\nl 1 2\nf 2 3 5\nf 3 4 5\n")
view = ["--eye", "0.5,0.5,9", "--target", "0.5,0.5,0"]
run("bvh", "--scene", "faces.obj", *view, "--faces", "faces.csv", "--out", "faces.bvh")
faces = [(int(row["number"]), int(row["face"])) for row in csv.DictReader(open("faces.csv"))]
expect(faces == [(0, 0), (1, 1), (2, 1), (3, 1), (4, 2), (5, 3), (6, 4)], f"faces: {faces}")
written = open("faces.bvh").read().split("triangles ")[1].split("\n", 1)[1].split()
expect(sorted(map(int, written)) == [1, 2, 3, 5, 6], f"faces.bvh holds {written}")
again, _ = facts("bvh", "--scene", "faces.obj", *view, "--bvh", "faces.bvh")
expect(again["triangles"] == 5, f"read again: {again['triangles']}")
run("core", "image", "--scene", "faces.obj", *view, "--bits", "20+1s20", "--out", "faces.img")
image = open("faces.img", "rb").read()
# A triangle's number is in bits 216 to 247 of its block of 32 bytes (docs/core.md). Records have other words there.
numbers = {int.from_bytes(image[at + 27:at + 31], "little") for at in range(0, len(image), 32)}
expect({1, 2, 3, 5, 6} == numbers - {0}, f"numbers of the image: {sorted(numbers)}")

# Answers name them too.
with open("down.csv", "w") as file:
    file.write("ox,oy,oz,dx,dy,dz\n" + "".join(f"{x / 10},{y / 10},1,0,0,-1\n" for x in range(1, 10) for y in range(1, 13)))
for world in ([], ["--world", "integer"]):
    run("render", "--scene", "faces.obj", *view, *world, "--rays", "down.csv", "--answers", "answers.csv")
    rows = [row for row in csv.DictReader(open("answers.csv")) if row["hit"] == "1"]
    expect(len(rows) > 80, f"{len(rows)} hits")
    expect({(int(row["number"]), int(row["face"])) for row in rows} == {(1, 1), (2, 1), (3, 1)}, "numbers and faces of answers")

print(f"{wrong} wrong")
sys.exit(wrong > 0)
