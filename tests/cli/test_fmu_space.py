# SPDX-License-Identifier: BSD-3-Clause
"""rondo fmu of wheels in three dimensions: led along slip angles, yaw rates and cambers, against runs of the program;
in states, in several instances, over a cleat at an angle; and what it refuses."""
import ctypes
import json
import pathlib
import sys
import tempfile
import threading
import unittest
import xml.etree.ElementTree as ElementTree

import numpy as np

import fmi2_rules
from program import ROOT, SANITIZED, ProgramTest, history, run

sys.path.insert(0, str(ROOT / "examples" / "fmu"))
from quarter_car import DOUBLE, ERROR, Fmu, unpack  # noqa: E402

CASE = ROOT / "cases" / "wheel3d-cornering.toml"
SPEED, SPIN, STEP = 10.0, 33.76455, 2e-4  # of the case [m/s], [rad/s]; communication step [s]
PASSES = round(24 * 2 * np.pi / 90 / SPIN / STEP)  # steps in the pass of 24 sectors
FORCES = ("contact_force_x", "contact_force_y", "contact_force_z", "contact_moment_x", "contact_moment_z")
SHARED = {}  # made once: folder and where the FMU is unpacked


def made(*arguments):
    done = run(*arguments)
    assert done.returncode == 0, done.stderr
    return done


def setUpModule():
    if SANITIZED:
        raise unittest.SkipTest("sanitizers want to be loaded before the program that loads the FMU")
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    shared = pathlib.Path(folder.name)
    made("fmu", CASE, "-o", shared / "wheel.fmu", "--set", "motion.slip_angle=0")
    SHARED["unpacked"] = unpack(shared / "wheel.fmu", shared / "wheel")


def turn(angle, t):
    """Angle and rate at t of a turn in 0.02 s, whose rate is linear between communication points."""
    rate, late = angle / 0.01, min(t, 0.02)
    if late <= 0.01:
        return rate * late**2 / 0.02, rate * late / 0.01
    return angle - rate * (0.02 - late)**2 / 0.02, rate * (0.02 - late) / 0.01


class SpaceTest(ProgramTest):
    def instance(self, folder=None, begins=True, **start):
        fmu = Fmu(folder or SHARED["unpacked"])
        self.addCleanup(fmu.free)
        if begins:
            fmu.begin(**start)
        return fmu

    def wheel_of(self, name, case, *settings):
        words = [word for s in settings for word in ("--set", s)]
        made("fmu", case, "-o", self.folder / f"{name}.fmu", *words)
        return unpack(self.folder / f"{name}.fmu", self.folder / name)

    def landed(self, height=0.29, steps=800, lead=None, folder=None, names=FORCES, **start):
        """Forces of a wheel that comes down at 1 m/s; `lead` gives inputs by the time."""
        fmu = self.instance(folder, hub_height_start=height + 0.016 + 0.5 * STEP, step=STEP,
                            hub_velocity_z=-1.0, **start)
        down = round(0.016 / STEP)
        out = []
        for k in range(steps):
            inputs = lead((k + 1) * STEP) if lead else {}
            fmu.set(hub_velocity_z=-1.0 if k < down else 0.0, **inputs)
            fmu.step(k * STEP, STEP)
            out.append(fmu.get(*names))
        self.assertAlmostEqual(fmu.get("hub_height")[0], height, 12)
        self.assertEqual(fmu.messages, [])
        return np.array(out)

    def steady(self, *settings):
        """F_x, F_y, F_z, M_x, M_z of ISO 8855 of the wheel in steady rolling."""
        words = [word for s in settings for word in ("--set", s)]
        made("run", ROOT / "cases" / "wheel3d-steady.toml", "-o", self.folder / "steady", "--overwrite",
             "--set", "analysis.samples_per_sector=8", *words)
        s = json.loads((self.folder / "steady" / "run.json").read_text())["steady"]
        return np.array([s["force_x"], -s["force_lateral"], s["force_y"], s["moment_overturning_iso"],
                         s["moment_aligning_iso"]])


