#!/usr/bin/env python3
"""The parts of the pictures: labels keep apart, axes show each value, colours are told apart, files are deterministic:
plots_test.py FOLDER of the report's programs."""
import math
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, sys.argv.pop(1))
import diagrams  # noqa: E402
import plots  # noqa: E402
import tables  # noqa: E402


def seen(colour: str, blind: str) -> tuple[float, float, float]:
    """How a colour looks without one kind of cone, after Vienot, Brettel and Mollon 1999."""
    red, green, blue = ((int(colour[i:i + 2], 16) / 255)**2.2 for i in (1, 3, 5))
    if blind == "protan":
        red = green = 0.112 * red + 0.888 * green
    elif blind == "deutan":
        red = green = 0.293 * red + 0.707 * green
    return red**(1 / 2.2), green**(1 / 2.2), blue**(1 / 2.2)


class Slots(unittest.TestCase):
    def test_are_apart_in_order_and_within_the_plot(self) -> None:
        for wanted in ([0.5], [0.1, 0.1, 0.1], [0.95, 0.99, 1.0, 1.0], [0.0, 0.01, 0.5, 0.52, 0.9]):
            places = plots.even_slots(wanted, 0.05)
            self.assertTrue(all(b - a > 0.05 - 1e-9 for a, b in zip(places, places[1:])), places)
            self.assertLessEqual(places[-1], 1.0)
        self.assertEqual(plots.even_slots([0.2, 0.8], 0.05), [0.2, 0.8])


class Axes(unittest.TestCase):
    def drawn(self, values: list[float], which: str = "x", **more):
        """An axis with these values, and its ticks."""
        ax = plots.Picture("axes", "Axes", 96).ax
        plots.log_axis(ax, which, values, **more)
        axis = getattr(ax, f"{which}axis")
        low, high = axis.get_view_interval()
        return low, high, [tick for tick in axis.get_ticklocs() if low <= tick <= high]

    def test_hold_all_values_and_have_ticks(self) -> None:
        for values in ([1, 2], [0.001, 1000], [5, 5], [0, 3], [-1, 0], [1e-7, 1e9], [830, 1200], [3.31, 3.33], [-2, 0, 1, 10]):
            for which in "xy":
                low, high, ticks = self.drawn(values, which)
                self.assertLess(low, min(values), values)
                self.assertGreater(high, max(values), values)
                self.assertTrue(1 <= len(ticks) <= 13, (values, ticks))
                self.assertEqual(0 in ticks, min(values) <= 0, values)
        self.assertGreaterEqual(len(self.drawn([1, 2])[2]), 3)
        self.assertEqual(len(self.drawn([4, 9], enough=1)[2]), 1)

    def test_have_ticks_far_enough_apart(self) -> None:
        for values in ([0.56, 1.36], [600, 1050], [0.82, 4.0], [0.001, 1000]):
            low, high, ticks = self.drawn(values)
            for a, b in zip(ticks, ticks[1:]):
                self.assertGreater(math.log(b / a) / math.log(high / low), 0.1, (values, ticks))

    def test_print_numbers_in_one_notation(self) -> None:
        for value, text in ((0.0001, "0.0001"), (0, "0"), (0.5, "0.5"), (10, "10"), (1000, "1,000"), (20000, "20,000"),
                            (5e6, "5 M")):
            self.assertEqual(plots.plain(value), text)

    def test_are_broken_where_few_values_lie_far_beyond(self) -> None:
        self.assertEqual(plots.beyond([0.5, 0.9, 1.0, 1.0, 1.1, 1.1, 1.2, 1.3, 12.4]), 1.3)
        self.assertIsNone(plots.beyond([0.5, 0.9, 1.0, 1.0, 1.1, 1.1, 1.2, 1.3, 3.5]))
        self.assertIsNone(plots.beyond([1, 1.1, 1.2, 10, 11, 12]), "half of them are not few")
        self.assertIsNone(plots.beyond([1, 10]), "nor is one of two")


class Styles(unittest.TestCase):
    def test_have_a_shape_of_their_own_each(self) -> None:
        self.assertEqual(len({plots.style(i)["marker"] for i in range(12)}), 12)
        self.assertEqual(len({tuple(plots.style(i).values()) for i in range(48)}), 48)

    def test_of_the_first_designs_are_told_apart_by_the_colour_blind(self) -> None:
        for blind in ("none", "protan", "deutan"):
            for i in range(7):
                for j in range(i):
                    a, b = (seen(plots.COLOURS[k], blind) for k in (i, j))
                    far = sum((x - y)**2 for x, y in zip(a, b))**0.5
                    self.assertGreater(far, 0.14, (blind, plots.COLOURS[i], plots.COLOURS[j]))


