"""The diagrams of a report, from the rows of its files."""
from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence

from plots import COLOURS, GREY, Line2D, Picture, beyond, key, log_axis, plain, style
from tables import Row

EXTRA_BOXES = "extra box tests, % above conservative float slabs"
EXTRA_TRIANGLES = "extra triangle tests, % above conservative float slabs"


@dataclasses.dataclass(frozen=True)
class Diagram:
    """Columns of rows.csv across and up, with their labels. A column with intervals has others, NAME_low and NAME_high."""
    name: str
    title: str
    cost: str
    cost_label: str
    error: str
    error_label: str


def error_diagrams(on_chip: bool) -> list[Diagram]:
    """Error against what it costs."""
    unit, area = ("lut", "lookup tables") if on_chip else ("mm2", "area")
    of, in_unit = ("lookup tables × run time", "LUT ms") if on_chip else ("area × run time", "mm² ms")
    boxes, triangles = ("extra_box_tests_pct", EXTRA_BOXES), ("extra_triangle_tests_pct", EXTRA_TRIANGLES)
    return [
        Diagram("error_run_time", "error and run time of box tests in hardware", "run_time_ms",
                "run time of the box tests, ms (cycles × clock period)", *boxes),
        Diagram("error_software_time", "error and run time of the same tests in software", "software_s_per_mray",
                "processor time of this machine, µs a ray", *boxes),
        Diagram("whole_run_time", "error and run time with triangle tests", "whole_run_time_ms",
                "run time of box tests and triangle tests, ms", *triangles),
        Diagram("error_area", "error and area", f"area_per_box_{unit}",
                f"{area} for each box tested in a cycle" + ("" if on_chip else ", mm²"), *boxes),
        Diagram("error_area_run_time", f"error and {of} of box tests alone", f"area_run_time_{unit}_ms",
                f"{of} of the box tests, {in_unit}", *boxes),
        Diagram("whole_area_run_time", f"error and {of} with triangle tests", f"whole_area_run_time_{unit}_ms",
                f"{of} of box unit and triangle unit, {in_unit}", *triangles),
        Diagram("memory", "error and memory traffic", "bytes_per_ray", "bytes of nodes and triangles for each ray",
                *boxes)]


def pareto(points: Sequence[tuple[float, float]]) -> list[int]:
    """Which points have none below and left of them, from left to right."""
    front: list[int] = []
    for i in sorted(range(len(points)), key=lambda i: points[i]):
        if not front or points[i][1] < points[front[-1]][1]:
            front.append(i)
    return front


@dataclasses.dataclass
class Mark:
    """A unit of a diagram."""
    row: Row
    unit: str
    x: float
    y: float
    fitted: bool = False


def marks_of(diagram: Diagram, rows: Sequence[Row], names: Sequence[str], fitted: Sequence[Row]) -> list[Mark]:
    """Units that have both figures. Fitted units are called so."""
    units = [*zip(rows, names, [False] * len(rows)),
             *((row, f"{row['design']} {row['bits'].removeprefix('n')} fitted", True) for row in fitted)]
    return [Mark(row, unit, float(row[diagram.cost]), float(row[diagram.error]), is_fitted)
            for row, unit, is_fitted in units if row.get(diagram.cost) and row.get(diagram.error)]


def reach(mark: Mark, column: str, value: float) -> list[list[float]] | None:
    """From the value to both ends of its interval, as a library of plots takes it."""
    low, high = (mark.row.get(f"{column}_{end}") for end in ("low", "high"))
    return [[max(0.0, value - float(low))], [max(0.0, float(high) - value)]] if low and high else None


def error_picture(diagram: Diagram, scene: str, marks: Sequence[Mark], places: Mapping[str, int], yardstick: str,
                  width_mm: float | None) -> Picture | None:
    """Marks of units by cost and error with their 95 % intervals, and the Pareto front, whose units are named. Fitted
    units are stars. The yardstick has a ring and its name."""
    if not any(not mark.fitted for mark in marks):  # a design without a tracer of its own has no measured time
        return None
    end = beyond([mark.x for mark in marks])
    picture = Picture(diagram.name, f"{scene}: {diagram.title}", width_mm, broken=end is not None)
    picture.labels(diagram.cost_label, diagram.error_label)
    log_axis(picture.ax, "y", [mark.y for mark in marks])
    log_axis(picture.ax, "x", [mark.x for mark in marks if end is None or mark.x <= end])
    if picture.far is not None:
        log_axis(picture.far, "x", [mark.x for mark in marks if mark.x > end], enough=1)
    front = pareto([(mark.x, mark.y) for mark in marks])
    designs = list(dict.fromkeys(mark.row["design"] for mark in marks if not mark.fitted))
    star = {"ls": "none", "marker": "*", "ms": 8, "markeredgecolor": "black", "markeredgewidth": 0.5}
    for ax in [picture.ax] if picture.far is None else [picture.ax, picture.far]:
        ax.step(*zip(*((marks[i].x, marks[i].y) for i in front)), where="post", color=GREY, ls="--", zorder=1)
        for mark in marks:
            ax.errorbar(mark.x, mark.y, reach(mark, diagram.error, mark.y), reach(mark, diagram.cost, mark.x), fmt="none",
                        ecolor=GREY, elinewidth=0.5, zorder=2)
        for at, design in enumerate(designs):  # the first ones are larger, so that none is hidden below another
            size = 6.5 - 3.5 * at / max(1, len(designs) - 1)
            of = [(mark.x, mark.y) for mark in marks if mark.row["design"] == design and not mark.fitted]
            ax.plot(*zip(*of), ls="none", markeredgecolor="white", markeredgewidth=0.4, ms=size, **style(places[design]))
        for mark in marks:
            if mark.fitted:
                ax.plot([mark.x], [mark.y], color=COLOURS[places[mark.row["design"]] % len(COLOURS)], **star)
            elif mark.row["design"] == yardstick:
                ax.plot([mark.x], [mark.y], "o", ms=9, mfc="none", mec="black", mew=0.7)
    keys = [key(places[design], design) for design in designs]
    if any(mark.fitted for mark in marks):
        keys.append(Line2D([], [], color="white", label="fitted unit", **star))
    keys.append(Line2D([], [], color=GREY, ls="--", label="Pareto front"))
    named = set(front) | {i for i, mark in enumerate(marks) if mark.row["design"] == yardstick and not mark.fitted}
    picture.label_above([(marks[i].unit, marks[i].x, marks[i].y) for i in sorted(named) if end is None or marks[i].x <= end])
    ends = [f"{column}_{of}" for column in (diagram.cost, diagram.error) for of in ("low", "high")]
    ends = [column for column in ends if any(mark.row.get(column) for mark in marks)]
    picture.header = ["unit", "design", "bits", diagram.cost, diagram.error, *ends, "on_front"]
    picture.values = [(mark.unit, mark.row["design"], mark.row["bits"], mark.row[diagram.cost], mark.row[diagram.error],
                       *(mark.row.get(column, "") for column in ends), int(i in front)) for i, mark in enumerate(marks)]
    picture.finish(keys)
    return picture


