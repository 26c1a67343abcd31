# SPDX-License-Identifier: BSD-3-Clause
"""A car on four wheels of one FMU in three dimensions (docs/fmu.md): a lane change, and a cleat at 30°.

    rondo fmu cases/wheel3d-car.toml -o wheel.fmu
    python3 examples/fmu/four_wheels.py wheel.fmu [FOLDER]

It needs numpy alone: no rondo. The body heaves, rolls, pitches, goes ahead and aside and yaws; each wheel moves up
and down on its suspension, spins, steers in front, and leans with the body. Forces of the last step move the car in
the next one. The FOLDER gets lane.csv and cleat.csv. Axes are x ahead, y to the left, z up.
"""
import concurrent.futures
import pathlib
import sys
import tempfile
import time

import numpy as np

from quarter_car import Fmu, unpack

SPEED, SETTLED = 10.0, 0.5  # m/s; s, in which the car settles on its wheels
WHEELS = ("front_left", "front_right", "rear_left", "rear_right")
AHEAD = np.array([1.3, 1.3, -1.3, -1.3])    # places of the hubs from the center of mass [m]
LEFT = np.array([0.75, -0.75, 0.75, -0.75])
STEERED = np.array([1.0, 1.0, 0.0, 0.0])
OUTPUTS = ("force_x", "force_y", "force_z", "moment_x", "moment_z", "torque", "contact_force_y", "contact_force_z",
           "contact_moment_z", "hub_height")
COLUMNS = ("time_s", "x_m", "y_m", "yaw_rad", "roll_rad", "pitch_rad", "lateral_acceleration", "steer_rad",
           *(f"{name}_{wheel}" for name in ("contact_force_y", "contact_force_z", "contact_moment_z")
             for wheel in WHEELS))


class Car:
    """The body, four hubs, and their wheels."""

    body, inertia = 1040.0, np.array([500.0, 1600.0, 1800.0])  # [kg], about x, y, z [kg m2]
    hub, spin_inertia = 20.0, 0.8                              # of a hub without its tyre [kg], [kg m2]
    stiffness, damping, travel = 3.0e4, 3.0e3, 0.085           # of a suspension [N/m], [N s/m]; its static travel [m]
    height, lean, gravity = 0.55, 0.6, 9.81                    # of the center of mass [m]; camber over roll; [m/s2]

    def __init__(self, wheels, length, threads):
        self.wheels, self.length, self.steps = wheels, length, 0
        self.threads = concurrent.futures.ThreadPoolExecutor(threads) if threads > 1 else None
        self.tyre, inertia = wheels[0].get("tyre_mass", "tyre_inertia")
        self.axle = self.spin_inertia + inertia
        self.place, self.velocity = np.zeros(3), np.array([SPEED, 0.0, 0.0])  # x, y, yaw; the car's axes [m/s], [rad/s]
        self.tilt, self.tilt_rate = np.zeros(3), np.zeros(3)  # heave [m], roll, pitch [rad]
        self.hub_rate, self.spin = np.zeros(4), np.full(4, wheels[0].get("hub_angular_velocity")[0])
        self.steer = np.zeros(4)
        self.felt = np.array([wheel.get(*OUTPUTS) for wheel in wheels])
        self.hub_start = self.felt[:, 9].copy()

    def accelerations(self, steer):
        """Of the plane motion, the tilt, the hubs and the spins, by the forces of the last step."""
        felt = self.felt
        cos, sin = np.cos(steer), np.sin(steer)
        fx, fy = cos * felt[:, 0] - sin * felt[:, 1], sin * felt[:, 0] + cos * felt[:, 1]
        whole = self.body + 4 * (self.hub + self.tyre)
        vx, vy, rate = self.velocity
        plane = np.array([fx.sum() / whole + rate * vy, fy.sum() / whole - rate * vx,
                          (AHEAD * fy - LEFT * fx + felt[:, 4]).sum() / self.inertia[2]])
        corner = self.tilt[0] + LEFT * self.tilt[1] - AHEAD * self.tilt[2]
        corner_rate = self.tilt_rate[0] + LEFT * self.tilt_rate[1] - AHEAD * self.tilt_rate[2]
        hub = felt[:, 9] - self.hub_start
        spring = (self.body * self.gravity / 4 + self.stiffness * (hub - corner)
                  + self.damping * (self.hub_rate - corner_rate))
        arm = self.height - felt[:, 9]
        tilt = np.array([spring.sum() / self.body - self.gravity,
                         (LEFT * spring + arm * fy + felt[:, 3]).sum() / self.inertia[0],
                         (-AHEAD * spring - arm * fx).sum() / self.inertia[1]])
        hubs = (felt[:, 2] - spring) / (self.hub + self.tyre) - self.gravity
        return plane, tilt, hubs, felt[:, 5] / self.axle

    def step(self, steer_angle):
        h = self.length
        steer = steer_angle * STEERED
        plane, tilt, hubs, spins = self.accelerations(self.steer)
        before = self.velocity.copy()
        self.velocity = self.velocity + h * plane
        self.tilt_rate += h * tilt
        self.hub_rate += h * hubs
        self.spin += h * spins
        self.tilt += h * self.tilt_rate
        mean = 0.5 * (before + self.velocity)
        yaw = self.place[2] + 0.5 * h * mean[2]
        self.place += h * np.array([np.cos(yaw) * mean[0] - np.sin(yaw) * mean[1],
                                    np.sin(yaw) * mean[0] + np.cos(yaw) * mean[1], mean[2]])
        vx, vy, rate = self.velocity
        ahead, aside = vx - rate * LEFT, vy + rate * AHEAD
        turned = rate + (steer - self.steer) / h
        self.steer = steer
        self.inputs = np.transpose([np.cos(steer) * ahead + np.sin(steer) * aside,
                                    np.cos(steer) * aside - np.sin(steer) * ahead, self.hub_rate, self.spin,
                                    np.full(4, -self.lean * self.tilt_rate[1]), turned])
        run = map if self.threads is None else self.threads.map
        self.felt = np.array(list(run(self.step_wheel, range(4))))
        self.steps += 1
        return [self.steps * h, *self.place, *self.tilt[1:], plane[1] + before[2] * before[0], steer_angle,
                *self.felt[:, 6], *self.felt[:, 7], *self.felt[:, 8]]

    def step_wheel(self, k):
        wheel = self.wheels[k]
        wheel.set(**dict(zip(("hub_velocity_x", "hub_velocity_y", "hub_velocity_z", "hub_angular_velocity",
                              "camber_rate", "yaw_rate"), self.inputs[k])))
        wheel.step(self.steps * self.length, self.length)
        return wheel.get(*OUTPUTS)


