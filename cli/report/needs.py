"""The third question: what does this scene not need?"""
from __future__ import annotations

from page import Section
from steps import Out
from tables import Row, Table, digits, percent, table
from work import Work, unit_of

MUST_BE_NONE = ("false_misses", "rtl_mismatches", "different_triangles", "vector_mismatches")
UNIT = ("design bits bits_before area_before_mm2 area_after_mm2 area_saved_pct extra_box_tests_pct "
        "extra_triangle_tests_pct bytes_per_ray whole_run_time_ms whole_area_run_time_mm2_ms").split()
WIDTHS = "levels block_bits address_bits tag_bits number_bits leaf_bits step_bits".split()  # the cuts have them


def fit(work: Work) -> list[dict]:
    """Units that are made for the scene: of the designs that are recommended, or of those that the user named."""
    wanted = work.plan["fit_designs"]
    if not work.plan["named"]:
        wanted = [design for design, _ in work.best_units() if design in wanted and work.never_misses(design)]
    if not wanted or not work.wanted("fit") or work.library:
        return []
    made = work.steps.records("fitted.json", [["fit", ",".join(dict.fromkeys(wanted)), *work.scene_options, "--out",
                                               Out("fitted")]])[0]
    work.fitted = work.steps.derived("fitted.csv", made)
    for row in work.fitted:
        for what in MUST_BE_NONE:
            work.count(what, int(row[what] or 0))
    return made


def question(work: Work, units: list[dict]) -> None:
    """Adds the section, unless it was left out."""
    if not work.wanted("fit"):
        return
    section = work.section("needs", "What does this scene not need?")
    answers = [unit_answer(work)] if work.fitted else []
    if work.fitted:
        fitted_units(work, section, units)
    elif work.library:
        section.part("Fitted units", "A unit is fitted by the default library alone, so no unit was fitted.")
    answers += fitted_core(work, section)
    section.lead = " ".join(answers) or "Nothing was fitted to this scene."


def unit_answer(work: Work) -> str:
    """The cheapest of the fitted units."""
    row = min(work.fitted, key=lambda row: float(row["whole_area_run_time_mm2_ms"]))
    return (f"The unit {row['design']} {row['bits'].removeprefix('n')} that is made for it leaves out "
            f"{digits(float(row['area_saved_pct']))} % of the area of {row['bits_before'].removeprefix('n')}, with "
            f"{percent(row, 'extra_box_tests_pct')} extra box tests.")


def cuts_table(file: str, caption: str, rows: list[Row], of: str) -> Table:
    """What was left out, a line for each cut."""
    return table(file, caption, rows, ["left_out", "share_pct", "why"],
                 [i for i, row in enumerate(rows) if row["unit"] == of])


def fitted_units(work: Work, section: Section, units: list[dict]) -> None:
    """The fitted units, their cuts, and the cheapest rows of their designs."""
    swept = work.swept
    part = section.part("Fitted units", "Each unit was compared with its C++ and with software on all rays of the "
                        "picture.")
    part.tables = [table("fitted.csv", "The units of hitpipe fit, before and after; extra tests with 95 % intervals.",
                         work.fitted, UNIT)]
    designs = {row["design"] for row in work.fitted}
    beside: dict[str, int] = {}
    for i in swept.usual:
        design = work.rows[i]["design"]
        if design in designs and (design not in beside or float(work.rows[i][swept.whole]) < float(
                work.rows[beside[design]][swept.whole])):
            beside[design] = i
    part.tables.append(table("rows.csv", "The cheapest swept unit of each of these designs.", work.rows,
                             ["design", "bits", "area_mm2", *UNIT[6:]], beside.values()))
    names = [work.name(unit_of(row)) for row in work.fitted]
    cuts = work.steps.derived("left_out.csv", [{"unit": name, **cut} for name, of in zip(names, units)
                                               for cut in of["left_out"]])
    part = section.part("What was left out of the units", "A share is what the cut alone saves of the whole unit's area.")
    for name, of in zip(names, units):
        if of["left_out"]:
            part.tables.append(cuts_table("left_out.csv", f"Left out of {name}.", cuts, name))
        else:
            part.text.append(f"Nothing was left out of {name}: the scene needs it all.")
        part.text.append(f"The scene bounds no bit of these inputs of {name}: {', '.join(of['kept_whole'])}.")
    section.commands += work.steps.commands["fitted.json"]


def fitted_core(work: Work, section: Section) -> list[str]:
    """A whole core for the scene."""
    part = section.part("A fitted core", "All rays of a small picture went through the Verilog of the fitted core.")
    width, height = (str(min(work.plan[side], 64)) for side in ("width", "height"))
    command = ["core", "fit", *work.view_options, "--width", width, "--height", height, *work.library, "--out",
               Out("core_fit")]
    try:
        made = work.steps.records("core_fit.json", [command], may_fail=True)[0]
    except RuntimeError as reason:
        part.text = [f"No core was fitted to this scene: {reason}."]
        section.commands += work.steps.commands["core_fit.json"]
        return []
    cores = work.steps.derived("core_fit.csv", [made["default"], made["fitted"]])
    cuts = work.steps.derived("core_left_out.csv", [{"unit": "core", **cut} for cut in made["left_out"]])
    scenes = work.steps.derived("core_scenes.csv", made["scenes"])
    area = "lut" if "lut" in cores[0] else "area_mm2"
    part.tables = [table("core_fit.csv", "The default core, with room for the scene, beside the fitted one.", cores,
                         [c for c in cores[0] if c not in WIDTHS]),
                   table("core_scenes.csv", "Its rays through the Verilog, and the share of the compared rays that find "
                         "another triangle than in floats, with Wilson's 95 % interval.", scenes, [c for c in scenes[0] if not c.endswith(("_low", "_high"))]),
                   cuts_table("core_left_out.csv", "Left out of the core. A share is how much smaller the core is than "
                              "without that cut alone.", cuts, "core")]
    for row in scenes:
        work.count("wrong_core_answers", int(row["wrong"]))
    section.commands += work.steps.commands["core_fit.json"]
    saved = 100 - 100 * float(cores[1][area]) / float(cores[0][area])
    return [f"A core that is made for it has {saved:.0f} % less logic than the default one, and "
            f"{percent(scenes[0], 'other_triangles_pct')} of its rays find another triangle than in floats."]
