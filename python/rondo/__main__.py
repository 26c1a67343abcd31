# SPDX-License-Identifier: BSD-3-Clause
"""Reports, figures, films and means of what the program rondo wrote. `rondo figures` and the like start this, with a
Python that has what it needs; called by hand it takes the Python that it is called with."""
from __future__ import annotations

import argparse
import os
import pathlib
import sys
from collections.abc import Callable, Sequence
from typing import NoReturn

from rondo import interrupts, open_modes, open_paper, open_sweep, open_validation
from rondo import open as open_run
from rondo.command_help import CommandParser, output_path
from rondo.data.axes import NAMES
from rondo.data.axes_table import in_words, table_of_run, table_of_sweep, write_axes_table
from rondo.data.errors import Error, FileError, UnfinishedRunError
from rondo.data.heat import Heat
from rondo.data.names import FRAME, OLDER_FRAMES
from rondo.data.run import Run
from rondo.needs import missing

WRONG, FILES = 2, 4  # exit codes of wrong input and of files, as the program's
NO_PICTURES = ("paper", "validate", "means", "converge", "axes")  # commands that need not load what draws
ABOUT_AXES = {  # what --axes of a command does
    "axes": "Axes and signs of the table",
    "means": "Prints forces, moments and slips of a wheel in three dimensions in these axes",
    "figures": "Of a wheel in three dimensions in time: draws forces-AXES as well",
    "tyre": "Axes and signs of the curves"}
