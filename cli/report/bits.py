"""The first question: what does each bit cost and buy?"""
from __future__ import annotations

import core_section
from diagrams import error_diagrams, error_picture, lines_picture, marks_of, occupancy_picture, rate_picture
from page import Section
from steps import Out
from tables import digits, percent, readable, table
from work import Work, unit_of

PIPELINE = ("design bits ii stages stage_delay_ns clock_mhz latency_ns area_mm2 area_pct adp_mm2_ns adp_pct "
            "boxes_per_test area_per_box_mm2 lut ff dsp luts registers multiplier_blocks").split()


def question(work: Work) -> None:
    """Adds the section."""
    section = work.section("bits", "What does each bit cost and buy?")
    section.lead = answer(work)
    baseline = work.plan["baseline"]
    part = section.part("The unit to build", "The table names the unit of least area × time at the error that you allow.")
    part.tables = [work.swept.best_table(baseline)]
    part.text = [work.swept.caveat(), "Extra tests are a sample of this picture's pixels. Their 95 % intervals treat the rays "
                 "of a pixel as a group; they are score intervals as Wilson's, and symmetrical where a unit may also save "
                 "tests."]
    part = section.part("Each format", "More bits take more area and leave fewer extra tests.")
    part.tables = [work.swept.bits_table(baseline)]
    section.commands = [work.plan["command"], *work.steps.commands["rows.csv"]]
    against_time(work, section)
    against_area(work, section)
    if work.wanted("pipelines"):
        pipelines(work, section)
    if work.wanted("world"):
        world(work, section)
    if work.wanted("core"):
        core(work, section)
    sweep(work, section)


def answer(work: Work) -> str:
    """The cheapest unit, with its error; then what its fewest bits would save."""
    swept, rows = work.swept, work.rows
    best = swept.cheapest(swept.whole)
    row, unit = rows[best], "LUT ms" if swept.on_chip else "mm² ms"
    text = (f"The unit {swept.names[best]} costs least, {digits(float(row[swept.whole]))} {unit} for this picture, "
            f"with {percent(row, 'extra_box_tests_pct')} extra box tests.")
    least = min(swept.of_design(row["design"]) or [best], key=lambda i: float(rows[i][swept.area]))
    saved = 100 - 100 * float(rows[least][swept.area]) / float(row[swept.area])
    if saved >= 0.5:
        text += (f" With {rows[least]['bits'].removeprefix('n')} its area is {saved:.0f} % less, with "
                 f"{percent(rows[least], 'extra_box_tests_pct')} extra.")
    for i in swept.of_design(work.plan["baseline"]):
        if row["design"] != rows[i]["design"]:
            text += f" The yardstick {swept.names[i]} costs {digits(float(rows[i][swept.whole]))} {unit}."
    return text


def against_time(work: Work, section: Section) -> None:
    """Error against run time, in hardware and in software."""
    swept = work.swept
    part = section.part("Error against run time", "Units near the lower left corner are better; no unit lies below the "
                        "dashed front.")
    part.text = ["Up are extra tests above the reference, which is conservative float slabs in software. Lines through a "
                 "mark are its 95 % intervals. Units of the front are named above the plot; a ring marks the yardstick."]
    diagrams = error_diagrams(swept.on_chip)
    part.figures = [figure for diagram in diagrams[:3] for figure in error_figure(work, diagram)]
    part.tables = [swept.time_table(work.plan["baseline"])]


def error_figure(work: Work, diagram) -> list:
    """One of the diagrams. An error does not depend on the interval, so it has the units with the shortest."""
    usual = work.swept.usual
    least = min(int(work.rows[i]["ii"]) for i in usual)
    soonest = [i for i in usual if int(work.rows[i]["ii"]) == least]
    marks = marks_of(diagram, [work.rows[i] for i in soonest], [work.swept.names[i] for i in soonest], work.fitted)
    return work.figure(error_picture(diagram, work.plan["scene"], marks, work.places, work.plan["baseline"], work.width),
                       f"{work.swept.rays} rays in flight. Columns {diagram.cost} and {diagram.error} of rows.csv.")


