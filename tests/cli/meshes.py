#!/usr/bin/env python3
"""meshes.py PROGRAM FOLDER: mesh files that readers get wrong, each with its right answer: so many triangles that lie where
right.bvh says, so many pixels, or one line that refuses it."""
import re
import subprocess
import sys

program, folder = sys.argv[1:]
# File, what it answers, and a hierarchy that fits.
CASES = [
    ("gltf_crashes/skin_without_matrices.gltf", 1, None),
    ("gltf_crashes/mime_type.gltf", 2, None),
    ("gltf_index_out_of_range/range.gltf", r"refers to vertex 7; .* 0 to 3", None),
    ("gltf_percent_uri/p.gltf", 2, None),
    ("gltf_required_extension/instances.gltf", 4, None),
    ("gltf_required_extension/unknown.gltf", "extension", None),
    ("obj_comment_behind_numbers/f.obj", 1, None),
    ("obj_comment_behind_numbers/v.obj", 1, None),
    ("obj_leading_dot/dot.obj", 2, "obj_leading_dot/right.bvh"),
    ("obj_leading_dot/dot_positive.obj", 1, None),
    ("obj_mtl_aniso/a.obj", 1, None),
    ("obj_no_texture_coordinates/novt.obj", 2, "obj_no_texture_coordinates/right.bvh"),
    ("obj_no_texture_coordinates/all.obj", 1, None),
    ("ply_binary_first_byte_10/x_is_0.01.ply", 1, None),
    ("ply_binary_first_byte_10/silent.ply", 4, "ply_binary_first_byte_10/right.bvh"),
    ("ply_blank_line/blank.ply", 1, None),
    ("ply_element_before_vertex/camera.ply", 4, "ply_element_before_vertex/right.bvh"),
    ("stl_spellings/ENDSOLID.stl", 1, None),
    ("stl_spellings/end_solid.stl", 1, None),
    ("stl_spellings/long_name.stl", 1, None),
    ("stl_spellings/binary_tail.stl", 1, None),
]
wrong = 0


def say(file, what):
    global wrong
    wrong += 1
    print(f"{file}: {what}")


def run(*words):
    return subprocess.run([program, *words], cwd=folder, capture_output=True, text=True)


def value(printed, key):
    found = re.search(rf"^{key} +([\d,]+)$", printed, re.M)
    return int(found[1].replace(",", "")) if found else None


for file, right, hierarchy in CASES:
    made = run("bvh", "--scene", file, *(["--bvh", hierarchy] if hierarchy else []))
    if isinstance(right, int):
        found = value(made.stdout, "triangles")
        if made.returncode != 0 or found != right or value(made.stdout, "degenerate_dropped") != 0:
            say(file, f"exit code {made.returncode}, {found} triangles and not {right}: {made.stderr}")
    elif made.returncode != 2 or made.stderr.count("\n") != 1 or not re.search(right, made.stderr):
        say(file, f"exit code {made.returncode}, and no line that says {right}: {made.stderr}")

# Five corners, concave, two of them on the line of an edge. An area of 2.5 shows in 2,778 of 10,000 pixels.
made = run("render", "--scene", "obj_concave_polygon/five.obj", "--width", "100", "--height", "100", "--orthographic", "--eye",
           "1.5,1.5,9", "--target", "1.5,1.5,0", "--up", "0,1,0", "--fov", "18.92464441605119", "--sun", "0,0,1", "--bounces", "0")
found = value(made.stdout, "surface_points")
if made.returncode != 0 or found is None or abs(found - 2778) > 60:
    say("obj_concave_polygon/five.obj", f"exit code {made.returncode}, {found} surface points: {made.stderr}")

print(f"{len(CASES) + 1} files, {wrong} wrong")
sys.exit(wrong > 0)
