"""What the template of the page is filled with."""
from __future__ import annotations

import base64
import dataclasses
import itertools
import re
from collections.abc import Sequence

from tables import Table


@dataclasses.dataclass
class Image:
    """A picture of pixels. `high`: the largest value of a map, whose colours begin at 0."""
    caption: str
    png: bytes
    width: int
    height: int
    high: str = ""

    @property
    def data(self) -> str:
        """The file inside the page."""
        return base64.b64encode(self.png).decode()


@dataclasses.dataclass
class Figure:
    """A drawing of lines, as the file NAME.svg has it."""
    title: str
    caption: str
    name: str
    svg: str


@dataclasses.dataclass
class Part:
    """A part of a section: a sentence of what the reader should see, then this."""
    title: str
    lead: str
    text: list[str] = dataclasses.field(default_factory=list)
    facts: list[tuple[str, str]] = dataclasses.field(default_factory=list)
    figures: list[Figure] = dataclasses.field(default_factory=list)
    images: list[Image] = dataclasses.field(default_factory=list)
    tables: list[Table] = dataclasses.field(default_factory=list)
    hidden: list[tuple[str, list[Figure]]] = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class Section:
    """A section: a question and its answer, what the answer rests on, and the commands that make all of it again."""
    name: str
    title: str
    lead: str
    parts: list[Part] = dataclasses.field(default_factory=list)
    commands: list[str] = dataclasses.field(default_factory=list)

    def part(self, title: str, lead: str) -> Part:
        """One more."""
        self.parts.append(Part(title, lead))
        return self.parts[-1]


@dataclasses.dataclass
class Page:
    """All of it."""
    title: str
    facts: Sequence[tuple[str, str]]
    sections: Sequence[Section]
    without: Sequence[str]

    def __post_init__(self) -> None:
        self.numbers = itertools.count(1)

    def inline(self, figure: Figure) -> str:
        """The <svg> element with a name, and with identifiers that no other drawing has."""
        svg = figure.svg[figure.svg.index("<svg"):]
        svg = re.sub(r"<!--.*?-->|<title>.*?</title>|<desc>.*?</desc>|<metadata>.*?</metadata>", "", svg, flags=re.S)
        prefix = f"d{next(self.numbers)}-"
        svg = re.sub(r"""(\sid=["'])""", rf"\1{prefix}", svg)
        svg = re.sub(r"""(href=["']#|url\(#)""", rf"\1{prefix}", svg)
        return svg.replace("<svg", f'<svg role="img" aria-label="{figure.title}"', 1)
