"""hitpipe.Scene: shapes, questions, refusals, signals, and examples/inside.py."""
import ctypes
import ctypes.util
import os
import pathlib
import platform
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
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


# Is interrupted in a call that takes many minutes, as each ray crosses 2,000 boxes; the same scene then answers.
INTERRUPTED = """
import hitpipe, numpy
corners = numpy.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) - .5
triangles = numpy.array([[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2],
                         [1, 3, 7], [1, 7, 5]])
boxes = numpy.arange(2000)
corners = (corners[None] * (1 + boxes[:, None, None])).reshape(-1, 3).astype(numpy.float32)
triangles = (triangles[None] + 8 * boxes[:, None, None]).reshape(-1, 3).astype(numpy.uint32)
scene = hitpipe.Scene(corners, triangles)
points = numpy.repeat(numpy.float32([[.1, .2, .3]]), 3_000_000, 0)
rays = numpy.concatenate([points, numpy.repeat(numpy.float32([[.5, .4, 1, numpy.inf]]), len(points), 0)], 1)
print("asks", flush=True)
try:
    CALL
except KeyboardInterrupt:
    print("interrupted", scene.count(rays[:1]).crossings[0], flush=True)
"""

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

    def test_moves_though_threads_ask_without_a_pause(self):
        corners, triangles = cube()
        scene = hitpipe.Scene(corners, triangles)
        rays = numpy.repeat(THROUGH[:1], 500_000, 0)
        asking, moved, calls = threading.Barrier(4), threading.Event(), [0, 0, 0]

        def ask(asker):
            asking.wait()
            while not moved.is_set() and calls[asker] < 40:
                scene.any(rays, threads=1)
                calls[asker] += 1

        askers = [threading.Thread(target=ask, args=(i,)) for i in range(3)]
        for asker in askers:
            asker.start()
        asking.wait()
        time.sleep(.1)  # until they overlap
        scene.move(corners + numpy.float32(1))
        moved.set()
        for asker in askers:
            asker.join()
        self.assertLess(max(calls), 40)
        self.assertFalse(scene.any(rays[:1])[0])

    def test_sides_of_overlapping_solids_are_winding_numbers(self):
        corners, triangles = cube(2)
        scene = hitpipe.Scene(numpy.concatenate([corners, corners + numpy.float32(1)]), numpy.concatenate([triangles, triangles + numpy.uint32(8)]))
        points = rays_of([.25, .5, .25], [1.5, 1.5, 1.5], [2.5, 2.25, 2.5], [4, 0, 0])
        rays = numpy.concatenate([points, numpy.tile(numpy.float32([1, .5, .25, numpy.inf]), (4, 1))], 1)
        self.assertEqual(scene.inside(points).tolist(), [True, False, True, False])
        self.assertEqual(scene.count(rays).sides.tolist(), [1, 2, 1, 0])

    def test_cube_contains_more_where_that_is_asked(self):
        corners, triangles = cube()
        with self.assertRaisesRegex(hitpipe.Error, r"^ray 0: its origin is \(-2\.997.* in the cube of the integer world"):
            hitpipe.Scene(corners, triangles, "20+1s20").any(THROUGH)
        scene = hitpipe.Scene(corners, triangles, "20+1s20", contains=THROUGH[:, :3])
        self.assertEqual(scene.any(THROUGH).tolist(), [True, False])
        self.assertEqual(scene.info.transform["offset"], [0, 1, .5])

    def test_does_not_depend_on_the_caller_s_rounding(self):
        libm = ctypes.CDLL(ctypes.util.find_library("m"))
        roundings = {"x86_64": (0, 0x400, 0x800, 0xc00), "aarch64": (0, 0x400000, 0x800000, 0xc00000)}.get(platform.machine(), (0,))
        random = numpy.random.default_rng(3)
        rays = numpy.concatenate([random.uniform(-1, 2, (2000, 6)), numpy.full((2000, 1), numpy.inf)], 1).astype(numpy.float32)
        corners, triangles = cube(.7)
        found = []
        for rounding in roundings:
            self.assertEqual(libm.fesetround(rounding), 0)
            try:
                scene = hitpipe.Scene(corners, triangles, "20+1s20", contains=rays[:, :3])
                found.append(b"".join(scene.nearest(rays, threads=threads).t.tobytes() for threads in (1, 3)))
                self.assertEqual(libm.fegetround(), rounding)
            finally:
                libm.fesetround(0)
        self.assertEqual(set(found), {found[0]})

    def test_refuses(self):
        corners, triangles = cube()
        scene = hitpipe.Scene(corners, triangles)
        for call, line in (
                (lambda: hitpipe.Scene(corners.astype(float), triangles), "corners: dtype is float64; allowed is float32"),
                (lambda: hitpipe.Scene(corners, triangles.astype(int)), "triangles: dtype is int64; allowed is uint32"),
                (lambda: hitpipe.Scene(corners, triangles[:, :2]), "triangles: shape is (12, 2); allowed is (N, 3)"),
                (lambda: hitpipe.Scene(corners[:4], triangles), "triangle 2: corner 4 of 4"),
                (lambda: hitpipe.Scene(corners, triangles, "20+1s20b1c3"),
                 'world 20+1s20b1c3: allowed is "float", or n+gsS or n+gsStF with n in 8..24, g in 0..3, S in 8..32 and F in 1..8, '
                 'for example "20+1s20"'),
                (lambda: hitpipe.Scene(corners, triangles, order=numpy.arange(12, dtype=numpy.uint32)),
                 "nodes and order: a hierarchy of your own has both"),
                (lambda: hitpipe.Scene(corners, triangles, nodes=numpy.array([(0, 12)], hitpipe.nodes_dtype)),
                 "nodes and order: a hierarchy of your own has both"),
                (lambda: hitpipe.Scene(corners, triangles, "20+1s20", contains=corners.astype(float)),
                 "contains: dtype is float64; allowed is float32"),
                (lambda: hitpipe.Scene(corners, triangles, contains=corners),
                 "contains: the float world has no cube; it takes rays from everywhere"),
                (lambda: hitpipe.Scene(corners, triangles, "20+1s20", contains=corners, transform={"offset": [0, 0, 0], "scale": 1}),
                 "contains: a transform is given; it alone says what the cube holds"),
                (lambda: scene.any(THROUGH.astype(float)), "rays: dtype is float64; allowed is float32, or hitpipe.rays_dtype"),
                (lambda: scene.any(THROUGH, threads=-1), "-1 threads; allowed are 1 to 256, or 0 for one a core"),
                (lambda: hitpipe.Scene(corners, triangles[:-1]).inside(corners),
                 "the mesh is not closed: 3 of its 18 edges have an odd number of triangles")):
            with self.assertRaises(hitpipe.Error) as refused:
                call()
            self.assertEqual(str(refused.exception), line)
        line = "transform: a dict of offset, three numbers, and scale is needed, as hitpipe.fit() gives it"
        for transform in ({}, [0, 0, 0, 1], 1, "offset scale", {"offset": [0, 0, 0]}, {"scale": 1}, {"offset": [0, 0], "scale": 1}, {"offset": 5, "scale": 1},
                          {"offset": ["a", 0, 0], "scale": 1}, {"offset": [0, 0, 0], "scale": "one"}, {"offset": [0, 0, 0], "scale": None},
                          {"offset": None, "scale": 1}, {"offset": [0, 0, 0, 0], "scale": 1}):
            with self.assertRaises(hitpipe.Error, msg=str(transform)) as refused:
                hitpipe.Scene(corners, triangles, "20+1s20", transform=transform)
            self.assertEqual(str(refused.exception), line)

    def test_a_signal_ends_a_call_and_not_the_scene(self):
        for call in ("scene.count(rays)", "scene.inside(points, threads=3)", "scene.all(rays, threads=1)"):
            child = subprocess.Popen([sys.executable, "-c", INTERRUPTED.replace("CALL", call)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                     text=True, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)})
            self.addCleanup(child.kill)
            self.assertEqual(child.stdout.readline(), "asks\n")
            time.sleep(.1)
            child.send_signal(signal.SIGINT)
            out, error = child.communicate(timeout=30)
            self.assertEqual((child.returncode, out, error), (0, "interrupted 2000\n", ""), call)

    def test_a_signal_s_handler_may_ask_the_same_scene(self):
        scene, unit = hitpipe.Scene(*cube()), hitpipe.Unit("int_slabs")
        rays, boxes = numpy.repeat(THROUGH, 100_000, 0) / numpy.float32(4), numpy.zeros((200_000, 2, 3), numpy.float32)
        rays[:, 6] = numpy.inf
        answers = []

        def handler(number, frame):
            answers.append(scene.any(rays[:1])[0])
            scene.move(cube()[0])
            answers.append(unit.test_pairs(rays[:1], boxes[:1]).hit[0])

        before = signal.signal(signal.SIGALRM, handler)
        signal.setitimer(signal.ITIMER_REAL, .02, .02)
        try:
            for call in (lambda: scene.nearest(rays), lambda: unit.test_pairs(rays, boxes)):
                expected, limit = len(answers) + 4, time.monotonic() + 60
                while len(answers) < expected and time.monotonic() < limit:
                    call()
                self.assertGreaterEqual(len(answers), expected)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)
        self.assertEqual(set(answers[0::2]), {True})
        self.assertEqual(scene.any(THROUGH).tolist(), [True, False])


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