class Front(unittest.TestCase):
    def test_has_no_point_below_and_left(self) -> None:
        self.assertEqual(diagrams.pareto([(3, 1), (1, 3), (2, 2), (3, 3), (2.5, 2)]), [1, 2, 0])


class Numbers(unittest.TestCase):
    def test_are_readable(self) -> None:
        for cell, shown in (("1234567", "1,234,567"), ("0.123456789", "0.1235"), ("12345.678", "12,346"),
                            ("-1234", "-1,234"), ("999", "999"), ("n20/24", "20/24"), ("inf", "inf"), ("", ""), ("20+1/13", "20+1/13")):
            self.assertEqual(tables.readable(cell), shown)

    def test_have_headings_in_words(self) -> None:
        self.assertEqual(tables.heading("whole_area_run_time_mm2_ms"), "whole area × run time, mm² ms")
        self.assertEqual(tables.heading("clock_mhz"), "clock, MHz")
        self.assertEqual(tables.heading("energy_nj_per_ray"), "energy, nJ a ray")
        self.assertEqual(tables.heading("bytes_per_ray_4kib"), "bytes a ray behind 4 KiB")

    def test_have_their_interval_beside_them(self) -> None:
        row = {"share_pct": "0.0345678", "share_pct_low": "0.0012345", "share_pct_high": "1234.5", "count": "7"}
        self.assertEqual(tables.with_interval(row, "share_pct"), "0.0346 (0.0012 to 1,234)")
        self.assertEqual(tables.with_interval(row, "count"), "7")
        self.assertEqual(tables.cell([row], 0, "share_pct").at, "2:share_pct 2:share_pct_low 2:share_pct_high")


class Pictures(unittest.TestCase):
    def draw(self, folder: str, width_mm: float, units: int, far: bool = False) -> plots.Picture:
        """Many units at nearly one place."""
        rows = [{"design": "a" if i % 2 else "b", "bits": f"n{i}/{i}", "run_time_ms": str(1 + i / 100 + (20 if far and i == 0 else 0)),
                 "extra_box_tests_pct": str(units - i), "extra_box_tests_pct_low": str(units - i - 0.5),
                 "extra_box_tests_pct_high": str(units - i + 2)} for i in range(units)]
        diagram = diagrams.error_diagrams(False)[0]
        marks = diagrams.marks_of(diagram, rows, [f"unit {i}" for i in range(units)], [])
        picture = diagrams.error_picture(diagram, "scene", marks, {"a": 0, "b": 1}, "none", width_mm)
        picture.write(pathlib.Path(folder))
        return picture

    def test_have_the_width_and_the_same_bytes(self) -> None:
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as two:
            for folder in (one, two):
                self.draw(folder, 84, 8)
            for kind in ("svg", "pdf", "png", "csv"):
                files = [pathlib.Path(folder, f"error_run_time.{kind}").read_bytes() for folder in (one, two)]
                self.assertEqual(*files)
            svg = pathlib.Path(one, "error_run_time.svg").read_text()
            self.assertIn('width="238.11', svg)
            self.assertEqual(len(list(pathlib.Path(one).iterdir())), 4)

    def test_have_no_label_on_another_or_outside(self) -> None:
        for width, units, far in ((40, 30, False), (84, 12, False), (96, 24, True), (96, 24, False), (180, 60, True)):
            with tempfile.TemporaryDirectory() as folder:
                picture = self.draw(folder, width, units, far)
                figure = picture.figure
                renderer = figure.canvas.get_renderer()
                figure.draw(renderer)
                # An annotation's own extent has its line, which may pass another line.
                boxes = [type(text).__mro__[1].get_window_extent(text, renderer) for text in picture.ax.texts]
                names = [text.get_text() for text in picture.ax.texts]
                self.assertEqual(picture.far is not None, far)
                self.assertEqual(len(boxes) + picture.unnamed, units - far)
                self.assertGreaterEqual(len(boxes), min(units, 5))
                for i, box in enumerate(boxes):
                    self.assertTrue(box.x0 >= 0 and box.y1 <= figure.bbox.y1 + 1 and box.x1 <= figure.bbox.x1, names[i])
                    for other in range(i):
                        self.assertFalse(box.padded(-0.5).overlaps(boxes[other].padded(-0.5)),
                                         (width, names[i], names[other]))


if __name__ == "__main__":
    unittest.main()
