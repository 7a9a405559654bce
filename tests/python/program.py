"""The program, and random rays and boxes, for the tests of this folder."""
import os
import pathlib
import subprocess

import numpy

SOURCE = pathlib.Path(os.environ["HITPIPE_SOURCE"])


def hitpipe_prints(*words):
    run = subprocess.run([os.environ["HITPIPE"], *words], capture_output=True, text=True)
    if run.returncode:
        raise AssertionError(f"hitpipe {' '.join(words)}: {run.stderr}")
    return run.stdout


def random_pairs(count, seed=1):
    """Rays that meet about every other box; some have an end, some a direction along an axis."""
    random = numpy.random.default_rng(seed)
    half = random.uniform(0.01, 0.3, (count, 3))
    middle = random.uniform(-0.7, 0.7, (count, 3))
    boxes = numpy.stack([middle - half, middle + half], axis=1).astype(numpy.float32)
    rays = numpy.empty((count, 7), numpy.float32)
    rays[:, 0:3] = random.uniform(-1, 1, (count, 3))
    rays[:, 3:6] = middle + 2 * half * random.uniform(-1, 1, (count, 3)) - rays[:, 0:3]
    rays[::7, 4:6] = 0
    rays[:, 6] = numpy.where(random.random(count) < 0.5, random.uniform(0, 2, count), numpy.inf)
    return rays, boxes
