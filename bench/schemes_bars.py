# SPDX-License-Identifier: BSD-3-Clause
"""Bars of bench/schemes.py: 100 elements of 0.1 m and ten of a tenth of that, one of which is plain;
waves run at 30 m/s, ν = 0 makes them one-dimensional."""
import h5py
import numpy as np
from schemes_common import MASSLESS, SECONDS, history, integral, ledger, panels, steps, summary

H, WAVE, COURANT = 0.1, 30.0, 0.9
LENGTH = 100 * H + 10 * H / 10  # m
CASE = """schema = 1
[mesh]
file = "{mesh}"
clamped = "{held}"
contact = "{free}"
[material]
youngs_modulus = 900.0
poissons_ratio = 0.0
density = 1.0
plane = "stress"
{region}{damping}[motion]
angular_velocity = 0.0
{body}[time]
safety = 0.9
end = {end!r}
{time}[output]
history_interval = 0
snapshots = 2
stress = false
{solver}"""
# Tables of the case that a scheme adds to.
PLAIN = {"region": "", "time": "", "solver": ""}
SCHEMES = {
    "plain": PLAIN,
    "implicit elements": PLAIN | {"solver": '[[solver.implicit]]\nregion = "thin"\n'},
    "asynchronous, ratio 10": PLAIN | {"time": 'scheme = "hati"\n',
                                       "solver": '[solver.hati]\nfine = {region = "thin"}\nratio = 10\n'},
    "mass scaling": PLAIN | {"region": '[[material.region]]\nsurface = "thin"\ndensity = 100.0\n'},
    "massless": PLAIN | {"solver": "[solver]\n" + MASSLESS},
}


def strip_mesh(edges, thin, along_x):
    """Gmsh 2.2: one element wide, between these edges; "first" and "last" are its ends, "thin" the
    elements of these places, "thick" the others."""
    nodes = [(a, b) for a in edges.tolist() for b in (-H / 2, H / 2)]
    place = [(a, b) if along_x else (-b, a) for a, b in nodes]
    elements = [(1, 1, (2, 1)), (1, 2, (len(nodes) - 1, len(nodes)))]
    elements += [(3, 3 if k in thin else 4, (2 * k + 1, 2 * k + 3, 2 * k + 4, 2 * k + 2))
                 for k in range(len(edges) - 1)]
    text = ('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n1 1 "first"\n1 2 "last"\n'
            f'2 3 "thin"\n2 4 "thick"\n$EndPhysicalNames\n$Nodes\n{len(nodes)}\n')
    text += "".join(f"{i} {x!r} {y!r} 0\n" for i, (x, y) in enumerate(place, 1))
    text += f"$EndNodes\n$Elements\n{len(elements)}\n"
    text += "".join(f"{i} {kind} 2 {group} {group} {' '.join(map(str, corners))}\n"
                    for i, (kind, group, corners) in enumerate(elements, 1))
    return text + "$EndElements\n"


def meshes(folder, name, edges, thin, along_x):
    """Files with the thin elements, and with one of the usual size in their place."""
    found = []
    for kind, places, of in (("fine", edges, thin), ("coarse", np.arange(102) * H, ())):
        path = folder / f"{name}-{kind}.msh"
        path.write_text(strip_mesh(places, of, along_x))
        found.append(path)
    return found


