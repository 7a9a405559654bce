#!/usr/bin/env python3
"""from_outside.py [PAGES]: hitpipe as somebody has it who installed the packages and has no checkout.

Runs each command of the three paths of README.md, and what its first lines and docs/library.md print, in a new folder where
build/hitpipe is the installed program, and compares with what the pages say. `make fresh` starts it in a bare Debian.
"""
import importlib.metadata
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

PAGES = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "/usr/share/doc/hitpipe")
PATHS = ("You build hardware", "You compare and choose", "You learn")
# Meshes and lists of the reader's own.
OWN = {
    "rays.csv": "ox,oy,oz,dx,dy,dz\n0,0,0,1,0.01,0.02\n",
    "boxes.csv": "min_x,min_y,min_z,max_x,max_y,max_z\n0.5,-0.1,-0.1,0.6,0.1,0.1\n",
    "bunny.ply": "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
                 "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n",
}
# What a command leaves behind, or prints, by the comment behind it or by the page. Lines of counts that must be 0 are seen by the exit code.
LEAVES = {
    "area int_major": r"clock +latency +LUT +FF +DSP48E1\n.*\nint_major +20\+1/13 ",
    "implement int_major": "chip/ice40_up5k/int_major_implementation.json",
    "operands int_major": "tests.csv",
    "core fit": "core/fit.json",
    "core rtl": "core/hitpipe_core.v",
    "core trace": r"\nwrong +0\n",
    "cosim int_major": "out/bunny/int_major.v",
    "check int_major": r"false_misses",
    "check --safe": r"int_major",
    "sweep": "rows.csv",
    "report": "page/index.html",
    "fit int_slabs": "fitted",
    "table 5.1": r"Table 5\.1:",
    "rtl int_slabs": "small/int_slabs_6_6.v",
    "help rtl": r"Usage: hitpipe rtl NAME --out FOLDER",
}
wrong = []
folder = pathlib.Path(tempfile.mkdtemp())


def run(command):
    begin = time.monotonic()
    made = subprocess.run(["bash", "-c", command], cwd=folder, capture_output=True, text=True, check=False)
    print(f"{time.monotonic() - begin:6.1f} s  {command}", flush=True)
    if made.returncode != 0:
        wrong.append(f"$ {command}\nends with {made.returncode}: {made.stdout[-500:]}{made.stderr[-500:]}")
    return made.stdout


def same(what, printed, promised):
    if printed != promised:
        wrong.append(f"{what} prints\n{printed}\nand the page says\n{promised}")


def fences(page, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", page, re.M | re.S)


def first_lines(page):
    """The consoles of the README, without the checkout."""
    for step in re.split(r"^\$ ", "".join(fences(page, "console")), flags=re.M)[1:]:
        command, _, promised = step.partition("\n")
        command = command.split("  #")[0].strip()
        if not command.startswith(("git clone", "make build", "make demo", "make test")):
            same(command, run(command), promised)


def path(page, name):
    """Each command of one of the three paths."""
    section = page.partition(f"\n## {name}\n")[2].partition("\n## ")[0]
    lines = [line.split("  #")[0].split(" # ")[0].strip() for block in fences(section, "sh") for line in block.splitlines()]
    if not lines:
        wrong.append(f"README has no commands for {name}")
    for line in lines:
        printed = run(line)
        words = line.removeprefix("build/hitpipe ")
        known = [leaves for begins, leaves in LEAVES.items() if words.startswith(begins)]
        if not known:
            wrong.append(f"from_outside.py does not know what {line} leaves behind")
        elif not (folder / known[0]).exists() and not re.search(known[0], printed):
            wrong.append(f"{line}: no {known[0]} in {printed[:1000]}")


def library(page):
    """The programs in C and Python that docs/library.md prints."""
    (folder / "my_ray.c").write_text(fences(page, "c")[0])
    run("gcc -std=c99 my_ray.c $(pkg-config --cflags --libs hitpipe) -o build/my_ray")
    promised = fences(page, "text")[0]
    same("my_ray", "$ build/my_ray\n" + run("build/my_ray"), promised[promised.index("$ build/my_ray\n"):])
    (folder / "my_pairs.py").write_text(fences(page, "python")[0])
    same("my_pairs.py", run("python3 my_pairs.py"), fences(page, "text")[1])


try:
    (folder / "build").mkdir()
    (folder / "build/hitpipe").symlink_to(shutil.which("hitpipe") or sys.exit("from_outside: hitpipe is not installed"))
    for name, text in OWN.items():
        (folder / name).write_text(text)
    version = run("hitpipe --version").split()[1]
    same("importlib.metadata", importlib.metadata.version("hitpipe"), version)
    same("pkg-config", run("pkg-config --modversion hitpipe"), version + "\n")
    run("man -w hitpipe || test -e /usr/share/man/man1/hitpipe.1.gz")
    same("int_slabs", run("hitpipe rtl int_slabs --out u > u.txt && make -s -C u/tb icarus"), "PASS 6000 vectors\n")
    readme = (PAGES / "README.md").read_text()
    first_lines(readme)
    library((PAGES / "docs/library.md").read_text())
    for name in PATHS if "SHORT" not in os.environ else ():
        path(readme, name)
finally:
    shutil.rmtree(folder)
print("\n".join(wrong) if wrong else "from_outside: all is as the pages say")
sys.exit(bool(wrong))
