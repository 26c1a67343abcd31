# SPDX-License-Identifier: BSD-3-Clause
"""rondo fmu: the FMU is unpacked elsewhere, loaded and led by the master of examples/fmu/quarter_car.py."""
import ctypes
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import xml.etree.ElementTree as ElementTree
import zipfile

import numpy as np

import fmi2_rules
from program import ROOT, SANITIZED, ProgramTest, history, run

sys.path.insert(0, str(ROOT / "examples" / "fmu"))
from quarter_car import (DOUBLE, ERROR, LOGGER, Callbacks, ExplicitQuarterCar,  # noqa: E402
                         Fmu, QuarterCar, unpack)

CASE = ROOT / "cases" / "quarter-car-bump.toml"
STATIC = 1.5e5  # load [N], by which forces are judged
CRUSH = 0.3 - 0.29167  # of the tyre under it [m], by which heights are
EXPORTED = """GetTypesPlatform GetVersion SetDebugLogging Instantiate FreeInstance SetupExperiment
    EnterInitializationMode ExitInitializationMode Terminate Reset GetReal GetInteger GetBoolean
    GetString SetReal SetInteger SetBoolean SetString GetFMUstate SetFMUstate FreeFMUstate
    SerializedFMUstateSize SerializeFMUstate DeSerializeFMUstate GetDirectionalDerivative
    SetRealInputDerivatives GetRealOutputDerivatives DoStep CancelStep GetStatus GetRealStatus
    GetIntegerStatus GetBooleanStatus GetStringStatus""".split()


def schema_folder():
    """The standard's own schema, which is not ours to ship; None: it is not at hand."""
    if "RONDO_FMI2_SCHEMA" in os.environ:
        return pathlib.Path(os.environ["RONDO_FMI2_SCHEMA"])
    try:
        import fmpy
    except ImportError:
        return None
    return pathlib.Path(fmpy.__file__).parent / "schema" / "fmi2"


def made(*arguments):
    done = run(*arguments)
    assert done.returncode == 0, done.stderr
    return done


SHARED = {}  # made once: folder, model, FMU and where it is unpacked


def setUpModule():
    if SANITIZED:
        raise unittest.SkipTest("sanitizers want to be loaded before the program that loads the FMU")
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    shared = pathlib.Path(folder.name)
    made("fmu", CASE, "-o", shared / "wheel.fmu")
    unpack(shared / "wheel.fmu", shared / "else where")
    SHARED.update(fmu=shared / "wheel.fmu", unpacked=shared / "else where")


class FmuTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.fmu, self.unpacked = SHARED["fmu"], SHARED["unpacked"]

    def instance(self, begins=True, **start):
        fmu = Fmu(self.unpacked)
        self.addCleanup(fmu.free)
        if begins:
            fmu.begin(**start)
        return fmu

    def refused(self, fmu, function, *arguments):
        """What an error says; the instance is as it was."""
        del fmu.messages[:]
        status = getattr(fmu.library, "fmi2" + function)(ctypes.c_void_p(fmu.component), *arguments)
        self.assertEqual(status, ERROR)
        self.assertEqual(len(fmu.messages), 1)
        return fmu.messages[0]

    def refused_to_set(self, fmu, name, value):
        return self.refused(fmu, "SetReal", (ctypes.c_uint * 1)(fmu.references.get(name, 999)),
                            ctypes.c_size_t(1), (DOUBLE * 1)(value))


