"""examples/error_against_bits.py with few rays: its picture, and its figures against what `hitpipe` prints."""
import contextlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import hitpipe
import numpy

from program import SOURCE, hitpipe_prints

sys.path.append(str(SOURCE / "examples"))
import error_against_bits as example

STARTS = {".png": b"\x89PNG\r\n", ".pdf": b"%PDF-"}


def run(*words, **environment):
    return subprocess.run([sys.executable, str(SOURCE / "examples/error_against_bits.py"), *words], capture_output=True, text=True,
                          env={**os.environ, **environment}, cwd=run.folder)


class Example(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        run.folder = folder.name

    def test_draws_and_prints(self):
        for name in ("error.png", "new/folder/error.pdf"):
            ran = run("2000", name)
            self.assertEqual((ran.returncode, ran.stderr), (0, ""))
            picture = pathlib.Path(run.folder, name).read_bytes()
            self.assertTrue(picture.startswith(STARTS[pathlib.Path(name).suffix]))
            self.assertGreater(len(picture), 5000)
            lines = ran.stdout.splitlines()
            self.assertEqual(len(lines), 2 + sum(map(len, example.FORMATS.values())))
            self.assertRegex(lines[-1], rf"^{name}: 2000 rays, [0-9.]+ s$")

    def test_picture_has_a_place_of_its_own(self):
        self.assertEqual(run("10").returncode, 0)
        self.assertTrue(pathlib.Path(run.folder, "out/error_against_bits.png").is_file())

    def test_figures_are_those_of_the_program(self):
        rays, boxes = example.random_pairs(2000)
        places = pathlib.Path(run.folder)
        for name, columns, table in (("rays", "ox,oy,oz,dx,dy,dz,length", rays),
                                     ("boxes", "min_x,min_y,min_z,max_x,max_y,max_z", boxes.reshape(2000, 6))):
            lines = [columns] + [",".join("inf" if x == numpy.inf else float(x).hex() for x in row) for row in table]
            (places / f"{name}.csv").write_text("\n".join(lines) + "\n")
        printed = {tuple(line.split()[:2]): line.split()[2:] for line in run("2000").stdout.splitlines()[1:-1]}
        errors = []
        for design, bits in (("int_slabs", "12/12"), ("int_slabs", "16/16"), ("int_major", "12+1/9")):
            rows = [json.loads(line) for line in hitpipe_prints(
                "operands", design, "--bits", bits, "--rays", str(places / "rays.csv"), "--boxes", str(places / "boxes.csv"), "--as", "json",
                "--out", "-").splitlines()[1:]]
            false_hits = sum(row["hit"] and not row["exact_hit"] for row in rows)
            misses = sum(not row["exact_hit"] for row in rows)
            area, = json.loads(hitpipe_prints("area", design, "--bits", bits, "--format", "json"))
            self.assertEqual(printed[design, bits], [str(false_hits), f"{100 * false_hits / misses:.3f}", f'{area["area_mm2"]:.4f}'])
            errors.append(false_hits)
        self.assertTrue(errors[0] > errors[1] > 0)

    def test_sees_a_false_miss(self):
        rays, boxes = example.random_pairs(2000)
        self.assertEqual(example.measure("int_major", "12+1/9", rays, boxes)["false_misses"], 0)

        class Deaf(hitpipe.Unit):
            def test_pairs(self, *arguments, **options):
                answers = super().test_pairs(*arguments, **options)
                answers.hit[:] = False
                return answers

        own, example.hitpipe.Unit = hitpipe.Unit, Deaf
        self.addCleanup(setattr, example.hitpipe, "Unit", own)
        with contextlib.redirect_stdout(None), self.assertRaisesRegex(SystemExit, "^error_against_bits: [1-9][0-9]* false misses$"):
            example.main(2000, pathlib.Path(run.folder, "x.png"))

    def test_bad_input_is_one_line(self):
        usage = "error_against_bits: RAYS is a number from 1; usage: error_against_bits.py [RAYS] [PICTURE]\n"
        for words in (["0"], ["-5"], ["many"], ["5", "x.png", "y"]):
            self.assertEqual((run(*words).returncode, run(*words).stderr), (1, usage))
        self.assertEqual(run("5", "x.jp").stderr, "error_against_bits: x.jp: no picture's name; it ends in .png, .pdf or .svg\n")
        pathlib.Path(run.folder, "file").touch()
        self.assertEqual(run("5", "file/x.png").stderr.count("\n"), 1)

    def test_without_the_module_says_so(self):
        copy = pathlib.Path(run.folder, "examples/alone.py")
        copy.parent.mkdir()
        copy.write_text((SOURCE / "examples/error_against_bits.py").read_text())
        ran = subprocess.run([sys.executable, str(copy)], capture_output=True, text=True, env={**os.environ, "PYTHONPATH": ""})
        self.assertEqual(ran.returncode, 1)
        self.assertRegex(ran.stderr, r"^error_against_bits: .*, Python 3[0-9.]+: No module named 'hitpipe'; `make build` builds hitpipe "
                                     r"for /usr/bin/python3\n$")


unittest.main()
