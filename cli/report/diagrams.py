"""The diagrams of a report, from the rows of its files."""
from __future__ import annotations

from collections.abc import Mapping, Sequence

from plots import COLOURS, GREY, Line2D, Log, Picture, key, style
from tables import Row

EXTRA_BOXES = "extra box tests, % above conservative float slabs"
EXTRA_TRIANGLES = "extra triangle tests, % above conservative float slabs"


def error_diagrams(on_chip: bool) -> list[tuple[str, str, str, str, str, str]]:
    """Name, title, column of the cost, its label, column of the error, its label."""
    unit, area = ("lut", "lookup tables") if on_chip else ("mm2", "area")
    of, in_unit = ("lookup tables × run time", "LUT ms") if on_chip else ("area × run time", "mm² ms")
    boxes, triangles = ("extra_box_tests_pct", EXTRA_BOXES), ("extra_triangle_tests_pct", EXTRA_TRIANGLES)
    return [
        ("error_run_time", "error and run time of box tests alone", "run_time_ms",
         "run time of the box tests, ms (cycles × clock period)", *boxes),
        ("error_software_time", "error and measured run time in software", "software_s_per_mray",
         "processor time in software, s for a million rays", *boxes),
        ("error_area", "error and area", f"area_per_box_{unit}",
         f"{area} for each box tested in a cycle" + ("" if on_chip else ", mm²"), *boxes),
        ("error_area_run_time", f"error and {of} of box tests alone", f"area_run_time_{unit}_ms",
         f"{of} of the box tests, {in_unit}", *boxes),
        ("whole_run_time", "error and run time with triangle tests", "whole_run_time_ms",
         "run time of box tests and triangle tests, ms", *triangles),
        ("whole_area_run_time", f"error and {of} with triangle tests", f"whole_area_run_time_{unit}_ms",
         f"{of} of box unit and triangle unit, {in_unit}", *triangles),
        ("memory", "error and memory traffic", "bytes_per_ray", "bytes of nodes and triangles for each ray", *boxes)]


def pareto(points: Sequence[tuple[float, float]]) -> list[int]:
    """Which points have none below and left of them, from left to right."""
    front: list[int] = []
    for i in sorted(range(len(points)), key=lambda i: points[i]):
        if not front or points[i][1] < points[front[-1]][1]:
            front.append(i)
    return front


def error_picture(diagram: tuple[str, ...], scene: str, rows: Sequence[Row], names: Sequence[str],
                  places: Mapping[str, int], fitted: Sequence[Row], width_mm: float | None) -> Picture | None:
    """Marks of units by cost and error, with the Pareto front, whose units are named. Fitted units are stars."""
    name, title, cost, cost_label, error, error_label = diagram
    shown = [(row, unit) for row, unit in zip(rows, names) if row.get(cost)]
    stars = [row for row in fitted if row.get(cost) and row.get(error)]
    if not shown:  # a design without a tracer of its own has no measured time
        return None
    all_rows = [row for row, _ in shown] + stars
    x, y = Log(float(r[cost]) for r in all_rows), Log(float(r[error]) for r in all_rows)
    points = [(x.shown(float(row[cost])), y.shown(float(row[error]))) for row in all_rows]
    names = [unit for _, unit in shown] + [f"{r['design']} {r['bits'].removeprefix('n')} fitted" for r in stars]
    picture = Picture(name, f"{scene}: {title}", width_mm)
    picture.labels(cost_label, error_label)
    x.apply(picture.ax, "x")
    y.apply(picture.ax, "y")
    front = pareto(points)
    picture.ax.step(*zip(*(points[i] for i in front)), where="post", color=GREY, ls="--", zorder=1)
    designs = list(dict.fromkeys(row["design"] for row, _ in shown))
    for design in designs:
        of = [point for point, row in zip(points, all_rows[:len(shown)]) if row["design"] == design]
        picture.ax.plot(*zip(*of), ls="none", markeredgecolor="white", markeredgewidth=0.4, **style(places[design]))
    keys = [key(places[design], design) for design in designs]
    if stars:
        star = {"ls": "none", "marker": "*", "ms": 8, "markeredgecolor": "black", "markeredgewidth": 0.5}
        for row, point in zip(stars, points[len(shown):]):
            picture.ax.plot([point[0]], [point[1]], color=COLOURS[places[row["design"]] % len(COLOURS)], **star)
        keys.append(Line2D([], [], color="white", label="fitted unit", **star))
    keys.append(Line2D([], [], color=GREY, ls="--", label="Pareto front"))
    picture.unnamed = picture.label_above([(names[i], *points[i], x.share(points[i][0])) for i in front])
    picture.header = ["unit", "design", "bits", cost, error, "on_front"]
    picture.values = [(unit, row["design"], row["bits"], row[cost], row[error], int(i in front))
                      for i, (unit, row) in enumerate(zip(names, all_rows))]
    picture.finish(keys)
    return picture


def lines_picture(name: str, title: str, labels: tuple[str, str], lines: Mapping[str, Sequence[tuple[float, float]]],
                  styles: Mapping[str, int], width_mm: float | None, ticks: Sequence[str] | None = None,
                  axis: str = "") -> Picture:
    """Lines between values. `axis`: "log2" across, "pct" up to 100, "log" for both, "log-y"."""
    picture = Picture(name, title, width_mm)
    picture.labels(*labels)
    points = [point for line in lines.values() for point in line]
    y = Log(p[1] for p in points)
    for line, of in lines.items():
        shown = [(px, y.shown(py) if axis.startswith("log-y") or axis == "log" else py) for px, py in of]
        picture.ax.plot(*zip(*shown), markeredgecolor="white", markeredgewidth=0.4, **style(styles[line]))
    if axis in ("log", "log-y"):
        y.apply(picture.ax, "y")
    else:
        picture.ax.set_ylim(0, 102 if axis.startswith("pct") else 1.1 * max(p[1] for p in points))
    if axis == "log":
        Log(p[0] for p in points).apply(picture.ax, "x")
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