class AgainstRuns(SpaceTest):
    def test_is_the_reduced_run_on_the_same_rim(self):
        """The same motion at a slip angle, without a kink: all rows of all of the run. It is held on a rim of 1 kg and
        1 kg m2; what holds it does the work against what the FMU tells. The run has what no mode has at its one spin,
        the FMU between those at three, which makes 1e-6 of the force."""
        held = self.folder / "held.toml"
        held.write_text(CASE.read_text() + "\n[rim]\nmass = 1.0\ninertia = 1.0\nfree = []\n")
        down = ("motion.height=[[0,0.301],[1,-0.099]]", "output.history_interval=0", "time.end=0.04",
                "motion.gravity=9.81")
        words = [word for s in down for word in ("--set", s)]
        made("run", held, "--reduced", "--reduced-step", STEP, "-o", self.folder / "run", *words)
        own = history(self.folder / "run")
        fmu = self.instance(self.wheel_of("down", CASE, *down))
        columns = (("force_x", "contact_force_x", 1), ("force_lateral", "contact_force_y", -1),
                   ("force_y", "contact_force_z", 1), ("moment_aligning_iso", "contact_moment_z", 1),
                   ("moment_overturning_iso", "contact_moment_x", 1))
        rows = []
        for k in range(200):
            fmu.step(k * STEP, STEP)
            rows.append(fmu.get(*(name for _, name, _ in columns), "force_x", "force_y", "force_z", "torque"))
        rows = np.array(rows)
        largest = np.abs(rows[:, 2]).max()
        self.assertGreater(largest, 2.9e4)
        for i, (column, _, sign) in enumerate(columns):
            np.testing.assert_allclose(sign * rows[:, i], np.asarray(own[column])[-200:], rtol=0,
                                       atol=2e-6 * largest, err_msg=column)
        weight = (fmu.get("tyre_mass")[0] + 1.0) * 9.81
        velocity = np.array(fmu.get("hub_velocity_x", "hub_velocity_y", "hub_velocity_z"))
        power = velocity[2] * weight - rows[:, 5:8] @ velocity - SPIN * rows[:, 8]
        work = np.cumsum(power) * STEP
        np.testing.assert_allclose(np.asarray(own["work_held"])[-200:], work, rtol=0, atol=2e-6 * np.abs(work).max())

    def test_a_viscous_wheel_is_its_run_and_goes_on_to_the_same_bits(self):
        """The matrices of the creep between the three spins of the FMU make 1e-7 of the force."""
        loss = ("material.loss_factor=0.15", "material.loss_band=[5.0, 500.0]", "motion.slip_angle=0")
        down = ("motion.height=[[0,0.301],[1,-0.099]]", "output.history_interval=0", "time.end=0.04", *loss)
        made("run", CASE, "--reduced", "--reduced-step", STEP, "-o", self.folder / "run",
             *(word for s in down for word in ("--set", s)))
        own = history(self.folder / "run")
        fmu = self.instance(self.wheel_of("viscous", CASE, *down))

        def lead(first, last):
            rows = []
            for k in range(first, last):
                fmu.step(k * STEP, STEP)
                rows.append(fmu.get("contact_force_x", "contact_force_z"))
            return np.array(rows)

        rows = lead(0, 100)
        saved = fmu.save()
        late = lead(100, 200)
        fmu.restore(saved)
        self.addCleanup(fmu.free_state, saved)
        np.testing.assert_array_equal(lead(100, 200), late)
        rows = np.concatenate([rows, late])
        largest = np.abs(rows[:, 1]).max()
        self.assertGreater(largest, 3.5e4)
        for i, name in enumerate(("force_x", "force_y")):
            np.testing.assert_allclose(rows[:, i], np.asarray(own[name])[-200:], rtol=0, atol=1e-6 * largest, err_msg=name)

    def test_a_circle_has_the_turn_slip_of_steady_rolling(self):
        """At a slip angle of 0 on a circle of 2 m: the ground pushes outwards, and turns against the turn."""
        left = self.landed(lead=lambda t: {"yaw_rate": 0.5 * SPEED * min(1.0, t / 0.02)})
        mean = left[-PASSES:].mean(axis=0)
        expected = self.steady("motion.slip_angle=0", "motion.turn_slip=0.5")
        self.assertAlmostEqual(mean[1] / expected[1], 1.0, delta=0.02)
        self.assertAlmostEqual(mean[2] / expected[2], 1.0, delta=0.002)
        self.assertAlmostEqual(mean[3] / expected[3], 1.0, delta=0.03)  # of a mesh that is as coarse as this
        self.assertAlmostEqual(mean[4] / expected[4], 1.0, delta=0.02)
        self.assertLess(max(mean[1], mean[4]), 0.0)
        right = self.landed(lead=lambda t: {"yaw_rate": -0.5 * SPEED * min(1.0, t / 0.02)})
        np.testing.assert_allclose(right[-1], np.array([1, -1, 1, -1, -1]) * left[-1], rtol=0,
                                   atol=2e-5 * mean[2])

    def test_a_yaw_is_a_slip_angle(self):
        """A hub that goes straight on while its heading is turned to the left has a slip angle, as it says itself."""
        angle = np.radians(1.0)

        def turned(t):
            yaw, rate = turn(angle, t)
            return {"yaw_rate": rate, "hub_velocity_x": SPEED * np.cos(yaw), "hub_velocity_y": -SPEED * np.sin(yaw)}

        yawed = self.landed(lead=turned, names=(*FORCES, "hub_y", "yaw"))
        aside = self.landed(hub_velocity_x=SPEED * np.cos(angle), hub_velocity_y=-SPEED * np.sin(angle))
        np.testing.assert_allclose(yawed[-PASSES:, :5].mean(axis=0), aside[-PASSES:].mean(axis=0), rtol=0,
                                   atol=5e-4 * aside[-1, 2])
        self.assertGreater(aside[-1, 1], 1400.0)  # back to the left
        self.assertLess(abs(yawed[-1, 5]), 1e-7)
        self.assertAlmostEqual(yawed[-1, 6], angle, 12)

    def test_a_camber_is_that_of_steady_rolling(self):
        """Led to it, and begun with it."""
        expected = self.steady("motion.slip_angle=0", "motion.camber=0.05")
        led = self.landed(lead=lambda t: {"camber_rate": turn(0.05, t)[1]}, names=(*FORCES, "camber"))
        begun = self.landed(camber_start=0.05)
        self.assertAlmostEqual(led[-1, 5], 0.05, 12)
        for forces in (led[-PASSES:, :5].mean(axis=0), begun[-PASSES:].mean(axis=0)):
            np.testing.assert_allclose(forces[[1, 2, 3]], expected[[1, 2, 3]], rtol=0.015)
        self.assertLess(expected[1], -1000.0)

    def test_moments_are_about_the_hub_and_the_contact_centre(self):
        """Those of contact forces and their moments, shifted to the hub; steady, so that no inertia is in them."""
        names = ("contact_force_x", "contact_force_y", "contact_force_z", "contact_moment_x", "contact_moment_y",
                 "contact_moment_z", "moment_x", "moment_y", "moment_z", "torque", "force_x", "force_y", "force_z",
                 "loaded_radius")
        out = self.landed(camber_start=0.05, names=names, hub_velocity_y=-0.2)[-PASSES:].mean(axis=0)
        force, at_ground, at_hub, torque, on_hub, radius = (out[:3], out[3:6], out[6:9], out[9], out[10:13], out[13])
        np.testing.assert_allclose(on_hub, force, atol=2e-4 * force[2])
        self.assertAlmostEqual(radius, 0.29 / np.cos(0.05), 12)
        centre = np.array([0.0, -0.29 * np.tan(0.05), -0.29])  # the wheel leans to the left, its foot is to the right
        expected = at_ground + np.cross(centre, force)
        np.testing.assert_allclose(at_hub[[0, 2]], expected[[0, 2]], atol=1e-9 * force[2])
        axle = np.array([0.0, np.cos(0.05), -np.sin(0.05)])
        self.assertAlmostEqual(axle @ at_hub, torque, 6)
        self.assertAlmostEqual(axle @ expected, torque, delta=2e-4 * force[2])


