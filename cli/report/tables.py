"""Tables of the page. Each cell that is a number says from which line and column of which file it comes."""
from __future__ import annotations

import csv
import dataclasses
import io
import math
import re
from collections.abc import Iterable, Sequence

Row = dict[str, str]

UNITS = {"_mm2_ns": ", mm² ns", "_mm2_ms": ", mm² ms", "_lut_ms": ", LUT ms", "_lut": ", LUT",
         "_per_million": " in a million", "_mm2": ", mm²", "_mhz": ", MHz", "_pct": ", %", "_ns": ", ns", "_ms": ", ms",
         "_kib": ", KiB", "mrays_s": "million rays a second", "_a_ray": " a ray", "_ps": ", ps"}
WORDS = {"stage delay": "clock period", "area delay": "area × clock period", "adp": "area × clock period",
         "area run time": "area × run time",
         "area per box": "area for each box", "rtl": "RTL"}
SCHEMA_UNITS = {"_mm2_ns": "mm2 ns", "_mm2_ms": "mm2 ms", "_mm2": "mm2", "_mhz": "MHz", "_pct": "%", "_ns": "ns",
                "_ms": "ms"}


def parse_csv(text: str) -> list[Row]:
    """Rows by column."""
    return list(csv.DictReader(io.StringIO(text)))


def heading(column: str) -> str:
    """A column in words: "clock_mhz" is "clock, MHz"."""
    for ending, unit in UNITS.items():
        if column.endswith(ending):
            column = column.removesuffix(ending)
            break
    else:
        unit = ""
    column = column.replace("_", " ")
    for name, words in WORDS.items():
        column = column.replace(name, words)
    return column + unit


def readable(cell: str) -> str:
    """Whole numbers in groups of three digits, others with four significant digits; any other text stays."""
    try:
        value = float(cell)
    except ValueError:
        return cell.removeprefix("n") if re.fullmatch(r"n\d+/\d+", cell) else cell
    if not math.isfinite(value):
        return cell
    if re.search(r"[.eE]", cell) and len(cell) > 6:
        cell = f"{value:.0f}" if abs(value) >= 1e4 else f"{value:.4g}"
    return re.sub(r"(?<=\d)(?=(\d{3})+$)", ",", cell) if re.fullmatch(r"-?\d+", cell) else cell


@dataclasses.dataclass
class Cell:
    """What a reader sees, and where it comes from: "LINE:COLUMN", several for several numbers, empty for words of the
    page itself."""
    text: str
    at: str = ""

    @property
    def kind(self) -> str:
        """The class of the style: numbers are aligned on the right, long texts are broken."""
        if re.fullmatch(r"-?[\d,.]+(e[-+]?\d+)?|inf|nan", self.text):
            return "n"
        return "t" if len(self.text) > 40 else ""


@dataclasses.dataclass
class Table:
    """A table of the page."""
    file: str
    caption: str
    columns: list[str]
    rows: list[list[Cell]]


def cell(rows: Sequence[Row], index: int, column: str) -> Cell:
    """A cell of a file. Its first line is the header."""
    return Cell(readable(rows[index].get(column, "")), f"{index + 2}:{column}")


def table(file: str, caption: str, rows: Sequence[Row], columns: Iterable[str], of: Iterable[int] | None = None,
          first: tuple[str, Sequence[str]] | None = None) -> Table:
    """Columns of some rows of a file, after a column of the page's own words."""
    shown = [c for c in columns if rows and c in rows[0]]
    made = Table(file, caption, [*([first[0]] if first else []), *map(heading, shown)], [])
    for i in range(len(rows)) if of is None else of:
        made.rows.append([*([Cell(first[1][len(made.rows)])] if first else []), *(cell(rows, i, c) for c in shown)])
    return made


def described(name: str, header: Sequence[str]) -> dict[str, object]:
    """A table as CSV on the Web describes it."""
    columns = []
    for column in header:
        unit = next((unit for ending, unit in SCHEMA_UNITS.items() if column.endswith(ending)), "")
        columns.append({"name": column, **({"schema:unitText": unit} if unit else {})})
    return {"url": name, "tableSchema": {"columns": columns}}
