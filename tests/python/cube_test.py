"""hitpipe.fit, to_cube and rounded_outward: binary64 into the cube."""
import unittest

import hitpipe
import numpy


class Cube(unittest.TestCase):
    def test_boxes_are_rounded_outward_and_rays_to_nearest(self):
        random = numpy.random.default_rng(64)
        low = random.uniform(0, 90, (2000, 3))
        boxes = numpy.stack([low, low + random.uniform(0, 10, (2000, 3))], 1)
        transform = hitpipe.fit(numpy.array([[0, 0, 0], [100, 100, 100.]]))
        moved = hitpipe.to_cube(transform, boxes)
        self.assertEqual((moved.dtype, moved.shape), (numpy.float32, (2000, 2, 3)))
        right = (boxes.astype(numpy.longdouble) - transform["offset"]) * numpy.longdouble(transform["scale"])
        self.assertTrue((moved[:, 0] <= right[:, 0]).all() and (moved[:, 1] >= right[:, 1]).all())
        close = numpy.nextafter(numpy.nextafter(moved[:, 0], numpy.float32(2)), numpy.float32(2))
        self.assertTrue((close >= right[:, 0]).all())

        rays = numpy.concatenate([low, random.uniform(-1, 1, (2000, 3)), numpy.full((2000, 1), 50.)], 1)
        in_cube = hitpipe.to_cube(transform, rays)
        self.assertEqual((in_cube.dtype, in_cube.shape), (numpy.float32, (2000, 7)))
        self.assertTrue((in_cube[:, :3] == ((low - transform["offset"]) * transform["scale"]).astype(numpy.float32)).all())
        self.assertTrue((in_cube[:, 6] == numpy.float32(50 * transform["scale"])).all())
        self.assertEqual(hitpipe.Unit("int_slabs").test_pairs(in_cube, moved).hit.shape, (2000,))

        third = numpy.full((1, 2, 3), 1 / 3)
        outward = hitpipe.rounded_outward(third)
        self.assertTrue((outward[0, 0] < third[0, 0]).all() and (outward[0, 1] > third[0, 1]).all())

    def test_refuses(self):
        boxes = numpy.zeros((3, 2, 3))
        boxes[2, 1, 1] = 1.5
        for call, line in (
                (lambda: hitpipe.rounded_outward(boxes), "box 2: max.y = 1.5 is outside the cube; allowed is [-1, 1]"),
                (lambda: hitpipe.rounded_outward(boxes.astype(numpy.float32)), "boxes: dtype is float32; allowed is float64"),
                (lambda: hitpipe.rounded_outward(boxes[0]), "boxes: shape is (2, 3); allowed is (N, 2, 3)"),
                (lambda: hitpipe.to_cube({"scale": 1.0}, boxes),
                 "transform: a dict of offset, three numbers, and scale is needed, as hitpipe.fit() gives it"),
                (lambda: hitpipe.to_cube({"offset": [0, 0, 0], "scale": 1.0}, numpy.zeros((2, 7))),
                 "ray 0: direction is (0, 0, 0); one component must differ from 0"),
                (lambda: hitpipe.fit(numpy.zeros((3, 3))), "bounds: 3 rows; allowed is (2, 3)")):
            with self.assertRaises(hitpipe.Error) as refused:
                call()
            self.assertEqual(str(refused.exception), line)


if __name__ == "__main__":
    unittest.main()