def lines_picture(name: str, title: str, labels: tuple[str, str], lines: Mapping[str, Sequence[tuple[float, float]]],
                  styles: Mapping[str, int], width_mm: float | None, ticks: Sequence[str] | None = None,
                  axis: str = "") -> Picture:
    """Lines between values. `axis`: "log2" across, "pct" up to 100, "log" for both, "log-y"."""
    picture = Picture(name, title, width_mm)
    picture.labels(*labels)
    points = [point for line in lines.values() for point in line]
    for line, of in lines.items():
        picture.ax.plot(*zip(*of), markeredgecolor="white", markeredgewidth=0.4, **style(styles[line]))
    if axis in ("log", "log-y"):
        log_axis(picture.ax, "y", [p[1] for p in points])
    else:
        picture.ax.set_ylim(0, 102 if axis.startswith("pct") else 1.1 * max(p[1] for p in points))
        if not axis.startswith("pct"):
            picture.ax.yaxis.set_major_formatter(plain)
    if axis == "log":
        log_axis(picture.ax, "x", [p[0] for p in points])
    elif axis == "pct-log2":
        at = sorted({int(p[0]) for p in points})
        picture.ax.set_xscale("log", base=2)
        picture.ax.set_xticks(at, [str(x) for x in at])
        picture.ax.minorticks_off()
    elif ticks:
        picture.ax.set_xticks(range(len(ticks)), ticks)
        picture.ax.set_xlim(-0.3, len(ticks) - 0.7)
    picture.header = ["line", "x", "y"]
    picture.values = [(line, ticks[int(px)] if ticks else f"{px:.6g}", f"{py:.6g}")
                      for line, of in lines.items() for px, py in of]
    picture.finish([key(styles[line], line, "-") for line in lines])
    return picture


def occupancy_picture(scene: str, rows: Sequence[Row], names: Sequence[str], places: Mapping[str, int],
                      width_mm: float | None) -> Picture | None:
    """A line for each unit that was swept with several numbers of rays in flight."""
    lines: dict[str, list[tuple[float, float]]] = {}
    styles: dict[str, int] = {}
    for row, name in zip(rows, names):
        lines.setdefault(name, []).append((int(row["rays_in_flight"]), float(row["occupancy_pct"])))
        styles[name] = places[row["design"]]
    lines = {name: sorted(line) for name, line in lines.items() if len(line) > 1}
    if not lines:
        return None
    return lines_picture("occupancy", f"{scene}: occupancy of the pipeline against rays in flight",
                         ("rays in flight", "cycles that begin a test, %"), lines, distinct(styles, lines), width_mm,
                         axis="pct-log2")


def distinct(styles: Mapping[str, int], lines: Mapping[str, object]) -> dict[str, int]:
    """Two lines of one design have styles of their own."""
    taken: dict[str, int] = {}
    for name in lines:
        place = styles[name]
        while place in taken.values():
            place += 1
        taken[name] = place
    return taken


def rate_picture(scene: str, rows: Sequence[Row], names: Sequence[str], places: Mapping[str, int], area: str,
                 width_mm: float | None) -> Picture | None:
    """Area against boxes a second, a line for each unit that was swept at several intervals."""
    lines: dict[str, list[tuple[float, float]]] = {}
    styles: dict[str, int] = {}
    for row, name in zip(rows, names):
        unit = name.split(" II ")[0]
        rate = 1000 / float(row["box_time_ns"])
        lines.setdefault(unit, []).append((rate, float(row[area])))
        styles[unit] = places[row["design"]]
    lines = {unit: sorted(line) for unit, line in lines.items() if len(line) > 1}
    one: dict[int, str] = {}
    for unit in lines:  # one format of a design, its last
        one[styles[unit]] = unit
    lines = {unit: lines[unit] for unit in one.values()}
    if not lines:
        return None
    label = "lookup tables of the unit" if area == "luts" else "area of the unit, mm²"
    return lines_picture("area_rate", f"{scene}: area and boxes a second",
                         ("boxes a second of a full unit, millions", label), lines, distinct(styles, lines), width_mm,
                         axis="log")