BROKEN_PIPE = 141  # as a shell has it of a program that is killed by SIGPIPE


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        from rondo.about import about
        print(about())
        parser.exit()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python3 -m rondo", description=__doc__)
    parser.add_argument("--version", action=_Version, nargs=0,
                        help="Versions and paths of the package, the library and the program")
    commands = parser.add_subparsers(dest="command", required=True, prog="rondo", parser_class=CommandParser)

    def add(name: str, meaning: str, epilog: str = "", prog: str | None = None) -> CommandParser:
        return commands.add_parser(name, help=meaning, description=meaning, epilog=epilog, prog=prog)

    paper = add(
        "paper", "Runs the study of the paper: our results against those expected",
        epilog="The same command resumes a study that was interrupted. Exit code "
               "3: a row of the table is not as expected. docs/paper.md walks through it.")
    paper.add_argument("-o", "--output", type=output_path, metavar="DIRECTORY",
                       help='Directory of the study; default "paper", or "paper-quick"')
    paper.add_argument("--quick", action="store_true", help="Coarse meshes, a third of the work")
    paper.add_argument("--jobs", "--threads", type=_count, metavar="N",
                       help="Number of runs at once, each on one core; default all cores")
    paper.add_argument("--overwrite", action="store_true", help="Repeats what is there already")
    paper.add_argument("--quiet", action="store_true", help="Prints failures and the table only")
    paper.add_argument("--study", type=pathlib.Path, metavar="FOLDER",
                       help="Directory of another study.toml; default studies/paper")

    rig = add(
        "rig", "Tests a wheel on a tyre test rig: tables, tyre.tir, a report",
        epilog="The same command goes on with a rig that was interrupted. Exit code 3: some points failed, each a row "
               "with its reason. docs/rig.md.")
    rig.add_argument("case", type=pathlib.Path, metavar="TYRE.toml", help="Case file of the wheel")
    rig.add_argument("-o", "--output", type=output_path, metavar="DIRECTORY",
                     help='Directory of the results; default the case\'s name and "-rig" in the working folder')
    rig.add_argument("--rig", type=pathlib.Path, metavar="RIG.toml",
                     help="Loads, pressures, slips, speeds of the tests; default: those that fit the case")
    rig.add_argument("--write-defaults", action="store_true",
                     help="Prints a RIG.toml with all values, those of --rig and the defaults, and runs no test")
    rig.add_argument("--tests", metavar="NAME,NAME", help="Tests that are done; default all that the wheel can do: vertical, "
                     "footprint, longitudinal, lateral, combined, rolling-resistance, relaxation, cleat, modes, road")
    rig.add_argument("--quick", action="store_true", help="A quarter of the points, and half the sectors of wheels in three dimensions")
    rig.add_argument("--dry-run", action="store_true", help="Prints tests, points, time and disk, from one state")
    rig.add_argument("--against", type=pathlib.Path, metavar="FILE",
                     help="Measurements, .tdx or .csv with channels of TYDEX, in figures and report")
    rig.add_argument("--fmu", action="store_true", help="Adds the reduced wheel as tyre.fmu")
    rig.add_argument("--jobs", "--threads", type=_count, metavar="N",
                     help="Number of runs at once, each on one core; default all cores")
    rig.add_argument("--overwrite", action="store_true", help="Goes on in a directory of another tyre or other settings")
    rig.add_argument("--quiet", action="store_true", help="Prints warnings and errors only")

    figures = add("figures", "Draws the figures of a run, a sweep, modes or a study of the paper")
    figures.add_argument("directory", type=pathlib.Path,
                         help="Directory of `rondo run`, `rondo sweep`, `rondo modes` or `rondo paper`")
    figures.add_argument("-o", "--output", type=output_path, metavar="FOLDER",
                         help="Directory for the .png and .svg files; default DIRECTORY/figures")

    report = add(
        "report", "Writes one HTML file of results that needs no network",
        epilog="The same as rondo report. Unfinished results are shown as far as they go. docs/report.md.")
    report.add_argument("directory", type=pathlib.Path,
                        help="Directory of `rondo run`, `rondo sweep`, `rondo pod` or `rondo paper`")
    report.add_argument("-o", "--output", type=output_path, metavar="FILE",
                        help="File that ends in .html; default DIRECTORY/report.html")

    film = add("animate", "Makes a film of a run")
    film.add_argument("directory", type=pathlib.Path, help="Directory of `rondo run`")
    film.add_argument("file", type=pathlib.Path, help="File that ends in .mp4 (needs ffmpeg) or .gif")
    film.add_argument("--quantity", default="displacement",
                      help="Field: displacement, velocity, displacement_y, von_mises, ...; default "
                           "%(default)s")
    film.add_argument("--deformation", type=float, default=1.0, metavar="FACTOR",
                      help="Factor on the deformation as drawn; default %(default)s")
    film.add_argument("--follow", action="store_true", default=None,
                      help="The picture moves along with the body; default: if the body goes far")
    film.add_argument("--frames", type=int, help="Number of pictures; default at most 300")
    film.add_argument("--fps", type=int, help="Number of pictures a second; default at most 30")

    wheel = add("wheel", "Draws height, speeds, slip, forces, torques and energies of a rim that forces move")
    wheel.add_argument("directory", type=pathlib.Path, help="Directory of `rondo run` of a case with [rim]")
    wheel.add_argument("-o", "--output", type=output_path, metavar="FOLDER",
                       help="Directory for wheel.png and .svg; default DIRECTORY/figures")

    footprint = add("footprint", "Draws pressure, shear, slip and sticking in the contact of steady rolling, or of "
                    "a wheel in three dimensions; friction, wear and flash temperature there",
                    epilog="Of steady rolling, and of runs with output.friction_work, it also tells and draws the "
                           "energy that friction takes around the tread, in a plane motion alone. docs/wear.md.")
    footprint.add_argument("directory", type=pathlib.Path,
                           help='Directory of `rondo run` with analysis.kind = "steady-rolling", or of a '
                                'wheel in three dimensions')
    footprint.add_argument("--time", type=float, metavar="SECONDS",
                           help="In three dimensions: takes the snapshot nearest to this time; default the "
                                "last with contact")
    footprint.add_argument("--conductivity", type=float, metavar="K",
                           help="Heat conductivity of the tread in W/(m K), for its flash temperature; with --density "
                                "and --heat-capacity")
    footprint.add_argument("--density", type=float, metavar="RHO",
                           help="Density of the tread in kg/m3, for the flash temperature")
    footprint.add_argument("--heat-capacity", type=float, metavar="C",
                           help="Heat capacity of the tread in J/(kg K), for the flash temperature")
    footprint.add_argument("--share", type=float, metavar="BETA",
                           help="Of the friction power, that goes into the tread; default 0.5: ground and tread "
                                "of one material")
    footprint.add_argument("-o", "--output", type=output_path, metavar="FOLDER",
                           help="Directory for footprint.png and .svg, wear.csv, .png and .svg, and those of "
                                "flash-temperature; default DIRECTORY/figures")

    traction = add(
        "traction", "Draws the longitudinal force of a sweep over slip: curves and carpets",
        epilog="Draws curves over slip for each other parameter that varies, the rest at its middle "
               "value; carpets over slip and a load for each value of the rest.")
    traction.add_argument("directory", type=pathlib.Path,
                          help="Directory of `rondo sweep` over motion.speed (or the angular velocity)")
    traction.add_argument("-o", "--output", type=output_path, metavar="FOLDER",
                          help="Directory for the .png and .svg files; default DIRECTORY/figures")

    tyre = add(
        "tyre", "Draws lateral force and aligning moment of a sweep over the slip angle",
        epilog="Draws curves for each other parameter that varies, the rest at its middle value. The "
               "members of further sweeps, for example steady ones, are marks beside them, with a table of "
               "two. If spin or speed varies, it draws the forces at combined slip.")
    tyre.add_argument("directory", type=pathlib.Path, nargs="+",
                      help="Directory of `rondo sweep` over motion.slip_angle")
    tyre.add_argument("-o", "--output", type=output_path, metavar="FOLDER",
                      help="Directory for the .png and .svg files; default DIRECTORY/figures of the first")

    campbell = add("campbell", "Draws the frequencies of a body over its spin")
    campbell.add_argument("directory", type=pathlib.Path, help="Directory of `rondo modes`")
    campbell.add_argument("--frame", choices=(FRAME, "fixed", *OLDER_FRAMES), default=FRAME,
                          metavar="FRAME",
                          help=f"Frame of the frequencies, by default {FRAME}: {FRAME} | fixed")
    campbell.add_argument("-o", "--output", type=output_path, metavar="FOLDER",
                          help="Directory for campbell-FRAME.png and .svg; default DIRECTORY/figures")

    sweep = add("sweep", "Draws main effects, spread, maps and curves of a sweep, as rondo figures does",
                prog="python3 -m rondo sweep")  # rondo sweep makes one
    sweep.add_argument("directory", type=pathlib.Path, help="Directory of `rondo sweep`")
    sweep.add_argument("-o", "--output", type=output_path, metavar="FOLDER",
                       help="Directory for the .png and .svg files; default DIRECTORY/figures")

    converge = add(
        "converge", "Prints how the figures of a sweep converge with its mesh or its step",
        epilog="Prints observed orders and Richardson's extrapolated value with an error bar, or that a figure does "
               "not converge monotonically. Exit code 3: a figure of --figure does not. docs/studies.md.")
    converge.add_argument("directory", type=pathlib.Path,
                          help="Directory of `rondo sweep` over disk.mesh.radial, time.step, ...: three or more levels")
    converge.add_argument("--figure", nargs="+", action="extend", default=[], metavar="NAME",
                          help="Columns of results.csv, e.g. force_y_mean; default: all")
    converge.add_argument("--by", metavar="KEY", help="Key that is refined, if several vary")

    validate = add(
        "validate", "Compares reduced runs with the full runs that they predict",
        epilog="Prints the table, and writes validation.csv, validation.json and profiles to OUTPUT. "
               "What is measured: docs/reduced.md.")
    validate.add_argument("runs", type=pathlib.Path, nargs="+", metavar="REDUCED FULL",
                          help="Results directories of `rondo run --reduced` and of the same case "
                               "without it, in turn")
    validate.add_argument("-o", "--output", type=output_path, metavar="DIRECTORY",
                          help="Directory for the tables; default REDUCED-validation, beside the first one")
    validate.add_argument("--model", type=pathlib.Path, help=argparse.SUPPRESS)  # of earlier versions

    validation = add("validation", "Draws the errors of reduced runs")
    validation.add_argument("directory", type=pathlib.Path,
                            help="Directory of `rondo validate`")
    validation.add_argument("--run", nargs="+", action="extend", default=[], metavar="NAME",
                            help="Names of the runs that are drawn; default: all")
    validation.add_argument("-o", "--output", type=output_path, metavar="FOLDER",
                            help="Directory for validation.png and .svg; default DIRECTORY/figures")

    means = add("means", "Prints the mean forces of the ground on the body")
    means.add_argument("directory", type=pathlib.Path, nargs="+", help="Directory of `rondo run`")
    for command in figures, sweep:
        command.add_argument("--figure", nargs="+", action="extend", default=[], metavar="NAME",
                             help="Of a sweep: columns of results.csv, e.g. force_y_mean; default: the usual ones")
        command.add_argument("--map", nargs=2, action="append", default=[], metavar=("X", "Y"),
                             help="Of a sweep: draws each figure over these two parameters; may be repeated")
        command.add_argument("--curves", nargs=2, action="append", default=[], metavar=("X", "BY"),
                             help="Of a sweep: draws each figure over X, a curve for each value of BY; may be repeated")
    axes = add(
        "axes", "Writes the forces of a run or a sweep in the axes of ISO 8855, TYDEX, SAE or Pacejka",
        epilog="The table history-AXES.csv, or results-AXES.csv of a sweep, has the units in its names; a .json "
               "beside it says what its axes are. Wheels in three dimensions that roll. docs/conventions.md.")
    axes.add_argument("directory", type=pathlib.Path, help="Directory of `rondo run` or `rondo sweep`")
    axes.add_argument("-o", "--output", type=output_path, metavar="FILE",
                      help="File that ends in .csv; default DIRECTORY/history-AXES.csv, of a sweep results-AXES.csv")
    axes.add_argument("--effective-radius", type=float, metavar="METRES",
                      help="Radius of the slip ratio, V/w of free rolling; default: the outer radius of the undeformed "
                           "wheel")
    for command in axes, means, figures, tyre:
        command.add_argument("--axes", required=command is axes, metavar="AXES",
                             help=f"{ABOUT_AXES[command.prog.split()[-1]]}: {' | '.join(NAMES)}")
    psd = add(
        "psd", "Draws the power spectral density of a column of history.csv, and writes it as CSV",
        epilog="Welch's method: segments that overlap by half, without their means, with Hann windows; "
               "one-sided, so that the integral is the mean square. docs/python.md, Figures.")
    psd.add_argument("directory", type=pathlib.Path, help="Directory of a dynamic `rondo run`")
    psd.add_argument("--column", default="force_y", metavar="NAME",
                     help="Column of history.csv; default %(default)s")
    psd.add_argument("--segment", type=float, metavar="SECONDS",
                     help="Length of the segments; default: eight segments")
    psd.add_argument("-o", "--output", type=output_path, metavar="FOLDER",
                     help="Directory for psd-NAME.png, .svg and .csv; default DIRECTORY/figures")
    for command in film, footprint, means, validate, psd:
        command.add_argument("--from", dest="from_time", type=float, metavar="SECONDS",
                             help="First time used")
        command.add_argument("--to", dest="to_time", type=float, metavar="SECONDS",
                             help="Last time used")
    for command in figures, film, wheel, footprint, traction, tyre, sweep, means, converge, psd, axes:
        command.add_argument("--unfinished", action="store_true",
                             help="Accepts results of a run that has not ended, was interrupted or has failed")
    return parser


