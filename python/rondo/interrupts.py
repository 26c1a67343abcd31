# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C in python3 -m rondo: exit code 130 and a line, as of the program, no traceback."""
from __future__ import annotations

import os
import signal
import sys

from .needs import started_as_program

INTERRUPTED = 130


def end_at_once(*_: object) -> None:
    """While the package is loaded there is nothing to be put in order."""
    os.write(2, b"rondo: warning: interrupted\n")
    os._exit(INTERRUPTED)


def while_loading() -> None:
    """From the first import of python3 -m rondo on; in a program that imports the package Ctrl-C stays
    what it was."""
    if started_as_program() and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, end_at_once)


def while_working() -> None:
    """From here on Ctrl-C is a KeyboardInterrupt again, so that unfinished files are removed."""
    if signal.getsignal(signal.SIGINT) is end_at_once:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def ended() -> int:
    """The exit code after a KeyboardInterrupt, of which one is enough."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    print("rondo: warning: interrupted", file=sys.stderr)
    return INTERRUPTED
