# SPDX-License-Identifier: BSD-3-Clause
"""Opening the files of a directory; what is wrong with one becomes a rondo.Error that names it."""
from __future__ import annotations

import contextlib
import csv
import json
import os
import pathlib
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import h5py
import numpy as np

from .errors import Error, FileError, NewerSchemaError, NotARunError
from .plain_files import demand_plausible, demand_regular, text_of

FORMAT = 1  # of results.h5, pod.h5, paper.json, sweep.json, validation.json
SCHEMA = 1  # of case.toml
MOST_NAMED = 12  # names in a message

KINDS = {  # what is in a directory with this file, and who opens it
    "paper.json": ("a paper study", "rondo.open_paper"),
    "pod.json": ("a POD", "rondo.open_pod"),
    "run.json": ("a run", "rondo.open"),
    "modes.json": ("modes of a body", "rondo.open_modes"),
    "sweep.json": ("a sweep", "rondo.open_sweep"),
    "rig.json": ("a tyre test rig", "rondo.open_rig"),
    "validation.json": ("a validation of reduced runs", "rondo.open_validation"),
}


def read_json(path: pathlib.Path) -> dict[str, Any]:
    """The object in a JSON file."""
    try:
        found = json.loads(text_of(path))
    except (ValueError, RecursionError) as reason:
        raise Error(f"{path}: cannot be read: {reason}") from None
    if not isinstance(found, dict):
        raise Error(f"{path}: damaged: an object is expected, found {type(found).__name__}")
    return found


def some(names: Iterable[object]) -> str:
    """Names in a message; of many, the first ones."""
    texts = [str(name) for name in names]
    if len(texts) <= MOST_NAMED:
        return ", ".join(texts)
    return f"{', '.join(texts[:MOST_NAMED])}, ... ({len(texts)} in all)"


def read_case(path: pathlib.Path) -> dict[str, Any]:
    """A case file as nested dicts."""
    try:
        case = tomllib.loads(text_of(path))
    except (ValueError, RecursionError) as reason:
        raise Error(f"{path}: cannot be read: {reason}") from None
    schema = case.get("schema")
    if not isinstance(schema, int):
        raise Error(f"{path}: damaged: no schema")
    if schema > SCHEMA:
        raise NewerSchemaError(f"{path}: schema {schema}; this package reads {SCHEMA}: "
                               "install the Python package of that version of rondo")
    return case


def read_table(path: pathlib.Path) -> dict[str, np.ndarray]:
    """Columns of a CSV file of numbers: (rows,) each. The last line may be one being written, or
    one at which the program was killed: without its end of line it is left out."""
    try:
        text = text_of(path)
    except ValueError as reason:
        raise Error(f"{path}: cannot be read: {reason}") from None
    header, *lines = text[: text.rfind("\n") + 1].splitlines() or [""]
    names = header.split(",")
    if not header:
        raise Error(f"{path}: damaged: it has no header")
    if not lines:
        return {name: np.empty(0) for name in names}
    try:
        values = np.loadtxt(lines, delimiter=",", ndmin=2, comments=None)
    except ValueError as reason:
        raise Error(f"{path}: damaged: {reason} (row 1 is line 2)") from None
    if values.shape[1] != len(names):
        raise Error(f"{path}: damaged: {len(names)} columns are named, "
                    f"but there are {values.shape[1]}")
    return dict(zip(names, values.T.copy()))


def write_table(path: pathlib.Path, columns: Mapping[str, np.ndarray]) -> pathlib.Path:
    """A CSV file of these columns."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with open(path, "w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(columns)
            writer.writerows(zip(*(values.tolist() for values in columns.values())))
    except OSError as reason:
        raise FileError(f"{path}: cannot be written: {reason.strerror}; choose another -o") from None
    return path


def _readable(path: pathlib.Path) -> h5py.File:
    """The file, open for reading. A simulation of this process that writes it has no lock on it (that
    of the directory keeps others out), and HDF5 refuses to have one file open both ways."""
    try:
        file = h5py.File(path, "r")
    except OSError as reason:
        if "locking flag" not in str(reason):
            raise
        file = h5py.File(path, "r", locking=False)
    try:
        _look_once(path, file)
    except BaseException:
        file.close()
        raise
    return file


_seen: set[tuple[pathlib.Path, int, int]] = set()  # files that are plausible, as they were then


def _look_once(path: pathlib.Path, file: h5py.File) -> None:
    found = path.stat()
    key = (path, found.st_size, found.st_mtime_ns)
    if key not in _seen:
        demand_plausible(path, file)
        _seen.add(key)


_kept: dict[pathlib.Path, h5py.File] = {}  # files that stay open


@contextlib.contextmanager
def kept(path: pathlib.Path) -> Iterator[None]:
    """As long as the block lasts `opened` does not open this file anew each time."""
    if path in _kept:
        yield
        return
    with opened(path):  # an error where it cannot be read
        pass
    with _readable(path) as file:
        _kept[path] = file
        try:
            yield
        finally:
            del _kept[path]


@contextlib.contextmanager
def opened(path: pathlib.Path) -> Iterator[h5py.File]:
    """An HDF5 file, open for reading as long as the block lasts."""
    if path not in _kept:
        if not path.exists():
            raise Error(f"{path}: no such file")
        demand_regular(path)
    try:
        if path in _kept:
            yield _kept[path]
        else:
            with _readable(path) as file:
                yield file
    except FileError:
        raise
    except (OSError, KeyError, RuntimeError) as reason:
        raise Error(f"{path}: cannot be read, it may be damaged: {reason}") from None


def check_format(path: pathlib.Path, what: str, found: Any) -> None:
    """`found` is to be "rondo <what> N" with an N that this package reads."""
    match = re.fullmatch(rf"rondo {what} (\d+)", found) if isinstance(found, str) else None
    if match is None:
        raise Error(f'{path}: its format is {found!r}; "rondo {what} {FORMAT}" is expected')
    if int(match[1]) > FORMAT:
        raise NewerSchemaError(f'{path}: its format is "{found}"; this package reads '
                               f'"rondo {what} {FORMAT}": install the Python package of that '
                               "version of rondo")


def require(path: str | os.PathLike[str], wanted: str, beside: str | None = None) -> pathlib.Path:
    """The directory, if it has the file `wanted` (a key of KINDS) and the one beside it."""
    directory = pathlib.Path(path)
    what, opener = KINDS[wanted]
    if not directory.exists():
        raise NotARunError(f"{directory}: no such directory")
    if not directory.is_dir():
        raise NotARunError(f"{directory}: is a file; {opener} takes the directory of {what}")
    if (directory / wanted).is_file():
        if beside is None or (directory / beside).is_file():
            return directory
        raise NotARunError(f"{directory}: has {wanted}, but no {beside}: part of {what} is missing")
    for name, (other, its_opener) in KINDS.items():
        if name != wanted and (directory / name).is_file():
            raise NotARunError(f"{directory}: is {other}, not {what}; "
                               f'{its_opener}("{directory}") opens it')
    inside = sorted(found.parent.name for found in directory.glob(f"*/{wanted}"))
    hint = f"; it holds {some(inside)}" if inside else ""
    raise NotARunError(f"{directory}: is not {what}: it has no {wanted}{hint}")
