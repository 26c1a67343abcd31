# SPDX-License-Identifier: BSD-3-Clause
"""fields.vtkhdf of a plane run and of a wheel in three dimensions, read by VTK's own vtkHDFReader:
each step from VTK 9.3 on, the first one with the readers before it, which know no time. Exits 77
where there is no VTK for this Python.

    RONDO=build/release/rondo python3 vtk_reads.py [--png DIRECTORY]     also draws the last step read
"""
import argparse
import pathlib
import sys
import tempfile

import h5py
import numpy as np

try:
    import vtkmodules.all as vtk
    from vtkmodules.util.numpy_support import vtk_to_numpy
except ImportError:
    print("skipped: VTK is not installed for this Python (python3-vtk9 or pip install vtk)")
    sys.exit(77)

from program import SMALL, run
from test_solid import WHEEL
from vtkhdf_layout import need, shown

TEMPORAL = (9, 3)  # first version that reads steps
KINDS = {"plane": vtk.VTK_QUAD, "wheel": vtk.VTK_HEXAHEDRON}


def version():
    return tuple(int(part) for part in vtk.vtkVersion.GetVTKVersion().split(".")[:2])


def reader_of(path):
    reader = vtk.vtkHDFReader()
    need(reader.CanReadFile(str(path)), f"VTK does not know {path}")
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    return reader


def times_of(reader):
    key = vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    info = reader.GetOutputInformation(0)
    return [info.Get(key, k) for k in range(info.Length(key))] if info.Has(key) else []


def check(out, kind):
    """Steps, points, cells, every array. Returns the number of steps read."""
    reader = reader_of(out / "fields.vtkhdf")
    with h5py.File(out / "results.h5") as file:
        fields, times, cells = file["fields"], file["frame/time"][:], len(file["mesh/vtk/types"])
        if version() >= TEMPORAL:
            need(np.array_equal(times_of(reader), times), "times")
        steps = range(len(times)) if version() >= TEMPORAL else [0]
        for k in steps:
            reader.UpdateTimeStep(times[k])
            grid = reader.GetOutputDataObject(0)
            need(np.array_equal(vtk_to_numpy(grid.GetPoints().GetData()), fields["position"][k]),
                 f"points of step {k}")
            need(grid.GetNumberOfCells() == cells and grid.GetCellType(0) == kind, "cells")
            data = grid.GetPointData()
            need(data.GetNumberOfArrays() > 8, "arrays")
            for i in range(data.GetNumberOfArrays()):
                name = data.GetArrayName(i)
                need(np.array_equal(vtk_to_numpy(data.GetArray(i)), shown(fields, name, k)), name)
    return grid, len(steps)


def refused_without_results(out):
    """An error, not zeros."""
    (out / "results.h5").rename(out / "away.h5")
    reader = reader_of(out / "fields.vtkhdf")
    vtk.vtkObject.GlobalWarningDisplayOff()
    reader.Update()
    need(reader.GetOutputDataObject(0).GetNumberOfPoints() == 0, "no points without results.h5")


def draw(grid, path):
    surface, mapper, actor = vtk.vtkDataSetSurfaceFilter(), vtk.vtkPolyDataMapper(), vtk.vtkActor()
    surface.SetInputData(grid)
    mapper.SetInputConnection(surface.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("von_mises")
    mapper.SetScalarRange(grid.GetPointData().GetArray("von_mises").GetRange())
    actor.SetMapper(mapper)
    actor.GetProperty().EdgeVisibilityOn()
    renderer, window = vtk.vtkRenderer(), vtk.vtkRenderWindow()
    renderer.AddActor(actor)
    renderer.SetBackground(1, 1, 1)
    window.SetOffScreenRendering(True)
    window.SetSize(700, 600)
    window.AddRenderer(renderer)
    window.Render()
    picture, writer = vtk.vtkWindowToImageFilter(), vtk.vtkPNGWriter()
    picture.SetInput(window)
    writer.SetFileName(str(path))
    writer.SetInputConnection(picture.GetOutputPort())
    writer.Write()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--png", type=pathlib.Path, metavar="DIRECTORY")
    png = parser.parse_args().png
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("plane", SMALL), ("wheel", WHEEL)):
            case, out = pathlib.Path(folder, f"{name}.toml"), pathlib.Path(folder, name)
            case.write_text(text)
            done = run("run", case, "-o", out, "--quiet")
            need(done.returncode == 0, done.stderr)
            grid, steps = check(out, KINDS[name])
            print(f"{name}: VTK {vtk.vtkVersion.GetVTKVersion()} reads {steps} step(s): "
                  f"{grid.GetNumberOfPoints()} points, {grid.GetNumberOfCells()} cells")
            if png:
                draw(grid, png / f"{name}.png")
            refused_without_results(out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