def _count(text: str) -> int:
    number = int(text)
    if not 1 <= number <= 1024:
        raise argparse.ArgumentTypeError(f"{number} is not in 1 to 1024")
    return number


def _paper(options: argparse.Namespace) -> int:
    from rondo.studies.paper import command
    return command(options.output, options.quick, options.jobs, options.overwrite, options.quiet,
                   options.study)


def _rig(options: argparse.Namespace) -> int:
    from rondo.rig.command import Request, defaults_text, plan, run_rig

    tests = tuple(name.strip() for name in options.tests.split(",")) if options.tests is not None else ()
    request = Request(options.case, options.output or pathlib.Path(f"{options.case.stem}-rig"), options.rig, tests,
                      options.quick, options.jobs or 0, options.overwrite, options.quiet, options.against, options.fmu)
    if options.write_defaults or options.dry_run:
        print(defaults_text(request) if options.write_defaults else plan(request), end="")
        return 0
    return run_rig(request)


def _validate(options: argparse.Namespace) -> None:
    from rondo.studies.validate import text_of, validate

    if len(options.runs) % 2:
        raise Error("REDUCED FULL: after each reduced run the full one that it is to predict")
    if options.model:
        print("rondo: warning: --model is ignored: a reduced run needs no model now", file=sys.stderr)
    pairs = list(zip(options.runs[::2], options.runs[1::2]))
    first = options.runs[0]
    out = options.output or first.with_name(f"{first.resolve().name}-validation")
    print(text_of(validate(pairs, out, options.from_time, options.to_time)))
    print(f"validation  {out}\nfigure      rondo validation {out}")


