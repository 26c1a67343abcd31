# SPDX-License-Identifier: BSD-3-Clause
"""rondo converge: how the figures of a sweep converge with the mesh or the step."""
from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..data.errors import Error
from ..data.files import some
from ..data.refinement import Convergence, converge
from ..data.sweep import Sweep

NUMERICAL = 3  # exit code, as the program's
COUNTS = ("radial", "circumferential", "axial", "land_columns", "groove_columns", "layers", "sectors",
          "increments")  # last words of the keys that count elements or increments
SIZES = ("time.step", "time.safety")
ALIKE = 0.02  # keys that are refined together have the same ratios to this
CHECKS = ("steps", "end_time_s", "energy_residual_relative", "contact_residual_max", "penetration_max_m",
          "iterations", "residual", "modes", "solves")  # columns that are no figures of the body


def is_refined(key: str) -> bool:
    return key in SIZES or key.rpartition(".")[2] in COUNTS


def size_of(sweep: Sweep, key: str) -> np.ndarray:
    """(r,) of an element or a step, up to a factor."""
    values = sweep[key]
    if values.dtype.kind not in "if" or not (values > 0).all():
        raise Error(f"{sweep.directory}: {key}: sizes are numbers above 0")
    return np.asarray(values if key in SIZES else 1.0 / values)


def refined(sweep: Sweep, by: str | None) -> list[str]:
    """The keys that are refined together, the one that is named first."""
    varied = [key for key in sweep.parameters if len(np.unique(sweep[key])) > 1]
    if by is not None and by not in varied:
        raise Error(f"{sweep.directory}: --by {by}: is not varied; there are: {some(varied)}")
    groups = {sweep.leader_of(key) for key in ([by] if by else varied) if by or is_refined(key)}
    if len(groups) != 1:
        raise Error(f"{sweep.directory}: {'several keys are' if groups else 'no key is'} refined by "
                    f"itself ({some(varied)}): give one with --by KEY, or vary those that are refined "
                    "alike together, by keys = [...] in a [[vary]]")
    leader = groups.pop()
    keys = [key for key in varied if sweep.leader_of(key) == leader and (key == by or is_refined(key))]
    first = size_of(sweep, keys[0])
    for key in keys[1:]:
        ratio = size_of(sweep, key) / first
        if np.ptp(ratio) > ALIKE * ratio.max():
            raise Error(f"{sweep.directory}: {keys[0]} and {key} are not refined alike: sizes over each "
                        f"other are {some(f'{one:.4g}' for one in np.unique(ratio))}; refine both by the "
                        "same factors, or vary one alone")
    return keys


def groups_of(sweep: Sweep, keys: Sequence[str]) -> Iterator[tuple[str, Sweep]]:
    """The levels of each set of values of what else varies, which is named."""
    leader = sweep.leader_of(keys[0])
    others = [key for key in sweep.varied if sweep.leader_of(key) != leader]
    rows = list(zip(*(sweep[key] for key in others))) if others else [()] * len(sweep)
    for row in dict.fromkeys(rows):
        name = ", ".join(f"{key} = {value:g}" if isinstance(value, float) else f"{key} = {value}"
                         for key, value in zip(others, row))
        yield name, sweep.where(np.array([one == row for one in rows]))


def text_of(name: str, unit: str, found: Convergence) -> list[str]:
    """Lines of a figure."""
    unit = "" if unit == "1" else f" {unit}"
    lines = [f"{name}: {', '.join(f'{value:.8g}' for value in found.values)}{unit}"]
    if found.trouble:
        last = abs(found.values[-1] - found.values[-2])
        share = f", {100 * last / abs(found.values[-1]):.2g} %" if found.values[-1] else ""
        return [*lines, f"    {found.trouble}: no order and no extrapolated value; the two finest differ by "
                        f"{last:.3g}{unit}{share}"]
    orders = ", ".join("none" if np.isnan(order) else f"{order:.2f}" for order in found.orders)
    doubt = f"; the bar is wide, since {found.doubt}" if found.doubt else ""
    return [*lines, f"    order {orders}; extrapolated {found.extrapolated:.8g} ± {found.bar:.2g}{unit} "
                    f"({100 * found.relative:.2g} %){doubt}"]


def command(sweep: Sweep, figures: Sequence[str], by: str | None) -> int:
    """Prints it; 3: a figure that was asked for by its name does not converge monotonically."""
    keys = refined(sweep, by)
    names = list(figures) or [name for name in sweep.figures if name not in CHECKS]
    code = 0
    for group, levels in groups_of(sweep, keys):
        if not levels.done.all():
            raise Error(f"{sweep.directory}: not all levels have results: {some(levels['run'][~levels.done])}")
        sizes = size_of(levels, keys[0])
        order = np.argsort(-sizes)
        told = ", ".join(f"{value:g}" for value in levels[keys[0]][order])
        print(f"{group + '; ' if group else ''}{len(levels)} levels, {keys[0]} = {told}"
              + (f", with {', '.join(keys[1:])}" if keys[1:] else ""))
        for name in names:
            values = levels[name]
            if not figures and not np.isfinite(values).all():
                continue  # the analysis has no such figure
            found = converge(sizes, values)
            print("\n".join(text_of(name, levels.unit_of(name), found)))
            if figures and found.trouble and not found.trouble.startswith("the same"):
                code = NUMERICAL
    return code
