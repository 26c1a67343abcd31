# SPDX-License-Identifier: BSD-3-Clause
"""Reads fields.xdmf of a results directory as a user of ParaView does, and says what is there.

    pvpython read_fields.py RESULTS [--reader XDMFReader] [--png last.png] [--times N] [--stress]

Prints the number of times, the bounds at the first and last time, and the name, number of
components and range of each array at the last one. Exits with 1 and a reason on stderr where
something is missing or wrong: no times, no moving mesh, arrays or datasets that are not there or
not finite. --png renders the last time coloured by von_mises (else by displacement); it needs a
display, e.g. `xvfb-run -a pvpython ...`.
"""
import argparse
import math
import os
import sys

from paraview import simple

READERS = {
    "XDMFReader": lambda file: simple.XDMFReader(FileNames=[file]),
    "Xdmf3ReaderT": lambda file: simple.Xdmf3ReaderT(FileName=[file]),
    "Xdmf3ReaderS": lambda file: simple.Xdmf3ReaderS(FileName=[file]),
}
TENSOR = ("cauchy_stress", "von_mises", "stress_xx", "stress_xy", "stress_yy", "stress_zz")


def fail(reason):
    sys.stdout.flush()
    print("read_fields: " + reason, file=sys.stderr)
    sys.exit(1)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", help="results directory")
    parser.add_argument("--reader", choices=sorted(READERS), default="XDMFReader")
    parser.add_argument("--png", help="render the last time to this file")
    parser.add_argument("--times", type=int, help="number of times that must be there")
    parser.add_argument("--stress", action="store_true", help="stress must be there")
    return parser.parse_args()


def open_fields(file, name):
    if not os.path.isfile(file):
        fail("no file " + file)
    reader = READERS[name](file)
    reader.UpdatePipelineInformation()
    times = reader.TimestepValues
    times = list(times) if hasattr(times, "__len__") else [times]
    if not times:
        fail("no times in " + file)
    if sorted(times) != times or len(set(times)) != len(times):
        fail("times do not increase: {}".format(times))
    return reader, times


def state(reader, time):
    """Bounds, numbers of points and cells, and {array: (components, ranges)} at a time."""
    reader.UpdatePipeline(time)
    info = reader.GetDataInformation()
    arrays = {}
    for array in reader.PointData:
        n = array.GetNumberOfComponents()
        arrays[array.Name] = (n, [array.GetRange(k) for k in range(n)])
    return info.GetBounds(), info.GetNumberOfPoints(), info.GetNumberOfCells(), arrays


def check(time, bounds, points, cells, arrays):
    if points == 0 or cells == 0:
        fail("no mesh at time {}: {} points, {} cells".format(time, points, cells))
    if not (bounds[0] < bounds[1] and bounds[2] < bounds[3]):
        fail("mesh without extent at time {}: {}".format(time, bounds))
    if "displacement" not in arrays:
        fail("no displacement at time {}: {}".format(time, sorted(arrays)))
    if any(name in arrays for name in TENSOR) and not all(name in arrays for name in TENSOR):
        fail("stress is incomplete at time {}: {}".format(time, sorted(arrays)))
    for name, (_, ranges) in arrays.items():
        if not all(math.isfinite(value) for pair in ranges for value in pair):
            fail("{} is not finite at time {}: {}".format(name, time, ranges))


def rounded(bounds):
    return ["{:.6g}".format(b) for b in bounds]


def describe(reader, times):
    for time in (times[0], times[-1]):
        bounds, points, cells, arrays = state(reader, time)
        check(time, bounds, points, cells, arrays)
        print("time {:.9g}: {} points, {} cells, bounds {}".format(time, points, cells,
                                                                 " ".join(rounded(bounds))))
    for name, (n, ranges) in sorted(arrays.items()):
        text = " ".join("[{:.6g}, {:.6g}]".format(*pair) for pair in ranges)
        print("{} ({}): {}".format(name, n, text))
    return arrays


def render(reader, time, arrays, file):
    view = simple.GetActiveViewOrCreate("RenderView")
    view.ViewSize = [1200, 700]
    view.ViewTime = time
    view.OrientationAxesVisibility = 0
    display = simple.Show(reader, view)
    display.SetRepresentationType("Surface With Edges")
    display.LineWidth = 0.5
    name = "von_mises" if "von_mises" in arrays else "displacement"
    simple.ColorBy(display, ("POINTS", name))
    display.RescaleTransferFunctionToDataRange(True)
    display.SetScalarBarVisibility(view, True)
    view.InteractionMode = "2D"
    simple.ResetCamera(view)
    simple.Render(view)
    simple.SaveScreenshot(file, view)
    if not os.path.isfile(file) or os.path.getsize(file) == 0:
        fail("nothing was rendered to " + file)
    print("rendered {} at time {:.9g} to {}".format(name, time, file))


def main():
    args = arguments()
    file = os.path.join(os.path.abspath(args.results), "fields.xdmf")
    reader, times = open_fields(file, args.reader)
    print("{}: {} times from {:.9g} to {:.9g}".format(args.reader, len(times), times[0], times[-1]))
    if args.times is not None and len(times) != args.times:
        fail("{} times, expected {}".format(len(times), args.times))
    arrays = describe(reader, times)
    if args.stress and "von_mises" not in arrays:
        fail("no von_mises: {}".format(sorted(arrays)))
    if args.png:
        render(reader, times[-1], arrays, args.png)


main()
