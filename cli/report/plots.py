"""Pictures: one width, letters of 8 points, SVG, PDF and PNG of the same figure, and its values as CSV beside them."""
from __future__ import annotations

import csv
import io
import logging
import math
import os
import pathlib
from collections.abc import Iterable, Sequence

logging.getLogger("matplotlib").setLevel(logging.CRITICAL)
import matplotlib  # noqa: E402

matplotlib.use("Agg")
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.layout_engine import ConstrainedLayoutEngine  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

PAGE_MM = 96.0  # a telephone shows this width as it is, a desktop three such pictures side by side
LETTERS_PT = 8.0
PT_PER_MM = 72 / 25.4
SLOT_PT = 10.5  # between two labels above a plot
# Okabe's and Ito's colours, then darker ones: the colour-blind tell them apart, and each has a shape of its own too.
COLOURS = ("#0072B2", "#D55E00", "#000000", "#E69F00", "#009E73", "#CC79A7",
           "#56B4E9", "#806000", "#7A1F5C", "#666666", "#004C77", "#8F3F00")
SHAPES = "os^DvPX<>ph*"
GREY = "#888888"

matplotlib.rcParams.update({
    "font.size": LETTERS_PT, "axes.labelsize": LETTERS_PT, "axes.titlesize": LETTERS_PT, "legend.fontsize": LETTERS_PT,
    "xtick.labelsize": LETTERS_PT, "ytick.labelsize": LETTERS_PT, "font.family": "sans-serif",
    "svg.fonttype": "none", "pdf.fonttype": 42, "axes.unicode_minus": False, "lines.linewidth": 1.0,
    "lines.markersize": 4.0, "axes.linewidth": 0.6, "axes.grid": True, "grid.color": "#dddddd", "grid.linewidth": 0.5,
    "axes.axisbelow": True, "xtick.major.width": 0.6, "ytick.major.width": 0.6, "savefig.dpi": 300,
})


def style(place: int) -> dict[str, str]:
    """The colour and the shape of the design at this place of the catalogue."""
    turn = place // len(SHAPES)
    return {"color": COLOURS[place % len(COLOURS)], "marker": SHAPES[(place + turn) % len(SHAPES)]}


def key(place: int, label: str, line: str = "none") -> Line2D:
    """An entry of the legend."""
    return Line2D([], [], linestyle=line, label=label, markeredgewidth=0.4, **style(place))


def even_slots(wanted: Sequence[float], room: float) -> list[float]:
    """Places in 0..1, in the order of those that are wanted and near them, at least `room` apart."""
    places = sorted(wanted)
    for i in range(1, len(places)):
        places[i] = max(places[i], places[i - 1] + room)
    places[-1] = min(places[-1], 1.0)
    for i in range(len(places) - 2, -1, -1):
        places[i] = min(places[i], places[i + 1] - room)
    return places


def plain(value: float, _place: int = 0) -> str:
    """A number of an axis, never with an exponent: 1,000 and 0.002."""
    if abs(value) >= 1e6:
        return f"{value / 1e6:g} M"
    return f"{value:,.0f}" if abs(value) >= 1e3 else f"{value:.10f}".rstrip("0").rstrip(".")


