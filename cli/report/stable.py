"""The second question: is it stable on stiff and extreme cases?"""
from __future__ import annotations

from collections.abc import Sequence

import stiff_plot
from page import Section
from tables import Cell, Row, Table, cell, digits, percent, table
from work import Unit, Work, unit_of


def question(work: Work) -> None:
    """Adds the section, unless all of it was left out."""
    if not work.wanted("stability") and not work.wanted("stiff"):
        return
    section = work.section("stable", "Is it stable on stiff and extreme cases?")
    if work.wanted("stability"):
        judged(work, section)
        moved(work, section)
    if work.wanted("stiff"):
        stiff(work, section)


def judged(work: Work, section: Section) -> None:
    """The units of the rows, the recommended and the fitted ones against the exact referee, by category."""
    usual = [unit_of(work.rows[i]) for i in work.swept.usual]
    fitted = [unit_of(row) for row in work.fitted]
    units = list(dict.fromkeys([*work.best_units(), *fitted, *usual]))
    made = work.steps.records("stability.json", [["check", *work.several(units), "--tests", str(work.plan["tests"]),
                                                  *work.seed]], quiet=True)[0]
    rows = work.steps.derived("stability.csv", made)
    of_all = {unit_of(row): row for row in rows if row["category"] == "all"}
    section.lead = answer(work, of_all)
    work.count("false_misses", sum(int(row["false_misses"]) for unit, row in of_all.items() if work.never_misses(unit[0])))
    close = list(dict.fromkeys([*work.best_units(), *fitted]))
    part = section.part("By category", "Rays and boxes that are made to break box tests show which cases are hard for a unit.")
    part.text = ["Exact arithmetic judges boxes that are not padded. Shares say nothing about a scene: most cases graze a "
                 "box. The boxes of a ray answer alike, so Wilson's interval is for as many cases as would spread like the "
                 "rays. A fitted unit is judged in its format as a whole unit, because it only takes rays of its scene."]
    part.tables = [by_category(rows, close, work)]
    part = section.part("Every unit", "A unit that never misses has 0 false misses; a float unit to nearest may have some.")
    part.facts = [("Why units miss", "a float unit rounds each difference and product to nearest, so entry and exit may "
                   "change their order; padded boxes of the hierarchy hide it")]
    whole = [i for i, row in enumerate(rows) if row["category"] == "all"]
    part.tables = [table("stability.csv", "All categories together, with 95 % intervals.", rows,
                         ["tests", "exact_hits", "false_misses", "false_miss_pct", "false_hits", "false_hit_pct"], whole,
                         ("unit", [work.name(unit_of(rows[i])) for i in whole])),
                   table("stability.csv", "Categories with false misses.", rows,
                         ["design", "bits", "category", "tests", "exact_hits", "false_misses", "false_miss_pct"],
                         [i for i, r in enumerate(rows) if int(r["false_misses"]) and r["category"] != "all"])]
    part.tables = [t for t in part.tables if t.rows]
    section.commands += work.steps.commands["stability.json"]


def answer(work: Work, of_all: dict[Unit, Row]) -> str:
    """The misses, and the least stable case of the cheapest unit."""
    safe = {unit: row for unit, row in of_all.items() if work.never_misses(unit[0])}
    missed = {unit: row for unit, row in of_all.items() if int(row["false_misses"])}
    text = ""
    if safe and not set(safe) & set(missed):
        met = sum(int(row["exact_hits"]) for row in safe.values())
        worst = max(float(row["false_miss_pct_high"]) for row in safe.values())
        text = (f"None of {len(safe)} units that must not miss missed one of {met:,} boxes that rays met; of each unit at "
                f"most {digits(1e4 * worst, 2)} in a million may be missed (95 %).")
    for unit in sorted(set(safe) & set(missed)):
        text += f" The unit {work.name(unit)} must not miss and missed {int(missed[unit]['false_misses']):,} boxes."
    floats = [unit for unit in missed if unit not in safe]
    if floats:
        unit = max(floats, key=lambda u: float(missed[u]["false_miss_pct"]))
        text += f" Units of floats to nearest miss some: {work.name(unit)} {percent(missed[unit], 'false_miss_pct')}."
    elif not safe:
        text = f"None of {len(of_all)} units missed a box, though none is proved never to miss."
    return text.strip()


def by_category(rows: Sequence[Row], units: Sequence[Unit], work: Work) -> Table:
    """False hits: a line for each category, a column for each unit, with the 95 % interval."""
    made = Table("stability.csv", "False hits, % of the boxes that the ray misses, and the 95 % interval.",
                 ["category", *map(work.name, units)], [])
    at = {(*unit_of(row), row["category"]): i for i, row in enumerate(rows)}
    for category in dict.fromkeys(row["category"] for row in rows):
        of = [at.get((design, bits, category)) for design, bits in units]  # some categories are of some designs alone
        if any(i is not None for i in of):
            made.rows.append([Cell(category.replace("_", " ")),
                              *(Cell("") if i is None else cell(rows, i, "false_hit_pct") for i in of)])
    return made


def moved(work: Work, section: Section) -> None:
    """The picture in other units and at other places."""
    best = work.swept.cheapest(work.swept.whole)
    unit = unit_of(work.rows[best])
    part = section.part("By scale and place", "A scale by a power of two changes no pixel; other scales and far places round "
                        "the mesh itself, and the unit answers as software on each.")
    command = ["cosim", unit[0], *work.bits_option(unit), *work.scene_options, "--rescale"]
    try:
        made = work.steps.records("moved.json", [command], may_fail=True)[0]
    except RuntimeError as reason:
        part.text = [f"This scene was not moved: {reason}."]
        section.commands += work.steps.commands["moved.json"]
        return
    rows = work.steps.derived("moved.csv", made)
    columns = ["transform", "vertices_moved", "lost_to_rounding", "pixels_other_triangle", "pixels_other_colour",
               "different_triangles", "rtl_mismatches"]
    part.tables = [table("moved.csv", f"The picture by {work.name(unit)} when mesh, camera and lights are scaled and moved. "
                         "The last two columns must be 0.", rows, columns)]
    for what in ("different_triangles", "rtl_mismatches"):
        work.count(what, sum(int(row[what]) for row in rows))
    section.commands += work.steps.commands["moved.json"]


def stiff(work: Work, section: Section) -> None:
    """False hits on stiff rays."""
    designs = list(dict.fromkeys(work.rows[i]["design"] for i in work.swept.usual))
    conservative = [design for design in designs if work.never_misses(design)]
    if not conservative:
        if not section.lead:
            section.lead = "No unit of this report is proved never to miss, so none was given stiff rays."
        return
    names = [",".join(conservative)] if work.plan["named"] else []
    rows = work.steps.table("stiffness.csv", [["check", "--stiff", *names, "--tests", str(work.plan["ratio_tests"]),
                                               *work.seed]])
    part = section.part("Stiff rays", "A line that rises shows a unit that accepts boxes in vain as the components of a "
                        "direction grow apart.")
    for picture in stiff_plot.pictures(rows, work.width, apart=True):
        picture.header = []
        part.figures += work.figure(picture, f"{work.plan['ratio_tests']:,} boxes for each ratio; stiffness.csv has the 95 % "
                                    "intervals.")
    missed = sum(int(row["false_misses"] or 0) for row in rows)
    work.count("false_misses", missed)
    if not section.lead:
        tests = sum(int(row["exact_hits"] or 0) for row in rows)
        section.lead = f"Stiff rays met {tests:,} boxes, and units that must not miss missed {missed:,} of them."
    section.commands += work.steps.commands["stiffness.csv"]
