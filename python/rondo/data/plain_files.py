# SPDX-License-Identifier: BSD-3-Clause
"""Files as they are read: regular files only, and no more of them than fits into the memory."""
from __future__ import annotations

import os
import pathlib
import re
import resource
import stat

import h5py

from .errors import Error, FileError

TEXT_ROOM = 8  # bytes of memory for a byte of a text: the text, its lines, the numbers in them
SMALL = 2**24  # bytes for which nobody looks how many there are
IN_PARTS = ("snapshots", "fields", "contact")  # groups of results.h5
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([EeDd][+-]?\d+)?")  # also with the D of Fortran
_KINDS = ((stat.S_ISFIFO, "a FIFO"), (stat.S_ISCHR, "a device"), (stat.S_ISBLK, "a device"),
          (stat.S_ISSOCK, "a socket"), (stat.S_ISDIR, "a directory"))


def available_memory() -> int:
    """That this process may still take [B]: of the machine, of its control group, of its own limit."""
    found = [_number_after("MemAvailable:", pathlib.Path("/proc/meminfo"), 1024)]
    for line in _lines(pathlib.Path("/proc/self/cgroup")):
        group = pathlib.Path("/sys/fs/cgroup") / line.rpartition(":")[2].lstrip("/")
        limit, used = (_number_after("", group / f"memory.{name}") for name in ("max", "current"))
        found.append(None if limit is None else max(0, limit - (used or 0)))
    most = resource.getrlimit(resource.RLIMIT_AS)[0]
    found.append(None if most == resource.RLIM_INFINITY else most)
    return min((bytes for bytes in found if bytes is not None), default=2**63)


def _lines(path: pathlib.Path) -> list[str]:
    try:
        return path.read_text().splitlines()
    except (OSError, ValueError):
        return []


def _number_after(beginning: str, path: pathlib.Path, unit: int = 1) -> int | None:
    for line in _lines(path):
        words = line.removeprefix(beginning).split()
        if line.startswith(beginning) and words and words[0].isdigit():
            return int(words[0]) * unit
    return None


def demand_regular(path: pathlib.Path) -> int:
    """Its size [B], of a regular file: others, as pipes and devices, may have no end."""
    try:
        found = os.stat(path)
    except FileNotFoundError:
        raise Error(f"{path}: cannot be read: there is no such file") from None
    except OSError as reason:
        raise FileError(f"{path}: cannot be read: {reason.strerror or reason}") from None
    if not stat.S_ISREG(found.st_mode):
        kind = next((name for is_kind, name in _KINDS if is_kind(found.st_mode)), "of another kind")
        raise FileError(f"{path}: cannot be read: it is {kind}, and no regular file")
    return found.st_size


def demand_memory(path: pathlib.Path, what: str, size: int) -> None:
    """Before `size` bytes of memory are taken for a part of a file."""
    there = available_memory() if size > SMALL else size
    if size > there:
        raise FileError(f"{path}: {what} would take {size / 1e9:.3g} GB of memory, and "
                        f"{there / 1e9:.3g} GB are free: the file is damaged, or too large for this "
                        "machine")


def bytes_of(path: pathlib.Path) -> bytes:
    """All of a regular file that fits into the memory."""
    demand_memory(path, "its text", TEXT_ROOM * demand_regular(path))
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)  # if it is a FIFO by now
        with open(descriptor, "rb") as file:
            return file.read()
    except OSError as reason:
        raise FileError(f"{path}: cannot be read: {reason.strerror or reason}") from None


def text_of(path: pathlib.Path) -> str:
    """The same as a text. Raises ValueError: it is not UTF-8."""
    return bytes_of(path).decode("utf-8").replace("\r\n", "\n")


def foreign_lines(path: pathlib.Path, kind: str) -> list[str]:
    """Lines of a text that another program wrote, in UTF-8 or Latin-1, with the ends of lines of any system.
    @param kind: what is allowed, as "a TYDEX file". @raise FileError: it is no text"""
    raw = bytes_of(path).rstrip(b"\x1a")
    if b"\0" in raw:
        raise FileError(f"{path}: holds a byte 0: it is no text (allowed: {kind}, text in UTF-8 or Latin-1)")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")


def demand_plausible(path: pathlib.Path, file: h5py.File) -> None:
    """What is read as a whole fits into the memory: all but what snapshots have, which is read in parts."""
    def look(name: str, data: object) -> None:
        if isinstance(data, h5py.Dataset) and name.partition("/")[0] not in IN_PARTS:
            demand_memory(path, data.name, data.size * data.dtype.itemsize)
    file.visititems(look)
