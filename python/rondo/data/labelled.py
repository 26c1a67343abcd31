# SPDX-License-Identifier: BSD-3-Clause
"""Fields of runs and modes of PODs as datasets of xarray, which is used where it is installed and
never required. Fields of runs stay in their file until a part of them is asked for. Run and Pod import
this module, so that it knows them by their members alone."""
from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from .arrays import LazyArray
from .errors import unknown
from .tables import installed

if TYPE_CHECKING:
    import xarray

AXES = ("x", "y", "z")
ALONG = ("normal", "tangential", "lateral")  # of contact
STRESS = ("xx", "xy", "xz", "yy", "yz", "zz")  # order of /fields/cauchy_stress
CONTACT = ("force", "traction")  # of run.contact
USUAL = ("displacement", "velocity", "force")


def _lazy(xarray: Any, array: LazyArray) -> Any:
    """An array of xarray that reads from the file what is asked of it."""
    from xarray.core import indexing

    class Stored(xarray.backends.BackendArray):  # type: ignore[misc]
        shape, dtype = array.shape, np.dtype(array.dtype)

        def __getitem__(self, key: Any) -> Any:
            # Not by explicit_indexing_adapter, which in xarray 2023.01 takes wrong places for
            # slices with a step below -1.
            if isinstance(key, indexing.VectorizedIndexer):
                rows, first = _rows(key.tuple[0])
                rest = indexing.VectorizedIndexer((first, *key.tuple[1:]))
                return indexing.NumpyIndexingAdapter(array[rows])[rest]
            return _outer(array, key.tuple)

    return indexing.LazilyIndexedArray(Stored())


def _outer(array: LazyArray, key: tuple[Any, ...]) -> Any:
    """Each axis by its own index: lists do not go together as numpy's do. All places of the lists
    behind the first one are read."""
    lists = [axis for axis, index in enumerate(key) if isinstance(index, np.ndarray)][1:]
    read = array[tuple(slice(None) if axis in lists else index for axis, index in enumerate(key))]
    for axis in lists:
        gone = sum(isinstance(index, (int, np.integer)) for index in key[:axis])
        read = np.take(read, key[axis], axis=axis - gone)
    return read


def _rows(first: Any) -> tuple[Any, Any]:
    """The rows to be read for an index of the first axis, and the index within them."""
    if isinstance(first, slice):
        return first, slice(None)
    rows, places = np.unique(first, return_inverse=True)
    return rows, places.reshape(np.shape(first))


def _field(run: Any, name: str) -> tuple[tuple[str, ...], LazyArray]:
    """The dimensions of a field, and the field."""
    if name in CONTACT:
        if run.contact is None:
            raise unknown(run.directory, "field", name, run.field_names)
        return ("time", "contact_node", "direction"), getattr(run.contact, name)
    array = run.field(name)
    if array.ndim == 2:
        return ("time", "node"), array
    last = {_width(run): "component", 6: "stress_component"}.get(array.shape[2], "component_fixed")
    return ("time", "node", last), array


def _width(run: Any) -> int:
    return int(run.mesh.coordinates.shape[1])


def run_dataset(run: Any, names: Iterable[str] | None = None) -> xarray.Dataset:
    """What Run.to_xarray gives."""
    xarray = installed("xarray", "to_xarray()")
    there = USUAL if run.contact is not None else USUAL[:2]
    fields = {name: _field(run, name) for name in (there if names is None else names)}
    data = {name: (dims, _lazy(xarray, array), _said(array.units, array.description))
            for name, (dims, array) in fields.items()}
    wanted = {dim for dims, _ in fields.values() for dim in dims}
    coords = {name: value for name, value in _coordinates(run).items()
              if name in wanted or set(value[0]) <= wanted & {"time", "node", "contact_node"}}
    dataset = xarray.Dataset(data, coords)
    dataset.attrs.update(title=run.title, analysis=run.analysis, status=run.status,
                         directory=str(run.directory))
    return dataset


def _said(units: str, description: str) -> dict[str, str]:
    return {"units": units, "description": description}


def _coordinates(run: Any) -> dict[str, Any]:
    width, mesh = _width(run), run.mesh
    coords: dict[str, Any] = {
        "time": (("time",), run.times, _said(run.time_unit, "of all but velocity")),
        "time_velocity": (("time",), run.times_velocity, _said(run.time_unit, "of velocity")),
        "angle": (("time",), run.angle,
                  _said("rad", "of the co-rotating frame, counter-clockwise")),
        "node": (("node",), np.arange(mesh.n_nodes), _said("1", "number of the node")),
        "contact_node": (("contact_node",), mesh.boundary,
                         _said("1", "number of the node, of those that may touch something")),
        "component": (("component",), list(AXES[:width])),
        "component_fixed": (("component_fixed",), list(AXES)),
        "direction": (("direction",), list(ALONG[:width])),
        "stress_component": (("stress_component",), list(STRESS))}
    for k, axis in enumerate(AXES[:width]):
        coords[f"reference_{axis}"] = (("node",), mesh.coordinates[:, k],
                                       _said("m", f"{axis} of the node, not deformed"))
    return coords


def pod_dataset(pod: Any) -> xarray.Dataset:
    """What Pod.to_xarray gives."""
    xarray = installed("xarray", "to_xarray()")
    width = pod.mesh.coordinates.shape[1]
    names = ALONG[:width] if pod.field == "contact" else AXES[:width]
    modes, values = np.arange(1, pod.n_modes + 1), len(pod.singular_value)
    data = {
        "spatial": (("mode", "node", "component"), pod.spatial,
                    _said("", f"modes of {pod.field}, weight {pod.weight}")),
        "coefficients": (("snapshot", "mode"), pod.coefficients,
                         _said("", "of the spatial modes in each snapshot")),
        "singular_value": (("rank",), pod.singular_value, _said("", "falling")),
        "energy": (("rank",), pod.energy,
                   _said("1", "share of each mode in the energy of the snapshots"))}
    for _, _, said in data.values():
        if not said["units"]:
            del said["units"]  # they hang on the weight: docs/results.md
    coords = {"mode": modes, "node": pod.points, "component": list(names),
              "rank": np.arange(1, values + 1),
              "time": (("snapshot",), pod.time, {"units": pod.time_unit}),
              "run": (("snapshot",), pod.run)}
    dataset = xarray.Dataset(data, coords)
    dataset.attrs.update(field=pod.field, frame=pod.frame, weight=pod.weight, unit=pod.unit,
                         directory=str(pod.directory))
    return dataset
