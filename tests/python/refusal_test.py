"""What the module refuses, by its whole line."""
import unittest

import hitpipe
import numpy

from program import random_pairs


class Refusals(unittest.TestCase):
    def setUp(self):
        self.unit = hitpipe.Unit("int_slabs")
        self.rays, self.boxes = random_pairs(10)

    def refused(self, line, call, *arguments):
        with self.assertRaises(hitpipe.Error) as caught:
            call(*arguments)
        self.assertEqual(str(caught.exception), line)
        self.assertIsInstance(caught.exception, ValueError)

    def test_shapes(self):
        test = self.unit.test_pairs
        self.refused("rays: shape is (7,); allowed is (N, 7)", test, self.rays[0], self.boxes)
        self.refused("rays: shape is (10, 6); allowed is (N, 7)", test, self.rays[:, :6], self.boxes)
        self.refused("boxes: shape is (9, 2, 3); allowed for 10 rays is (10, 2, 3)", test, self.rays, self.boxes[:9])
        self.refused("boxes: shape is (10, 6); allowed for 10 rays is (10, 2, 3)", test, self.rays, self.boxes.reshape(10, 6))
        self.refused("boxes: shape is (10, 2, 3); allowed for 10 rays is (10, 2, 2, 3)", hitpipe.Unit("int_major_pair").test_pairs,
                     self.rays, self.boxes)
        self.refused("boxes: shape is (3,); allowed for 10 rays is (10,)", test, self.rays, numpy.zeros(3, hitpipe.boxes_dtype))
        self.refused("rays: shape is (2, 5); allowed is (N,)", test, numpy.zeros((2, 5), hitpipe.rays_dtype), self.boxes)
        self.refused("boxes: shape is (9, 2, 3); allowed for 10 rays is (10, 2, 3)", hitpipe.exact, self.rays, self.boxes[:9])

    def test_types(self):
        test = self.unit.test_pairs
        self.refused("rays: dtype is float64; allowed is float32, or hitpipe.rays_dtype", test, self.rays.astype(float), self.boxes)
        self.refused("boxes: dtype is float64; allowed is float32, or hitpipe.boxes_dtype", test, self.rays, self.boxes.tolist())
        self.refused("rays: dtype is >f4; allowed is float32, or hitpipe.rays_dtype", test, self.rays.astype(">f4"), self.boxes)
        self.refused("rays: dtype is object; allowed is float32, or hitpipe.rays_dtype", test, None, self.boxes)
        self.refused("rays: no array", test, [[1, 2], [3]], self.boxes)

    def test_numbers_by_the_lines_of_c(self):
        test = self.unit.test_pairs
        bad = self.rays.copy()
        bad[7, 1] = 1.5
        self.refused("ray 7: origin.y = 1.5 is outside the cube; allowed is [-1, 1]", test, bad, self.boxes)
        self.refused("ray 7: origin.y = 1.5 is outside the cube; allowed is [-1, 1]", hitpipe.exact, bad, self.boxes)
        bad = self.boxes.copy()
        bad[9, 0, 2], bad[9, 1, 2] = 0.5, 0.25
        self.refused("box 9: min.z = 0.5 is above max.z = 0.25", test, self.rays, bad)

    def test_operands(self):
        zeros = numpy.zeros((3, 17), numpy.int64)
        self.refused("operands: shape is (3, 16); allowed is (N, 17)", self.unit.test_operands, zeros[:, :16])
        self.refused("operands: dtype is int32; allowed is int64", self.unit.test_operands, zeros.astype(numpy.int32))
        self.refused("operands: shape is (17,); allowed is (N, 17)", self.unit.port_bits, zeros[0])
        zeros[2, 0] = 1 << 40
        self.refused("test 2: operand irx is 1099511627776; allowed is -524288 to 524287", self.unit.test_operands, zeros)

    def test_designs_formats_and_libraries(self):
        line = "bits 40/24: no format of int_slabs; allowed is n/t with n in 6..32 and t in 6..2n-1, for example 20/24"
        self.refused(line, hitpipe.Unit, "int_slabs", "40/24")
        self.refused(line, hitpipe.check_format, "int_slabs", "40/24")
        self.refused(line, hitpipe.price, "int_slabs", "40/24")
        self.assertIsNone(hitpipe.check_format("int_slabs", "20/24"))
        names = ", ".join(d.name for d in hitpipe.designs())
        self.refused(f"design slabs: unknown; there are: {names}", hitpipe.Unit, "slabs")
        self.refused("design int_triangle: tests no boxes; give it operands", hitpipe.Unit("int_triangle").test_pairs, self.rays,
                     self.boxes)
        with self.assertRaisesRegex(hitpipe.Error, "^library gold: .*thesis_250nm"):
            hitpipe.price("int_slabs", library="gold")


unittest.main()
