#!/usr/bin/env python3
"""sources_hash.py SCRIPT: the hash of cmake/HitpipeSourcesHash.cmake is one of names and contents, wherever the folder is."""
import pathlib
import subprocess
import sys
import tempfile

script = pathlib.Path(sys.argv[1]).resolve()
FILES = {"hls/a.hpp": "int a;", "hls/b.hpp": "int b;", "sim/c.cpp": "int c;"}


def hash_of(files):
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder)
        for name, text in files.items():
            (source / name).parent.mkdir(parents=True, exist_ok=True)
            (source / name).write_text(text)
        names = source / "names"
        names.write_text("\n".join(str(source / name) for name in files))
        header = source / "hash.hpp"
        subprocess.run(["cmake", f"-DSOURCE={source}", f"-DNAMES={names}", f"-DHEADER={header}", "-P", str(script)], check=True)
        return header.read_text()


usual = hash_of(FILES)
others = {"the same in another folder": hash_of(FILES),
          "a byte changed": hash_of(FILES | {"sim/c.cpp": "int d;"}),
          "a file more": hash_of(FILES | {"sim/d.cpp": ""}),
          "contents traded": hash_of(FILES | {"hls/a.hpp": "int b;", "hls/b.hpp": "int a;"}),
          "another name": hash_of({("hls/e.hpp" if name == "hls/b.hpp" else name): text for name, text in FILES.items()})}
wrong = [what for what, made in others.items() if (made == usual) != what.startswith("the same")]
if len(set(others.values())) != len(others):
    wrong.append("two of them have one hash")
sys.exit(f"hash: {', '.join(wrong)}" if wrong else 0)