class Hub(SpaceTest):
    def test_the_rigid_tyre_is_left_to_the_hub(self):
        """On a circle in the air, faster and faster, with gravity, a tyre of 23 kg does next to nothing to its hub: there
        is the inertia of the deformation alone."""
        fmu = self.instance(self.wheel_of("heavy", CASE, "motion.slip_angle=0", "motion.gravity=9.81"),
                            hub_height_start=0.6, hub_velocity_z=0.0, step=STEP)
        n, length = 250, 4 * STEP
        for k in range(n):
            fmu.set(yaw_rate=2.0 * min(1.0, (k + 1) / 100), hub_velocity_z=0.0,
                    hub_angular_velocity=SPIN + 10.0 * (k + 1) / n)
            fmu.step(k * length, length)
        mass = fmu.get("tyre_mass")[0]
        self.assertAlmostEqual(mass, 1100 * np.pi * (0.3**2 - 0.15**2) * 0.1, delta=0.1)
        self.assertLess(np.abs(fmu.get("force_x", "force_y", "force_z")).max(), 0.01 * mass * SPEED * 2.0)
        self.assertEqual(fmu.get("contact_force_z", "contact_moment_x"), [0.0, 0.0])
        inertia, across, torque = fmu.get("tyre_inertia", "tyre_inertia_across", "torque")
        self.assertLess(abs(torque), 0.02 * inertia * 50.0)
        self.assertAlmostEqual(inertia / (0.5 * mass * (0.3**2 + 0.15**2)), 1.0, delta=0.03)
        self.assertAlmostEqual(across / (0.5 * inertia + mass * 0.1**2 / 12), 1.0, delta=0.05)

    def test_places_are_integrals_along_the_heading(self):
        """A half circle of 10 m: the hub is 20 m to the left of where it began, and looks back."""
        fmu = self.instance(hub_height_start=0.6, hub_x_start=3.0, hub_y_start=-1.0, hub_velocity_z=0.0)
        n = 2000
        for k in range(n):
            fmu.set(yaw_rate=1.0, hub_velocity_z=0.0)
            fmu.step(k * STEP * 8, STEP * 8)
        x, y, yaw, height = fmu.get("hub_x", "hub_y", "yaw", "hub_height")
        self.assertAlmostEqual(yaw, n * STEP * 8 - 4 * STEP, 9)  # the rate begins at 0
        self.assertAlmostEqual(x, 3.0 + 10 * np.sin(yaw), delta=0.02)
        self.assertAlmostEqual(y, -1.0 + 10 * (1 - np.cos(yaw)), delta=0.02)
        self.assertAlmostEqual(height, 0.6, 12)

    def test_inputs_are_linear_in_a_communication_step(self):
        """One of three internal steps is as three of one with the inputs between."""
        names = ("hub_velocity_x", "hub_velocity_y", "hub_velocity_z", "hub_angular_velocity", "camber_rate", "yaw_rate")
        first, last = np.array([10.0, 0.0, -1.0, 33.0, 0.1, -0.4]), np.array([10.3, -0.6, 0.5, 36.0, 1.0, 0.8])
        start = {"hub_height_start": 0.296, "step": STEP, **dict(zip(names, first))}
        whole, parts = self.instance(**start), self.instance(**start)
        whole.set(**dict(zip(names, last)))
        whole.step(0.0, 3 * STEP)
        for k in range(3):
            parts.set(**dict(zip(names, first + (k + 1) / 3 * (last - first))))
            parts.step(k * STEP, STEP)
        places = ("hub_x", "hub_y", "hub_height", "hub_angle", "camber", "yaw", "loaded_radius")
        np.testing.assert_allclose(whole.get(*places), parts.get(*places), rtol=1e-12, atol=1e-15)

    def test_a_start_with_rates(self):
        """Rates that are given before initialisation are there from the start: no step takes them from 0."""
        fmu = self.instance(hub_height_start=0.6, yaw_rate=1.0, camber_rate=0.5)
        for k in range(10):
            fmu.step(k * STEP, STEP)
        np.testing.assert_allclose(fmu.get("yaw", "camber"), [10 * STEP, 5 * STEP], rtol=1e-12)

    def test_a_cleat_at_an_angle(self):
        """At 30° and -30° the forces are mirror images; aside by s it comes later by s tan 30°."""
        low = ("motion.slip_angle=0", "ground.obstacle=[{kind='cleat',at=0.3,height=0.011,length=0.04,angle=%s,fillet=0.0108}]",
               "disk.mesh.circumferential=180")
        case = ROOT / "cases" / "wheel3d-cornering.toml"
        left, right = (self.wheel_of(f"cleat{k}", case, low[0], low[1] % angle, low[2])
                       for k, angle in enumerate(("0.5236", "-0.5236")))
        over = self.landed(folder=left, steps=260)
        mirrored = self.landed(folder=right, steps=260)
        largest = over[:, 2].max()
        np.testing.assert_allclose(mirrored * [1, -1, 1, -1, -1], over, rtol=0, atol=1e-4 * largest)
        self.assertGreater(np.abs(over[:, 1]).max(), 0.02 * largest)
        aside = self.landed(folder=left, steps=260, hub_y_start=-0.2, hub_x_start=0.2 * np.tan(0.5236))
        np.testing.assert_allclose(aside, over, rtol=0, atol=1e-4 * largest)

    def test_friction_is_a_parameter(self):
        slow = self.landed(steps=300, hub_velocity_y=-1.0, friction=0.1)
        fast = self.landed(steps=300, hub_velocity_y=-1.0, friction=0.2)
        for forces, friction in ((slow, 0.1), (fast, 0.2)):
            self.assertAlmostEqual(np.hypot(forces[-1, 0], forces[-1, 1]) / forces[-1, 2], friction, delta=0.01)


