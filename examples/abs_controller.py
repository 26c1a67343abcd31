# SPDX-License-Identifier: BSD-3-Clause
"""An anti-lock brake: once a millisecond a controller in Python looks at the slip of a wheel and sets its brake.

    python3 examples/abs_controller.py results/abs

The wheel of cases/wheel-abs.toml carries 15 t/m, free in speed, height and spin, and is braked from 10 to 1 m/s:
by a brake that locks it, and by the controller. Coulomb's friction has no peak but a plateau, from some 11 % of slip
on: no controller stops shorter than the locked wheel, which decelerates by friction times gravity. What it keeps is
a wheel that turns, so that it can be steered (abs_corner.py), and the tread, which a locked wheel rubs off.
Writes abs.csv, abs.png and abs.svg."""
import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import rondo  # noqa: E402
from rondo import style  # noqa: E402

CASES = pathlib.Path(__file__).resolve().parents[1] / "cases"
CAR = {"rim.free": ["speed", "height", "angular_velocity"], "rim.mass": 15000.0,  # kg/m
       "rim.force_y": 0.0, "motion.gravity": 9.81,                                # its weight is the load
       "rim.support.y.damping": 7.0e5, "rim.brake": 0.0, "time.end": 2.5,
       "disk.mesh.radial": 8, "disk.mesh.circumferential": 120}


def locking(slip: float, brake: float, most: float) -> float:
    """A foot on the pedal: the brake grows to the most it can, in 0.1 s."""
    return min(brake + 0.01 * most, most)


def anti_lock(slip: float, brake: float, most: float) -> float:
    """Presses below 11 % of slip, lets go above 13 %, holds in between."""
    if slip > 0.13:
        return max(brake - 0.04 * most, 0.0)
    return min(brake + 0.01 * most, most) if slip < 0.11 else brake


def braked(simulation, controller, most: float, settled: float, slowest: float = 0.0) -> dict[str, np.ndarray]:
    """Rolls until it has settled [s], then brakes to a speed [m/s] or to the end: columns, a row each millisecond."""
    simulation.advance_to(settled)
    radius = simulation.now["speed_x"] / simulation.now["spin_rad_s"]  # of free rolling
    every, brake, rows = round(1e-3 / simulation.dt), 0.0, []
    for now in simulation.steps(every):
        rolling = now["spin_rad_s"] * radius
        rows.append({**now, "rolling": rolling, "slip": 1.0 - rolling / now["speed_x"], "brake": brake})
        if now["speed_x"] < slowest:
            break
        brake = controller(rows[-1]["slip"], brake, most)
        simulation.set({"rim.brake": brake}, over=0.5 * every * simulation.dt)
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def main(folder: pathlib.Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    table = ["brake,distance_m,deceleration_m_s2,into_brake_j_m,into_ground_j_m"]
    with style.paper():
        figure, axes = plt.subplots(1, 3, figsize=(style.PAGE, 2.2))
        for name, controller, line in (("locked", locking, style.CURVES[1]), ("anti-lock", anti_lock, style.CURVES[0])):
            with rondo.Simulation(CASES / "wheel-abs.toml", CAR) as simulation:
                h = braked(simulation, controller, most=4.0e4, settled=0.25, slowest=1.0)
            change = {column: values[-1] - values[0] for column, values in h.items()}
            table.append(f"{name},{change['center_x_m']:.3f},{-change['speed_x'] / change['time_s']:.3f},"
                         f"{change['dissipation_brake']:.0f},{change['dissipation_friction']:.0f}")
            axes[0].plot(h["time_s"], h["speed_x"], color="0.6", lw=0.6)
            for ax, values in zip(axes, (h["rolling"], 100.0 * h["slip"], 1e-3 * h["brake"])):
                ax.plot(h["time_s"], values, label=name, **line)
        for ax, label in zip(axes, ("spin times rolling radius (m/s)", "slip (%)", "brake (kN)")):
            ax.set(xlabel="time (s)", ylabel=label)
        axes[1].legend()
        style.save(figure, folder / "abs")
    (folder / "abs.csv").write_text("\n".join(table) + "\n")
    print("\n".join(table))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