class Coupling(FmuTest):
    def test_is_our_own_quarter_car(self):
        """The reduced run with the same step: pointwise, all of the run. The full run: its extremes,
        for one by one its nodes shake the force."""
        made("run", CASE, "--reduced", "-o", self.folder / "reduced")
        made("run", CASE, "-o", self.folder / "full")
        reduced, full = history(self.folder / "reduced"), history(self.folder / "full")
        fmu = self.instance()
        step = json.loads((self.folder / "reduced" / "run.json").read_text())["step"]
        car = QuarterCar(fmu, step)
        rows = car.drive(0.4)
        n = min(len(rows), len(reduced["time_s"]))
        np.testing.assert_allclose(rows[:n, 0], reduced["time_s"][:n], rtol=1e-12)
        force = abs(rows[:n, 2] - reduced["force_y"][:n]).max() / STATIC
        height = abs(rows[:n, 3] - reduced["center_y_m"][:n]).max()
        self.assertLess(force, 0.01)
        self.assertLess(height, 0.01 * CRUSH)
        self.assertLess(car.tries / len(rows), 4.0)
        over, there = rows[rows[:, 0] > 0.1], full["time_s"] > 0.1
        for extreme in (np.max, np.min):
            self.assertLess(abs(extreme(over[:, 2]) - extreme(full["force_y"][there])) / STATIC, 0.01)
            self.assertLess(abs(extreme(over[:, 3]) - extreme(full["center_y_m"][there])), 0.05 * CRUSH)
        self.assertGreater(over[:, 2].max() - over[:, 2].min(), 0.1 * STATIC)  # there is a bump

    def test_width_is_a_factor(self):
        one, two = self.instance(), self.instance(width=0.25)
        for fmu in (one, two):
            for k in range(20):
                fmu.set(hub_velocity_y=-0.2)
                fmu.step(k * 4e-4, 4e-4)
        names = ("force_x", "force_y", "torque", "contact_force_y", "tyre_mass", "tyre_inertia")
        np.testing.assert_allclose(np.array(two.get(*names)), 0.25 * np.array(one.get(*names)))
        self.assertEqual(one.get("hub_height"), two.get("hub_height"))

    def test_ground_height_lifts_all(self):
        one, two = self.instance(), self.instance(ground_height=1.5, hub_height_start=1.8)
        for fmu in (one, two):
            for k in range(20):
                fmu.set(hub_velocity_y=-0.2)
                fmu.step(k * 4e-4, 4e-4)
        self.assertAlmostEqual(one.get("force_y")[0] / two.get("force_y")[0], 1.0, 6)
        self.assertAlmostEqual(two.get("hub_height")[0] - one.get("hub_height")[0], 1.5, 12)

    def test_momentum_is_that_of_hub_and_tyre(self):
        """Without ground what the tyre does to a hub that goes on evenly comes to an end, and what
        it did was to take along the deformation alone: nothing stays of it."""
        fmu = self.instance(hub_height_start=0.5)
        impulse = 0.0
        for k in range(1500):
            fmu.set(hub_velocity_y=min(1.0, (k + 1) / 20))
            fmu.step(k * 4e-4, 4e-4)
            impulse += 4e-4 * fmu.get("force_y")[0]
        self.assertLess(abs(impulse), 1e-3 * fmu.get("tyre_mass")[0])
        self.assertEqual(fmu.get("contact_force_y"), [0.0])

    def test_explicit_master_with_small_steps(self):
        """And with large ones not: docs/fmu.md, 2."""
        explicit = ExplicitQuarterCar(self.instance(), 5e-5).drive(0.05)
        implicit = QuarterCar(self.instance(), 5e-5).drive(0.05)
        self.assertLess(abs(explicit[:, 3] - implicit[:, 3]).max(), 5e-4)