class State(SpaceTest):
    def test_goes_on_to_the_same_bits(self):
        fmu = self.instance(hub_height_start=0.292)
        names = list(fmu.references)

        def lead(wheel, first, last):
            out = []
            for k in range(first, last):
                wheel.set(hub_velocity_x=10.0, hub_velocity_y=0.1 * np.sin(0.1 * k), hub_velocity_z=-0.02,
                          yaw_rate=0.3 * np.cos(0.05 * k), camber_rate=0.2, hub_angular_velocity=33.0 + 0.01 * k)
                wheel.step(k * STEP, STEP)
                out.append(wheel.get(*names))
            return out

        lead(fmu, 0, 100)
        saved, size = fmu.save(), ctypes.c_size_t()
        expected = lead(fmu, 100, 160)
        fmu.restore(saved)
        self.assertEqual(lead(fmu, 100, 160), expected)
        fmu.call("SerializedFMUstateSize", saved, ctypes.byref(size))
        data = ctypes.create_string_buffer(size.value)
        fmu.call("SerializeFMUstate", saved, data, size)
        fmu.free_state(saved)
        for other in (self.instance(begins=False), self.instance(hub_velocity_y=1.0, hub_height_start=0.292)):
            state = ctypes.c_void_p()
            other.call("DeSerializeFMUstate", data, size, ctypes.byref(state))
            other.restore(state)
            self.assertEqual(lead(other, 100, 160), expected)
            other.free_state(state)

    def test_four_wheels_in_a_process(self):
        """One after the other in each step, and in two threads: each as if it were alone."""
        def lead(wheel, k, which):
            wheel.set(hub_velocity_z=-0.05, hub_velocity_y=0.1 * which, yaw_rate=0.2)
            wheel.step(k * STEP, STEP)
            return wheel.get(*FORCES)

        start = {"hub_height_start": 0.292}
        alone = []
        for which in range(4):
            wheel = self.instance(**start)
            alone.append([lead(wheel, k, which) for k in range(60)])
        wheels = [self.instance(**start) for _ in range(4)]
        rows = [[] for _ in range(4)]
        for k in range(30):
            for which in range(4):
                rows[which].append(lead(wheels[which], k, which))

        def pair(first):
            for k in range(30, 60):
                for which in (first, first + 1):
                    rows[which].append(lead(wheels[which], k, which))

        threads = [threading.Thread(target=pair, args=(first,)) for first in (0, 2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(rows, alone)
        self.assertNotEqual(alone[0], alone[1])


class Refusals(SpaceTest):
    def refused(self, fmu, function, *arguments):
        del fmu.messages[:]
        status = getattr(fmu.library, "fmi2" + function)(ctypes.c_void_p(fmu.component), *arguments)
        self.assertEqual(status, ERROR)
        return " ".join(fmu.messages)

    def test_command(self):
        def fails(case, *settings):
            words = [word for s in settings for word in ("--set", s)]
            done = run("fmu", case, "-o", self.folder / "none.fmu", *words)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertFalse((self.folder / "none.fmu").exists())
            return done.stderr

        self.assertIn("ground.fillet", fails(ROOT / "cases" / "wheel3d-cleat-30.toml"))
        self.assertIn("restitution", fails(CASE, "ground.restitution=0.5"))

    def test_there_is_no_width(self):
        self.assertNotIn("width", self.instance(begins=False).references)

    def test_a_wheel_does_not_lie_down(self):
        fmu = self.instance(hub_height_start=0.6)
        self.assertIn("camber_start = 1: must be", self.refused(
            self.instance(begins=False), "SetReal", (ctypes.c_uint * 1)(fmu.references["camber_start"]),
            ctypes.c_size_t(1), (DOUBLE * 1)(1.0)))
        for k in range(20):
            fmu.set(camber_rate=200.0)
            if k < 19 and fmu.get("camber")[0] + 200 * STEP < 0.78:
                fmu.step(k * STEP, STEP)
            else:
                self.assertIn("its camber is", self.refused(fmu, "DoStep", DOUBLE(k * STEP), DOUBLE(STEP), 1))
                return
        self.fail("it lies")

    def test_a_rim_in_the_ground(self):
        fmu = self.instance(hub_height_start=0.31)
        with self.assertRaisesRegex(RuntimeError, "the rim|strain|law|balance"):
            for k in range(3000):
                fmu.set(hub_velocity_z=-5.0)
                fmu.step(k * STEP, STEP)

    def test_description(self):
        root = ElementTree.parse(SHARED["unpacked"] / "modelDescription.xml").getroot()
        self.assertEqual(fmi2_rules.faults(root), [])
        manual = (ROOT / "docs" / "fmu.md").read_text()
        for variable in root.find("ModelVariables"):
            self.assertIn(f"`{variable.get('name')}`", manual)
            self.assertGreater(len(variable.get("description")), 10)


if __name__ == "__main__":
    unittest.main()
