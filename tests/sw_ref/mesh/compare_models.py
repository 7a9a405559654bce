#!/usr/bin/env python3
"""compare_models.py PROGRAM FOLDER: what `hitpipe bvh` reads of every mesh file below the folder, beside an independent reader.

A line a file: triangles with area, their area, and the bounds, of both; or why one of them refuses it. Lines that differ end
with DIFFERS. The other reader is VTK (Debian's package python3-vtk9, for the system's Python), which joins no vertices; its
polygons are cut by vtkTriangleFilter.
"""
import json
import pathlib
import subprocess
import sys

import vtk

ENDINGS = {".obj": vtk.vtkOBJReader, ".ply": vtk.vtkPLYReader, ".stl": vtk.vtkSTLReader, ".gltf": vtk.vtkGLTFReader,
           ".glb": vtk.vtkGLTFReader}


def of_hitpipe(program, file):
    made = subprocess.run([program, "bvh", "--scene", str(file), "--format", "json"], capture_output=True, text=True)
    if made.returncode not in (0, 2):
        return f"ends with {made.returncode}"
    if made.returncode == 2:
        return made.stderr.strip().split('": ', 1)[-1]
    row = json.loads(made.stdout)
    return row["triangles"], row["area"], row["min"] + row["max"]


def of_vtk(file):
    """In a process of its own, because VTK ends some by a signal."""
    made = subprocess.run([sys.executable, __file__, "--vtk", str(file)], capture_output=True, text=True)
    return json.loads(made.stdout) if made.returncode == 0 else f"VTK ends with {made.returncode}"


def read_by_vtk(file):
    vtk.vtkObject.GlobalWarningDisplayOff()
    reader = ENDINGS[file.suffix.lower()]()
    reader.SetFileName(str(file))
    reader.Update()
    data = reader.GetOutput()
    if isinstance(data, vtk.vtkMultiBlockDataSet):
        geometry = vtk.vtkCompositeDataGeometryFilter()
        geometry.SetInputData(data)
        geometry.Update()
        data = geometry.GetOutput()
    cut = vtk.vtkTriangleFilter()
    cut.SetInputData(data)
    cut.PassLinesOff()
    cut.PassVertsOff()
    cut.Update()
    mesh = cut.GetOutput()
    areas = [mesh.GetCell(i).ComputeArea() for i in range(mesh.GetNumberOfCells())]
    corners = [mesh.GetPoint(mesh.GetCell(i).GetPointId(k)) for i, area in enumerate(areas) if area > 0 for k in range(3)]
    if not corners:
        return "no triangle with area"
    return (sum(area > 0 for area in areas), sum(areas),
            [min(c[axis] for c in corners) for axis in range(3)] + [max(c[axis] for c in corners) for axis in range(3)])


def same(a, b):
    if isinstance(a, str) or isinstance(b, str):
        return isinstance(a, str) and isinstance(b, str)
    size = max(map(abs, a[2] + b[2])) or 1
    return (a[0] == b[0] and abs(a[1] - b[1]) <= 1e-4 * max(a[1], b[1])
            and all(abs(x - y) <= 1e-5 * size for x, y in zip(a[2], b[2])))


def text(found):
    return found if isinstance(found, str) else f"{found[0]} {found[1]:.6g} [{' '.join(f'{x:.5g}' for x in found[2])}]"


def main():
    if sys.argv[1] == "--vtk":
        print(json.dumps(read_by_vtk(pathlib.Path(sys.argv[2]))))
        return
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    files = sorted(file for file in folder.rglob("*") if file.is_file() and file.suffix.lower() in ENDINGS)
    different = 0
    for file in files:
        ours, others = of_hitpipe(program, file), of_vtk(file)
        differs = not same(ours, others)
        different += differs
        print(f"{file.relative_to(folder)}: {text(ours)} | {text(others)}{' DIFFERS' if differs else ''}", flush=True)
    print(f"{len(files)} files, {different} differ")


main()
