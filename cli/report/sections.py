"""The sections of a report that stand alone: each runs its commands, and has what they made for the page. The user can
leave out each of them."""
from __future__ import annotations

import pathlib
import shlex

import core_section
import stiff_plot
from diagrams import lines_picture
from page import Figure, Image, Section
from plots import Picture
from steps import Out, Steps
from sweep_section import Swept, stability_table
from tables import Row, readable, table

PIPELINE = ("design bits ii stages stage_delay_ns clock_mhz latency_ns area_mm2 area_pct adp_mm2_ns adp_pct "
            "boxes_per_test area_per_box_mm2 lut ff dsp luts registers multiplier_blocks").split()


class Sections:
    """What was asked, and what has been made of it."""

    def __init__(self, plan: dict) -> None:
        self.plan = plan
        self.out = pathlib.Path(plan["out"])
        self.out.mkdir(parents=True, exist_ok=True)
        self.steps = Steps(plan["program"], plan["version"], self.out, plan["threads"], plan["talk"])
        self.sweep_options, self.scene_options, self.view_options, self.library = (
            shlex.split(plan[name]) for name in ("sweep_options", "scene_options", "view_options", "library_option"))
        self.width = plan["plot_width_mm"]
        self.seed = ["--seed", str(plan["seed"])]
        self.sections: list[Section] = []
        self.wrong: dict[str, int] = {}
        self.rows: list[Row] = []
        self.swept: Swept
        self.places = {name: design["place"] for name, design in plan["catalogue"].items()}

    def section(self, name: str, title: str, lead: str) -> Section:
        """A section begins with what the reader should see."""
        self.sections.append(Section(name, title, lead))
        return self.sections[-1]

    def wanted(self, name: str) -> bool:
        """Whether the user did not leave it out."""
        return name not in self.plan["without"]

    def figure(self, picture: Picture | None, caption: str) -> list[Figure]:
        """Writes the picture, and has it for the page."""
        if picture is None:
            return []
        picture.write(self.out)
        unnamed = getattr(picture, "unnamed", 0)
        if unnamed:
            caption += f" {unnamed} units of the front have no room for a label."
        svg = (self.out / f"{picture.name}.svg").read_text(encoding="utf-8")
        return [Figure(picture.title, caption, picture.name, svg)]

    def count(self, what: str, number: int) -> None:
        """A count that must be none."""
        self.wrong[what] = self.wrong.get(what, 0) + number

    def unit_words(self, unit: dict) -> list[str]:
        """A unit as a command takes it."""
        return [unit["design"], *shlex.split(unit["bits_option"])]

    def images(self) -> None:
        """The scene by software and through the Verilog, and maps of box tests."""
        image = self.plan["image"]
        unit = f"{image['design']} {image['bits']}"
        render = ["render", *self.scene_options]
        commands = [([*render, "--out", Out("software.png"), "--box-map", Out("box_tests.png")], "software",
                     ["software.png", "box_tests.png"]),
                    (["cosim", *self.unit_words(image), *self.library, *self.scene_options, "--referee", "--out",
                      Out("cosim")], unit, [f"cosim/{self.plan['scene_file']}.png"])]
        maps = []
        for bits, tracer in image["tracers"]:
            file = f"extra_box_tests_{bits.replace('/', '_')}.png"
            maps.append((file, f"{image['design']} {bits}"))
            commands.append(([*render, *shlex.split(tracer), "--extra-box-map", Out(file)], maps[-1][1], [file]))
        files = [file for _, _, made in commands for file in made]
        rows = self.steps.table("pictures.csv", [words for words, _, _ in commands],
                                [{"unit": of} for _, of, _ in commands], more=files)
        section = self.section("images", "Images and where the work is",
                               "Both images are the same, and bright pixels of a map need many tests.")

        def image_of(file: str, caption: str, high: str = "") -> Image:
            return Image(caption, (self.out / file).read_bytes(), self.plan["width"], self.plan["height"],
                         readable(high) if high else "")

        section.images = [image_of("software.png", "By software: conservative float slabs."),
                          image_of(files[2], f"Through the Verilog of {unit}, which answered each box test."),
                          image_of("box_tests.png", "Box tests of all rays of a pixel, in software.",
                                   rows[0]["box_map_high"])]
        section.images += [image_of(file, f"Extra box tests of a pixel: {of} above conservative float slabs.",
                                    row["extra_box_map_high"]) for (file, of), row in zip(maps, rows[2:])]
        columns = ["unit", "box_tests", "triangle_tests", "extra_box_tests_pct", "different_triangles",
                   "rtl_mismatches", "box_map_high", "extra_box_map_high"]
        section.tables = [table("pictures.csv", "The numbers of the pictures.", rows, columns)]
        for what in ("rtl_mismatches", "different_triangles"):
            self.count(what, int(rows[1][what]))
        different = (self.out / "software.png").read_bytes() != (self.out / files[2]).read_bytes()
        self.count("different_pixels", int(different))
        section.commands = self.steps.commands["pictures.csv"]

    def pipelines(self) -> None:
        """What the units take."""
        units = [(self.unit_words(u), "1") for u in self.plan["priced_units"]]
        for _, i in self.swept.best():
            row = self.rows[i]
            single = self.plan["catalogue"][row["design"]]["single"]
            unit = ([row["design"], *([] if single else ["--bits", row["bits"].removeprefix("n")])], row["ii"])
            if unit not in units:
                units.append(unit)
        rows = self.steps.table("pipelines.csv", [
            ["area", *words, *self.library, *([] if ii == "1" else ["--ii", ii])] for words, ii in units])
        section = self.section("pipelines", "Pipelines",
                               "Fewer stages answer a ray sooner, and a smaller area is cheaper.")
        section.tables = [table("pipelines.csv", "All that is emitted, priced by the component library.", rows,
                                [c for c in rows[0] if c in PIPELINE])]
        section.commands = self.steps.commands["pipelines.csv"]

    def stability(self) -> None:
        """Units against the exact referee, by category."""
        plan = self.plan
        units = plan["units"]
        rows = self.steps.table(
            "stability.csv", [["check", *self.unit_words(u), "--tests", str(plan["tests"]), *self.seed] for u in units],
            quiet=True)
        section = self.section("stability", "Stability",
                               "Units that never miss have no false miss in any category; each share has an interval.")
        can_miss = [u["design"] for u in units if not plan["catalogue"][u["design"]]["conservative"]]
        misses = dict.fromkeys((u["design"] for u in units), 0)
        for row in rows:
            misses[row["design"]] += int(row["false_misses"])
        section.text = ["Rays and boxes made to break box tests, judged by exact arithmetic on boxes that are not "
                        "padded. Shares say nothing about a scene."]
        missed = ", ".join(f"{design} missed {misses[design]:,}" for design in dict.fromkeys(can_miss))
        section.facts = [("Units that can miss", missed or "none"),
                         ("Their reason", "a float unit rounds each difference and product to nearest, so entry and "
                          "exit may change their order; padded boxes of the hierarchy hide it")]
        self.count("false_misses", sum(n for d, n in misses.items() if d not in can_miss))
        section.tables = [stability_table(rows, [u["name"] for u in units]),
                          table("stability.csv", "What units missed.", rows,
                                ["design", "bits", "category", "tests", "exact_hits", "false_misses"],
                                [i for i, r in enumerate(rows) if int(r["false_misses"])])]
        section.tables = [t for t in section.tables if t.rows]
        section.commands = self.steps.commands["stability.csv"]

    def stiff(self) -> None:
        """False hits on stiff rays."""
        plan = self.plan
        conservative = [d for d in plan["designs"] if plan["catalogue"][d]["conservative"]]
        if not conservative:
            return
        names = [",".join(conservative)] if plan["named"] else []
        rows = self.steps.table("stiffness.csv", [["check", "--stiff", *names, "--tests", str(plan["ratio_tests"]),
                                                   *self.seed]])
        section = self.section("stiff", "Stiff rays", "A line that rises shows a unit that accepts boxes in vain "
                               "as the components of a direction grow apart.")
        for picture in stiff_plot.pictures(rows, self.width):
            picture.header = []
            section.figures += self.figure(picture, f"{plan['ratio_tests']:,} boxes for each ratio; stiffness.csv has "
                                           "the 95 % intervals.")
        self.count("false_misses", sum(int(row["false_misses"] or 0) for row in rows))
        section.commands = self.steps.commands["stiffness.csv"]

    def world(self) -> None:
        """What the bits of the integer world change."""
        rows = self.steps.table("integer_world.csv", [
            ["sweep", "int_triangle", *self.scene_options, *self.library, "--mantissas", "11", "--out",
             Out("integer_world.csv")]])
        section = self.section("world", "The integer world",
                               "More bits of the grid leave fewer rays with another triangle, for more area.")
        ticks = [row["bits"] for row in rows]
        lines = {name: [(i, float(row[column])) for i, row in enumerate(rows)]
                 for name, column in (("rays with another triangle", "different_rays_pct"),
                                      ("pixels that differ", "different_pixels_pct"))}
        section.figures = self.figure(
            lines_picture("integer_world_plot", "Rays and pixels that differ, by the bits of the integer world",
                          ("bits of the world", "%"), lines, {name: i for i, name in enumerate(lines)}, self.width,
                          ticks, "log-y"), "Against exact arithmetic on the float scene.")
        left = {"scene", "rays", "different_rays", "pixels", "different_pixels", "triangles", "degenerate_dropped",
                "mesh_share_of_cube_pct"}
        section.tables = [table("integer_world.csv", "What the bits change and cost.", rows,
                                [c for c in rows[0] if c not in left])]
        section.commands = self.steps.commands["integer_world.csv"]

    def core(self) -> None:
        """Cores that trace a small picture."""
        settings = [of for of, _ in core_section.settings()]
        commands = core_section.commands(self.view_options, self.library, self.plan["width"], self.plan["height"])
        section = self.section("core", "The core", "More rays in flight keep the memory port busy, and a cache saves "
                               "bytes; every answer was compared with software.")
        try:
            rows = self.steps.table("core.csv", commands, settings, may_fail=True)
        except RuntimeError as reason:
            section.text = [f"The core has not traced this scene: {reason}."]
            section.commands = self.steps.commands["core.csv"]
            return
        areas = self.steps.table("core_area.csv", core_section.area_commands(self.library),
                                 core_section.area_settings())
        for picture in core_section.pictures(self.plan["scene"], rows, areas, self.width):
            section.figures += self.figure(picture, "Rows of core.csv, areas of core_area.csv.")
        wrong = sum(int(row["wrong"]) for row in rows)
        section.facts = [("Must be none", f"wrong answers {wrong}")]
        self.count("wrong_core_answers", wrong)
        section.tables = [table("core.csv", "What cores did with the rays of the picture.", rows, core_section.SHOWN)]
        section.commands = [*self.steps.commands["core.csv"], *self.steps.commands["core_area.csv"]]

    def schematics(self) -> None:
        """The stages of each design, in groups."""
        section = self.section("schematics", "Schematics", "Each drawing opens at a touch and shows a design's stages.")
        commands = [["rtl", design, "--out", Out(f"schematics/{design}")] for design in self.plan["designs"]]
        self.steps.files("schematics", commands, [f"schematics/{d}/{d}.v" for d in self.plan["designs"]], at_once=True)
        section.commands = self.steps.commands["schematics"]
        for design in self.plan["designs"]:
            folder = f"schematics/{design}"
            drawings = [Figure(f"Schematic of {file.stem.replace('_', ' ')}", "", file.stem,
                               file.read_text(encoding="utf-8"))
                        for file in sorted((self.out / folder).glob("**/*.svg"))]
            if drawings:
                section.hidden.append((design, drawings))
        if not section.hidden:
            section.text = ["Not drawn: Graphviz was not installed."]
