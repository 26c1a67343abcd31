# SPDX-License-Identifier: BSD-3-Clause
"""Only one command at a time is at work in a directory of a study."""
from __future__ import annotations

import fcntl
import os
import pathlib
import time
from types import TracebackType

from ..data.errors import FileError


class FilesError(FileError):
    """Of files of a study: exit code 4."""


class Lock:
    """Two studies cannot be at work in one directory; the lock ends with the process."""

    def __init__(self, directory: pathlib.Path) -> None:
        self._directory = directory

    def __enter__(self) -> None:
        self._descriptor = os.open(self._directory, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
        for wait in [0.05] * 20 + [0.0]:  # a second: one that was killed may be ending
            try:
                return fcntl.flock(self._descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                time.sleep(wait)
            except OSError:  # a file system without locks
                return None
        os.close(self._descriptor)
        raise FilesError(f"{self._directory}: another rondo is at work here; wait until it ends")

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        os.close(self._descriptor)
