"""The program hitpipe, as it was built."""

from pathlib import Path

import osu018

ROOT = Path(__file__).resolve().parents[2]
path = ROOT / "build/hitpipe"


def add_option(options):
    options.add_argument("--hitpipe", type=Path, default=path, help="the program, if it is not build/hitpipe")


def hitpipe(*arguments):
    if not path.is_file():
        osu018.fail(f"{path}: no such program; make build")
    return osu018.run([str(path), *arguments], ROOT)