def log_axis(ax: Axes, which: str, values: Sequence[float], enough: int = 3) -> None:
    """Makes the x or the y axis logarithmic. Where a value is not above zero, it is linear around zero. It has so many
    ticks or more, where their numbers have room."""
    positive = [v for v in values if v > 0] or [1.0]
    low, high = min(positive), max(positive)
    axis = getattr(ax, f"{which}axis")
    scale, limits = getattr(ax, f"set_{which}scale"), getattr(ax, f"set_{which}lim")
    least = min(values, default=low)
    if least > 0:
        scale("log")
        margin = max((high / low) ** 0.06, 1.04)
        limits(low / margin, high * margin)
    else:
        linear = 10.0 ** math.floor(math.log10(low))
        scale("symlog", linthresh=linear, linscale=0.4)
        limits(min(1.2 * least, -0.6 * linear), high * max((high / linear) ** 0.06, 1.5))
    shown = axis.get_view_interval()
    at: list[float] = []
    for steps in ((1,), (1, 2, 5), (1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9)):
        decades = range(math.floor(math.log10(low)) - 1, math.ceil(math.log10(high)) + 1)
        at = [s * 10.0**d for d in decades for s in steps if max(shown[0], low / 3) <= s * 10.0**d <= shown[1]]
        if len(at) >= enough:
            break
    if not at:
        at = [t for t in matplotlib.ticker.MaxNLocator(3).tick_values(low, high) if shown[0] <= t <= shown[1]]
    at = apart(at, shown[0] if least > 0 else linear, shown[1], 0.12 if which == "x" else 0.08) if enough > 1 else at[:1]
    axis.set_major_locator(matplotlib.ticker.FixedLocator(([0.0] if least <= 0 else []) + at))
    axis.set_major_formatter(matplotlib.ticker.FuncFormatter(plain))
    axis.set_minor_locator(matplotlib.ticker.NullLocator())


def apart(ticks: Sequence[float], low: float, high: float, room: float) -> list[float]:
    """Those of the ticks that are so far apart, as shares of a logarithmic axis."""
    kept: list[float] = []
    for tick in ticks:
        if not kept or math.log(tick / kept[-1]) >= room * math.log(high / low):
            kept.append(tick)
    return kept


