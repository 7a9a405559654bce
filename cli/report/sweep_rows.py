"""What a report reads from the rows of a sweep: names of units, the recommended ones, tables."""
from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from tables import Cell, Row, Table, cell, heading, table

WORK = ("box_tests extra_box_tests_pct triangle_tests extra_triangle_tests_pct false_hits_per_million false_misses "
        "nodes_fetched bytes_per_ray bytes_per_ray_4kib bytes_per_ray_16kib bytes_per_ray_64kib").split()
MUST_BE_NONE = ("false_misses", "rtl_mismatches", "different_triangles", "different_pixels")


class Swept:
    """The rows with their names, and those with the usual number of rays in flight."""

    def __init__(self, rows: Sequence[Row], designs: Mapping[str, Mapping[str, object]]) -> None:
        self.rows, self.designs = rows, designs
        self.names = [self.name(row) for row in rows]
        counts = Counter(int(row["rays_in_flight"]) for row in rows)
        self.rays = max(counts, key=lambda rays: (counts[rays], rays))
        self.usual = [i for i, row in enumerate(rows) if int(row["rays_in_flight"]) == self.rays]
        self.on_chip = "luts" in rows[0] and float(rows[0]["area_mm2"] or 0) == 0
        self.area = "luts" if self.on_chip else "area_mm2"
        of = "lut" if self.on_chip else "mm2"
        self.whole, self.boxes = f"whole_area_run_time_{of}_ms", f"area_run_time_{of}_ms"
        self.costs = ["boxes_per_test", "stages", "stage_delay_ns",
                      *(["luts", "registers", "multiplier_blocks"] if self.on_chip else ["area_mm2"]),
                      f"area_per_box_{of}", "occupancy_pct", "run_time_ms", self.boxes, "whole_run_time_ms", self.whole,
                      "set_up_run_time_ms", "energy_nj_per_ray"]

    def name(self, row: Row) -> str:
        """A design with its format, or its name alone where it has one format only; "int_slabs 20/24 II 3"."""
        name = row["design"]
        if not self.designs[name]["single"]:
            name += " " + row["bits"].removeprefix("n")
        return name if row["ii"] == "1" else f"{name} II {row['ii']}"

    def wrong(self) -> dict[str, int]:
        """Sums that must be none. False misses count only for units that never miss."""
        return {what: sum(int(row[what] or 0) for row in self.rows
                          if what != "false_misses" or self.designs[row["design"]]["conservative"])
                for what in MUST_BE_NONE}

    def cheapest(self, column: str, most_extra_pct: float = float("inf")) -> int | None:
        """The row with the least cost, among those with at most so many extra box tests."""
        return min((i for i in self.usual if float(self.rows[i]["extra_box_tests_pct"]) <= most_extra_pct),
                   key=lambda i: float(self.rows[i][column]), default=None)

    def best(self) -> list[tuple[str, int]]:
        """What each recommended row is the best in."""
        found = [(f"Least whole area × run time, at most {limit:g} % extra box tests", self.cheapest(self.whole, limit))
                 for limit in (0.1, 1, 10)]
        found += [("Least whole area × run time of all", self.cheapest(self.whole)),
                  ("Least by box tests alone, as the thesis compares", self.cheapest(self.boxes))]
        return [(what, row) for what, row in found if row is not None]

    def of_design(self, design: str) -> list[int]:
        """Rows of the design that take a test in every cycle."""
        return [i for i in self.usual if self.rows[i]["design"] == design and self.rows[i]["ii"] == "1"]

    def best_table(self, baseline: str) -> Table:
        """The recommended rows, and the yardstick."""
        found = self.best() + [("The yardstick", i) for i in self.of_design(baseline)]
        columns = [self.area, "boxes_per_test", self.whole, self.boxes, "extra_box_tests_pct",
                   "extra_triangle_tests_pct", "bytes_per_ray", "energy_nj_per_ray"]
        made = table("rows.csv", "The recommended units, with their lines of rows.csv.", self.rows, columns,
                     [i for _, i in found], ("unit", [self.names[i] for _, i in found]))
        made.columns = ["unit", "is", *made.columns[1:], "line"]
        made.rows = [[cells[0], Cell(what), *cells[1:], Cell(str(i + 2))] for (what, i), cells in zip(found, made.rows)]
        made.cards = True
        return made

    def bits_table(self, baseline: str) -> Table:
        """Each format of the recommended designs, by area, and the yardstick."""
        designs = dict.fromkeys(self.rows[i]["design"] for _, i in self.best())
        found = [i for design in [*designs, *([] if baseline in designs else [baseline])]
                 for i in sorted(self.of_design(design), key=lambda i: float(self.rows[i][self.area]))]
        columns = [self.area, "extra_box_tests_pct", "extra_triangle_tests_pct", self.whole, "bytes_per_ray"]
        return table("rows.csv", "What each format costs and buys, with the 95 % intervals of extra tests.", self.rows,
                     columns, found, ("unit", [self.names[i] for i in found]))

    def time_table(self, baseline: str) -> Table:
        """Hardware beside software, of the recommended units."""
        found = list(dict.fromkeys([i for _, i in self.best()] + self.of_design(baseline)))
        columns = ["cycles_per_ray", "stage_delay_ns", "run_time_ns_per_ray", "software_s_per_mray"]
        return table("rows.csv", "Box tests of a ray: cycles and time of the hardware, and processor time of the same "
                     "traversal in software on this machine, triangle tests included, with its 95 % interval.", self.rows,
                     columns, found, ("unit", [self.names[i] for i in found]))

    def caveat(self) -> str:
        """What the whole cost counts, and what it leaves out."""
        row = self.rows[0]
        set_up = row.get("set_up_divisions", "") != ""
        unit = f"{row['triangle_luts']} LUTs" if self.on_chip else f"{float(row['triangle_area_mm2']):.4g} mm²"
        return (f"Whole counts box tests, triangle tests{' and the divisions of ray set-up' if set_up else ''}. A "
                f"triangle test is taken as {float(row['triangle_delay_ns']):.4g} ns of a unit of {unit}. "
                f"{'' if set_up else 'Set-up of rays is not counted. '}Shading and waiting for memory are left out; "
                "bytes a ray are read without a cache."
                + (" Area is lookup tables alone: weigh multiplier blocks and registers beside them." if self.on_chip
                   else ""))

    def tables(self) -> list[Table]:
        """What the units cost, what they did, and their occupancy."""
        made = []
        for what, columns in (("What the units cost", self.costs), ("What the units did", WORK)):
            of = table("rows.csv", f"{what}, with {self.rays} rays in flight. The last column is the line of rows.csv, "
                       "which has further columns and all digits.", self.rows, columns, self.usual,
                       ("unit", [self.names[i] for i in self.usual]))
            of.columns.append("line")
            for i, cells in zip(self.usual, of.rows):
                cells.append(Cell(str(i + 2)))
            made.append(of)
        rays = sorted({int(row["rays_in_flight"]) for row in self.rows})
        lines: dict[str, dict[int, Cell]] = {}
        for i, row in enumerate(self.rows):
            lines.setdefault(self.names[i], {})[int(row["rays_in_flight"])] = cell(self.rows, i, "occupancy_pct")
        several = {name: line for name, line in lines.items() if len(line) > 1}
        if several:
            made.append(Table("rows.csv", "Occupancy in percent by rays in flight.", ["unit", *map(str, rays)],
                              [[Cell(name), *(line.get(r, Cell("")) for r in rays)] for name, line in several.items()]))
        return made
