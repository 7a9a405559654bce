#!/usr/bin/env python3
"""each_alone.py BUILD [WORD...]: every source and header of the tree compiles by itself, without a warning: no file before it in a
unity file or a precompiled header brings what it forgot to include. BUILD is a configured folder, of the preset alone. With words, only
files whose path holds one of them. A file that the compiler is given proves its first include too, before which there is nothing. The
slowest headers of libraries are precompiled for the sources that include them themselves; these prove no header."""
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

# These need headers that packages.txt does not bring.
NEEDS_OTHERS = {"bench/embree_tracer.hpp", "hls/num/ac_types.hpp", "hls/num/vendor.hpp",
                "tests/hls/num/vendor_domain_test.cpp", "tests/hls/num/vendor_fp_test.cpp"}
# An example is a project of its own, and most of its headers are generated; a test builds it.
OWN_PROJECTS = "examples/"

SLOW = re.compile(r"^#include <((?:gmock/gmock|gtest/gtest|CLI/CLI|nlohmann/json)\.h(?:pp)?)>", re.M)

root = Path(__file__).resolve().parent.parent.parent
tracked = subprocess.run(["git", "ls-files", "*.cpp", "*.hpp", "*.h"], cwd=root, capture_output=True, text=True,
                         check=True).stdout.split()
tree = [f for f in tracked if f not in NEEDS_OTHERS and not f.startswith(OWN_PROJECTS) and (root / f).exists()]
headers = {f for f in tree if not f.endswith(".cpp")}


def flags(entry):
    """Without what changes no include, but which a precompiled header and its sources must share."""
    words = [word for word in shlex.split(entry["command"]) if not word.startswith(("-O", "-fPI"))]
    return words[:words.index("-o")] + ["-Werror", f"-I{root}"]


def slow_headers(file):
    return tuple(SLOW.findall((root / file).read_text())) if file.endswith(".cpp") else ()


def precompile(slow):
    """The file of those headers, with the options that all sources share that include them."""
    file = f"{folder}/{'_'.join(slow).replace('/', '_')}.hpp"
    Path(file).write_text("".join(f"#include <{header}>\n" for header in slow))
    options = [flags(entry) for source, entry in commands.items() if source in compiled and slow_headers(source) == slow]
    shared = [word for word in options[0] if all(word in each for each in options)]
    subprocess.run([*shared, "-x", "c++-header", file, "-o", file + ".pch"], cwd=root, check=True)
    return file + ".pch"


def first_include(file):
    """The header of the tree that is read before all else, if there is one."""
    for line in (root / file).read_text().splitlines():
        if line.startswith("#include"):
            name = re.match(r'#include ["<](.*)[">]', line)
            for path in (name[1], "library/include/" + name[1]) if name else ():
                if path in headers:
                    return path
            return None
        if line.startswith("#") and line != "#pragma once":
            return None
    return None


def proven_by(file, proven):
    while (file := first_include(file)) and file not in proven:
        proven.add(file)
    return proven


def compile_alone(file):
    near = max(commands, key=lambda source: len(os.path.commonpath([source, file])))
    # What a header includes may look for others beside that header.
    given = [file] if file.endswith(".cpp") else [f"-I{os.path.dirname(file)}", "-x", "c++", "-include", file, "/dev/null"]
    if slow_headers(file):
        given = ["-include-pch", precompiled[slow_headers(file)], *given]
    run = subprocess.run([*flags(commands.get(file, commands[near])), "-fsyntax-only", *given], cwd=root, capture_output=True, text=True)
    if run.returncode:
        print(f"{file} does not compile by itself:\n{run.stderr}", end="", flush=True)
    return run.returncode == 0


commands = {os.path.relpath(e["file"], root): e for e in json.loads((Path(sys.argv[1]) / "compile_commands.json").read_text())}
words = sys.argv[2:] or [""]
asked = [f for f in tree if any(word in f for word in words)]
compiled = [f for f in asked if f.endswith(".cpp")]
proven = set()
for source in compiled:
    if not slow_headers(source):
        proven_by(source, proven)
left = sorted(set(asked) & headers - proven)
for header in left:
    if header not in proven:
        proven_by(header, proven)
compiled += [header for header in left if header not in proven]
if not compiled:
    sys.exit(f"no file's path holds {' or '.join(words)}")
with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
    sets = {slow_headers(file) for file in compiled} - {()}
    precompiled = dict(zip(sets, pool.map(precompile, sets)))
    failed = list(pool.map(compile_alone, compiled)).count(False)
print(f"{len(asked)} files: {failed} do not compile by themselves")
sys.exit(failed != 0)
