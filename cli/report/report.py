"""`hitpipe report`: runs the steps of a report, draws its pictures and writes its page. The program hitpipe starts
it as report.py PLAN, where PLAN is what it was asked for, in JSON."""
from __future__ import annotations

import datetime
import json
import pathlib
import platform
import subprocess
import sys

import jinja2

from diagrams import error_diagrams, error_picture, occupancy_picture, rate_picture
from page import Page
from plots import write_whole
from sections import Sections
from steps import Ended, Out, Stopped, printed
from sweep_section import Swept
from tables import Row, described, parse_csv, readable, table

ORDER = ("images", "pipelines", "stability", "stiff", "world", "core", "schematics")


class Report(Sections):
    """All sections, in their order, and the page."""

    def sweep(self) -> None:
        """The rows, and all that is told of them."""
        plan = self.plan
        if plan["rows_given"]:
            self.steps.commands["rows.csv"] = sweep_commands(
                parse_csv((self.out / "rows.csv").read_text(encoding="utf-8")), self.sweep_options, plan["catalogue"])
        else:
            ii = [] if plan["intervals"] == [1] else ["--ii", ",".join(map(str, plan["intervals"]))]
            bits = ["--bits", ",".join(plan["bits"])] if plan["bits"] else []
            rows = [["sweep", *self.sweep_options, ",".join(plan["designs"]), *bits, "--rays-in-flight", "32", *ii,
                     "--out", Out("rows.csv")]]
            if plan["priced_units"]:
                of = [f"{u['design']}={u['bits']}" for u in plan["priced_units"] if u["bits_option"]]
                rows.append(["sweep", *self.sweep_options,
                             ",".join(dict.fromkeys(u["design"] for u in plan["priced_units"])),
                             *(["--bits", ",".join(of)] if of else []), "--rays-in-flight", "1,2,4,8,16,32,64,128,256",
                             "--out", Out("rows.csv")])
            self.steps.files("rows.csv", rows, ["rows.csv"])
        self.rows = parse_csv((self.out / "rows.csv").read_text(encoding="utf-8"))
        self.swept = Swept(self.rows, plan["catalogue"])
        self.fitted: list[Row] = []
        for what, number in self.swept.wrong().items():
            self.count(what, number)

    def fit(self) -> None:
        """Units that are made for the scene."""
        names = ",".join(self.plan["fit_designs"])
        self.fitted = self.steps.table("fitted.csv", [["fit", names, *self.scene_options, "--out", Out("fitted")]])

    def found(self) -> None:
        """The recommended units, and error against cost."""
        swept, plan = self.swept, self.plan
        asked = self.section("question", "What was asked and found",
                             "The table names the unit to build: least area × time at the error that you allow.")
        rays = [f"{readable(self.rows[0][f'rays_{kind}'])} {kind}" for kind in ("primary", "secondary", "shadow")]
        asked.facts = [("Scene", plan["scene"]), ("Mesh", plan["mesh"]), ("Hierarchy", plan["hierarchy"]),
                       ("Image", f"{plan['width']} x {plan['height']} pixels"), ("Rays", ", ".join(rays))]
        asked.tables = [swept.best_table(plan["baseline"])]
        asked.text = [swept.caveat()]
        asked.commands = [plan["command"]]
        error = self.section("error", "Error against cost",
                             "Units near the lower left corner are better; no unit lies below the dashed front.")
        error.text = ["Up are extra tests above the reference, which is conservative float slabs in software. The "
                      "first four diagrams count box tests alone, as the thesis does, the next two triangle tests "
                      "too. Units of the front are named above the plot."]
        usual = [self.rows[i] for i in swept.usual]
        names = [swept.names[i] for i in swept.usual]
        least = min(int(row["ii"]) for row in usual)  # an error does not depend on the interval
        soonest = [(row, name) for row, name in zip(usual, names) if int(row["ii"]) == least]
        for diagram in error_diagrams(swept.on_chip):
            error.figures += self.figure(
                error_picture(diagram, plan["scene"], [row for row, _ in soonest], [name for _, name in soonest],
                              self.places, self.fitted, self.width),
                f"{swept.rays} rays in flight. Columns {diagram[2]} and {diagram[4]} of rows.csv.")
        error.figures += self.figure(rate_picture(plan["scene"], usual, names, self.places, swept.area, self.width),
                                     f"A mark for each interval. Column {swept.area} of rows.csv.")
        thesis = [i for i, name in enumerate(swept.names) if name in plan["thesis"] or plan["named"]]
        error.figures += self.figure(
            occupancy_picture(plan["scene"], [self.rows[i] for i in thesis], [swept.names[i] for i in thesis],
                              self.places, self.width),
            "Column occupancy_pct of rows.csv: the share of cycles in which a test begins.")
        error.commands = self.steps.commands["rows.csv"]
        if self.fitted:
            self.fitted_section()

    def fitted_section(self) -> None:
        """The fitted units beside the cheapest rows of their designs."""
        section = self.section("fitted", "Fitted units",
                               "A fitted unit costs less than the swept units of its design, or the scene needs all.")
        columns = ["design", "bits", "area_after_mm2", "extra_box_tests_pct", "extra_triangle_tests_pct",
                   "bytes_per_ray", "whole_run_time_ms", "whole_area_run_time_mm2_ms"]
        section.tables = [table("fitted.csv", "The units of hitpipe fit.", self.fitted, columns)]
        designs = {row["design"] for row in self.fitted}
        beside: dict[str, int] = {}
        for i in self.swept.usual:
            design = self.rows[i]["design"]
            if design in designs and (design not in beside or float(self.rows[i][self.swept.whole]) < float(
                    self.rows[beside[design]][self.swept.whole])):
                beside[design] = i
        section.tables.append(table("rows.csv", "The cheapest swept unit of each of these designs.", self.rows,
                                    ["design", "bits", "area_mm2", *columns[3:]], beside.values()))
        for row in self.fitted:
            for what in MUST_BE_NONE_OF_FITS:
                self.count(what, int(row[what] or 0))
        section.commands = self.steps.commands["fitted.csv"]

    def sweep_table(self) -> None:
        """All rows with the usual number of rays in flight."""
        section = self.section("sweep", "The sweep", "Each line is a unit; its cost stands in the first table, what it "
                               "did in the second.")
        facts = [f"{what.replace('_', ' ')} {number}" for what, number in self.swept.wrong().items()]
        section.facts = [("Must be none", ", ".join(facts))]
        section.tables = self.swept.tables()
        section.commands = self.steps.commands["rows.csv"]

    def versions(self) -> None:
        """The programs."""
        def said(*words: str) -> str:
            try:
                made = subprocess.run(words, capture_output=True, text=True, timeout=300, check=False)
            except OSError:
                return "not found"
            return ((made.stdout + made.stderr).splitlines() or ["not found"])[0]

        section = self.section("versions", "Versions", "No number but a time depends on threads or machine.")
        section.facts = [("Program", self.plan["version"]), ("Measured on", f"{self.plan['machine']}, "
                                                             f"{datetime.date.today().isoformat()}"),
                         ("Verilator", said("verilator", "--version")), ("Graphviz", said("dot", "-V")),
                         ("Python", platform.python_version())]
        section.commands = ["hitpipe --version"]

    def write_page(self) -> None:
        """The page, and what its tables have in common."""
        template = jinja2.Environment(loader=jinja2.FileSystemLoader(pathlib.Path(__file__).parent), autoescape=True,
                                      trim_blocks=True, lstrip_blocks=True).get_template("page.html.j2")
        page = Page(f"hitpipe: which box test for {self.plan['scene']}?", self.sections, self.plan["without"])
        write_whole(self.out / "index.html", template.render(page=page).encode())
        tables = []
        for file in sorted(self.out.glob("*.csv")):
            with open(file, encoding="utf-8") as text:
                tables.append(described(file.name, text.readline().rstrip("\n").split(",")))
        notes = {"program": self.plan["version"], "command": self.plan["command"], **self.plan["notes"]}
        write_whole(self.out / "csv-metadata.json", (json.dumps(
            {"@context": "http://www.w3.org/ns/csvw", "tables": tables, "notes": [notes]}, indent=2,
            ensure_ascii=False) + "\n").encode())

    def make(self) -> int:
        """The whole report. 1 if a count that must be none is not."""
        self.sweep()
        if self.plan["fit"]:
            self.fit()
        self.found()
        for name in ORDER:
            if name == "stability":
                self.sweep_table()
            if self.wanted(name):
                getattr(self, name)()
        self.versions()
        self.write_page()
        page = str(self.out / "index.html")
        print(record({"page": page, "rows": len(self.rows), **self.wrong}, self.plan["format"]), end="")
        if not any(self.wrong.values()) and not self.steps.wrong:
            return 0
        print(f"hitpipe: a count that must be 0 is not; see {page}", file=sys.stderr)
        return 1


