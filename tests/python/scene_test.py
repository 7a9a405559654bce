"""hitpipe.Scene: shapes, questions, refusals, and examples/inside.py."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import unittest

import hitpipe
import numpy

from program import SOURCE

sys.path.append(str(SOURCE / "examples"))
import inside as example


def cube(side=1.0):
    corners = numpy.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)], numpy.float32) * numpy.float32(side)
    triangles = numpy.array([[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3], [0, 4, 6],
                             [0, 6, 2], [1, 3, 7], [1, 7, 5]], numpy.uint32)
    return corners, triangles


def rays_of(*rows):
    return numpy.array(rows, numpy.float32)


THROUGH = rays_of([-1, .25, .5, 2, 0, 0, numpy.inf], [-1, 2, .5, 2, 0, 0, numpy.inf])


class Scene(unittest.TestCase):
    def test_answers_have_their_shapes_and_numbers(self):
        scene = hitpipe.Scene(*cube())
        nearest = scene.nearest(THROUGH)
        self.assertEqual(nearest.triangle.tolist(), [8, hitpipe.no_triangle])
        self.assertEqual(nearest.t.tolist(), [.5, numpy.inf])
        self.assertEqual(nearest.weights.tolist(), [[.5, .25, .25], [0, 0, 0]])
        self.assertIsNone(scene.nearest(THROUGH, weights=False).weights)
        self.assertEqual(scene.any(THROUGH).tolist(), [True, False])
        counts = scene.count(THROUGH)
        self.assertEqual((counts.crossings.tolist(), counts.sides.tolist()), ([2, 0], [0, 0]))
        every = scene.all(THROUGH)
        self.assertEqual(every.offsets.tolist(), [0, 2, 2])
        self.assertEqual((every.triangle.tolist(), every.t.tolist(), every.side.tolist()), ([8, 11], [.5, 1], [-1, 1]))
        self.assertEqual(scene.inside(numpy.array([[.5, .5, .5], [2, 0, 0]], numpy.float32)).tolist(), [True, False])
        info = scene.info
        self.assertEqual((info.world, info.triangles, info.closed, info.oriented), ("float", 12, True, True))

    def test_structures_are_rows(self):
        scene = hitpipe.Scene(*cube())
        structured = numpy.zeros(2, hitpipe.rays_dtype)
        structured["origin"], structured["direction"], structured["length"] = THROUGH[:, :3], THROUGH[:, 3:6], THROUGH[:, 6]
        self.assertEqual(scene.nearest(structured).t.tolist(), scene.nearest(THROUGH).t.tolist())

    def test_moves_and_takes_a_hierarchy(self):
        corners, triangles = cube()
        nodes = numpy.array([(1, 0), (0, 6), (6, 6)], hitpipe.nodes_dtype)
        scene = hitpipe.Scene(corners, triangles, nodes=nodes, order=numpy.arange(12, dtype=numpy.uint32))
        self.assertEqual(scene.nearest(THROUGH).t.tolist(), [.5, numpy.inf])
        scene.move(corners + numpy.float32(1))
        self.assertEqual(scene.nearest(THROUGH).t.tolist(), [numpy.inf, numpy.inf])
        with self.assertRaisesRegex(hitpipe.Error, "^corners: 7 of them; the scene has 8$"):
            scene.move(corners[:7])

    def test_serves_a_host_of_the_core(self):
        scene = hitpipe.Scene(*cube(), "20+1s20", transform={"offset": [0, 0, 0], "scale": .5})
        self.assertEqual(scene.info.transform, {"offset": [0, 0, 0], "scale": .5})
        ray = scene.integer_rays(rays_of([.5, .25, 1, 0, -4, 1, 1]))[0]
        self.assertEqual((int(ray["major"]), ray["direction"].tolist()), (1, [0, -2**20, 2**18]))
        self.assertEqual(ray["negative"].tolist(), [0, 1, 0])
        image = scene.core_image()
        self.assertEqual(len(image) % 64, 0)
        self.assertGreater(len(image), 12 * 32)

    def test_threads_share_it_while_one_moves_it(self):
        corners, triangles = cube()
        scene = hitpipe.Scene(corners, triangles)
        rays = numpy.repeat(THROUGH[:1], 20000, 0)
        seen = set()

        def ask():
            for _ in range(20):
                seen.update(numpy.unique(scene.nearest(rays, threads=2).t).tolist())

        askers = [threading.Thread(target=ask) for _ in range(3)]
        for asker in askers:
            asker.start()
        for step in range(20):
            scene.move(corners + numpy.array([step % 2, 0, 0], numpy.float32))
        for asker in askers:
            asker.join()
        self.assertLessEqual(seen, {.5, 1})

    def test_refuses(self):
        corners, triangles = cube()
        scene = hitpipe.Scene(corners, triangles)
        for call, line in (
                (lambda: hitpipe.Scene(corners.astype(float), triangles), "corners: dtype is float64; allowed is float32"),
                (lambda: hitpipe.Scene(corners, triangles.astype(int)), "triangles: dtype is int64; allowed is uint32"),
                (lambda: hitpipe.Scene(corners, triangles[:, :2]), "triangles: shape is (12, 2); allowed is (N, 3)"),
                (lambda: hitpipe.Scene(corners[:4], triangles), "triangle 2: corner 4 of 4"),
                (lambda: scene.any(THROUGH.astype(float)), "rays: dtype is float64; allowed is float32, or hitpipe.rays_dtype"),
                (lambda: scene.any(THROUGH, threads=-1), "-1 threads; allowed are 1 to 256, or 0 for one a core"),
                (lambda: hitpipe.Scene(corners, triangles[:-1]).inside(corners),
                 "the mesh is not closed: 3 of its 18 edges have an odd number of triangles")):
            with self.assertRaises(hitpipe.Error) as refused:
                call()
            self.assertEqual(str(refused.exception), line)


class Inside(unittest.TestCase):
    def run_in(self, folder, *words):
        return subprocess.run([sys.executable, str(SOURCE / "examples/inside.py"), *words], capture_output=True, text=True,
                              env=dict(os.environ), cwd=folder)

    def test_draws_a_knot_and_a_mesh_of_ones_own(self):
        with tempfile.TemporaryDirectory() as folder:
            ran = self.run_in(folder, "-", "24")
            self.assertEqual((ran.returncode, ran.stderr), (0, ""))
            self.assertTrue(pathlib.Path(folder, "out/inside.png").read_bytes().startswith(b"\x89PNG\r\n"))
            share = float(re.search(r"inside, (.*) %", ran.stdout)[1])
            # The tube's volume over that of its bounding box.
            corners, triangles = example.knot()
            a, b, c = (corners[triangles[:, k]].astype(float) for k in range(3))
            volume = numpy.einsum("ij,ij->i", a, numpy.cross(b, c)).sum() / 6
            box = numpy.prod(corners.max(0) - corners.min(0))
            self.assertAlmostEqual(share, 100 * abs(volume) / box, delta=1)

            pathlib.Path(folder, "half.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n")
            ran = self.run_in(folder, "half.obj", "8")
            self.assertEqual((ran.returncode, ran.stdout), (1, ""))
            self.assertRegex(ran.stderr, "^inside: the mesh is not closed: 3 of its 6 edges")


if __name__ == "__main__":
    unittest.main()