def _folder(options: argparse.Namespace) -> pathlib.Path:
    """Where figures go."""
    first = options.directory[0] if isinstance(options.directory, list) else options.directory
    return pathlib.Path(options.output or first / "figures")


def _figures(options: argparse.Namespace) -> None:
    folder = _folder(options)
    if (options.directory / "sweep.json").is_file():
        if options.axes:
            raise Error(f"--axes: {options.directory} holds a sweep: rondo axes writes its forces in these axes, and "
                        "rondo tyre --axes draws its curves")
        return _sweep(options)
    if options.figure or options.map or options.curves:
        raise Error(f"--figure, --map and --curves: {options.directory} holds no sweep; leave them out")
    if options.axes and not (options.directory / "run.json").is_file():
        raise Error(f"--axes: {options.directory} holds no run, whose forces it draws; leave it out")
    if (options.directory / "paper.json").is_file():
        from rondo.figures import draw_paper
        written = draw_paper(open_paper(options.directory, options.unfinished), folder)
    elif (options.directory / "modes.json").is_file():
        from rondo.figures.modes_figures import draw_modes
        written = draw_modes(open_modes(options.directory), folder)
    else:
        from rondo.figures.run_figures import draw_run
        run = open_run(options.directory, options.unfinished)
        written = []
        if options.axes:  # first, as it may refuse the run
            from rondo.figures.axes_figures import draw_in_axes
            written = draw_in_axes(run, folder, options.axes)
        written += draw_run(run, folder)
    for path in written:
        print(path)


