# SPDX-License-Identifier: BSD-3-Clause
"""Keyword arguments of the package's functions that are options of the commands: type, default and meaning.
Written from the library's table of options (src/rondo/study/options): RONDO_WRITE_MANUAL=1 ctest -R Manual."""

OPTIONS: dict[str, dict[str, tuple[str, str]]] = {
    "run": {
        "threads": ("int | None = None", "Number of threads; chosen by the size of the case if left out; 1 to 1024"),
        "overwrite": ("bool = False", "Replaces the results of another run"),
        "resume": ("bool = False", "Resumes the run from its last checkpoint, with bitwise the same results; begins it if there is none; with a later time.end a finished run continues"),
        "modes_from": ("Place | None = None", "Results directory of a run of the same body; a crush by analysis.solver = latin-pgd begins with the modes of this run"),
        "reduced": ("Place | None = None", "Runs a reduced wheel instead of the mesh: `case` for one made of the case, or a file of rondo.reduce"),
        "modes": ("int | None = None", "Number of modes of a reduced wheel made of the case; chosen by its step if left out"),
        "estimate": ("bool = False", "Runs a reduced wheel again, with half the step and with twice the modes, and tells how far its mean forces differ"),
        "reduced_step": ("float | None = None", "Step of a reduced wheel [s]; chosen by spin and contact if left out"),
        "law_residual": ("float | None = None", "Largest residual of the law of contact of a reduced wheel in three dimensions, over the largest force; 1e-6 if left out"),
    },
    "modes": {
        "count": ("int | None = None", "Number of modes at each spin, besides rigid-body motions; default 20; 1 to 100000"),
        "spins": ("Sequence[float] | None = None", "Rotation speeds, > 0 rolls towards +x [rad/s]; if left out, 0 and that of the case at t = 0"),
        "sweep": ("str | None = None", "Rotation speeds, FROM:TO:NUMBER, at which the frequencies of a Campbell diagram are found [rad/s]"),
        "diameters": ("int | None = None", "Largest number of nodal diameters for critical speeds; default 12; 0 to 1000000"),
        "standing": ("bool = False", "Holds the nodes of a wheel in three dimensions that touch the ground when it is pressed at rest to motion.height, or under analysis.load: in all directions, or without friction along the normal"),
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
        "basis": ("str | None = None", "Modes of the wheel: those of a case at rest, or those of displacements that runs went through; by default by what is named: eigenmodes | pod"),
        "modes": ("int | None = None", "Number of modes; if left out, chosen as for rondo run --reduced, of a POD 40"),
        "from_time": ("float | None = None", "Time of the first snapshot used [s]"),
        "to_time": ("float | None = None", "Time of the last snapshot used [s]"),
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
