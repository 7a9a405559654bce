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
         "_kib": ", KiB", "mrays_s": "million rays a second", "_s_per_mray": ", µs a ray", "_nj_per_ray": ", nJ a ray",
         "_ns_per_ray": ", ns a ray", "_per_ray": " a ray", "_a_ray": " a ray", "_ps": ", ps"}
WORDS = {"stage delay": "clock period", "area delay": "area × clock period", "adp": "area × clock period",
         "area run time": "area × run time", "mm2": "mm²",
         "area per box": "area for each box", "rtl": "RTL"}
CACHE = re.compile(r"_(\d+)kib$")
SCHEMA_UNITS = {"_mm2_ns": "mm2 ns", "_mm2_ms": "mm2 ms", "_mm2": "mm2", "_mhz": "MHz", "_pct": "%", "_ns": "ns",
                "_ms": "ms"}


def parse_csv(text: str) -> list[Row]:
    """Rows by column."""
    return list(csv.DictReader(io.StringIO(text)))


def heading(column: str) -> str:
    """A column in words: "clock_mhz" is "clock, MHz"."""
    if cache := CACHE.search(column):
        return f"{heading(column.removesuffix(cache[0]))} behind {cache[1]} KiB"
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
        cell = f"{value:.0f}" if abs(value) >= 1e4 else digits(value, 4).replace(",", "")
    return re.sub(r"(?<=\d)(?=(\d{3})+$)", ",", cell) if re.fullmatch(r"-?\d+", cell) else cell


def digits(value: float, most: int = 3) -> str:
    """So many significant digits, never with an exponent."""
    if not math.isfinite(value) or value == 0:
        return "0" if value == 0 else str(value)
    places = max(0, most - 1 - math.floor(math.log10(abs(value))))
    text = f"{value:,.{places}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def with_interval(row: Row, column: str) -> str:
    """A figure and the ends of its 95 % interval: "0.086 (0.05 to 0.14)"."""
    of, low, high = (row.get(column + end, "") for end in ENDS)
    if not low or not high:
        return digits(float(of)) if of else ""
    return f"{digits(float(of))} ({digits(float(low), 2)} to {digits(float(high), 2)})"


def percent(row: Row, column: str) -> str:
    """The same in a sentence: "0.086 % (95 %: 0.05 to 0.14)"."""
    return with_interval(row, column).replace(" (", " % (95 %: ", 1)


ENDS = ("", "_low", "_high")


@dataclasses.dataclass
class Cell:
    """What a reader sees, and where it comes from: "LINE:COLUMN", several for several numbers, empty for words of the
    page itself."""
    text: str
    at: str = ""

    @property
    def kind(self) -> str:
        """The class of the style: numbers are aligned on the right, long texts are broken."""
        if re.fullmatch(r"-?[\d,.]+(e[-+]?\d+)?( \(.*\))?|inf|nan", self.text):
            return "n"
        return "t" if len(self.text) > 40 else ""


@dataclasses.dataclass
class Table:
    """A table of the page. On a narrow screen each row of `cards` is a block of its own."""
    file: str
    caption: str
    columns: list[str]
    rows: list[list[Cell]]
    cards: bool = False


def cell(rows: Sequence[Row], index: int, column: str) -> Cell:
    """A cell of a file. Its first line is the header."""
    if rows[index].get(f"{column}_low"):
        return Cell(with_interval(rows[index], column), " ".join(f"{index + 2}:{column}{end}" for end in ENDS))
    return Cell(readable(rows[index].get(column, "")), f"{index + 2}:{column}")


def table(file: str, caption: str, rows: Sequence[Row], columns: Iterable[str], of: Iterable[int] | None = None,
          first: tuple[str, Sequence[str]] | None = None) -> Table:
    """Columns of some rows of a file, after a column of the page's own words. A figure has its interval beside it."""
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
