#!/usr/bin/env python3
"""talk.py PROGRAM: what --quiet, --verbose and --version print."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

program = sys.argv[1]
wrong = []


def run(*words, **more):
    return subprocess.run([program, *words], capture_output=True, text=True, check=False, **more)


def expect(what, holds, made):
    if not holds:
        wrong.append(f"{what}: exit code {made.returncode}\n{made.stdout[:500]}{made.stderr[:500]}")


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    # A mesh that loses a triangle by rounding: a note.
    (folder / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.7 1e-13 0\nf 1 2 3\nf 1 2 4\n")
    bvh = ("bvh", "--scene", str(folder / "flat.obj"))
    usual, quiet, front = run(*bvh), run(*bvh, "--quiet"), run("--quiet", *bvh)
    expect("a note", usual.returncode == 0 and usual.stderr.startswith("hitpipe: ") and usual.stderr.count("\n") == 1, usual)
    for made in (quiet, front):
        expect("quiet", made.returncode == 0 and made.stderr == "" and made.stdout == usual.stdout, made)
    error = run("bvh", "--scene", str(folder / "none.obj"), "--quiet")
    expect("an error", error.returncode == 2 and error.stderr.startswith("hitpipe: ") and "none.obj" in error.stderr, error)
    both = run(*bvh, "--quiet", "--verbose")
    expect("both", both.returncode == 2 and "--verbose excludes --quiet: one says less, the other more" in both.stderr, both)

    # Programs that are started, and steps. A verbose run changes no result.
    rtl = ("rtl", "int_slabs", "--bits", "6/6", "--vectors", "1", "--out")
    usual, verbose = run(*rtl, str(folder / "a")), run(*rtl, str(folder / "a"), "--verbose")
    expect("a program that starts", re.search(r"^hitpipe: runs (\S*/)?dot ", verbose.stderr, re.M), verbose)
    expect("the same result", verbose.stdout == usual.stdout and usual.stderr == "", verbose)
    check = run("check", "int_slabs", "--tests", "1000", "--verbose")
    expect("a step", re.search(r"^hitpipe: (?!runs)\S", check.stderr, re.M) and check.returncode == 0, check)

    # A file of figures does not say how much was printed.
    sweep = run("sweep", "int_slabs", "--bits", "8/8", "--scene", "spheres", "--width", "4", "--height", "4", "--quiet", "--out",
                str(folder / "rows.csv"))
    metadata = folder / "rows.csv-metadata.json"
    expect("a quiet sweep", sweep.returncode == 0 and sweep.stderr == "" and metadata.exists()
           and "--quiet" not in metadata.read_text() and "--width" in metadata.read_text(), sweep)

    # Tools in PATH, none, and one that a variable names.
    tools = folder / "tools"
    tools.mkdir()
    for tool in ("yosys", "mine"):
        (tools / tool).write_text(f"#!/bin/sh\necho '{tool} 7.1'\necho more\n")
        (tools / tool).chmod(0o755)
    first = r"hitpipe \d+\.\d+\.\d+ \([0-9a-f]{8}\)\n"
    version = run("--version", env={"PATH": str(tools)})
    expect("tools", re.fullmatch(first + rf"Verilator: not found\nYosys: {tools}/yosys, yosys 7.1\nIcarus: not found\n",
                                 version.stdout) and version.returncode == 0, version)
    version = run("--version", env={"PATH": str(tools), "VERILATOR": "mine", "IVERILOG": str(tools / "mine"), "YOSYS": "none"})
    expect("chosen tools", re.fullmatch(first + rf"Verilator: {tools}/mine, mine 7.1\nYosys: not found\nIcarus: {tools}/mine, "
                                        r"mine 7.1\n", version.stdout), version)
    version = run("--version", env=dict(os.environ))
    expect("the machine's tools", re.fullmatch(first + "Verilator: /.*, Verilator .*\nYosys: /.*, Yosys .*\nIcarus: /.*, Icarus .*\n",
                                               version.stdout), version)
sys.exit("\n".join(wrong) if wrong else 0)
