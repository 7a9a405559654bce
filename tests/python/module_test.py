"""The module's arrays against what `hitpipe` prints of the same rays, boxes, designs and prices."""
import csv
import json
import pathlib
import tempfile
import threading
import time
import unittest

import hitpipe
import numpy

from program import hitpipe_prints, random_pairs


def of_boxes():
    """The designs that test boxes."""
    return [d.name for d in hitpipe.designs() if any(r.meaning == "hit" for r in hitpipe.Unit(d.name).results) and d.name != "int_triangle"]


def rows_of_the_program(design, rays, boxes):
    with tempfile.TemporaryDirectory() as folder:
        for name, columns, table in (("rays", "ox,oy,oz,dx,dy,dz,length", rays),
                                     ("boxes", "min_x,min_y,min_z,max_x,max_y,max_z", boxes.reshape(len(boxes), 6))):
            lines = [columns] + [",".join("inf" if x == numpy.inf else float(x).hex() for x in row) for row in table]
            pathlib.Path(folder, f"{name}.csv").write_text("\n".join(lines) + "\n")
        printed = hitpipe_prints("operands", design, "--rays", f"{folder}/rays.csv", "--boxes", f"{folder}/boxes.csv", "--as", "csv",
                                 "--out", "-")
    return list(csv.DictReader(line for line in printed.splitlines() if not line.startswith("#")))


def number(text):
    return int(text, 0)


class Catalogue(unittest.TestCase):
    def test_designs_are_those_of_the_program(self):
        listed = json.loads(hitpipe_prints("list", "designs", "--format", "json"))
        self.assertEqual([d.name for d in hitpipe.designs()], [row["design"] for row in listed])
        self.assertEqual([d.default_format for d in hitpipe.designs()], [row["bits"] for row in listed])
        self.assertEqual(hitpipe.__version__, hitpipe_prints("--version").split()[1])

    def test_prices_are_those_of_the_program(self):
        for bits in ("16/16", "20/24"):
            row, = json.loads(hitpipe_prints("area", "int_slabs", "--bits", bits, "--format", "json"))
            price = hitpipe.price("int_slabs", bits)
            self.assertEqual(round(price.area_um2 / 1e6, 4), row["area_mm2"])
            self.assertEqual((price.stages, price.stage_delay_ps), (row["stages"], round(row["stage_delay_ns"] * 1000)))
            self.assertIsNone(price.lookup_tables)
            row, = json.loads(hitpipe_prints("area", "int_slabs", "--bits", bits, "--library", "xc7", "--format", "json"))
            price = hitpipe.Unit("int_slabs", bits).price("xc7")
            self.assertEqual((price.lookup_tables, price.registers, price.multiplier_blocks), (row["lut"], row["ff"], row["dsp"]))
            self.assertIsNone(price.area_um2)
            self.assertEqual(repr(price), f"<hitpipe.Price: {price.stages} stages of {price.stage_delay_ps} ps, {row['lut']} lookup tables, "
                                          f"{row['ff']} registers, {row['dsp']} multiplier blocks>")

    def test_ports_are_described(self):
        unit = hitpipe.Unit("int_slabs", "12/14")
        self.assertEqual((unit.design, unit.format, unit.conservative, unit.boxes_per_test), ("int_slabs", "12/14", True, 1))
        port = unit.ports[0]
        self.assertEqual((port.name, port.width, port.signed, port.kind, port.role, port.axis), ("irx", 12, True, "integer", "origin", 0))
        self.assertEqual([(r.name, r.meaning, r.width) for r in unit.results], [("hit", "hit", 1)])
        self.assertEqual((repr(port), repr(unit)), ("<signed irx, 12 bits>", "<hitpipe.Unit int_slabs 12/14>"))
        # A port outlives its unit.
        ports = [hitpipe.Unit("int_slabs").ports[i] for i in range(17)]
        self.assertEqual([p.name for p in ports], [p.name for p in unit.ports])
        corners = [p for p in hitpipe.Unit("int_triangle").ports if p.role == "corner"]
        self.assertEqual({p.box for p in corners}, {0, 1, 2})


