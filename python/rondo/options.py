# SPDX-License-Identifier: BSD-3-Clause
"""Keyword arguments of the package's functions that are options of the commands: type, default and meaning.
Written from the library's table of options (src/rondo/study/options): RONDO_WRITE_MANUAL=1 ctest -R Manual."""

OPTIONS: dict[str, dict[str, tuple[str, str]]] = {
    "run": {
        "threads": ("int | None = None", "Number of threads; chosen by the size of the case if left out; 1 to 1024"),
        "overwrite": ("bool = False", "Replaces the results of another run"),
        "resume": ("bool = False", "Resumes the run from its last checkpoint, with bitwise the same results; begins it if there is none; with a later time.end a finished run continues"),
        "modes_from": ("Place | None = None", "Results directory of a run of the same body; a crush by analysis.solver = latin-pgd begins with the modes of this run"),
        "reduced": ("Place | None = None", "Runs a reduced wheel instead of the mesh: `case` for one made of the case, or a model of rondo.reduce"),
        "modes": ("int | None = None", "Number of modes of a reduced wheel made of the case; chosen by its step if left out"),
        "estimate": ("bool = False", "Runs a reduced wheel made of the case again, with half the step and with twice the modes, and tells how far its mean forces differ"),
        "step_factor": ("float | None = None", "Step of a reduced run over that of the full run; default 20"),
        "reduced_step": ("str | None = None", "Number of seconds, the step of a wheel made of the case, which is chosen by spin and contact if left out; scheme of the step of a model: midpoint | explicit; default midpoint"),
        "snapshots": ("str | None = None", "Snapshots of a reduced run as fields, or as coordinates of the modes, which are far cheaper, have no stress, and become fields in Python: fields | modes; default fields"),
    },
    "modes": {
        "count": ("int | None = None", "Number of modes at each spin, besides rigid-body motions; default 20; 1 to 100000"),
        "spins": ("Sequence[float] | None = None", "Rotation speeds, > 0 rolls towards +x [rad/s]; if left out, 0 and that of the case at t = 0"),
        "sweep": ("str | None = None", "Rotation speeds, FROM:TO:NUMBER, at which the frequencies of a Campbell diagram are found [rad/s]"),
        "diameters": ("int | None = None", "Largest number of nodal diameters for critical speeds; default 12; 0 to 1000000"),
        "overwrite": ("bool = False", "Replaces the results of another run"),
    },
    "pod": {
        "field": ("str | None = None", "Field that is decomposed: displacement | velocity | contact; default displacement"),
        "frame": ("str | None = None", "Frame of the modes: co-rotating | rectified; default co-rotating"),
        "from_time": ("float | None = None", "Time of the first snapshot used [s]"),
        "to_time": ("float | None = None", "Time of the last snapshot used [s]"),
        "modes": ("int | None = None", "Number of modes; if left out, as many as leave out 1e-6 of the energy"),
        "weight": ("str | None = None", "Norm; default mass, delassus for contact: mass | delassus | none"),
        "shift": ("str | None = None", "Rectification by the angle itself or by whole sectors: fourier | pitch; default fourier"),
        "memory": ("str | None = None", "Memory limit, e.g. 500MB; snapshots that exceed it are streamed; default 2GB"),
        "method": ("str | None = None", "Method of the decomposition: auto | direct | tsqr | incremental; default auto"),
        "reconstruct": ("int | None = None", "Number of snapshots rebuilt from the modes for ParaView; 0: none; default 20"),
    },
    "reduce": {
        "displacement_modes": ("int | None = None", "Number of displacement modes, each with its derivative by the angle; 30 if left out"),
        "velocity_modes": ("int | None = None", "Number of velocity modes; 30 if left out"),
        "tolerance": ("float | None = None", "Share of the displacements' energy left out, instead of a number of modes"),
        "velocity_tolerance": ("float | None = None", "Share of the velocities' energy left out, instead of a number of modes"),
        "contact_weight": ("float | None = None", "Weight of the boundary's motion near the contact in the choice of modes, relative to that of the mass; 0: none; default 10"),
        "from_time": ("float | None = None", "Time of the first snapshot used [s]"),
        "to_time": ("float | None = None", "Time of the last snapshot used [s]"),
        "contact_stride": ("int | None = None", "Boundary nodes for each contact point, a divisor of their number; if left out, as many as give 180 points; 1 to 1000000"),
        "contact_phases": ("int | None = None", "Contact points for each boundary node; more than 1 also lie between nodes, for comparisons; default 1; 1 to 16"),
        "contact": ("str | None = None", "Contact points, by default places that are fixed in space on a smooth disk, otherwise nodes that pass by: places | nodes"),
        "frame": ("str | None = None", "Frame of the modes, of which co-rotating is for comparisons: rectified | co-rotating; default rectified"),
        "memory": ("str | None = None", "Memory limit of the decompositions, e.g. 500MB; default 2GB"),
        "error_estimate": ("bool = True", "Whether an error estimate predicts each of 3 or more runs from the others"),
    },
    "sweep": {
        "overwrite": ("bool = False", "Replaces another sweep's results"),
        "resume": ("bool = False", "Resumes a sweep, or a shard, that was interrupted"),
    },
    "fmu": {
        "modes": ("int | None = None", "Number of modes; if left out, chosen as for rondo run --reduced"),
        "reduced_step": ("float | None = None", "Largest internal step [s]; if left out, chosen as for rondo run --reduced"),
    },
}