def beyond(values: Sequence[float]) -> float | None:
    """The end of the axis that most values need: a fifth of them at most is three times above all others. Nothing if
    none is."""
    ordered = sorted(v for v in values if v > 0)
    for i in range(max(1, len(ordered) - len(ordered) // 5), len(ordered)):
        if ordered[i] > 3 * ordered[i - 1]:
            return ordered[i - 1]
    return None


class Picture:
    """A figure of panels on a common scale, labels above the first, a legend below. With `broken` a second panel beside
    the first is for the few values that lie far beyond."""

    def __init__(self, name: str, title: str, width_mm: float | None, panels: int = 1, broken: bool = False) -> None:
        self.name, self.title = name, title
        self.width = (width_mm or PAGE_MM) * PT_PER_MM
        self.columns = min(panels, max(1, int(self.width // 190)))
        self.rows = -(-panels // self.columns)
        self.figure = Figure(figsize=(self.width / 72, 3))
        FigureCanvasAgg(self.figure)
        self.far: Axes | None = None
        if broken:
            near, self.far = self.figure.subplots(1, 2, sharey=True, width_ratios=[4, 1])
            self.axes = [near]
            self.mark_the_break()
        else:
            self.axes = list(self.figure.subplots(self.rows, self.columns, sharex=True, sharey=True, squeeze=False).flat)
        for ax in self.axes[panels:]:
            ax.set_visible(False)
        for column in range(self.columns):  # the lowest panel of a column has the axis
            last = max(i for i in range(panels) if i % self.columns == column)
            self.axes[last].tick_params(labelbottom=True)
        self.ax = self.axes[0]
        self.above = 0.0  # points that labels take
        self.unnamed = 0  # labels without room
        self.header: list[str] = []
        self.values: list[Sequence[object]] = []

    def mark_the_break(self) -> None:
        """No frame between the panels, and a slanted line at each of their corners there."""
        near, far = self.axes[0], self.far
        near.spines.right.set_visible(False)
        far.spines.left.set_visible(False)
        far.tick_params(left=False, labelleft=False)
        slanted = {"marker": [(-0.5, -1), (0.5, 1)], "ls": "none", "ms": 6, "color": "black", "mew": 0.6, "clip_on": False}
        near.plot([1, 1], [0, 1], transform=near.transAxes, **slanted)
        far.plot([0, 0], [0, 1], transform=far.transAxes, **slanted)

    def labels(self, x: str, y: str) -> None:
        """Names the axes: those of the panels on the left and of the lowest ones."""
        panels = [ax for ax in self.axes if ax.get_visible()]
        across = "\n".join(wrapped(x, (self.width / self.columns - 40) / 4.3))
        up = "\n".join(wrapped(y, self.height_of_axes() / 4.3))
        for i, ax in enumerate(panels):
            if i + self.columns >= len(panels):
                ax.set_xlabel(across)
            if i % self.columns == 0:
                ax.set_ylabel(up)

    def height_of_axes(self) -> float:
        """Narrow pictures are higher than wide ones, for their width."""
        return 50 + 0.42 * self.width / self.columns

    def label_above(self, marks: Sequence[tuple[str, float, float]]) -> None:
        """Labels in a row above the plot, a line from each to its mark: (text, x, y). None lies on another."""
        to_share = self.ax.transScale + self.ax.transLimits
        placed = sorted(((text, x, y, float(to_share.transform((x, y))[0])) for text, x, y in marks),
                        key=lambda mark: mark[3])
        room = (self.width - 60) * (1 if self.far is None else 0.74)
        most = max(1, int(room / SLOT_PT))
        kept = placed if len(placed) <= most else [placed[i * len(placed) // most] for i in range(most)]
        for (text, x, y, _), slot in zip(kept, even_slots([mark[3] for mark in kept], SLOT_PT / room)):
            self.ax.annotate(text, (x, y), (slot, 1.04), textcoords="axes fraction", rotation=90, va="bottom",
                             ha="center", arrowprops={"arrowstyle": "-", "lw": 0.4, "color": GREY, "shrinkA": 1,
                                                      "shrinkB": 2})
        self.above = 4.6 * max((len(mark[0]) for mark in kept), default=0) + 8
        self.unnamed = len(placed) - len(kept)

    def finish(self, keys: Sequence[Line2D]) -> None:
        """Lays the legend below the plot, and everything at its place."""
        below = 0.0
        if keys:
            entry = 4.9 * max(len(k.get_label()) for k in keys) + 24
            columns = max(1, min(len(keys), int(self.width / entry)))
            below = 11.5 * -(-len(keys) // columns) + 8
            self.figure.legend(handles=list(keys), loc="lower center", ncol=columns, frameon=False, borderpad=0.2,
                               labelspacing=0.3, handletextpad=0.4, columnspacing=1.2, borderaxespad=0.2,
                               handlelength=1.6)
        height = self.rows * (self.height_of_axes() + (16 if len(self.axes) > 1 else 0)) + 40 + self.above + below
        self.figure.set_size_inches(self.width / 72, height / 72)
        self.figure.set_layout_engine(ConstrainedLayoutEngine(
            rect=(0, below / height, 1, 1 - below / height), w_pad=3 / 72, h_pad=3 / 72, wspace=0.02, hspace=0.02))

    def write(self, folder: pathlib.Path) -> None:
        """Writes NAME.svg, NAME.pdf, NAME.png and NAME.csv. The same values give the same bytes."""
        matplotlib.rcParams["svg.hashsalt"] = self.name
        self.figure.draw_without_rendering()  # lays out
        self.figure.set_layout_engine("none")
        none = {"svg": {"Date": None, "Title": self.title}, "png": {"Software": None},
                "pdf": {"CreationDate": None, "Title": self.title}}
        for kind, metadata in none.items():
            made = io.BytesIO()
            self.figure.savefig(made, format=kind, metadata=metadata)
            write_whole(folder / f"{self.name}.{kind}", made.getvalue())
        if self.header:
            write_whole(folder / f"{self.name}.csv", csv_text(self.header, self.values).encode())


def wrapped(text: str, letters: float) -> list[str]:
    """Lines of at most so many letters, where words allow it."""
    lines: list[str] = []
    for word in text.split(" "):
        if lines and len(lines[-1]) + 1 + len(word) <= letters:
            lines[-1] += " " + word
        else:
            lines.append(word)
    return lines


def csv_text(header: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table as hitpipe writes it."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([header, *rows])
    return text.getvalue()


def write_whole(file: pathlib.Path, contents: bytes) -> None:
    """A file is there as a whole or not at all."""
    aside = file.with_name(f".{file.name}.hitpipe-{os.getpid():x}")
    try:
        aside.write_bytes(contents)
        os.replace(aside, file)
    finally:
        aside.unlink(missing_ok=True)