class Answers(unittest.TestCase):
    def test_are_those_of_the_program(self):
        rays, boxes = random_pairs(300)
        for design in of_boxes():
            unit = hitpipe.Unit(design)
            if unit.boxes_per_test != 1:
                continue
            with self.subTest(design):
                answers = unit.test_pairs(rays, boxes)
                rows = rows_of_the_program(design, rays, boxes)
                self.assertEqual(len(rows), 300)
                operands = [[number(row[port.name]) for port in unit.ports] for row in rows]
                numpy.testing.assert_array_equal(answers.operands, operands)
                numpy.testing.assert_array_equal(answers.results, [[number(row[r.name]) for r in unit.results] for row in rows])
                numpy.testing.assert_array_equal(answers.hit, [row["hit"] == "1" for row in rows])
                numpy.testing.assert_array_equal(answers.exact, [row["exact_hit"] == "1" for row in rows])
                numpy.testing.assert_array_equal(answers.exact, hitpipe.exact(rays, boxes))
                numpy.testing.assert_array_equal(answers.results, unit.test_operands(answers.operands))
                self.assertTrue(50 < numpy.count_nonzero(answers.hit) < 250)

    def test_of_two_boxes_are_those_of_each(self):
        rays, boxes = random_pairs(300)
        both = numpy.stack([boxes, numpy.roll(boxes, 1, axis=0)], axis=1)
        pair, one = hitpipe.Unit("int_major_pair"), hitpipe.Unit("int_major")
        answers = pair.test_pairs(rays, both)
        self.assertEqual(answers.hit.shape, (300, 2))
        for box in (0, 1):
            each = one.test_pairs(rays, both[:, box])
            numpy.testing.assert_array_equal(answers.hit[:, box], each.hit)
            numpy.testing.assert_array_equal(answers.exact[:, box], each.exact)

    def test_do_not_depend_on_the_layout(self):
        rays, boxes = random_pairs(100)
        unit = hitpipe.Unit("int_major")
        expected = unit.test_pairs(rays, boxes)
        structured_rays = numpy.zeros(100, hitpipe.rays_dtype)
        structured_rays["origin"], structured_rays["direction"], structured_rays["length"] = rays[:, :3], rays[:, 3:6], rays[:, 6]
        structured_boxes = numpy.zeros(100, hitpipe.boxes_dtype)
        structured_boxes["min"], structured_boxes["max"] = boxes[:, 0], boxes[:, 1]
        wide = numpy.zeros((100, 9), numpy.float32)
        wide[:, 1:8] = rays
        for own_rays, own_boxes in ((structured_rays, structured_boxes), (numpy.asfortranarray(rays), numpy.asfortranarray(boxes)),
                                    (wide[:, 1:8], boxes), (rays[::-1][::-1], boxes)):
            found = unit.test_pairs(own_rays, own_boxes)
            numpy.testing.assert_array_equal(found.operands, expected.operands)
            numpy.testing.assert_array_equal(found.hit, expected.hit)
        one_ray = unit.test_pairs(numpy.broadcast_to(rays[5], rays.shape), boxes)
        self.assertEqual(one_ray.hit[5], expected.hit[5])
        numpy.testing.assert_array_equal(one_ray.operands[:, 0], expected.operands[5, 0])

    def test_have_these_types_and_only_what_is_asked(self):
        rays, boxes = random_pairs(10)
        unit = hitpipe.Unit("fp_slabs")
        answers = unit.test_pairs(rays, boxes)
        self.assertEqual([(a.dtype.name, a.shape) for a in (answers.hit, answers.exact, answers.operands, answers.results)],
                         [("bool", (10,)), ("bool", (10,)), ("int64", (10, 14)), ("int64", (10, 1))])
        few = unit.test_pairs(rays, boxes, exact=False, operands=False, results=False)
        self.assertEqual((few.exact, few.operands, few.results), (None, None, None))
        numpy.testing.assert_array_equal(few.hit, answers.hit)
        self.assertEqual(unit.test_pairs(rays[:0], boxes[:0]).operands.shape, (0, 14))

    def test_port_bits_are_cut_to_the_width(self):
        unit = hitpipe.Unit("int_slabs", "12/12")
        operands = unit.test_pairs(*random_pairs(50)).operands
        bits = unit.port_bits(operands)
        self.assertEqual(bits.dtype.name, "uint64")
        self.assertLess(operands[:, 0].min(), 0)
        numpy.testing.assert_array_equal(bits[:, 0], operands[:, 0] & 0xFFF)


class Threads(unittest.TestCase):
    def test_share_a_unit(self):
        unit = hitpipe.Unit("int_slabs")
        pairs = [random_pairs(20_000, seed) for seed in range(4)]
        expected = [hitpipe.Unit("int_slabs").test_pairs(*each).operands for each in pairs]
        found = [None] * 4

        def test(i):
            found[i] = unit.test_pairs(*pairs[i]).operands

        threads = [threading.Thread(target=test, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for i in range(4):
            numpy.testing.assert_array_equal(found[i], expected[i])

    def test_run_while_the_library_works(self):
        unit = hitpipe.Unit("fp_plucker")
        rays, boxes = random_pairs(300_000)
        stamps, ends, most = [], threading.Event(), 0

        def stamp():
            while not ends.wait(0.001):
                stamps.append(time.monotonic())

        other = threading.Thread(target=stamp)
        other.start()
        # On a busy machine the other thread may not come to run in one call.
        for _ in range(100):
            began = time.monotonic()
            unit.test_pairs(rays, boxes)
            ended = time.monotonic()
            most = max(most, sum(began < when < ended for when in stamps))
            if most > 5:
                break
        ends.set()
        other.join()
        # While the library held the interpreter, there would be one before its work begins, and one when it ends.
        self.assertGreater(most, 5)



unittest.main()
