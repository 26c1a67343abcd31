# SPDX-License-Identifier: BSD-3-Clause
"""A quarter car on the wheel of an FMU (docs/fmu.md): the FMU is unpacked, loaded, and led over a bump.

    rondo fmu cases/quarter-car-bump.toml -o wheel.fmu
    python3 examples/fmu/quarter_car.py wheel.fmu [car.csv [RUN/history.csv]]

It needs numpy alone: no rondo. The car is that of cases/quarter-car-bump.toml, 1 m wide. With the
history of a run of that case it tells how far off force and height are, from 0.02 s on.
"""
import ctypes
import pathlib
import sys
import tempfile
import time
import xml.etree.ElementTree
import zipfile

import numpy as np

OK, WARNING, DISCARD, ERROR = range(4)
LOGGER = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p,
                          ctypes.c_char_p, ctypes.c_char_p)
DOUBLE = ctypes.c_double


class Callbacks(ctypes.Structure):
    _fields_ = [("logger", LOGGER), ("allocate", ctypes.c_void_p), ("free", ctypes.c_void_p),
                ("step_finished", ctypes.c_void_p), ("environment", ctypes.c_void_p)]


class Fmu:
    """An instance of the FMU that is unpacked in a folder; what it logs is in `messages`."""

    def __init__(self, folder, name="wheel", guid=None):
        root = xml.etree.ElementTree.parse(folder / "modelDescription.xml").getroot()
        binary = root.find("CoSimulation").get("modelIdentifier")
        self.step_size = float(root.find("DefaultExperiment").get("stepSize"))
        self.references = {v.get("name"): int(v.get("valueReference"))
                           for v in root.find("ModelVariables")}
        self.library = ctypes.CDLL(str(folder / "binaries" / "linux64" / f"{binary}.so"))
        self.library.fmi2Instantiate.restype = ctypes.c_void_p
        self.messages = []
        self.callbacks = Callbacks(LOGGER(self._log))  # kept as long as the instance
        self.component = self.library.fmi2Instantiate(
            name.encode(), 1, (guid or root.get("guid")).encode(),
            (folder / "resources").resolve().as_uri().encode(), ctypes.byref(self.callbacks), 0, 1)
        if not self.component:
            raise RuntimeError("; ".join(self.messages))

    def _log(self, _environment, _name, _status, _category, _format, message):
        self.messages.append(message.decode())

    def call(self, function, *arguments):
        """The status of fmi2...; an error is one here, too."""
        status = getattr(self.library, "fmi2" + function)(ctypes.c_void_p(self.component), *arguments)
        if status >= DISCARD:
            raise RuntimeError(f"{function}: status {status}: {self.messages[-1:]}")
        return status

    def begin(self, **start):
        self.set(**start)
        self.call("SetupExperiment", 0, DOUBLE(0.0), DOUBLE(0.0), 0, DOUBLE(0.0))
        self.call("EnterInitializationMode")
        self.call("ExitInitializationMode")

    def _references(self, names):
        return (ctypes.c_uint * len(names))(*(self.references[name] for name in names))

    def set(self, **values):
        self.call("SetReal", self._references(values), ctypes.c_size_t(len(values)),
                  (DOUBLE * len(values))(*values.values()))

    def get(self, *names):
        values = (DOUBLE * len(names))()
        self.call("GetReal", self._references(names), ctypes.c_size_t(len(names)), values)
        return list(values)

    def step(self, time, length):
        self.call("DoStep", DOUBLE(time), DOUBLE(length), 1)

    def save(self):
        state = ctypes.c_void_p()
        self.call("GetFMUstate", ctypes.byref(state))
        return state

    def restore(self, state):
        self.call("SetFMUstate", state)

    def free_state(self, state):
        self.call("FreeFMUstate", ctypes.byref(state))

    def free(self):
        self.library.fmi2FreeInstance(ctypes.c_void_p(self.component))


def unpack(fmu, folder):
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder)
    return pathlib.Path(folder)


