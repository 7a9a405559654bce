"""What a report was asked for, its steps, and what they counted. Each question's module adds a section of the page."""
from __future__ import annotations

import pathlib
import shlex
from collections.abc import Mapping

from page import Figure, Section
from plots import Picture
from steps import Steps
from sweep_rows import Swept
from tables import Row

Unit = tuple[str, str]  # a design and its format


def unit_of(row: Row) -> Unit:
    """Of a row of any file."""
    return row["design"], row["bits"].removeprefix("n")


class Work:
    """The plan of the program hitpipe, and what has been made of it."""

    def __init__(self, plan: dict) -> None:
        self.plan = plan
        self.out = pathlib.Path(plan["out"])
        self.out.mkdir(parents=True, exist_ok=True)
        self.steps = Steps(plan["program"], plan["version"], self.out, plan["threads"], plan["talk"])
        self.sweep_options, self.scene_options, self.view_options, self.library = (
            shlex.split(plan[name]) for name in ("sweep_options", "scene_options", "view_options", "library_option"))
        self.width = plan["plot_width_mm"]
        self.seed = ["--seed", str(plan["seed"])]
        self.catalogue: Mapping[str, Mapping[str, object]] = plan["catalogue"]
        self.places = {name: design["place"] for name, design in self.catalogue.items()}
        self.sections: list[Section] = []
        self.wrong: dict[str, int] = {}
        self.rows: list[Row] = []
        self.swept: Swept
        self.fitted: list[Row] = []  # units that were made for the scene

    def section(self, name: str, title: str) -> Section:
        """Its first sentence is written when the answer is known."""
        self.sections.append(Section(name, title, ""))
        return self.sections[-1]

    def wanted(self, name: str) -> bool:
        """Whether the user did not leave it out."""
        return name not in self.plan["without"]

    def figure(self, picture: Picture | None, caption: str) -> list[Figure]:
        """Writes the picture, and has it for the page."""
        if picture is None:
            return []
        picture.write(self.out)
        if picture.unnamed:
            caption += f" {picture.unnamed} units of the front have no room for a label."
        svg = (self.out / f"{picture.name}.svg").read_text(encoding="utf-8")
        return [Figure(picture.title, caption, picture.name, svg)]

    def count(self, what: str, number: int) -> None:
        """A count that must be none."""
        self.wrong[what] = self.wrong.get(what, 0) + number

    def never_misses(self, design: str) -> bool:
        """Whether it is proved to."""
        return bool(self.catalogue[design]["conservative"])

    def bits_option(self, unit: Unit) -> list[str]:
        """What a command needs to take the unit in its format."""
        return [] if self.catalogue[unit[0]]["single"] else ["--bits", unit[1]]

    def several(self, units: list[Unit]) -> list[str]:
        """The units as one command takes them."""
        of = [f"{design}={bits}" for design, bits in units if not self.catalogue[design]["single"]]
        return [",".join(dict.fromkeys(design for design, _ in units)), *(["--bits", ",".join(of)] if of else [])]

    def name(self, unit: Unit) -> str:
        """"int_slabs 20/24", or the design's name where it has one format only."""
        return unit[0] if self.catalogue[unit[0]]["single"] else f"{unit[0]} {unit[1]}"

    def best_units(self) -> list[Unit]:
        """The recommended units, each once, and the yardstick."""
        found = [i for _, i in self.swept.best()] + self.swept.of_design(self.plan["baseline"])
        return list(dict.fromkeys(unit_of(self.rows[i]) for i in found))
