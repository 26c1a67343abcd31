# SPDX-License-Identifier: BSD-3-Clause
"""Keyword arguments of the package's functions that are options of the commands: type, default and meaning.
Written from the library's table of options (src/rondo/study/options): RONDO_WRITE_MANUAL=1 ctest -R Manual."""

OPTIONS: dict[str, dict[str, tuple[str, str]]] = {
    "run": {
        "threads": ("int | None = None", "Number of cores that the threads of the run use; chosen by size if left out; 1 to 1024"),
        "overwrite": ("bool = False", "Replaces the results of another run in the results directory"),
        "resume": ("bool = False", "Resumes the run in the results directory from its last checkpoint, with bitwise the same results; begins it where there is none; continues a finished run to a later time.end"),
        "modes_from": ("Place | None = None", "Results directory of a run of the same body; a crush by analysis.solver = latin-pgd begins with its modes"),
        "reduced": ("Place | None = None", "Model (rondo reduce) on whose modes the case is run instead of its mesh; docs/reduced.md"),
        "step_factor": ("float | None = None", "Step of a reduced run over that of the full run; default 20"),
        "reduced_step": ("str | None = None", "Scheme of a reduced run, implicit or by central differences: midpoint | explicit; default midpoint"),
        "snapshots": ("str | None = None", "Snapshots of a reduced run, as fields, or as coordinates of the modes alone, which are far cheaper, have no stress, and are lifted when they are read in Python: fields | modes; default fields"),
    },
    "modes": {
        "count": ("int | None = None", "Number of modes at each spin, besides rigid-body motions; default 20; 1 to 100000"),
        "spins": ("Sequence[float] | None = None", "Rotation speeds, > 0 where the body rolls towards +x [rad/s]; rest and the case's own at t = 0 if left out"),
        "sweep": ("str | None = None", "Rotation speeds, FROM:TO:NUMBER, at which the frequencies of a Campbell diagram are found [rad/s]"),
        "diameters": ("int | None = None", "Largest number of nodal diameters of the waves whose critical speeds are found; default 12; 0 to 1000000"),
        "overwrite": ("bool = False", "Replaces what another run has left in the results directory"),
    },
    "pod": {
        "field": ("str | None = None", "Field that is decomposed: displacement | velocity | contact; default displacement"),
        "frame": ("str | None = None", "Frame of the modes: co-rotating | rectified; default co-rotating"),
        "from_time": ("float | None = None", "Time of the first snapshot that is taken [s]"),
        "to_time": ("float | None = None", "Time of the last snapshot that is taken [s]"),
        "modes": ("int | None = None", "Number of modes that are kept; as many as leave 1e-6 of the energy if left out"),
        "weight": ("str | None = None", "Weight of the inner product; mass if left out, delassus for contact: mass | delassus | none"),
        "shift": ("str | None = None", "Rectification by the angle itself or by whole sectors: fourier | pitch; default fourier"),
        "memory": ("str | None = None", "Memory allowed, e.g. 500MB; beyond it snapshots are streamed; default 2GB"),
        "method": ("str | None = None", "Method of the decomposition: auto | direct | tsqr | incremental; default auto"),
        "reconstruct": ("int | None = None", "Number of snapshots that are rebuilt from the modes, for ParaView; 0: none; default 20"),
    },
    "reduce": {
        "displacement_modes": ("int | None = None", "Number of modes of the displacements, each with its derivative by the angle; 30 if left out"),
        "velocity_modes": ("int | None = None", "Number of modes of the velocities; 30 if left out"),
        "tolerance": ("float | None = None", "Share of the displacements' energy that is left out, instead of a number of modes"),
        "velocity_tolerance": ("float | None = None", "Share of the velocities' energy that is left out, instead of a number of modes"),
        "contact_weight": ("float | None = None", "Weight that the motion of the boundary near the contact has in choosing modes, over that of the mass; 0: none; default 10"),
        "from_time": ("float | None = None", "Time of the first snapshot that is taken [s]"),
        "to_time": ("float | None = None", "Time of the last snapshot that is taken [s]"),
        "contact_stride": ("int | None = None", "Number of boundary nodes to a contact point, which divides their number; as many as leave 180 points if left out; 1 to 1000000"),
        "contact_phases": ("int | None = None", "Number of contact points to a node of the boundary, those between two nodes where nodes come by; to compare with; default 1; 1 to 16"),
        "contact": ("str | None = None", "Points of contact that stand still in space, or the nodes that come by; places on a smooth disk if left out, nodes otherwise: places | nodes"),
        "frame": ("str | None = None", "Frame of the modes; co-rotating, with the disk, to compare with: rectified | co-rotating; default rectified"),
        "memory": ("str | None = None", "Memory allowed to the decompositions, e.g. 500MB; default 2GB"),
        "error_estimate": ("bool = True", "Prediction of each run from the others, where there are 3 runs or more"),
    },
    "sweep": {
        "overwrite": ("bool = False", "Replaces another sweep in the directory of the study"),
        "resume": ("bool = False", "Resumes a sweep, or a shard, that was interrupted"),
    },
    "fmu": {
        "case": ("Place | None = None", "Case file with ground, dampings, gravity and start of the wheel; the case of the first run behind the model if left out"),
        "step_factor": ("float | None = None", "Largest internal step over that of the full run; default 20"),
    },
}
