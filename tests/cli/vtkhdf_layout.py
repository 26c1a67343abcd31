# SPDX-License-Identifier: BSD-3-Clause
"""Reads a VTKHDF file by its published layout (docs.vtk.org, "VTKHDF format specification":
UnstructuredGrid, version 2, temporal), rule by rule, with h5py alone.

    python3 vtkhdf_layout.py FILE...     what is in it; an AssertionError where a rule is broken
"""
import sys

import h5py
import numpy as np

CORNERS = {5: 3, 9: 4, 12: 8}  # of triangle, quadrilateral, hexahedron
# Place of each number of a symmetric tensor, VTK's xx, yy, zz, xy, yz, xz, in xx, xy, xz, yy, yz, zz.
TENSOR = [0, 3, 5, 1, 4, 2]


def need(well, rule):
    if not well:
        raise AssertionError(rule)


def text_attribute(group, name):
    """Of fixed length, ASCII, one value."""
    attribute = h5py.h5a.open(group.id, name.encode())
    kind = attribute.get_type()
    need(kind.get_class() == h5py.h5t.STRING and not kind.is_variable_str(),
         f"{name} is a text of fixed length")
    need(kind.get_cset() == h5py.h5t.CSET_ASCII, f"{name} is ASCII")
    need(attribute.shape == (), f"{name} is one text")
    value = group.attrs[name]
    need(kind.get_size() == len(value), f"{name} has the length of its text")
    return value.decode()


def whole(dataset, shape, name, kind=np.int64):
    need(dataset.dtype == kind and dataset.shape == shape,
         f"{name}: {dataset.dtype} {dataset.shape}, not {np.dtype(kind)} {shape}")
    return dataset[:]


class Layout:
    """n nodes, e cells, t steps. counts: of points, cells, connectivity; types: (e,); cells: list of
    (corners,); times: (t,); points(k): (n, 3); arrays(k): {name: (n,) or (n, 3) or (n, 6)}."""

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            need(list(file) == ["VTKHDF"], "there is the group VTKHDF alone")
            group = file["VTKHDF"]
            version = group.attrs["Version"]
            need(version.shape == (2,) and version.dtype.kind == "i", "Version is two integers")
            need(version[0] == 2, "the major version is 2")
            need(text_attribute(group, "Type") == "UnstructuredGrid", "Type is UnstructuredGrid")
            self.n, self.e, self.c = (int(whole(group[f"NumberOf{name}"], (1,), name)[0])
                                      for name in ("Points", "Cells", "ConnectivityIds"))
            self.read_cells(group)
            self.read_steps(group["Steps"])
            self.read_arrays(group)

    def read_cells(self, group):
        connectivity = whole(group["Connectivity"], (self.c,), "Connectivity")
        offsets = whole(group["Offsets"], (self.e + 1,), "Offsets")
        self.types = whole(group["Types"], (self.e,), "Types", np.uint8)
        need(offsets[0] == 0 and offsets[-1] == self.c, "Offsets go from 0 to all corners")
        need(list(np.diff(offsets)) == [CORNERS[kind] for kind in self.types],
             "each cell has the corners of its type")
        need(connectivity.min() >= 0 and connectivity.max() < self.n, "corners are points")
        self.cells = np.split(connectivity, offsets[1:-1])

    def read_steps(self, steps):
        count = steps.attrs["NSteps"]
        need(np.shape(count) == () and count.dtype.kind == "i" and count > 0, "NSteps is an integer")
        t = self.t = int(count)
        self.times = whole(steps["Values"], (t,), "Values", np.float64)
        need(np.isfinite(self.times).all() and (np.diff(self.times) > 0).all(), "times ascend")
        parts = whole(steps["NumberOfParts"], (t,), "NumberOfParts")
        need((parts == 1).all(), "one part a step")
        need(not whole(steps["PartOffsets"], (t,), "PartOffsets").any(), "it is always the first")
        for name in ("CellOffsets", "ConnectivityIdOffsets"):
            need(not whole(steps[name], (t, 1), name).any(), f"{name}: the cells stay")
        self.offset = {None: whole(steps["PointOffsets"], (t,), "PointOffsets")}
        for name, dataset in steps["PointDataOffsets"].items():
            self.offset[name] = whole(dataset, (t,), f"PointDataOffsets/{name}")

    def read_arrays(self, group):
        self.data = {None: group["Points"][:]}
        need(self.data[None].shape[1] == 3, "points have three coordinates")
        for name, dataset in group["PointData"].items():
            need(dataset.ndim == 1 or dataset.shape[1] in (3, 6), f"{name}: scalar, vector, tensor")
            self.data[name] = dataset[:]
        need(set(self.data) == set(self.offset), "each array has its offsets")
        for name, values in self.data.items():
            need(values.dtype == np.float32, f"{name}: single precision")
            # Of a run that goes on, or was killed, there is room for the steps to come.
            need(len(values) % self.n == 0 and len(values) >= self.t * self.n,
                 f"{name}: {len(values)} values of {self.t} steps of {self.n} points")
            need((self.offset[name] + self.n <= len(values)).all(), f"{name}: steps within")

    def points(self, k):
        return self.array(None, k)

    def array(self, name, k):
        return self.data[name][self.offset[name][k]:][:self.n]

    @property
    def names(self):
        return sorted(name for name in self.data if name)


def compare(layout, results):
    """With results.h5: every step, every number; the names are those of fields.xdmf."""
    with h5py.File(results, "r") as file:
        fields, mesh = file["fields"], file["mesh"]
        times = file["frame/time"][:]
        need(np.array_equal(layout.times, times[~np.isnan(times)]), "a step for each snapshot")
        need(len(layout.data[None]) == len(times) * layout.n, "arrays as long as those of /fields")
        cells = mesh["hexahedra" if "hexahedra" in mesh else "cells"][:]
        need(all(np.array_equal(a, b[b >= 0]) for a, b in zip(layout.cells, cells)), "cells")
        need(len(cells) == layout.e and len(mesh["coordinates"]) == layout.n, "sizes")
        for k in range(layout.t):
            need(np.array_equal(layout.points(k), fields["position"][k]), f"points of step {k}")
            for name in layout.names:
                need(np.array_equal(layout.array(name, k), shown(fields, name, k)), f"{name} {k}")
    names = set(layout.names)
    text = (results.parent / "fields.xdmf").read_text()
    need(names == {part.split('"')[0] for part in text.split('<Attribute Name="')[1:]}, "names")


def shown(fields, name, k):
    """What an array of ParaView holds of snapshot k."""
    if name == "cauchy_stress":
        return fields[name][k][:, TENSOR]
    if name.startswith("stress_"):
        return fields["cauchy_stress"][k][:, ["xx", "xy", "xz", "yy", "yz", "zz"].index(name[7:])]
    return fields[name][k]


if __name__ == "__main__":
    for path in sys.argv[1:]:
        found = Layout(path)
        print(f"{path}: {found.n} points, {found.e} cells, {found.t} steps from {found.times[0]:g} to "
              f"{found.times[-1]:g}, {', '.join(found.names)}")
