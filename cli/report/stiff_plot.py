"""Draws the rows of `hitpipe check --stiff`: stiff_plot.py CSV FOLDER [WIDTH_MM]. Percent against the ratio of the
direction's components, a panel for each design, a line for each format."""
from __future__ import annotations

import csv
import pathlib
import sys
from collections.abc import Callable, Mapping, Sequence

from plots import Log, Picture, key, style

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
         width_mm: float | None) -> Picture:
    """One picture of these rows."""
    groups: dict[tuple[str, str, str], list[Row]] = {}
    for row in rows:
        groups.setdefault((row["design"], row["bits"].removeprefix("n"), row["log2_ratio"]), []).append(row)
    designs = list(dict.fromkeys(design for design, _, _ in groups))
    formats = list(dict.fromkeys(bits for _, bits, _ in groups))
    values = {at: percent(of) for at, of in groups.items()}
    picture = Picture(name, title, width_mm, len(designs))
    picture.header = ["design", "bits", "log2_ratio", "percent"]
    picture.values = [(d, f"n{b}" if "/" in b and b[0].isdigit() else b, r, f"{v:.6g}")
                      for (d, b, r), v in values.items()]
    last = max(int(r) for _, _, r in groups if r != "inf")
    zero = last + 10
    for design, ax in zip(designs, picture.axes):
        ax.set_title(design, pad=3)
        for place, bits in enumerate(formats):
            line = [(int(r), max(values[design, bits, r], LEAST)) for d, b, r in groups
                    if (d, b) == (design, bits) and r != "inf"]
            if not line:
                continue
            ax.plot(*zip(*sorted(line)), lw=0.9, ms=2.6, markeredgewidth=0.3, **style(place))
            if (design, bits, "inf") in values:  # no power of two, so it stands apart
                ax.plot([zero], [max(values[design, bits, "inf"], LEAST)], ls="none", ms=4, **style(place))
        axis = Log([LEAST, 10 * LEAST, *(max(value, LEAST) for value in values.values())])
        axis.apply(ax, "y")
        at = [t for t in axis.ticks() if t >= LEAST]
        ax.set_yticks(at, [("≤ " if t == LEAST else "") + f"{t:g}" for t in at])
        ax.set_xlim(-3, zero + 5)
        step = 10 if 10 * (picture.width / picture.columns - 40) / (zero + 8) > 20 else 20
        ratios = list(range(0, last + 1, step))
        ax.set_xticks([*ratios, zero], [f"$2^{{{r}}}$" for r in ratios] + ["zero"])
    picture.labels("ratio of direction components", label + ", %")
    picture.finish([key(place, bits, "-") for place, bits in enumerate(formats)])
    return picture


def pictures(rows: Sequence[Row], width_mm: float | None) -> list[Picture]:
    """Of drawn boxes, and of a scene if one was traversed."""
    boxes = [r for r in rows if not r["rays"]]
    scene = [r for r in rows if r["rays"]]
    drawn = [draw("stiffness", "False hits on stiff rays", "false hits of the boxes that rays miss", boxes,
                  false_hit_pct, width_mm)]
    if scene:
        drawn.append(draw("stiffness_scene", f"Box tests of stiff rays on {scene[0]['boxes']}",
                          "box tests above conservative float slabs", scene, extra_pct, width_mm))
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
