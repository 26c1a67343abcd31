# SPDX-License-Identifier: BSD-3-Clause
"""What a run says of itself: did it end, does its energy balance close, what was it warned of."""
from __future__ import annotations

from typing import Any

import numpy as np

from ..data.errors import STATUS
from ..data.members import MEMBERS
from ..data.run import Run
from ..plots.curves import TERMS
from ..plots.labels import column_label, readable
from .document import note, table, tiles
from .encoding import escaped, number

BOUND = 1e-9  # at which a run stops, of energy balance and contact law (docs/theory.md, 5 and 4.5)
BOUND_FREE = 1e-2  # of the energy balance of elastic bodies that nothing holds: run.json says which it was
SCHEME_SHARE = 0.05  # above it a steady run warns
ADDS_UP = 1e-6  # over the largest term, to which the terms of the ledger are what it says
Tile = tuple[str, str, str, str]
ENERGIES = ("kinetic", "strain", "kinetic_rim", "support_energy")
POWERS = ("drive", "mass", "stiffness", "friction", "weight", "scheme")


def status_tile(status: str, message: object = None) -> Tile:
    if status == "done":
        return ("status", "done", "good", "it came to its end, and no check failed")
    meaning = STATUS.get(status, "not known to this version")
    return ("status", status, "bad" if status == "failed" else "warn", f"{meaning}"
            f"{f': {message}' if message else ''}")


def health_tiles(run: Run) -> str:
    info = run.info
    bound = info.get("energy_residual_bound", BOUND_FREE if run.mesh.free.any() else BOUND)
    found = [status_tile(run.status, info.get("message"))]
    if run.is_inflation:
        found += _equilibrium(info)
    else:
        found += _judged(info, "energy_residual_relative", "energy balance closes to", bound)
        found += _judged(info, "contact_residual_max", "law of contact met to", BOUND)
    if info.get("penetration_max_m") is not None:
        found.append(("largest penetration", f"{number(1e3 * info['penetration_max_m'])} mm", "",
                      MEMBERS["penetration_max_m"][2]))
    share = info.get("steady", {}).get("scheme_share")
    if share is not None:
        found.append(("power of the discretisation", f"{100 * share:.3g} %", "good" if share <= SCHEME_SHARE else "warn",
                      "over the largest of drive, damping and friction: rolling resistance is wrong by about that much"))
    if info.get("strain_max") is not None:
        small = info["strain_max"] <= 0.1 or "hyperelastic" in run.case.get("material", {})
        found.append(("largest strain", f"{100 * info['strain_max']:.3g} %", "good" if small else "warn",
                      "the law of the material is for small strains: rough above 10 %" if not small else
                      "at the centers of the elements"))
    found += _steps(info) + _contact(run) + _speed(info)
    return tiles(found) + _warnings(info)


def _judged(info: dict[str, Any], key: str, words: str, bound: float) -> list[Tile]:
    value = info.get(key)
    if value is None:
        return [(words, "not known", "warn", "run.json has no such figure yet: the run has not ended")]
    return [(words, number(value), "good" if value <= bound else "bad",
             f"{MEMBERS[key][2]}; a run stops above {number(bound)}")]


def _equilibrium(info: dict[str, Any]) -> list[Tile]:
    """Of an inflation; nothing where no equilibrium was found."""
    told = info.get("inflation")
    if not told:
        return [("loads reached", "not known", "warn", "run.json has no such figure: no equilibrium was found")]
    share = told["share"]
    found: list[Tile] = [("loads reached", f"{number(100 * share, 4)} %", "good" if share == 1.0 else "bad",
                          f"of pressure, spin and mounting, in {number(info.get('equilibria'))} equilibria and "
                          f"{number(told['newton_iterations'])} iterations of Newton's method")]
    found.append(("out of balance", number(told["residual"]), "", MEMBERS["inflation.residual"][2]))
    found.append(("smallest det F", number(told["det_f_min"], 4), "", "volume over undeformed volume, at the worst "
                  "point of the rubber"))
    found.append(("largest stretch", number(told["stretch_max"], 4), "", MEMBERS["inflation.stretch_max"][2]))
    return found


def _steps(info: dict[str, Any]) -> list[Tile]:
    step, critical = info.get("step"), info.get("critical_step")
    if not step:
        done = info.get("increments_done")
        return [("increments", number(done), "", "each one solved for balance and contact")] if done else []
    made = info.get("steps_done")
    done = f"{number(made)} of {number(info.get('steps'))} steps" if made is not None else \
        f"{number(info.get('steps'))} steps, of which it has not told how many are done"
    if not critical:
        return [("time step", f"{number(1e6 * step)} µs", "", done)]
    return [("time step", f"{number(1e6 * step)} µs", "good" if step <= critical else "bad",
             f"{100 * step / critical:.3g} % of the critical step, {number(1e6 * critical)} µs; {done}")]


