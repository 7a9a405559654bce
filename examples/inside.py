#!/usr/bin/env python3
"""A mesh's inside as voxels: inside.py [MESH.obj] [SIDE] [PICTURE]

Asks of SIDE^3 points (128 unless said) whether they are inside the mesh, and draws the slice in the middle into PICTURE
(out/inside.png). Without a mesh, or for "-", it makes a knot of its own. The mesh must be closed; `hitpipe bvh` says where
one is not. Prints the time. No point is decided by a tolerance: only the mesh says what is inside."""
import pathlib
import sys
import time

checkout = pathlib.Path(__file__).resolve().parent.parent
sys.path.append(str(checkout / "build/library/python"))
try:
    import matplotlib
    import numpy

    import hitpipe
except ImportError as missing:
    sys.exit(f"inside: {sys.executable}, Python {sys.version.split()[0]}: {missing}; `make build` builds hitpipe for "
             "/usr/bin/python3")

matplotlib.use("Agg")  # draws into files, without a screen
from matplotlib import pyplot  # noqa: E402


def knot(along=600, around=40):
    """A tube along a trefoil: corners (C, 3) and triangles (T, 3)."""
    s = numpy.linspace(0, 2 * numpy.pi, along, endpoint=False)[:, None]
    middle = numpy.stack([numpy.sin(s) + 2 * numpy.sin(2 * s), numpy.cos(s) - 2 * numpy.cos(2 * s), -numpy.sin(3 * s)], -1)
    way = numpy.roll(middle, -1, 0) - numpy.roll(middle, 1, 0)
    way /= numpy.linalg.norm(way, axis=-1, keepdims=True)
    side = numpy.cross(way, [0, 0, 1.0])
    side /= numpy.linalg.norm(side, axis=-1, keepdims=True)
    angle = numpy.linspace(0, 2 * numpy.pi, around, endpoint=False)[None, :, None]
    corners = middle + 0.45 * (numpy.cos(angle) * side + numpy.sin(angle) * numpy.cross(way, side))
    i, j = numpy.meshgrid(numpy.arange(along), numpy.arange(around), indexing="ij")
    here, next_ring = i * around + j, (i + 1) % along * around + j
    here_next, both_next = i * around + (j + 1) % around, (i + 1) % along * around + (j + 1) % around
    triangles = numpy.concatenate([numpy.stack([here, next_ring, both_next], -1).reshape(-1, 3),
                                   numpy.stack([here, both_next, here_next], -1).reshape(-1, 3)])
    return corners.reshape(-1, 3).astype(numpy.float32), triangles.astype(numpy.uint32)


def obj(name):
    """Corners and triangles of an OBJ file; faces with more corners become fans."""
    corners, triangles = [], []
    for line in open(name, encoding="utf-8", errors="replace"):
        words = line.split()
        if words[:1] == ["v"]:
            corners.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            face = [int(word.split("/")[0]) for word in words[1:]]
            face = [n - 1 if n > 0 else len(corners) + n for n in face]
            triangles += [[face[0], face[k], face[k + 1]] for k in range(1, len(face) - 1)]
    return numpy.array(corners, numpy.float32), numpy.array(triangles, numpy.uint32)


def main():
    words = sys.argv[1:] + [""] * 3
    corners, triangles = obj(words[0]) if words[0] not in ("", "-") else knot()
    side = int(words[1] or 128)
    picture = pathlib.Path(words[2] or "out/inside.png")

    began = time.monotonic()
    scene = hitpipe.Scene(corners, triangles)
    made = time.monotonic()
    low, high = corners.min(0), corners.max(0)
    axes = [numpy.linspace(low[k], high[k], 2 * side + 1, dtype=numpy.float32)[1::2] for k in range(3)]
    points = numpy.stack(numpy.meshgrid(*axes, indexing="ij"), -1)
    inside = scene.inside(points.reshape(-1, 3)).reshape(side, side, side)
    asked = time.monotonic()

    picture.parent.mkdir(parents=True, exist_ok=True)
    pyplot.imsave(picture, numpy.kron(inside[:, :, side // 2].T[::-1], numpy.ones((4, 4))), cmap="cividis")
    print(f"{len(triangles)} triangles, {side}^3 points: {inside.sum()} inside, {100 * inside.mean():.2f} %")
    print(f"scene {made - began:.2f} s, points {asked - made:.2f} s; {picture}")


if __name__ == "__main__":
    try:
        main()
    except (hitpipe.Error, OSError, ValueError) as refused:
        sys.exit(f"inside: {refused}")
