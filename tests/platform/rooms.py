#!/usr/bin/env python3
"""rooms.py ROOT: a folder's CMakeLists.txt begins with what may be in it and what it includes; is it so?

The line with "includes A, B" names the folders that its sources may include, "nothing" none, "all but A" the others.
A table below names each folder inside.
"""
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(sys.argv[1])
tracked = subprocess.run(["git", "-C", root, "ls-files"], capture_output=True, text=True)
names = tracked.stdout.split() or [str(f.relative_to(root)) for f in root.rglob("*") if "build" not in f.parts]
sources = [name for name in names if name.endswith((".hpp", ".cpp", ".cpp.in"))]
rooms = [room for room in sorted({name.split("/")[0] for name in sources})
         if (root / room / "CMakeLists.txt").exists() and room not in ("bench", "tests", "examples")]
faults = []
for room in rooms:
    head = "".join(re.match(r"(#.*\n)*", (root / room / "CMakeLists.txt").read_text()).group(0))
    says = re.search(r"[Ii]ncludes (nothing|all but ([a-z_]+)|[a-z_]+(?:, [a-z_]+)*)", head)
    if says is None:
        faults.append(f"{room}/CMakeLists.txt: does not say what the folder includes")
        continue
    allowed = {room} | (set() if says[1] == "nothing" else
                        set(rooms) - {says[2]} if says[2] else set(says[1].split(", ")))
    for name in sources:
        if name.split("/")[0] != room:
            continue
        for other in set(re.findall(r'#include "([a-z_]+)/', (root / name).read_text(errors="replace"))) & set(rooms):
            if other not in allowed:
                faults.append(f"{name}: includes {other}, which {room}/CMakeLists.txt does not allow")
    inside = {name.split("/")[1] for name in sources if name.startswith(room + "/") and name.count("/") > 1}
    if "#   " in head:
        for folder in sorted(inside):
            if not re.search(rf"#? +{folder} ", head):
                faults.append(f"{room}/CMakeLists.txt: does not name {room}/{folder}")
print("\n".join(faults) if faults else f"{len(rooms)} folders keep to what they say")
sys.exit(1 if faults else 0)