def _contact(run: Run) -> list[Tile]:
    contact = run.info.get("contact") or {}
    found: list[Tile] = []
    if contact.get("nodes_max") is not None:
        clusters = contact.get("cluster_iterations_max") or 0
        words = f"; at most {number(clusters)} iterations for contacts that share nodes" if clusters else \
            "; each solved in closed form, without iterations"
        found.append(("nodes in contact", f"at most {number(contact['nodes_max'])}", "",
                      f"in {number(contact.get('steps_in_contact'))} steps{words}"))
    if "contact_iterations" in run.history and len(run.history["contact_iterations"]):
        found.append(("contact iterations", number(int(run.history["contact_iterations"].max())), "",
                      "most in a step"))
    for path, value in (("steady.newton_steps", run.info.get("steady", {}).get("newton_steps")),
                        ("sweeps_max", run.info.get("sweeps_max"))):
        if value:
            found.append((MEMBERS[path][2], number(value), "", ""))
    return found


def _speed(info: dict[str, Any]) -> list[Tile]:
    found: list[Tile] = []
    wall = info.get("loop_wall_s")
    if wall is not None:
        each = info.get("ns_per_dof_step")
        words = f"{each:.3g} ns for each unknown and step" if each else "steps and what they wait for output"
        if info.get("end_time"):
            words += f"; {number(wall / info['end_time'], 3)} times the time of the motion"
        found.append(("computed in", f"{number(wall, 3)} s", "", words))
    threads = info.get("threads")
    built = f"rondo {info.get('version', '?')}, {info.get('build', '?')}"
    on = f"{threads} thread{'s' if threads != 1 else ''}, {info.get('dispatch', '')}" if threads else ""
    found.append(("machine", str(info.get("host", "not said")), "", f"{on + '; ' if on else ''}{built}"))
    found.append(("size", f"{number(info.get('dofs'))} unknowns", "", f"{number(info.get('nodes'))} nodes"))
    return found


def _warnings(info: dict[str, Any]) -> str:
    told = info.get("warnings") or []
    if not told:
        return "<p>The run warned of nothing.</p>"
    items = "".join(f"<li>{escaped(text)}</li>" for text in told)
    return f'<div class="note"><b>The run warned:</b><ul>{items}</ul></div>'


def ledger(run: Run) -> str:
    """The energy balance at the last row, term by term; of an inflation, which has none, nothing."""
    if run.is_inflation:
        return ""
    if run.is_steady:
        return _powers(run)
    history = run.history
    if not len(history["time_s"]):
        return note("The ledger is in history.csv, which has no rows yet.")
    first, last = ({name: float(history[name][row]) for name in history} for row in (0, -1))
    terms = [(name, sign, words) for name, (sign, words, _) in TERMS.items() if name in last]
    if "internal_work" in last or run.is_crush and "work_rim" not in last:
        terms = [term for term in terms if term[0] != "strain"]
    energies = [name for name in ENERGIES if name in last]
    # From the first row: what is said to be left open is then checked by the table, not made by it.
    start = sum(first[name] for name in energies) - sum(sign * first[name] for name, sign, _ in terms)
    whole, done = sum(last[name] for name in energies), sum(sign * last[name] for name, sign, _ in terms)
    residual = last.get("energy_residual", np.nan)
    factor, unit = readable(max([abs(whole), *(abs(last[name]) for name, _, _ in terms)]),
                            f"J{run.per_width}")
    rows = [(column_label(name), number(factor * last[name]), name) for name in energies]
    rows.append(("energy at the start", number(factor * start), "first row"))
    rows += [(words, _signed(factor * sign * last[name]), name) for name, sign, words in terms if last[name] != 0.0]
    rows.append(("what is left open", number(factor * residual), "energy_residual"))
    when = "last increment" if run.is_crush else f"t = {1e3 * last['time_s']:.4g} ms"
    shown = table(("term", unit, "column of history.csv"), rows, f"The ledger at the end ({when})",
                  ("", "number", "code"))
    left = whole - start - done
    if not abs(left - residual) > ADDS_UP * max(abs(whole), *(abs(last[name]) for name, _, _ in terms)):
        return shown
    return shown + note(f"These terms leave {number(factor * left)} {unit}, not what energy_residual says: "
                        "something is not among them.")


def _signed(value: float) -> str:
    """Of what is added to an energy: with its sign."""
    return f"{'+' if value > 0 else ''}{number(value)}"


def _powers(run: Run) -> str:
    if "steady" not in run.info:
        return note("run.json has no powers: the run has not come to its end.")
    power = run.steady["power"]
    words = {key: MEMBERS[f"steady.power.{key}"] for key in POWERS}
    factor, unit = readable(max(abs(power[key]) for key in POWERS), f"W{run.per_width}")
    rows = [(words[key][2], number(factor * power[key]), key) for key in POWERS]
    rows.append(("What is left open, over the largest", number(power["residual"]), "residual"))
    return table(("power", unit, "key in run.json"), rows, "The balance of powers in steady rolling",
                 ("", "number", "code"))