def lane_change(t):
    """Steering angle [rad]: one turn of a sine in 2 s."""
    late = t - SETTLED
    return np.radians(7.0) * np.sin(np.pi * late) if 0.0 < late < 2.0 else 0.0


def drive(folder, start, end, steering, threads):
    """(steps, columns) and the factor of real time. @param start: x of the car [m]"""
    wheels = [Fmu(folder, name) for name in WHEELS]
    for wheel, ahead, left in zip(wheels, AHEAD, LEFT):
        wheel.begin(hub_x_start=start + ahead, hub_y_start=left, hub_height_start=0.2965, hub_velocity_x=SPEED,
                    hub_velocity_z=0.0)
    steps = round(end / wheels[0].step_size)
    car = Car(wheels, end / steps, threads)
    begin = time.perf_counter()
    rows = np.array([car.step(steering((k + 1) * car.length)) for k in range(steps)])
    factor = end / (time.perf_counter() - begin)
    for wheel in wheels:
        wheel.free()
    return rows, factor


def report(name, rows, factor, threads):
    late = rows[rows[:, 0] > SETTLED]
    column = {c: late[:, i] for i, c in enumerate(COLUMNS)}
    loads = np.array([column[f"contact_force_z_{wheel}"] for wheel in WHEELS])
    aside = np.array([column[f"contact_force_y_{wheel}"] for wheel in WHEELS])
    print(f"{name}: y up to {column['y_m'].max():.2f} m, roll {np.degrees(column['roll_rad']).min():.2f} to "
          f"{np.degrees(column['roll_rad']).max():.2f} deg, lateral acceleration up to "
          f"{np.abs(column['lateral_acceleration']).max():.2f} m/s2, loads {loads.min():.0f} to {loads.max():.0f} N, "
          f"lateral forces {aside.min():.0f} to {aside.max():.0f} N; {factor:.2f} times real time, "
          f"threads {threads}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        unpacked = unpack(sys.argv[1], folder)
        for name, start, end, steering in (("lane", 10.0, 3.5, lane_change), ("cleat", -5.0, 1.3, lambda t: 0.0)):
            for threads in (1, 2):
                rows, factor = drive(unpacked, start, end, steering, threads)
                report(name, rows, factor, threads)
            if len(sys.argv) > 2:
                np.savetxt(pathlib.Path(sys.argv[2]) / f"{name}.csv", rows, delimiter=",", comments="",
                           header=",".join(COLUMNS))


if __name__ == "__main__":
    main()
