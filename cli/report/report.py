"""`hitpipe report`: runs the steps of a report, draws its pictures and writes its page. The program hitpipe starts
it as report.py PLAN, where PLAN is what it was asked for, in JSON."""
from __future__ import annotations

import json
import pathlib
import sys

import jinja2

import bits
import extras
import needs
import stable
from page import Page
from plots import write_whole
from steps import Ended, Out, Stopped, printed
from sweep_rows import Swept
from tables import Row, described, parse_csv, readable
from work import Work, unit_of


def sweep(work: Work) -> None:
    """The rows that the questions are about."""
    plan = work.plan
    if plan["rows_given"]:
        work.steps.commands["rows.csv"] = sweep_commands(
            parse_csv((work.out / "rows.csv").read_text(encoding="utf-8")), work.sweep_options, plan["catalogue"])
    else:
        ii = [] if plan["intervals"] == [1] else ["--ii", ",".join(map(str, plan["intervals"]))]
        formats = ["--bits", ",".join(plan["bits"])] if plan["bits"] else []
        rows = [["sweep", *work.sweep_options, ",".join(plan["designs"]), *formats, "--rays-in-flight", "32", *ii,
                 "--out", Out("rows.csv")]]
        if plan["priced_units"]:
            rows.append(["sweep", *work.sweep_options,
                         *work.several([unit_of(u) for u in plan["priced_units"]]),
                         "--rays-in-flight", "1,2,4,8,16,32,64,128,256", "--out", Out("rows.csv")])
        work.steps.files("rows.csv", rows, ["rows.csv"])
    work.rows = parse_csv((work.out / "rows.csv").read_text(encoding="utf-8"))
    work.swept = Swept(work.rows, plan["catalogue"])
    for what, number in work.swept.wrong().items():
        work.count(what, number)


def write_page(work: Work) -> None:
    """The page, and what its tables have in common."""
    plan = work.plan
    rays = [f"{readable(work.rows[0][f'rays_{kind}'])} {kind}" for kind in ("primary", "secondary", "shadow")]
    facts = [("Scene", plan["scene"]), ("Mesh", plan["mesh"]), ("Hierarchy", plan["hierarchy"]),
             ("Image", f"{plan['width']} x {plan['height']} pixels"), ("Rays", ", ".join(rays))]
    template = jinja2.Environment(loader=jinja2.FileSystemLoader(pathlib.Path(__file__).parent), autoescape=True,
                                  trim_blocks=True, lstrip_blocks=True).get_template("page.html.j2")
    page = Page(f"hitpipe: which box test for {plan['scene']}?", facts, work.sections, plan["without"])
    write_whole(work.out / "index.html", template.render(page=page).encode())
    tables = []
    for file in sorted(work.out.glob("*.csv")):
        with open(file, encoding="utf-8") as text:
            tables.append(described(file.name, text.readline().rstrip("\n").split(",")))
    notes = {"program": plan["version"], "command": plan["command"], **plan["notes"]}
    write_whole(work.out / "csv-metadata.json", (json.dumps(
        {"@context": "http://www.w3.org/ns/csvw", "tables": tables, "notes": [notes]}, indent=2,
        ensure_ascii=False) + "\n").encode())


def make(work: Work) -> int:
    """The whole report. 1 if a count that must be none is not."""
    sweep(work)
    fitted = needs.fit(work)
    bits.question(work)
    stable.question(work)
    needs.question(work, fitted)
    extras.add(work)
    write_page(work)
    page = str(work.out / "index.html")
    print(record({"page": page, "rows": len(work.rows), **work.wrong}, work.plan["format"]), end="")
    if not any(work.wrong.values()) and not work.steps.wrong:
        return 0
    print(f"hitpipe: a count that must be 0 is not; see {page}", file=sys.stderr)
    return 1


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
    work = Work(json.loads(sys.argv[1]))
    try:
        return make(work)
    except Stopped as stopped:
        work.steps.end_by(stopped.number)
        return 1
    except Ended as ended:
        return ended.code
    except OSError as reason:
        print(f"hitpipe: {reason.filename}: {reason.strerror}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
