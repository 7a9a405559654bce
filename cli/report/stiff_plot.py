"""Draws the rows of `hitpipe check --stiff`: stiff_plot.py CSV FOLDER [WIDTH_MM]. Percent against the ratio of the
direction's components, a panel for each design, a line for each format."""
from __future__ import annotations

import csv
import pathlib
import sys
from collections.abc import Callable, Mapping, Sequence

from plots import Axes, Picture, key, log_axis, plain, style

LEAST = 0.01  # percent; less is drawn there
Row = Mapping[str, str]


def false_hit_pct(rows: Sequence[Row]) -> float:
    """Of the boxes of all kinds that the ray misses."""
    misses = sum(int(r["tests"]) - int(r["exact_hits"]) for r in rows)
    return 100 * sum(int(r["false_hits"]) for r in rows) / misses if misses else 0.0


def extra_pct(rows: Sequence[Row]) -> float:
    """Box tests above the reference."""
    return float(rows[0]["extra_box_tests_pct"])


def draw(name: str, title: str, label: str, rows: Sequence[Row], percent: Callable[[Sequence[Row]], float],
         width_mm: float | None, apart: bool = False) -> list[Picture]:
    """A picture of these rows with a panel for each design, or with `apart` a picture for each, on common scales."""
    groups: dict[tuple[str, str, str], list[Row]] = {}
    for row in rows:
        groups.setdefault((row["design"], row["bits"].removeprefix("n"), row["log2_ratio"]), []).append(row)
    designs = list(dict.fromkeys(design for design, _, _ in groups))
    values = {at: percent(of) for at, of in groups.items()}
    if not apart:
        picture = Picture(name, title, width_mm, len(designs))
        for design, ax in zip(designs, picture.axes):
            ax.set_title(design, pad=3)
        made = {design: (picture, ax) for design, ax in zip(designs, picture.axes)}
    else:
        made = {}
        for design in designs:
            picture = Picture(f"{name}_{design}", f"{title}: {design}", width_mm)
            made[design] = (picture, picture.ax)
    of_picture: dict[int, dict[str, int]] = {}  # the formats of each, and their places
    for design, (picture, ax) in made.items():
        formats = of_picture.setdefault(id(picture), {})
        for of, bits, _ in groups:
            if of == design:
                formats.setdefault(bits, len(formats))
        panel(picture, ax, {(b, r): v for (d, b, r), v in values.items() if d == design}, formats, list(values.values()))
    pictures = list(dict.fromkeys(picture for picture, _ in made.values()))
    for picture in pictures:
        picture.labels("ratio of direction components", label + ", %")
        picture.finish([key(place, bits, "-") for bits, place in of_picture[id(picture)].items()])
        picture.header = ["design", "bits", "log2_ratio", "percent"]
        picture.values = [(d, f"n{b}" if "/" in b and b[0].isdigit() else b, r, f"{v:.6g}")
                          for (d, b, r), v in values.items() if made[d][0] is picture]
    return pictures


def panel(picture: Picture, ax: Axes, of: Mapping[tuple[str, str], float], places: Mapping[str, int],
          scale: Sequence[float]) -> None:
    """The lines of a design: percent by format and ratio. `scale` has the values of all designs."""
    last = max(int(r) for _, r in of if r != "inf")
    zero = last + 10
    for bits, place in places.items():
        line = [(int(r), max(v, LEAST)) for (b, r), v in of.items() if b == bits and r != "inf"]
        if not line:
            continue
        ax.plot(*zip(*sorted(line)), lw=0.9, ms=2.6, markeredgewidth=0.3, **style(place))
        if (bits, "inf") in of:  # no power of two, so it stands apart
            ax.plot([zero], [max(of[bits, "inf"], LEAST)], ls="none", ms=4, **style(place))
    log_axis(ax, "y", [LEAST, 10 * LEAST, *(max(value, LEAST) for value in scale)])
    at = [t for t in ax.get_yticks() if t >= LEAST]
    ax.set_yticks(at, [("≤ " if t == LEAST else "") + plain(t) for t in at])
    ax.set_xlim(-3, zero + 5)
    step = 10 if 10 * (picture.width / picture.columns - 40) / (zero + 8) > 20 else 20
    ratios = list(range(0, last + 1, step))
    ax.set_xticks([*ratios, zero], [f"$2^{{{r}}}$" for r in ratios] + ["zero"])


def pictures(rows: Sequence[Row], width_mm: float | None, apart: bool = False) -> list[Picture]:
    """Of drawn boxes, and of a scene if one was traversed."""
    boxes = [r for r in rows if not r["rays"]]
    scene = [r for r in rows if r["rays"]]
    drawn = draw("stiffness", "False hits on stiff rays", "false hits of the boxes that rays miss", boxes,
                 false_hit_pct, width_mm, apart)
    if scene:
        drawn += draw("stiffness_scene", f"Box tests of stiff rays on {scene[0]['boxes']}",
                      "box tests above conservative float slabs", scene, extra_pct, width_mm, apart)
    return drawn


def main() -> None:
    """Reads the rows, writes the pictures."""
    with open(sys.argv[1], newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for picture in pictures(rows, float(sys.argv[3]) if len(sys.argv) > 3 else None):
        picture.header = []  # the rows themselves are beside it
        picture.write(pathlib.Path(sys.argv[2]))


if __name__ == "__main__":
    main()
