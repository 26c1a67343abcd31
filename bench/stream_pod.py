# SPDX-License-Identifier: BSD-3-Clause
"""A POD that does not fit in the memory allowed, by the real program on a real file.

    /usr/bin/python3 bench/stream_pod.py build/release/rondo [SNAPSHOTS] [MEMORY] [FRAME]

A disk of 2·10⁵ degrees of freedom; its file of results is filled with travelling waves of falling
amplitude and noise (1.6 GB for 1,000 snapshots), so that every snapshot counts. Prints time and peak
memory of the whole process.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

CASE = """schema = 1
title = "stream"
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = 62
circumferential = 1600
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[motion]
angular_velocity = 33.333333
speed = 0.0
height = 1.0
[time]
end = 1.0e-6
[output]
snapshots = 1
stress = false
"""


def fill(path, mesh_path, n_snapshots):
    """results.h5 with the mesh of another and displacements by formula, one chunk a snapshot."""
    rng = np.random.default_rng(1)
    with h5py.File(mesh_path) as mesh, h5py.File(path, "w") as h5:
        mesh.copy("/mesh", h5)
        h5.attrs["format"] = mesh.attrs["format"]
        x = mesh["/mesh/coordinates"][:]
        n = len(x)
        time = np.linspace(0.0, 2 * np.pi / 33.333333, n_snapshots, endpoint=False)
        for name, values in (("time", time), ("time_velocity", time), ("angle", -33.333333 * time),
                             ("angle_velocity", -33.333333 * time),
                             ("center", np.zeros((n_snapshots, 2)))):
            h5.create_dataset("/frame/" + name, data=values)
        shape = (n_snapshots, n, 2)
        u = h5.create_dataset("/snapshots/displacement", shape, "f8", chunks=(1, n, 2))
        h5.create_dataset("/snapshots/velocity", shape, "f8", chunks=(1, n, 2))  # never written: 0
        phi, r = np.arctan2(x[:, 1], x[:, 0]), np.hypot(x[:, 0], x[:, 1])
        for j, t in enumerate(time):
            field = np.zeros((n, 2))
            for k in range(1, 40):
                wave = np.cos(k * (phi - 33.333333 * t) + k) * (r - 0.15) / k**3
                field[:, 0] += wave
                field[:, 1] += 0.5 * wave * np.sin(phi + k)
            field += 1e-6 * rng.standard_normal((n, 2)) * (r > 0.15)[:, None]
            u[j] = field


def main():
    program = sys.argv[1]
    n_snapshots = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
    memory = sys.argv[3] if len(sys.argv) > 3 else "400MB"
    frame = sys.argv[4] if len(sys.argv) > 4 else "co-rotating"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "case.toml").write_text(CASE)
        subprocess.run([program, "run", folder / "case.toml", "-o", folder / "run", "--quiet"],
                       check=True)
        fill(folder / "full.h5", folder / "run" / "results.h5", n_snapshots)
        os.replace(folder / "full.h5", folder / "run" / "results.h5")
        size = (folder / "run" / "results.h5").stat().st_size
        begin = time.perf_counter()
        pod = subprocess.Popen([program, "pod", folder / "run", "--memory", memory, "--frame", frame,
                                "--modes", "50", "--reconstruct", "0", "--quiet"])
        _, status, usage = os.wait4(pod.pid, 0)
        seconds = time.perf_counter() - begin
    print(f"file {size / 1e9:.2f} GB, {seconds:.1f} s of wall time, {usage.ru_utime:.1f} s of work, "
          f"peak memory {usage.ru_maxrss * 1024 / 1e6:.0f} MB")
    return os.waitstatus_to_exitcode(status)


if __name__ == "__main__":
    sys.exit(main())
