# SPDX-License-Identifier: BSD-3-Clause
"""The program's commands as functions: rondo.run("case.toml"). They work in this process; `fmu`,
`run` with further arguments, and sweeps of several runs at once start the program."""
from __future__ import annotations

import os
import pathlib
import signal
import subprocess
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from .data.errors import Error, NumericalError
from .data.modes import Modes, open_modes
from .data.pod import Pod, open_pod
from .data.run import Run, open_run
from .data.sweep import Sweep, open_sweep
from .native import Place, core, documented, options_in, place_of, settings_of, whole_number
from .studies.program import find_program

_SAID = "rondo: "


def _default_directory(case: pathlib.Path, ending: str = "") -> pathlib.Path:
    """As the program's: the case's name in the working folder."""
    name = f"{case.stem}{ending}"
    return pathlib.Path(name if case.suffix or ending else f"{case.name}.results")


def _finished(command: list[str]) -> tuple[int, list[str]]:
    """Exit code and what was said. An interrupt goes to the program, which ends cleanly."""
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True, errors="replace",
                          start_new_session=True) as process:
        try:
            said = process.communicate()[1]
        except BaseException:
            process.send_signal(signal.SIGINT)
            process.communicate()
            raise
    return process.returncode, said.splitlines()


def _command(arguments: list[str], directory: pathlib.Path, allowed: Sequence[int] = (0,)) -> None:
    """By the program: what it warns of is warned of here, what it refuses is an Error."""
    code, said = _finished([find_program().path, *arguments])
    for line in said:
        if line.startswith(f"{_SAID}warning: "):
            warnings.warn(line.removeprefix(f"{_SAID}warning: "), stacklevel=3)
    if code not in allowed or any(line.startswith(f"{_SAID}error: ") for line in said):
        errors = [line.removeprefix(f"{_SAID}error: ") for line in said
                  if not line.startswith(f"{_SAID}warning: ")]
        raise Error("\n".join(errors) or f"{directory}: the program ended with {code}")


def _words(settings: Mapping[str, Any] | None, options: Mapping[str, Any]) -> list[str]:
    """Settings and options as the program takes them: reduced_step=2e-4 as --reduced-step 0.0002."""
    words = [word for setting in settings_of(settings) for word in ("--set", setting)]
    for name, value in options.items():
        if value is not False:
            words += [f"--{name.replace('_', '-')}"] + [str(value)] * (value is not True)
    return words


def _directories(runs: Run | Place | Iterable[Run | Place]) -> list[pathlib.Path]:
    """Of one run or of several, opened or not."""
    several = [runs] if isinstance(runs, (Run, str, os.PathLike)) else list(runs)
    return [place_of(one.directory if isinstance(one, Run) else one) for one in several]


def _check(outcome: tuple[str, str], directory: pathlib.Path) -> None:
    status, message = outcome
    if status == "failed":
        raise NumericalError(f"{message}; the results so far are in {directory}")


@documented("run")
def run(case: Place, output: Place | None = None, settings: Mapping[str, Any] | None = None, *,
        overwrite: bool = False, resume: bool = False, threads: int | None = None,
        reduced: Place | None = None, modes: int | None = None, estimate: bool = False,
        reduced_step: float | None = None, law_residual: float | None = None,
        modes_from: Place | None = None,
        arguments: Sequence[str | os.PathLike[str]] = ()) -> Run:
    """Runs a case in this process (`rondo run`) and opens its results. `output`: results directory;
    by default the case's name in the working folder. `settings`: keys of the case, as
    {"ground.friction": 0.6}. The others are the command's options; with `arguments`, further ones
    in its words, the program is started instead. A case that is refused is an InputError, a run
    that fails a NumericalError, with what the program would say. Ctrl-C writes a checkpoint first:
    resume=True goes on from it."""
    options = options_in("run", locals())
    case = place_of(case)
    directory = place_of(output) if output is not None else _default_directory(case)
    if arguments:
        _command(["run", os.fspath(case), "-o", os.fspath(directory), "--quiet",
                  *_words(settings, options), *(os.fspath(word) for word in arguments)], directory)
        return open_run(directory)
    _check(core().run(case, settings_of(settings), directory, options), directory)
    return open_run(directory)


@documented("modes")
def modes(case: Place, output: Place | None = None, settings: Mapping[str, Any] | None = None, *,
          count: int | None = None, spins: Sequence[float] | None = None,
          sweep: str | None = None, diameters: int | None = None, standing: bool = False,
          overwrite: bool = False) -> Modes:
    """Frequencies, shapes and critical speeds of a case's body (`rondo modes`), made in this
    process and opened."""
    options = options_in("modes", locals())
    case = place_of(case)
    directory = (place_of(output) if output is not None
                 else _default_directory(case, "-modes"))
    _check(core().modes(case, settings_of(settings), directory, options), directory)
    return open_modes(directory)


@documented("pod")
def pod(runs: Run | Place | Sequence[Run | Place], output: Place | None = None, *,
        field: str | None = None, frame: str | None = None, modes: int | None = None,
        weight: str | None = None, shift: str | None = None, method: str | None = None,
        from_time: float | None = None, to_time: float | None = None,
        memory: str | None = None, reconstruct: int | None = None) -> Pod:
    """POD of the snapshots of one or several runs (`rondo pod`), made in this process and opened.
    output: by default pod/ of the run."""
    options = options_in("pod", locals())
    directory = "" if output is None else place_of(output)
    return open_pod(core().pod(_directories(runs), directory, options))


@documented("reduce")
def reduce(source: Run | Place | Sequence[Run | Place], output: Place,
           settings: Mapping[str, Any] | None = None, *, basis: str | None = None,
           modes: int | None = None, from_time: float | None = None,
           to_time: float | None = None) -> pathlib.Path:
    """The modes, matrices and tables of a reduced wheel (`rondo reduce`), made in this process into
    the file `output`, which run, solve and Simulation take as reduced=, and ReducedWheel opens.
    source: a case file, or runs for a POD. settings: keys of the case."""
    options = options_in("reduce", locals())
    file = place_of(output)
    core().reduce(_directories(source), file, settings_of(settings), options)
    return file


@documented("fmu")
def fmu(case: Place, output: Place, settings: Mapping[str, Any] | None = None, *,
        modes: int | None = None, reduced_step: float | None = None) -> pathlib.Path:
    """The wheel of a case, reduced, as an FMU (`rondo fmu`), made by the program into the file
    `output`."""
    options = options_in("fmu", locals())
    case, file = place_of(case), place_of(output)
    _command(["fmu", os.fspath(case), "-o", os.fspath(file), "--quiet",
              *_words(settings, options)], file)
    return file


@documented("sweep")
def sweep(study: Place, output: Place | None = None, settings: Mapping[str, Any] | None = None, *,
          overwrite: bool = False, resume: bool = False, jobs: int = 1) -> Sweep:
    """A parametric study (`rondo sweep`), opened. jobs = 1 makes one run after the other in this
    process; more start the program, whose runs are processes: a process with threads, as
    notebooks are, cannot be divided. Failed runs are rows without figures: see its failures."""
    options = options_in("sweep", locals())
    study = place_of(study)
    directory = place_of(output) if output is not None else _default_directory(study)
    if whole_number("sweep: jobs", jobs, 1) == 1:
        core().sweep(study, settings_of(settings), directory, options)
    else:
        _command(["sweep", os.fspath(study), "-o", os.fspath(directory), "--quiet",
                  *_words(settings, options | {"jobs": int(jobs)})], directory, (0, 3, 4))
    return open_sweep(directory)