def against_area(work: Work, section: Section) -> None:
    """Error against area and memory, and area against rate."""
    swept, plan = work.swept, work.plan
    part = section.part("Error against area and memory", "Area for a rate, the area × time of a picture, and bytes read "
                        "tell which unit is cheapest.")
    for diagram in error_diagrams(swept.on_chip)[3:]:
        part.figures += error_figure(work, diagram)
    rows, names = [work.rows[i] for i in swept.usual], [swept.names[i] for i in swept.usual]
    part.figures += work.figure(rate_picture(plan["scene"], rows, names, work.places, swept.area, work.width),
                                f"A mark for each interval. Column {swept.area} of rows.csv.")
    thesis = [i for i, name in enumerate(swept.names) if name in plan["thesis"] or plan["named"]]
    part.figures += work.figure(
        occupancy_picture(plan["scene"], [work.rows[i] for i in thesis], [swept.names[i] for i in thesis], work.places,
                          work.width), "Column occupancy_pct of rows.csv: the share of cycles in which a test begins.")


def pipelines(work: Work, section: Section) -> None:
    """What the units take."""
    units = [(unit_of(u), "1") for u in work.plan["priced_units"]]
    units += [(unit_of(work.rows[i]), work.rows[i]["ii"]) for _, i in work.swept.best()]
    rows = work.steps.table("pipelines.csv", [
        ["area", unit[0], *work.bits_option(unit), *work.library, *([] if ii == "1" else ["--ii", ii])]
        for unit, ii in dict.fromkeys(units)])
    part = section.part("Pipelines", "Fewer stages answer a ray sooner, and a smaller area is cheaper.")
    part.tables = [table("pipelines.csv", "All that is emitted, priced by the component library.", rows,
                         [c for c in rows[0] if c in PIPELINE])]
    section.commands += work.steps.commands["pipelines.csv"]


def world(work: Work, section: Section) -> None:
    """What the bits of the integer world change."""
    rows = work.steps.table("integer_world.csv", [
        ["sweep", "int_triangle", *work.scene_options, *work.library, "--mantissas", "11", "--out",
         Out("integer_world.csv")]])
    part = section.part("The integer world", "More bits of the grid leave fewer rays with another triangle, for more area.")
    ticks = [row["bits"] for row in rows]
    lines = {name: [(i, float(row[column])) for i, row in enumerate(rows)]
             for name, column in (("rays with another triangle", "different_rays_pct"),
                                  ("pixels that differ", "different_pixels_pct"))}
    part.figures = work.figure(
        lines_picture("integer_world_plot", "Rays and pixels that differ, by the bits of the integer world",
                      ("bits of the world", "%"), lines, {name: i for i, name in enumerate(lines)}, work.width,
                      ticks, "log-y"), "Against exact arithmetic on the float scene.")
    left = {"scene", "rays", "different_rays", "pixels", "different_pixels", "triangles", "degenerate_dropped",
            "mesh_share_of_cube_pct"}
    part.tables = [table("integer_world.csv", "What the bits change and cost; shares with Wilson's 95 % intervals.", rows,
                         [c for c in rows[0] if c not in left and not c.endswith(("_low", "_high"))])]
    section.commands += work.steps.commands["integer_world.csv"]


def core(work: Work, section: Section) -> None:
    """Cores that trace a small picture."""
    settings = [of for of, _ in core_section.settings()]
    commands = core_section.commands(work.view_options, work.library, work.plan["width"], work.plan["height"])
    part = section.part("The core", "More rays in flight keep the memory port busy, and a cache saves bytes; every answer "
                        "was compared with software.")
    try:
        rows = work.steps.table("core.csv", commands, settings, may_fail=True)
    except RuntimeError as reason:
        part.text = [f"The core has not traced this scene: {reason}."]
        section.commands += work.steps.commands["core.csv"]
        return
    areas = work.steps.table("core_area.csv", core_section.area_commands(work.library), core_section.area_settings())
    for picture in core_section.pictures(work.plan["scene"], rows, areas, work.width):
        part.figures += work.figure(picture, "Rows of core.csv, areas of core_area.csv.")
    wrong = sum(int(row["wrong"]) for row in rows)
    part.facts = [("Must be none", f"wrong answers {wrong}")]
    work.count("wrong_core_answers", wrong)
    part.tables = [table("core.csv", "What cores did with the rays of the picture.", rows, core_section.SHOWN)]
    section.commands += [*work.steps.commands["core.csv"], *work.steps.commands["core_area.csv"]]


def sweep(work: Work, section: Section) -> None:
    """All rows with the usual number of rays in flight."""
    part = section.part("All units", "Each line is a unit; its cost stands in the first table, what it did in the second.")
    facts = [f"{what.replace('_', ' ')} {readable(str(number))}" for what, number in work.swept.wrong().items()]
    part.facts = [("Must be none", ", ".join(facts))]
    part.tables = work.swept.tables()