def _report(options: argparse.Namespace) -> None:
    from rondo.reports import report

    path = report(options.directory, options.output)
    print(f"{path}: {path.stat().st_size / 1e6:.1f} MB")


def _animate(options: argparse.Namespace) -> None:
    run = open_run(options.directory, options.unfinished)
    print(run.animate(options.file, quantity=options.quantity, from_time=options.from_time,
                      to_time=options.to_time, frames=options.frames, fps=options.fps,
                      follow=options.follow, deformation=options.deformation))


def _mean_forces(run: Run, from_time: float | None, to_time: float | None) -> str:
    force_x, force_y = (run.history.mean(column, from_time, to_time)
                        for column in ("force_x", "force_y"))
    if run.is_solid:
        lateral, aligning = (run.history.mean(column, from_time, to_time)
                             for column in ("force_lateral", "moment_aligning"))
        return (f"{run.directory}: force_x {force_x:.5g} N, force_y {force_y:.6g} N, force_lateral "
                f"{lateral:.5g} N, moment_aligning {aligning:.5g} N·m")
    return f"{run.directory}: force_x {force_x:.5g} N/m, force_y {force_y:.6g} N/m"


def _means_in_axes(run: Run, axes: str, from_time: float | None, to_time: float | None) -> str:
    """Of the rows in these axes, of which moments and slip ratios are no linear functions."""
    found = run.history.in_axes(axes)
    chosen, weights = run.history.weights(from_time, to_time)
    return f"{run.directory}: {in_words(found.mean(weights, chosen))}"


def _axes(options: argparse.Namespace) -> None:
    if (options.directory / "sweep.json").is_file():
        table = table_of_sweep(open_sweep(options.directory, options.unfinished), options.axes, options.effective_radius)
    else:
        table = table_of_run(open_run(options.directory, options.unfinished), options.axes, options.effective_radius)
    written = write_axes_table(table, options.output)
    print(f"{options.directory}: {table.said}")
    for path in written:
        print(path)


def _means(options: argparse.Namespace) -> None:
    for directory in options.directory:
        run = open_run(directory, options.unfinished)
        if options.axes:
            print(_means_in_axes(run, options.axes, options.from_time, options.to_time))
            continue
        print(_mean_forces(run, options.from_time, options.to_time))


def _psd(options: argparse.Namespace) -> None:
    from rondo.figures.psd_figures import draw_psd_of

    words, written = draw_psd_of(open_run(options.directory, options.unfinished), _folder(options),
                                 options.column, options.from_time, options.to_time, options.segment)
    print(words)
    for path in written:
        print(path)


def _wheel(options: argparse.Namespace) -> None:
    from rondo import style

    figure = open_run(options.directory, options.unfinished).plot_wheel()
    for path in style.save(figure, _folder(options) / "wheel"):
        print(path)


def _footprint(options: argparse.Namespace) -> None:
    from rondo import style
    from rondo.figures.friction_figures import draw_heat, draw_wear, has_wear

    run, folder = open_run(options.directory, options.unfinished), _folder(options)
    heat = _heat(options)
    wears = has_wear(run)
    if not wears and not (options.from_time is None and options.to_time is None):
        raise Error(f"{run.directory}: --from and --to: are the times between which wear is told, and the run has "
                    "no friction work: run the case again with output.friction_work = true")
    written = []
    if run.is_solid or run.is_steady or not (wears or heat):  # else no footprint is drawn of it
        written += style.save(run.plot_footprint(options.time), folder / "footprint")
    told = [draw_wear(run, folder, options.from_time, options.to_time)] if wears else []
    if heat:
        told.append(draw_heat(run, folder, heat, options.time))
    for words, files in told:
        print(words)
        written += files
    for path in written:
        print(path)


