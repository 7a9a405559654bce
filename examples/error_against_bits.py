#!/usr/bin/env python3
"""False hits and area against bits: error_against_bits.py [RAYS] [PICTURE]

Tests RAYS random rays (1000000 unless said) against a box each, by int_slabs and int_major in formats of many widths. Draws
how many boxes that a ray misses are hit, and the area of the unit, into PICTURE (out/error_against_bits.png; .pdf and .svg
too). Prints the figures and the time. Ends with 1 if a unit misses a box that its ray meets: both designs say they never do.

The cells run one by one in an editor that knows "# %%"."""

# %% Modules. hitpipe is installed, or `make build` made it in this checkout, which the two lines behind the imports look for.
import pathlib
import sys
import time

checkout = pathlib.Path(__file__).resolve().parent.parent
sys.path.append(str(checkout / "build/library/python"))
try:
    import matplotlib
    import numpy

    import hitpipe
except ImportError as missing:
    sys.exit(f"error_against_bits: {sys.executable}, Python {sys.version.split()[0]}: {missing}; `make build` builds hitpipe for "
             "/usr/bin/python3")

matplotlib.use("Agg")  # draws into files, without a screen
from matplotlib import pyplot  # noqa: E402

began = time.monotonic()

FORMATS = {
    "int_slabs": ["8/8", "10/10", "12/12", "14/14", "16/16", "18/20", "20/24", "24/24"],
    "int_major": ["8+1/7", "10+1/8", "12+1/9", "14+1/10", "16+1/11", "20+1/13", "24+1/16"],
}


# %% Rays and boxes. Boxes are of every size from 2^-9 to 2^-2 of the cube's half, as in a hierarchy. A ray aims at a point
# in or around its box, so that it meets about every other one.
def random_pairs(count, seed=1):
    """Rays (count, 7) and boxes (count, 2, 3)."""
    random = numpy.random.default_rng(seed)
    size = 2.0 ** random.uniform(-8, -2, (count, 1))
    half = size * random.uniform(0.25, 1, (count, 3))
    middle = random.uniform(-1, 1, (count, 3)) * (1 - size)
    boxes = numpy.stack([middle - half, middle + half], axis=1).astype(numpy.float32)
    rays = numpy.empty((count, 7), numpy.float32)
    rays[:, 0:3] = random.uniform(-1, 1, (count, 3))
    rays[:, 3:6] = middle + 2 * half * random.uniform(-1, 1, (count, 3)) - rays[:, 0:3]
    rays[:, 6] = numpy.inf
    return rays, boxes


# %% One unit: a row of the table.
def measure(design, bits, rays, boxes):
    unit = hitpipe.Unit(design, bits)
    answers = unit.test_pairs(rays, boxes, operands=False, results=False)
    missed = ~answers.exact
    return {
        "design": design,
        "bits": bits,
        "width": next(port.width for port in unit.ports if port.role == "plane_low"),
        "false_hits": int(numpy.count_nonzero(answers.hit & missed)),
        "misses": int(numpy.count_nonzero(missed)),
        "false_misses": int(numpy.count_nonzero(answers.exact & ~answers.hit)),
        "area_um2": unit.price("thesis_250nm").area_um2,
    }


def percent(row):
    """False hits of the boxes that a ray misses."""
    return 100 * row["false_hits"] / max(row["misses"], 1)


# %% The picture: error and area above the bits of a plane.
def draw(rows, picture):
    figure, (error, area) = pyplot.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for design in FORMATS:
        own = [row for row in rows if row["design"] == design]
        width = [row["width"] for row in own]
        error.plot(width, [percent(row) or numpy.nan for row in own], "o-", label=design)
        area.plot(width, [row["area_um2"] / 1e6 for row in own], "o-", label=design)
    error.set(yscale="log", xlabel="bits of a plane", ylabel="false hits, % of misses")
    area.set(ylim=(0, None), xlabel="bits of a plane", ylabel="area, mm² in the thesis's cells")
    for axes in (error, area):
        axes.grid(alpha=0.3)
        axes.legend()
    picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(picture, dpi=150)
    pyplot.close(figure)


# %% All of it.
def main(count, picture):
    rays, boxes = random_pairs(count)
    rows = [measure(design, bits, rays, boxes) for design, all_bits in FORMATS.items() for bits in all_bits]
    print("design     bits     false hits      %  area mm2")
    for row in rows:
        print(f'{row["design"]:10} {row["bits"]:8} {row["false_hits"]:10} {percent(row):6.3f} {row["area_um2"] / 1e6:9.4f}')
    draw(rows, picture)
    print(f"{picture}: {count} rays, {time.monotonic() - began:.1f} s")
    false_misses = sum(row["false_misses"] for row in rows)
    if false_misses:
        sys.exit(f"error_against_bits: {false_misses} false misses")


def options(words):
    count, picture = (words + ["1000000", "out/error_against_bits.png"][len(words):])[:2]
    if len(words) > 2 or not count.isdecimal() or int(count) == 0:
        sys.exit("error_against_bits: RAYS is a number from 1; usage: error_against_bits.py [RAYS] [PICTURE]")
    if pathlib.Path(picture).suffix not in (".png", ".pdf", ".svg"):
        sys.exit(f"error_against_bits: {picture}: no picture's name; it ends in .png, .pdf or .svg")
    return int(count), pathlib.Path(picture)


if __name__ == "__main__":
    try:
        main(*options(sys.argv[1:]))
    except OSError as refused:
        sys.exit(f"error_against_bits: {refused}")
