# SPDX-License-Identifier: BSD-3-Clause
"""Files that have no end, or are larger than the memory, are refused at once; Ctrl-C is exit code 130."""
import os
import pathlib
import resource
import signal
import subprocess
import sys
import time

import h5py
import numpy as np
import pytest

import rondo
from rondo import __main__ as command
from rondo.data import plain_files


def module(*arguments, **options):
    return subprocess.run([sys.executable, "-m", "rondo", *map(str, arguments)], capture_output=True,
                          text=True, timeout=60, **options)


def endless(path, kind):
    path.unlink()
    if kind == "device":
        path.symlink_to("/dev/zero")
    elif kind == "pipe":
        os.mkfifo(path)
    else:
        with open(path, "wb") as file:
            file.truncate(10**12)


@pytest.mark.parametrize("kind, words", [("device", "it is a device, and no regular file"),
                                         ("pipe", "it is a FIFO, and no regular file"),
                                         ("sparse", "its text would take")])
@pytest.mark.parametrize("name", ["case.toml", "history.csv", "contact.csv"])
def test_texts_without_end(copy, name, kind, words):
    endless(copy / name, kind)
    with pytest.raises(rondo.FileError) as caught:
        run = rondo.open(copy)
        if name == "contact.csv":
            run.contact.rows
        else:
            run.history
    assert str(caught.value).startswith(f"{copy / name}: ") and words in str(caught.value)


@pytest.mark.parametrize("kind, words", [("device", "damaged|no results.h5"), ("pipe", "no results.h5"),
                                         ("sparse", "may be damaged")])
def test_fields_without_end(copy, kind, words):
    endless(copy / "results.h5", kind)
    with pytest.raises(rondo.Error, match=words):
        rondo.open(copy)


def test_exit_codes_are_the_programs(copy):
    endless(copy / "history.csv", "pipe")
    done = module("means", copy)
    assert done.returncode == 4 and done.stderr.startswith(f"rondo: {copy / 'history.csv'}: "), done
    endless(copy / "case.toml", "device")
    done = module("report", copy, "-o", copy / "page.html")
    assert done.returncode == 4 and "case.toml: cannot be read: it is a device" in done.stderr, done


def test_datasets_larger_than_the_memory(copy):
    """Datasets that were never written take no room in the file, whatever size they say."""
    with h5py.File(copy / "results.h5", "r+") as file:
        snapshots = file["snapshots/displacement"]
        shape, attributes = snapshots.shape, dict(snapshots.attrs)
        del file["snapshots/displacement"]
        huge = file.create_dataset("snapshots/displacement", (shape[0], 10**13, 2), chunks=(1, 10**4, 2))
        huge.attrs.update(attributes)
    run = rondo.open(copy)
    with pytest.raises(rondo.FileError, match="this part of snapshots/displacement would take"):
        run.displacement[0]
    assert run.displacement[0, :5].shape == (5, 2)
    with h5py.File(copy / "results.h5", "r+") as file:
        del file["mesh/mass"]
        file.create_dataset("mesh/mass", (10**13,), chunks=(10**4,))
    with pytest.raises(rondo.FileError, match="/mesh/mass would take 4e.04 GB of memory"):
        rondo.open(copy)


def test_memory_that_is_available(monkeypatch):
    there = plain_files.available_memory()
    assert 10**7 < there < 10**14
    monkeypatch.setattr(resource, "getrlimit", lambda which: (10**6, 10**6))
    assert plain_files.available_memory() == 10**6


def test_an_interrupt_at_work(monkeypatch, capsys, tmp_path):
    def work(options):
        raise KeyboardInterrupt
    before = signal.getsignal(signal.SIGINT)
    try:
        monkeypatch.setattr(command, "_means", work)
        assert command.main(["means", str(tmp_path)]) == 130
        assert capsys.readouterr().err == "rondo: warning: interrupted\n"
    finally:
        signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("waited_for", ["_multiarray_umath", "h5py"])
def test_an_interrupt_while_the_package_is_loaded(waited_for, tmp_path):
    process = subprocess.Popen([sys.executable, "-m", "rondo", "means", str(tmp_path)], text=True,
                               stderr=subprocess.PIPE)
    maps = pathlib.Path(f"/proc/{process.pid}/maps")
    while process.poll() is None and waited_for not in maps.read_text():
        time.sleep(0.001)
    process.send_signal(signal.SIGINT)
    told = process.communicate(timeout=60)[1]
    assert (process.returncode, told) == (130, "rondo: warning: interrupted\n")


def test_an_interrupt_in_a_program_that_imports_the_package_stays_what_it_is():
    code = "import signal, rondo; print(signal.getsignal(signal.SIGINT) is signal.default_int_handler)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout == "True\n", done.stderr


def test_numbers_are_read_as_before(smooth):
    run = rondo.open(smooth)
    assert np.isfinite(run.history["force_y"]).all() and np.isfinite(run.displacement[-1]).all()