class Instances(unittest.TestCase):
    def test_answer_as_one_mesh(self):
        corners, triangles = cube(0.25)
        unit = 131072 / 262143  # 2^17 units of the grid
        instances = numpy.zeros(3, hitpipe.instances_dtype)
        for i in range(3):
            instances[i] = (0, 70 + i, [0, -1, 0, i / 2 - .5, 1, 0, 0, 0, 0, 0, 1, 0], 1 << i)
        world = {"world": "20+1s20", "transform": {"offset": (0, 0, 0), "scale": unit}}
        scene = hitpipe.Scene.of_instances([(corners, triangles)], instances, **world)
        places = [corners @ matrix[:, :3].T + matrix[:, 3] for matrix in instances["matrix"].reshape(3, 3, 4)]
        flat = hitpipe.Scene(numpy.concatenate(places).astype(numpy.float32),
                             numpy.concatenate([triangles + 8 * i for i in range(3)]).astype(numpy.uint32), **world)
        rays = rays_of((-1, .1, .1, 1, 0, 0, numpy.inf), (-.6, .2, -1, 0, 0, 1, numpy.inf), (0, .9, 0, 1, .2, 0, numpy.inf))
        numpy.testing.assert_array_equal(scene.count(rays).crossings, [6, 2, 0])
        for question in "nearest", "all":
            for part in "triangle", "t":
                numpy.testing.assert_array_equal(getattr(getattr(scene, question)(rays), part),
                                                 getattr(getattr(flat, question)(rays), part))
        parts = scene.parts(scene.nearest(rays).triangle)
        self.assertEqual(parts["number"].tolist(), [70, 70, hitpipe.no_triangle])
        self.assertEqual(scene.masked(6).count(rays).crossings.tolist(), [4, 0, 0])
        with self.assertRaisesRegex(hitpipe.Error, "^instance 0: .* of the grid"):
            scene.place(0, instances["matrix"].reshape(3, 3, 4)[:1] + numpy.array([0, 0, 0, 9.]))
        scene.place(0, instances["matrix"].reshape(3, 3, 4)[2:])
        numpy.testing.assert_array_equal(scene.count(rays).crossings, [6, 0, 0])


if __name__ == "__main__":
    unittest.main()
