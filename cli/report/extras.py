"""What stands behind the questions: pictures, schematics and versions."""
from __future__ import annotations

import datetime
import platform
import shlex
import subprocess

from page import Figure, Image
from steps import Out
from tables import readable, table
from work import Work, unit_of


def add(work: Work) -> None:
    """The sections that the user did not leave out."""
    if work.wanted("images"):
        images(work)
    if work.wanted("schematics"):
        schematics(work)
    versions(work)


def images(work: Work) -> None:
    """The scene by software and through the Verilog, and maps of box tests."""
    image = work.plan["image"]
    unit = unit_of(image)
    render = ["render", *work.scene_options]
    commands = [([*render, "--out", Out("software.png"), "--box-map", Out("box_tests.png")], "software",
                 ["software.png", "box_tests.png"]),
                (["cosim", image["design"], *work.bits_option(unit), *work.library, *work.scene_options, "--referee",
                  "--out", Out("cosim")], work.name(unit), [f"cosim/{work.plan['scene_file']}.png"])]
    maps = []
    for bits, tracer in image["tracers"]:
        file = f"extra_box_tests_{bits.replace('/', '_')}.png"
        maps.append((file, work.name((image["design"], bits))))
        commands.append(([*render, *shlex.split(tracer), "--extra-box-map", Out(file)], maps[-1][1], [file]))
    files = [file for _, _, made in commands for file in made]
    rows = work.steps.table("pictures.csv", [words for words, _, _ in commands], [{"unit": of} for _, of, _ in commands],
                            more=files)
    section = work.section("images", "Images and where the work is")
    different = (work.out / "software.png").read_bytes() != (work.out / files[2]).read_bytes()
    section.lead = ("Both images are the same, and bright pixels of a map need many tests." if not different else
                    "The images are not the same, so the unit answers wrongly.")
    part = section.part("", "")

    def image_of(file: str, caption: str, high: str = "") -> Image:
        return Image(caption, (work.out / file).read_bytes(), work.plan["width"], work.plan["height"],
                     readable(high) if high else "")

    part.images = [image_of("software.png", "By software: conservative float slabs."),
                   image_of(files[2], f"Through the Verilog of {work.name(unit)}, which answered each box test."),
                   image_of("box_tests.png", "Box tests of all rays of a pixel, in software.", rows[0]["box_map_high"])]
    part.images += [image_of(file, f"Extra box tests of a pixel: {of} above conservative float slabs.",
                             row["extra_box_map_high"]) for (file, of), row in zip(maps, rows[2:])]
    columns = ["unit", "box_tests", "triangle_tests", "extra_box_tests_pct", "different_triangles",
               "rtl_mismatches", "box_map_high", "extra_box_map_high"]
    part.tables = [table("pictures.csv", "The numbers of the pictures.", rows, columns)]
    for what in ("rtl_mismatches", "different_triangles"):
        work.count(what, int(rows[1][what]))
    work.count("different_pixels", int(different))
    section.commands = work.steps.commands["pictures.csv"]


def schematics(work: Work) -> None:
    """The stages of each design, in groups."""
    section = work.section("schematics", "Schematics")
    designs = work.plan["designs"]
    commands = [["rtl", design, "--out", Out(f"schematics/{design}")] for design in designs]
    work.steps.files("schematics", commands, [f"schematics/{d}/{d}.v" for d in designs], at_once=True)
    section.commands = work.steps.commands["schematics"]
    part = section.part("", "")
    for design in designs:
        drawings = [Figure(f"Schematic of {file.stem.replace('_', ' ')}", "", file.stem, file.read_text(encoding="utf-8"))
                    for file in sorted((work.out / f"schematics/{design}").glob("**/*.svg"))]
        if drawings:
            part.hidden.append((design, drawings))
    section.lead = ("Each drawing opens at a touch and shows a design's stages." if part.hidden else
                    "Nothing is drawn here, because Graphviz was not installed.")


def versions(work: Work) -> None:
    """The programs."""
    def said(*words: str) -> str:
        try:
            made = subprocess.run(words, capture_output=True, text=True, timeout=300, check=False)
        except OSError:
            return "not found"
        return ((made.stdout + made.stderr).splitlines() or ["not found"])[0]

    section = work.section("versions", "Versions")
    section.lead = "No number but a time depends on threads or machine."
    section.part("", "").facts = [
        ("Program", work.plan["version"]), ("Measured on", f"{work.plan['machine']}, {datetime.date.today().isoformat()}"),
        ("Verilator", said("verilator", "--version")), ("Graphviz", said("dot", "-V")), ("Python", platform.python_version())]
    section.commands = ["hitpipe --version"]
