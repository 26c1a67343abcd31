# SPDX-License-Identifier: BSD-3-Clause
# %% [markdown]
# # A tour of rondo in Python
#
# A notebook kept as a script: open it in VS Code, Spyder or, by jupytext, in Jupyter, or run it as it is. All cases
# are those of the checkout; one run goes into `results/tour`, all else stays in memory.

# %%
import pathlib
from concurrent.futures import ThreadPoolExecutor

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

import rondo

CASES = pathlib.Path(rondo.__file__).resolve().parents[2] / "cases"

# %% [markdown]
# ## Step by step
# A wheel that rolls freely under a load. `now` has the columns of history.csv as they are; forces are means over the
# steps since the last call.

# %%
wheel = rondo.Simulation(CASES / "wheel-rolling.toml", {"time.end": 0.4})
wheel.advance_to(0.15)
print(wheel)
print({name: wheel.now[name] for name in ("spin_rad_s", "force_x", "force_y")})

# %% [markdown]
# ## Views
# Arrays look at the memory of the simulation, without a copy: a later step changes what they show. `copy()` keeps it.

# %%
u = wheel.displacement
before = u.copy()
wheel.advance(100)
print("moved within 100 steps by", np.abs(u - before).max(), "m; writeable:", u.flags.writeable)

# %%
touching = wheel.touching
print(len(touching.nodes), "nodes touch the ground,", touching.sticks.sum(), "of them stick; together they bear",
      touching.force[:, 0].sum(), "N/m")

# %%
figure, ax = plt.subplots(figsize=(5, 4))
strain = np.linalg.norm(wheel.displacement, axis=1)[wheel.mesh.cells].mean(axis=1)
cells = ax.add_collection(PolyCollection(wheel.position[wheel.mesh.cells], array=1e3 * strain, cmap="magma_r"))
ax.axhline(0.0, color="0.5")
ax.set(aspect="equal", title=f"t = {wheel.time:.3f} s")
ax.autoscale_view()
figure.colorbar(cells, label="displacement (mm)")

# %% [markdown]
# ## Setting loads and motion
# What is a table in time is led over to a new value between two steps: here a brake, below the grip. The case as it
# was driven, `case_text`, is run by the program to the same bits.

# %%
print(wheel.keys)
wheel.set({"rim.brake": 1.0e4}, over=0.02)
for row in wheel.steps(2000):
    print(f"{row.time:.3f} s: spin {row['spin_rad_s']:.3f} rad/s, force_x {row['force_x']:.0f} N/m")

# %%
history = wheel.history
figure, ax = plt.subplots(figsize=(5, 2.5))
ax.plot(history["time_s"], 1e-3 * history["force_x"])
ax.set(xlabel="time (s)", ylabel="horizontal force (kN/m)")

# %% [markdown]
# ## A sweep in memory, two at once
# The interpreter's lock is free while steps are made and states are solved: threads of Python are enough for two
# cores.

# %%
def braked(friction: float) -> float:
    state = rondo.steady_rolling(CASES / "steady-rolling.toml", {"ground.friction": friction}, threads=1)
    return float(state.steady["force_x"])


frictions = np.linspace(0.0, 0.8, 17)
with ThreadPoolExecutor(2) as two:
    forces = np.array(list(two.map(braked, frictions)))
figure, ax = plt.subplots(figsize=(5, 2.5))
ax.plot(frictions, 1e-3 * forces, ".-")
ax.set(xlabel="friction", ylabel="horizontal force (kN/m)")

# %% [markdown]
# ## Modes of a run
# `rondo.run` writes the files of `rondo run`, from which `rondo.pod` takes modes.

# %%
run = rondo.run(CASES / "ledge-smooth.toml", "results/tour/smooth", overwrite=True)
pod = rondo.pod(run, field="displacement", frame="rectified")
print(pod.modes_for)
pod.plot_spectrum()
run.plot_field(run.times[-1])