class Bar:
    NAME, TITLE = "bar", "A bar with a thin foot is pushed onto a wall"
    COLUMNS = ("steps", SECONDS, "force, mean (N/m)", "rms about 30 N/m", "lost in impacts", "ledger")
    # Next to none, but some: undamped, the bar has no energy at all before its first contact, and the
    # balance of nodes without mass would be judged by round-off there.
    DAMPING = "[damping]\nstiffness = 1e-12\n"
    BODY = 'speed = 0.0\nheight = [[0.0, 5.0], [1.1, -6.0]]\n[ground]\nprofile = "flat"\n'

    def cases(self, folder):
        edges = np.concatenate([np.arange(10) * H / 10, H + np.arange(101) * H])
        fine, coarse = meshes(folder, self.NAME, edges, range(10), along_x=False)
        common = {"held": "last", "free": "first", "body": self.BODY, "end": 1.1,
                  "damping": self.DAMPING}
        for name in ("plain", "massless"):
            yield f"{name}, no thin elements", CASE.format(mesh=coarse, **common, **SCHEMES[name])
        for name, more in SCHEMES.items():
            yield name, CASE.format(mesh=fine, **common, **more)

    def measure(self, out):
        h = history(out)
        seen = h["force_y"][(h["time_s"] > 0.56) & (h["time_s"] < 1.1)]
        energy = 0.5 * H * LENGTH * 10.0**2  # of the bar at 10 m/s
        return {"steps": steps(out), "force, mean (N/m)": f"{seen.mean():.3f}",
                "rms about 30 N/m": f"{np.sqrt(((seen - 30.0) ** 2).mean()):.3g}",
                "lost in impacts": f"{100 * h['loss_impact'][-1] / energy:.3g} %",
                "ledger": ledger(out)}

    def draw(self, rows, folder):
        def force(out):
            h = history(out)
            return h["time_s"], h["force_y"]
        panels(folder / "schemes-bar", rows, force, ("time (s)", "force on the foot (N/m)"),
               ((0.48, 1.1), (0, 80)))


class Pulse:
    NAME, TITLE = "pulse", "A pulse goes 20 times through a thin layer"
    COLUMNS = ("steps", SECONDS, "error of the velocity, L2", "energy kept", "ledger")
    SIZE = 2.0     # m, of the pulse
    PASSES = 20.5  # of the bar: ends in the middle

    def end(self):
        return (self.PASSES * LENGTH + 0.5 * self.SIZE) / WAVE

    def speed(self, time):
        """m/s: of the held end, one hump."""
        part = np.asarray(time) * WAVE / self.SIZE
        return np.where((part > 0) & (part < 1), np.sin(np.pi * part) ** 2, 0.0)

    def exact(self, x, time):
        """m/s: the wave that left the held end, and what both ends have made of it."""
        v = np.zeros_like(x)
        for n in range(12):
            for way in (2 * n * LENGTH + x, 2 * (n + 1) * LENGTH - x):
                v += (-1) ** n * self.speed(time - way / WAVE)
        return v

    def cases(self, folder):
        half = np.arange(51) * H
        edges = np.concatenate([half, half[-1] + H / 10 * np.arange(1, 10), half[-1] + H + half])
        fine, coarse = meshes(folder, self.NAME, edges, range(50, 60), along_x=True)
        times = np.linspace(0.0, self.SIZE / WAVE, 65)
        speed = [[t, v] for t, v in zip(times.tolist(), self.speed(times).tolist())]
        common = {"held": "first", "free": "last", "end": self.end(), "damping": "",
                  "body": f"height = 0.0\nspeed = {speed}\n"}
        yield "plain, no thin layer", CASE.format(mesh=coarse, **common, **PLAIN)
        for name, more in SCHEMES.items():
            if name != "massless":  # there is no contact
                yield name, CASE.format(mesh=fine, **common, **more)

    def field(self, out):
        """x, velocity and the exact one along one side, at the last snapshot."""
        with h5py.File(out / "results.h5") as file:
            places = file["mesh/coordinates"][:]
            side = places[:, 1] > 0.0
            x, v = places[side, 0], file["snapshots/velocity"][-1, side, 0]
            time = file["frame/time"][-1]
        if "hati" not in summary(out):  # else at the time of the displacements
            time -= 0.5 * summary(out)["step"]
        order = np.argsort(x)
        return x[order], v[order], self.exact(x[order], time)

    def measure(self, out):
        x, v, exact = self.field(out)
        error = np.sqrt(integral((v - exact) ** 2, x) / integral(exact**2, x))
        h = history(out)
        energy = (h["kinetic"] + h["strain"])[h["time_s"] > 1.1 * self.SIZE / WAVE]
        return {"steps": steps(out), "error of the velocity, L2": f"{error:.3f}",
                "energy kept": f"{energy[-1] / energy[0]:.6f}",
                "ledger": ledger(out)}

    def draw(self, rows, folder):
        panels(folder / "schemes-pulse", rows, lambda out: self.field(out)[:2],
               ("place (m)", "velocity (m/s)"), ((0, LENGTH), (-0.8, 1.2)),
               lambda out: self.field(out)[::2])