MUST_BE_NONE_OF_FITS = ("false_misses", "rtl_mismatches", "different_triangles", "vector_mismatches")


def sweep_commands(rows: list[Row], options: list[str], catalogue: dict) -> list[str]:
    """The commands that measure these rows. Units with the same numbers of rays at the same intervals share one."""
    measured: dict[tuple[str, str], set[tuple[int, int]]] = {}
    for row in rows:
        measured.setdefault((row["design"], row["bits"]), set()).add((int(row["ii"]), int(row["rays_in_flight"])))
    alike: dict[frozenset[tuple[int, int]], list[tuple[str, str]]] = {}
    for unit, of in measured.items():
        alike.setdefault(frozenset(of), []).append(unit)
    commands = []
    for of, units in alike.items():
        designs = ",".join(dict.fromkeys(design for design, _ in units))
        bits = ",".join(f"{d}={b.removeprefix('n')}" for d, b in units if not catalogue[d]["single"])
        ii, rays = (",".join(map(str, sorted({pair[i] for pair in of}))) for i in (0, 1))
        commands.append(printed(["sweep", *options, designs, *(["--bits", bits] if bits else []), "--rays-in-flight",
                                 rays, *([] if ii == "1" else ["--ii", ii]), "--out", "rows.csv"]))
    return commands


def record(values: dict[str, object], form: str) -> str:
    """As the program hitpipe prints it."""
    if form == "json":
        return json.dumps(values, indent=2, ensure_ascii=False) + "\n"
    if form == "csv":
        return ",".join(values) + "\n" + ",".join(map(str, values.values())) + "\n"
    return "".join(f"{name:<20} {value}\n" for name, value in values.items())


def main() -> int:
    """The exit code."""
    report = Report(json.loads(sys.argv[1]))
    try:
        return report.make()
    except Stopped as stopped:
        report.steps.end_by(stopped.number)
        return 1
    except Ended as ended:
        return ended.code
    except OSError as reason:
        print(f"hitpipe: {reason.filename}: {reason.strerror}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