class State(FmuTest):
    def test_goes_on_to_the_same_bits(self):
        fmu = self.instance()
        car = QuarterCar(fmu, 4e-4)
        car.drive(0.2)  # on the bump
        saved = fmu.save()
        names = list(fmu.references)

        def lead(wheel):
            out = []
            for k in range(60):
                wheel.set(hub_velocity_y=0.1 * np.cos(0.1 * k), hub_angular_velocity=16.8 + 0.01 * k)
                wheel.step(0.2 + k * 4e-4, 4e-4)
                out.append(wheel.get(*names))
            return out

        expected = lead(fmu)
        fmu.restore(saved)
        self.assertEqual(lead(fmu), expected)
        size = ctypes.c_size_t()
        fmu.call("SerializedFMUstateSize", saved, ctypes.byref(size))
        data = ctypes.create_string_buffer(size.value)
        fmu.call("SerializeFMUstate", saved, data, size)
        fmu.free_state(saved)
        other, state = self.instance(), ctypes.c_void_p()
        other.call("DeSerializeFMUstate", data, size, ctypes.byref(state))
        other.restore(state)
        self.assertEqual(lead(other), expected)
        other.free_state(state)
        self.assertIn("no state of this FMU",
                      self.refused(other, "DeSerializeFMUstate", data, ctypes.c_size_t(size.value - 8),
                                   ctypes.byref(state)))

    def test_a_state_goes_to_an_instance_that_has_not_begun(self):
        """Nor began with the same velocity: what is made once does not depend on the inputs."""
        names = ("force_x", "force_y", "torque", "hub_angle")
        fmu = self.instance()
        for k in range(60):
            fmu.set(hub_velocity_x=5.0 + 0.6 * k, hub_velocity_y=-0.1,
                    hub_angular_velocity=16.8 + 2.0 * k)
            fmu.step(k * 1e-4, 1e-4)
        saved, size = fmu.save(), ctypes.c_size_t()
        fmu.call("SerializedFMUstateSize", saved, ctypes.byref(size))
        data = ctypes.create_string_buffer(size.value)
        fmu.call("SerializeFMUstate", saved, data, size)
        fmu.free_state(saved)

        def go_on(wheel):
            out = []
            for k in range(20):
                wheel.set(hub_velocity_x=41.0, hub_velocity_y=0.0, hub_angular_velocity=136.8)
                wheel.step(6e-3 + k * 1e-4, 1e-4)
                out.append(wheel.get(*names))
            return out

        expected = go_on(fmu)
        for other in (self.instance(begins=False),
                      self.instance(hub_velocity_x=40.0, hub_angular_velocity=130.0)):
            state = ctypes.c_void_p()
            other.call("DeSerializeFMUstate", data, size, ctypes.byref(state))
            other.restore(state)
            self.assertEqual(go_on(other), expected)
            other.free_state(state)

    def test_damaged_bytes_are_refused(self):
        fmu = self.instance()
        fmu.step(0.0, 4e-4)
        saved, state, size = fmu.save(), ctypes.c_void_p(), ctypes.c_size_t()
        fmu.call("SerializedFMUstateSize", saved, ctypes.byref(size))
        data = ctypes.create_string_buffer(size.value)
        fmu.call("SerializeFMUstate", saved, data, size)
        fmu.free_state(saved)
        for at in (0, 12, 100, size.value // 2, size.value - 1):
            wrong = ctypes.create_string_buffer(data.raw, size.value)
            wrong[at] = bytes([data.raw[at] ^ 1])
            self.assertIn("or damaged", self.refused(fmu, "DeSerializeFMUstate", wrong, size,
                                                     ctypes.byref(state)))

    def test_threads_of_blas_are_the_importers(self):
        """Also those that it sets between two calls."""
        fmu = self.instance()
        maps = pathlib.Path("/proc/self/maps").read_text().splitlines()
        names = [line.split()[-1] for line in maps if "libopenblas" in line and "numpy" not in line]
        blas = ctypes.CDLL(names[0])
        self.addCleanup(blas.openblas_set_num_threads, blas.openblas_get_num_threads())
        for k, threads in enumerate((2, 1, 2)):
            blas.openblas_set_num_threads(threads)
            fmu.step(k * 4e-4, 4e-4)
            self.assertEqual(blas.openblas_get_num_threads(), threads)
        other = Fmu(self.unpacked)
        other.begin()
        other.free()
        self.assertEqual(blas.openblas_get_num_threads(), 2)

    def test_reset_begins_anew(self):
        fmu = self.instance(friction=0.3)
        first = QuarterCar(fmu, 4e-4).drive(0.02)
        fmu.call("Reset")
        self.assertEqual(fmu.get("friction"), [0.6])
        fmu.begin(friction=0.3)
        np.testing.assert_array_equal(QuarterCar(fmu, 4e-4).drive(0.02), first)

    def test_instances_in_threads(self):
        alone = QuarterCar(self.instance(), 4e-4).drive(0.03)
        cars = [QuarterCar(self.instance(), 4e-4) for _ in range(3)]
        rows = [None] * 3

        def drive(k):
            rows[k] = cars[k].drive(0.03)

        threads = [threading.Thread(target=drive, args=(k,)) for k in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for one in rows:
            np.testing.assert_array_equal(one, alone)


class Forks(FmuTest):
    """Python's own way to start processes on Linux before 3.14."""

    def in_child(self, work):
        """What the work returns, a number, in a process forked from this one."""
        reader, writer = os.pipe()
        child = os.fork()
        if child == 0:
            signal.alarm(60)  # a child that hangs is a fault, and not to be waited for
            try:
                os.write(writer, repr(work()).encode())
            finally:
                os._exit(0)
        os.close(writer)
        with os.fdopen(reader) as told:
            text = told.read()
        self.assertEqual(os.waitpid(child, 0)[1], 0, "the child hangs or ends by a signal")
        return float(text)

    def force(self):
        fmu = Fmu(self.unpacked)
        fmu.begin()
        fmu.set(hub_velocity_y=-0.2)
        fmu.step(0.0, 4e-4)
        force = fmu.get("force_y")[0]
        fmu.free()
        return force

    def test_a_child_begins_anew(self):
        expected = self.force()
        self.assertEqual(self.in_child(self.force), expected)
        self.assertEqual(self.force(), expected)

    def test_a_child_goes_on_with_its_copy(self):
        fmu = self.instance()

        def go_on():
            fmu.set(hub_velocity_y=-0.2)
            fmu.step(0.0, 4e-4)
            return fmu.get("force_y")[0]

        self.assertEqual(self.in_child(go_on), go_on())


class Pointers(FmuTest):
    """What an importer gets wrong in C: each of these ended it before."""

    def status(self, fmu, function, *arguments, component=True):
        """An error; what it says is empty where there is no instance to say it."""
        del fmu.messages[:]
        handle = ctypes.c_void_p(fmu.component if component is True else component)
        self.assertEqual(getattr(fmu.library, "fmi2" + function)(handle, *arguments), ERROR, function)
        return " ".join(fmu.messages)

    def test_null(self):
        fmu = self.instance()
        one, null = ctypes.c_size_t(1), None
        references, values = (ctypes.c_uint * 1)(0), (DOUBLE * 1)(1.0)
        saved, size = fmu.save(), ctypes.c_size_t(10_000_000)
        for function, *arguments in (
                ("GetReal", null, one, values), ("GetReal", references, one, null),
                ("SetReal", null, one, values), ("SetReal", references, one, null),
                ("SetDebugLogging", 1, one, null),
                ("SetDebugLogging", 1, one, (ctypes.c_char_p * 1)(null)),
                ("GetFMUstate", null), ("SerializedFMUstateSize", saved, null),
                ("SerializeFMUstate", saved, null, size),
                ("DeSerializeFMUstate", null, size, ctypes.byref(ctypes.c_void_p())),
                ("DeSerializeFMUstate", (ctypes.c_char * 8)(), ctypes.c_size_t(8), null),
                ("GetRealStatus", 2, null), ("GetBooleanStatus", 3, null)):
            self.assertIn("NULL", self.status(fmu, function, *arguments), function)
        for function, *arguments in (("SetFMUstate", null), ("SerializeFMUstate", null, null, size),
                                     ("SerializedFMUstateSize", null, ctypes.byref(size))):
            self.assertIn("this is no state", self.status(fmu, function, *arguments))
        self.assertEqual(fmu.library.fmi2FreeFMUstate(ctypes.c_void_p(fmu.component), None), 0)
        self.assertEqual(self.status(fmu, "DoStep", DOUBLE(0), DOUBLE(4e-4), 1, component=None), "")
        fmu.call("GetReal", null, ctypes.c_size_t(0), null)
        fmu.free_state(saved)
        fmu.step(0.0, 4e-4)

    def test_freed(self):
        fmu, other = self.instance(), self.instance()
        saved = fmu.save()
        freed = ctypes.c_void_p(saved.value)
        fmu.free_state(saved)
        size = ctypes.c_size_t(10_000_000)
        for function, *arguments in (
                ("SetFMUstate", freed), ("SerializedFMUstateSize", freed, ctypes.byref(size)),
                ("SerializeFMUstate", freed, (ctypes.c_char * 8)(), ctypes.c_size_t(8)),
                ("GetFMUstate", ctypes.byref(freed))):
            self.assertIn("freed", self.status(fmu, function, *arguments), function)
        self.assertEqual(self.status(fmu, "FreeFMUstate", ctypes.byref(freed)), "")
        component = fmu.component
        self.mistaken(fmu, other)
        fmu.free()
        fmu.free()  # nothing, the second time
        for function, *arguments in (
                ("DoStep", DOUBLE(0), DOUBLE(4e-4), 1), ("Reset",), ("Terminate",),
                ("GetReal", (ctypes.c_uint * 1)(0), ctypes.c_size_t(1), (DOUBLE * 1)()),
                ("EnterInitializationMode",), ("CancelStep",)):
            self.assertEqual(self.status(fmu, function, *arguments, component=component), "")
        other.step(0.0, 4e-4)

    def test_states_are_freed_with_their_instance(self):
        """The next instance may lie where the one before was, and it takes none of its states."""
        for _ in range(50):
            fmu = self.instance()
            saved, component = fmu.save(), fmu.component
            fmu.free()
            fmu = self.instance()
            if fmu.component == component:
                self.assertIn("this is no state", self.status(fmu, "SetFMUstate", saved))
                return
        self.skipTest("no instance came to lie where one had been freed")

    def mistaken(self, fmu, other):
        """A state for an instance, an instance for a state, a state of another instance."""
        saved = fmu.save()
        for function, *arguments in (("Reset",), ("Terminate",), ("EnterInitializationMode",)):
            self.assertEqual(self.status(fmu, function, *arguments, component=saved.value), "")
        fmu.library.fmi2FreeInstance(ctypes.c_void_p(saved.value))  # has no status
        instance = ctypes.c_void_p(fmu.component)
        self.assertIn("no state of this instance", self.status(fmu, "SetFMUstate", instance))
        self.assertEqual(self.status(fmu, "FreeFMUstate", ctypes.byref(instance)), "")
        self.assertIn("no state of this instance", self.status(other, "SetFMUstate", saved))
        self.assertEqual(self.status(other, "FreeFMUstate", ctypes.byref(saved)), "")
        fmu.call("SetFMUstate", saved)
        fmu.free_state(saved)


class Wrong(FmuTest):
    def test_bounds(self):
        early = self.instance(begins=False)
        for name, value, most in (("friction", 1e6, "100"), ("width", 1e300, "100"),
                                  ("step", 2.0, "1"), ("hub_height_start", -1e7, "1000000"),
                                  ("hub_velocity_x", 1e5, "10000"),
                                  ("hub_angular_velocity", -1e6, "100000")):
            said = self.refused_to_set(early, name, value)
            self.assertIn(f"{name} = ", said)
            self.assertIn(f"at most {most}", said)

    def test_stop_time(self):
        fmu = self.instance(begins=False)
        for start, stop in ((1.0, 1.0), (1.0, 0.5), (0.0, float("nan"))):
            self.assertIn("stopTime", self.refused(fmu, "SetupExperiment", 0, DOUBLE(0.0),
                                                   DOUBLE(start), 1, DOUBLE(stop)))
        fmu.call("SetupExperiment", 0, DOUBLE(0.0), DOUBLE(0.0), 1, DOUBLE(8e-4))
        fmu.call("EnterInitializationMode")
        fmu.call("ExitInitializationMode")
        fmu.step(0.0, 4e-4)
        self.assertIn("after the stopTime of 0.0008 s",
                      self.refused(fmu, "DoStep", DOUBLE(4e-4), DOUBLE(8e-4), 1))
        fmu.step(4e-4, 4e-4)
        self.assertIn("stopTime", self.refused(fmu, "DoStep", DOUBLE(8e-4), DOUBLE(4e-4), 1))

    def test_a_step_that_would_not_end(self):
        fmu = self.instance()
        self.assertIn("internal steps of", self.refused(fmu, "DoStep", DOUBLE(0), DOUBLE(1000.0), 1))
        fmu.step(0.0, 4e-4)

    def test_locations(self):
        def refused(uri):
            fmu = Fmu.__new__(Fmu)
            whole = self.instance(begins=False)
            fmu.library, fmu.messages = whole.library, []
            fmu.callbacks = Callbacks(LOGGER(fmu._log))
            guid = ElementTree.parse(self.unpacked / "modelDescription.xml").getroot().get("guid")
            self.assertIsNone(fmu.library.fmi2Instantiate(b"wheel", 1, guid.encode(), uri.encode(),
                                                          ctypes.byref(fmu.callbacks), 0, 1))
            return fmu.messages[0]

        for uri, words in (("file:///a%zz/b", 'has "%zz", which codes no byte'),
                           ("file:///a%2", 'has "%2", which'), ("file:///a%00b", 'has "%00", which'),
                           ("file:///a%+1", 'has "%+1", which'),
                           ("file://server/a", 'is on another machine, "server"'),
                           ("http://server/a", "is of another scheme than file")):
            said = refused(uri)
            self.assertIn(words, said)
            self.assertIn("fmuResourceLocation", said)

    def test_an_fmu_that_cannot_be_written(self):
        done = run("fmu", CASE, "-o", self.folder / "none" / "wheel.fmu")
        self.assertEqual(done.returncode, 4)
        self.assertIn("cannot be written: No such file or directory", done.stderr)

    def test_values(self):
        fmu = self.instance()
        self.assertIn("stays after initialisation", self.refused_to_set(fmu, "friction", 0.5))
        self.assertIn("is computed", self.refused_to_set(fmu, "force_y", 0.0))
        self.assertIn("no value reference 999", self.refused_to_set(fmu, "none", 0.0))
        self.assertIn("not a number", self.refused_to_set(fmu, "hub_velocity_y", float("nan")))
        early = self.instance(begins=False)
        self.assertIn("at least 0", self.refused_to_set(early, "friction", -0.1))
        self.assertIn("above 0", self.refused_to_set(early, "width", 0.0))

    def test_steps(self):
        early = self.instance(begins=False)
        self.assertIn("comes before", self.refused(early, "DoStep", DOUBLE(0), DOUBLE(1e-4), 1))
        fmu = self.instance()
        for length in (0.0, -1e-4, float("nan"), float("inf")):
            self.refused(fmu, "DoStep", DOUBLE(0), DOUBLE(length), 1)
        fmu.step(0.0, 4e-4)
        self.assertIn("internal steps, which are 0.0002 s",
                      self.refused(fmu, "DoStep", DOUBLE(4e-4), DOUBLE(5e-4), 1))
        self.assertIn("the wheel is at", self.refused(fmu, "DoStep", DOUBLE(0.1), DOUBLE(4e-4), 1))
        fmu.step(4e-4, 8e-4)

    def test_differences_of_late_times_are_lengths(self):
        fmu = self.instance(begins=False)
        fmu.call("SetupExperiment", 0, DOUBLE(0.0), DOUBLE(5000.0), 0, DOUBLE(0.0))
        fmu.call("EnterInitializationMode")
        fmu.call("ExitInitializationMode")
        times = [5000.0 + k * 1e-4 for k in range(20)]
        for at, to in zip(times, times[1:]):
            fmu.step(at, to - at)

    def test_sectors_passed_in_a_step(self):
        """180 sectors: 1 passes in 2.07 ms."""
        fmu = self.instance(step=2e-2)
        self.assertTrue([m for m in fmu.messages if "sectors of its mesh" in m])
        self.assertIn("9.67 sectors", self.refused(fmu, "DoStep", DOUBLE(0), DOUBLE(2e-2), 1))
        fmu.step(0.0, 4e-4)
        fmu.set(hub_velocity_x=60.0, hub_angular_velocity=200.0)
        self.assertIn("sectors", self.refused(fmu, "DoStep", DOUBLE(4e-4), DOUBLE(4e-4), 1))
        fmu.set(hub_velocity_x=5.04, hub_angular_velocity=16.8)
        fmu.step(4e-4, 4e-4)

    def test_outputs_are_of_the_initialised(self):
        early = self.instance(begins=False)
        for name in ("force_y", "tyre_mass", "hub_height"):
            self.assertIn("is computed", self.refused(
                early, "GetReal", early._references([name]), ctypes.c_size_t(1), (DOUBLE * 1)()))
        early.get("friction", "hub_velocity_y")

    def test_a_hub_in_the_ground(self):
        fmu = self.instance()
        before = fmu.save()
        with self.assertRaisesRegex(RuntimeError, "status 3"):
            for k in range(1000):
                fmu.set(hub_velocity_y=-20.0)
                fmu.step(k * 4e-4, 4e-4)
        self.assertIn("it has failed", self.refused(fmu, "DoStep", DOUBLE(0), DOUBLE(4e-4), 1))
        fmu.restore(before)
        fmu.set(hub_velocity_y=0.0)
        fmu.step(0.0, 4e-4)
        fmu.free_state(before)

    def test_instances(self):
        with self.assertRaisesRegex(RuntimeError, "is not that of this FMU"):
            Fmu(self.unpacked, guid="{other}")
        moved = self.folder / "moved"
        unpack(self.fmu, moved)
        (moved / "resources" / "wheel.json").unlink()
        with self.assertRaisesRegex(RuntimeError, "fmuResourceLocation"):
            Fmu(moved)

    def test_a_spin_beyond_what_is_known_is_warned_of_once(self):
        fmu = self.instance(step=5e-5)

        def warnings():
            for k in range(3):
                fmu.set(hub_angular_velocity=170.0)
                fmu.step(k * 5e-5, 5e-5)
            return len([m for m in fmu.messages if m.startswith("hub_angular_velocity = 170 rad/s")])

        self.assertEqual(warnings(), 1)
        del fmu.messages[:]
        fmu.call("Reset")
        fmu.begin(step=5e-5)
        self.assertEqual(warnings(), 1)

    def test_warnings_are_of_variables(self):
        """Not of the keys of a case."""
        said = self.instance(hub_velocity_y=-0.01).messages
        self.assertEqual([m for m in said if "motion." in m], [])

    def test_command(self):
        def fails(*arguments, code=2):
            done = run("fmu", *arguments, "-o", self.folder / "none.fmu")
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertFalse((self.folder / "none.fmu").exists())
            return done.stderr

        self.assertIn("rondo fmu CASE.toml", fails(self.folder / "model.h5"))
        self.assertIn("no such file", fails(self.folder / "none.toml"))
        self.assertIn("ground", fails(ROOT / "cases" / "spin-up-damped.toml"))
        self.assertIn("no number of modes", fails(CASE, "--modes", "-3"))
        self.assertIn("no step of a reduced wheel", fails(CASE, "--reduced-step", "-1"))
        done = run("fmu", CASE, "-o", self.folder / "own.fmu", "--modes", 20, "--reduced-step", 2e-4,
                   "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)["result"]
        self.assertEqual((told["identifier"], told["modes"], told["step"]), ("own", 20, 2e-4))
        self.assertAlmostEqual(told["tyre_mass"], 233.26, delta=0.1)  # of a ring: 1100 pi (R2 - r2)

    def rolls_as_its_own_run(self, case, sinks, settings=(), **start):
        """Forces of an FMU whose hub sinks by 10 mm in 0.02 s, or not, and of the run that does."""
        words = [word for s in settings for word in ("--set", s)]
        made("fmu", case, "-o", self.folder / "this.fmu", *words)
        fmu = Fmu(unpack(self.folder / "this.fmu", self.folder / case.stem))
        self.addCleanup(fmu.free)
        fmu.begin(**start)
        forces = []
        for k in range(150):
            fmu.set(hub_velocity_y=-0.5 if sinks and k < 100 else 0.0)
            fmu.step(k * 2e-4, 2e-4)
            forces.append(fmu.get("contact_force_y")[0])
        height = "[[0, 0.3], [0.02, 0.29]]" if sinks else "0.29"
        made("run", case, "--reduced", "--reduced-step", 2e-4, "-o", self.folder / case.stem / "run",
             *words, "--set", f"motion.height={height}", "--set", "time.end=0.03")
        own = history(self.folder / case.stem / "run")
        late = np.asarray(own["time_s"]) > 0.022
        self.assertAlmostEqual(np.mean(forces[110:]) / np.mean(np.asarray(own["force_y"])[late]), 1.0,
                               delta=0.01)

    def test_a_viscous_wheel(self):
        """Its force is that of its own run, and it goes on to the same bits, with what its branches remember."""
        case = self.folder / "viscous.toml"
        text = (ROOT / "cases" / "cleat-load.toml").read_text()
        begin, end = text.index("[rim]"), text.index("[ground]")
        case.write_text(text[:begin] + text[end:])
        loss = ["material.loss_factor=0.15", "material.loss_band=[5.0, 500.0]"]
        self.rolls_as_its_own_run(case, True, loss)
        fmu = Fmu(self.folder / "viscous")
        self.addCleanup(fmu.free)
        fmu.begin()

        def lead(first, last):
            for k in range(first, last):
                fmu.set(hub_velocity_y=-0.5 if k < 50 else 0.0)
                fmu.step(k * 4e-4, 4e-4)
            return fmu.get(*fmu.references)

        lead(0, 60)
        saved = fmu.save()
        expected = lead(60, 120)
        fmu.restore(saved)
        self.assertEqual(lead(60, 120), expected)
        fmu.free_state(saved)

    def test_a_tread(self):
        case = self.folder / "tread.toml"
        text = (ROOT / "cases" / "cleat-load-treaded.toml").read_text()
        begin, end = text.index("[rim]"), text.index("[ground]")
        case.write_text(text[:begin] + text[end:])
        self.rolls_as_its_own_run(case, True)

    def test_a_steady_start(self):
        self.rolls_as_its_own_run(ROOT / "cases" / "rolling-flat.toml", False,
                                  ["initial.state=steady-rolling", "motion.height=0.29"],
                                  hub_height_start=0.29)
        fmu = Fmu(self.folder / "rolling-flat")
        self.addCleanup(fmu.free)
        with self.assertRaisesRegex(RuntimeError, "does not roll steadily"):
            fmu.begin(hub_height_start=0.29, hub_velocity_x=0.0, hub_angular_velocity=0.0)

    def test_shipped_cases_have_a_step(self):
        for name in ("wheel-rolling", "wheel-landing", "pothole-load", "rolling-flat"):
            done = made("fmu", ROOT / "cases" / f"{name}.toml", "-o", self.folder / "it.fmu", "--json")
            self.assertGreater(json.loads(done.stdout)["result"]["step"], 1e-4, name)

    def test_two_fmus_in_a_process(self):
        """Each is its own library: neither sees what the other does."""
        made("fmu", CASE, "-o", self.folder / "other.fmu", "--modes", 20)
        other = Fmu(unpack(self.folder / "other.fmu", self.folder / "other"))
        self.addCleanup(other.free)
        other.begin()
        alone, both = self.instance(), self.instance()

        def go(fmu, k):
            fmu.set(hub_velocity_y=-0.2)
            fmu.step(k * 4e-4, 4e-4)
            return fmu.get("force_y", "torque")

        for k in range(50):
            expected = go(alone, k)
            go(other, k)
            self.assertEqual(go(both, k), expected)
        self.assertNotEqual(other.get("force_y"), both.get("force_y"))


class Files(FmuTest):
    def root(self):
        return ElementTree.parse(self.unpacked / "modelDescription.xml").getroot()

    def test_obeys_the_rules(self):
        self.assertEqual(fmi2_rules.faults(self.root()), [])

    def test_rules_refuse_what_is_wrong(self):
        def wrong(change):
            root = self.root()
            change(root)
            self.assertNotEqual(fmi2_rules.faults(root), [], change)

        variables = "ModelVariables/ScalarVariable"
        wrong(lambda r: r.set("fmiVersion", "3.0"))
        wrong(lambda r: r.attrib.pop("guid"))
        wrong(lambda r: r.set("else", "1"))
        wrong(lambda r: r.remove(r.find("ModelStructure")))
        wrong(lambda r: r.insert(0, r.find("ModelVariables")))
        wrong(lambda r: r.find("CoSimulation").set("modelIdentifier", "a b"))
        wrong(lambda r: r.find("CoSimulation").set("canGetAndSetFMUstate", "yes"))
        wrong(lambda r: r.find(variables).set("valueReference", "1"))
        wrong(lambda r: r.find(variables).set("name", "width"))
        wrong(lambda r: r.find(variables).set("variability", "continuous"))
        wrong(lambda r: r.find(variables).set("initial", "calculated"))
        wrong(lambda r: r.find(variables + "/Real").attrib.pop("start"))
        wrong(lambda r: r.find(variables + "/Real").set("start", "-1"))
        wrong(lambda r: r.find(variables + "/Real").set("unit", "furlong"))
        wrong(lambda r: r.findall(variables)[-1].find("Real").set("start", "0"))
        for tag in ("Outputs", "InitialUnknowns"):
            wrong(lambda r: r.find(f"ModelStructure/{tag}/Unknown").set("index", "1"))
            wrong(lambda r: r.find(f"ModelStructure/{tag}").remove(
                r.find(f"ModelStructure/{tag}/Unknown")))

    def test_obeys_the_schema_of_the_standard(self):
        folder = schema_folder()
        if folder is None:
            self.skipTest("neither RONDO_FMI2_SCHEMA nor Python's fmpy: the schema is not at hand")
        done = subprocess.run(["xmllint", "--noout", "--schema", folder / "fmi2ModelDescription.xsd",
                               self.unpacked / "modelDescription.xml"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_holds_what_an_fmu_has(self):
        with zipfile.ZipFile(self.fmu) as archive:
            self.assertIsNone(archive.testzip())
            self.assertEqual(archive.namelist(), [
                "modelDescription.xml", "binaries/linux64/wheel.so", "resources/case.toml",
                "resources/wheel.json", "documentation/index.html", "documentation/LICENSE"])
            self.assertEqual(archive.read("documentation/LICENSE"), (ROOT / "LICENSE").read_bytes())

    def test_tells_what_it_cannot(self):
        self.assertEqual(self.root().find("CoSimulation").get(
            "canHandleVariableCommunicationStepSize"), "false")

    def test_exports_the_functions_and_nothing_else(self):
        said = subprocess.run(["nm", "-D", "--defined-only", self.unpacked / "binaries/linux64/wheel.so"],
                              capture_output=True, text=True, check=True).stdout
        names = [line.split()[-1] for line in said.splitlines()]
        self.assertEqual(sorted(names), sorted("fmi2" + name for name in EXPORTED))
        fmu = self.instance()
        for name, value in (("GetTypesPlatform", b"default"), ("GetVersion", b"2.0")):
            function = getattr(fmu.library, "fmi2" + name)
            function.restype = ctypes.c_char_p
            self.assertEqual(function(), value)

    def test_runs_where_there_is_no_rondo(self):
        done = subprocess.run([sys.executable, ROOT / "examples" / "fmu" / "quarter_car.py", self.fmu],
                              env={"PATH": "/usr/bin:/bin"}, cwd="/", capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("hub up to 0.31", done.stdout)


if __name__ == "__main__":
    unittest.main()