class QuarterCar:
    """Hub and tyre as one mass on a spring and a dashpot, pressed by a load, and its spin."""

    mass, inertia = 100.0, 1.0                         # of the hub [kg], [kg m2]
    stiffness, damping, rest = 1.0e6, 2.0e4, 0.29167   # of the suspension [N/m], [N s/m], [m]
    scale = np.array([1e5, 1e4])                       # of force_y [N] and torque [N m]
    tolerance, most_tries = 1e-5, 20                   # the FMU's own answers jump by some 1e-6

    def __init__(self, fmu, length):
        self.fmu, self.length, self.time, self.tries = fmu, length, 0.0, 0
        mass, inertia, self.height, self.velocity, self.spin = fmu.get(
            "tyre_mass", "tyre_inertia", "hub_height", "hub_velocity_y", "hub_angular_velocity")
        self.mass, self.inertia = self.mass + mass, self.inertia + inertia
        self.tyre = np.array(fmu.get("force_y", "torque")) / self.scale
        self.inverse = np.eye(2)  # what a force that was wrong by so much is to change by

    def load(self, time):
        return -1.5e5 * min(time / 0.01, 1.0)

    def hub_after(self, tyre):
        """Velocity and spin at the end of a step in which the tyre does that: the suspension is
        taken in the mean of the step, as the FMU's forces are."""
        h = self.length
        force, torque = tyre * self.scale
        force += 0.5 * (self.load(self.time) + self.load(self.time + h))
        force -= self.stiffness * (self.height + 0.25 * h * self.velocity - self.rest)
        force -= 0.5 * self.damping * self.velocity
        line = 1.0 + h / self.mass * (0.25 * h * self.stiffness + 0.5 * self.damping)
        return (self.velocity + h / self.mass * force) / line, self.spin + h / self.inertia * torque

    def try_step(self, tyre):
        velocity, spin = self.hub_after(tyre)
        self.fmu.set(hub_velocity_y=velocity, hub_angular_velocity=spin)
        self.fmu.step(self.time, self.length)
        self.tries += 1
        return np.array(self.fmu.get("force_y", "torque")) / self.scale

    def step(self):
        """The tyre's force in a step is known after it. So it is guessed, the step is tried, and the
        FMU goes back to try another guess until it is right: Broyden's method, Math. Comp. 19 (1965)
        577, whose matrix serves the next step too."""
        before = self.fmu.save()
        guess = self.tyre
        wrong = self.try_step(guess) - guess
        for _ in range(self.most_tries):
            if np.abs(wrong).max() < self.tolerance:
                break
            change = self.inverse @ wrong
            self.fmu.restore(before)
            guess = guess + change
            now = self.try_step(guess) - guess
            answer = self.inverse @ (wrong - now)
            if change @ answer != 0.0:
                self.inverse += np.outer(change - answer, change @ self.inverse) / (change @ answer)
            wrong = now
        else:
            raise RuntimeError(f"t = {self.time}: no force was found that fits its own step")
        self.fmu.free_state(before)
        self.tyre = guess
        self.velocity, self.spin = self.hub_after(guess)
        self.time += self.length
        contact_x, contact_y, self.height = self.fmu.get("contact_force_x", "contact_force_y",
                                                         "hub_height")
        return [self.time, contact_x, contact_y, self.height, self.spin]

    def drive(self, end):
        """(steps, 5) time, force of the ground along x and y, means over the step, height, spin."""
        return np.array([self.step() for _ in range(round((end - self.time) / self.length))])


class ExplicitQuarterCar(QuarterCar):
    """The tyre's force of the step before is taken for that of the next: no step is tried twice."""

    def step(self):
        guess = self.tyre
        self.tyre = self.try_step(guess)
        self.velocity, self.spin = self.hub_after(guess)
        self.time += self.length
        contact_x, contact_y, self.height = self.fmu.get("contact_force_x", "contact_force_y",
                                                         "hub_height")
        return [self.time, contact_x, contact_y, self.height, self.spin]


def differences(rows, history):
    """Largest and root-mean-square difference of the contact force, and largest of the height, over
    the rows of a run. Forces of both are means over a row of the run, which is some steps long."""
    run = np.genfromtxt(history, delimiter=",", names=True)
    steps = max(1, round((run["time_s"][1] - run["time_s"][0]) / (rows[1, 0] - rows[0, 0])))
    of_row = rows[:len(rows) // steps * steps].reshape(-1, steps, 5)
    end = of_row[:, -1]
    late = end[:, 0] > 0.02
    force, height = (there - np.interp(end[:, 0], run["time_s"], run[name]) for name, there in
                     (("force_y", of_row[:, :, 2].mean(axis=1)), ("center_y_m", end[:, 3])))
    return np.abs(force[late]).max(), np.sqrt(np.mean(force[late]**2)), np.abs(height[late]).max()


def main():
    with tempfile.TemporaryDirectory() as folder:
        fmu = Fmu(unpack(sys.argv[1], folder))
        fmu.begin(hub_velocity_y=0.0)
        length = 4e-4 / np.ceil(4e-4 / fmu.step_size)
        begin = time.perf_counter()
        rows = QuarterCar(fmu, length).drive(0.4)
        wall = time.perf_counter() - begin
        fmu.free()
    over = rows[rows[:, 0] > 0.1]
    print(f"force_y {over[:, 2].min():.0f} to {over[:, 2].max():.0f} N, "
          f"hub up to {over[:, 3].max():.5f} m, spin {over[:, 4].min():.3f} to {over[:, 4].max():.3f} rad/s")
    print(f"{0.4 / wall:.2f} times real time, all tries included")
    if len(sys.argv) > 2:
        np.savetxt(sys.argv[2], rows, delimiter=",", comments="",
                   header="time_s,force_x,force_y,center_y_m,angular_velocity")
    if len(sys.argv) > 3:
        most, mean, height = differences(rows, sys.argv[3])
        print(f"against {sys.argv[3]}: force_y within {most:.0f} N (root mean square {mean:.0f} N), "
              f"hub within {1e6 * height:.1f} um")


if __name__ == "__main__":
    main()