def _heat(options: argparse.Namespace) -> Heat | None:
    """Of the options that say what the tread is made of; all three of them, or none."""
    given = {"--conductivity": options.conductivity, "--density": options.density,
             "--heat-capacity": options.heat_capacity}
    missing = [name for name, value in given.items() if value is None]
    if len(missing) == len(given):
        if options.share is not None:
            raise Error("--share: is of a flash temperature, which also needs --conductivity, --density and "
                        "--heat-capacity")
        return None
    if missing:
        raise Error(f"{', '.join(missing)}: missing: a flash temperature needs --conductivity, --density and "
                    "--heat-capacity of the tread")
    return Heat(options.conductivity, options.density, options.heat_capacity,
                0.5 if options.share is None else options.share)


def _traction(options: argparse.Namespace) -> None:
    from rondo.figures.traction_figures import draw_traction

    for path in draw_traction(open_sweep(options.directory, options.unfinished), _folder(options)):
        print(path)


def _tyre(options: argparse.Namespace) -> None:
    from rondo.figures.tyre_figures import draw_tyre

    first, *more = (open_sweep(path, options.unfinished) for path in options.directory)
    for path in draw_tyre(first, _folder(options), more, options.axes):
        print(path)


def _campbell(options: argparse.Namespace) -> None:
    from rondo import style

    frame = options.frame
    if frame in OLDER_FRAMES:
        print(f"rondo: warning: --frame {frame} is called {FRAME}", file=sys.stderr)
        frame = FRAME
    figure = open_modes(options.directory).plot_campbell(frame)
    for path in style.save(figure, _folder(options) / f"campbell-{frame}"):
        print(path)


def _converge(options: argparse.Namespace) -> int:
    from rondo.studies.converge import command
    return command(open_sweep(options.directory, options.unfinished), options.figure, options.by)


def _validation(options: argparse.Namespace) -> None:
    from rondo import style

    figure = open_validation(options.directory).plot(options.run)
    for path in style.save(figure, _folder(options) / "validation"):
        print(path)


def _sweep(options: argparse.Namespace) -> None:
    from rondo.figures.sweep_figures import draw_sweep

    for path in draw_sweep(open_sweep(options.directory, options.unfinished), _folder(options),
                           options.figure, options.map, options.curves):
        print(path)


def main(arguments: Sequence[str] | None = None) -> int:
    options = _parser().parse_args(arguments)
    if options.command not in NO_PICTURES:
        if lacks := missing("matplotlib"):
            print(f"rondo: {lacks}", file=sys.stderr)
            return FILES
        import matplotlib
        matplotlib.use("Agg")
    code: int | None = 0
    commands: dict[str, Callable[[argparse.Namespace], int | None]] = {
        "paper": _paper, "rig": _rig, "figures": _figures, "animate": _animate, "report": _report, "means": _means,
        "psd": _psd, "axes": _axes,
        "wheel": _wheel, "footprint": _footprint, "traction": _traction, "tyre": _tyre,
        "campbell": _campbell, "sweep": _sweep, "converge": _converge, "validate": _validate,
        "validation": _validation}
    try:
        interrupts.while_working()
        code = commands[options.command](options)
        sys.stdout.flush()
    except KeyboardInterrupt:
        return interrupts.ended()
    except BrokenPipeError:  # the reader, as `head`, has enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # for the flush at exit
        return BROKEN_PIPE
    except UnfinishedRunError as reason:
        print(f"rondo: {reason} (here: --unfinished)", file=sys.stderr)
        return WRONG
    except FileError as reason:
        print(f"rondo: {reason}", file=sys.stderr)
        return FILES
    except Error as reason:
        print(f"rondo: {reason}", file=sys.stderr)
        return WRONG
    except OSError as reason:
        # What else writes has said so itself.
        figures = options.command in ("figures", "wheel", "footprint", "traction", "tyre", "campbell",
                                      "sweep", "validation", "psd")
        place = reason.filename or (_folder(options) if figures else "output")
        advice = "; choose another -o" if figures else ""
        print(f"rondo: {place}: {reason.strerror or reason}{advice}", file=sys.stderr)
        return WRONG
    return code or 0


if __name__ == "__main__":
    sys.exit(main())
