# SPDX-License-Identifier: BSD-3-Clause
"""Snapshots of modes (rondo run --snapshots modes), lifted here, against the fields that the program
lifts itself."""
import numpy as np
import pytest
from program import SMALL, replaced, run

import rondo

TEXT = replaced(replaced(SMALL, "snapshots", "snapshots = 41"), "circumferential",
                "circumferential = 120")


def ok(*arguments):
    done = run(*arguments, "--quiet")
    assert done.returncode == 0, done.stderr


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A case and the run behind the models."""
    folder = tmp_path_factory.mktemp("lifted")
    (folder / "case.toml").write_text(TEXT)
    ok("run", folder / "case.toml", "-o", folder / "full", "--set", "output.snapshots=161")
    return folder


def both(folder, name, frame, step):
    """A run with fields and one with modes."""
    model = folder / f"{name}.h5"
    ok("reduce", folder / "full", "-o", model, "--frame", frame, "--displacement-modes", 20,
       "--velocity-modes", 20)
    runs = []
    for kept in ("fields", "modes"):
        out = folder / f"{name}-{kept}"
        ok("run", folder / "case.toml", "--reduced", model, "-o", out, "--snapshots", kept, *step)
        runs.append(rondo.open(out))
    return runs


MIDPOINT, EXPLICIT = ["--step-factor", 8], ["--reduced-step", "explicit", "--step-factor", 1]


@pytest.mark.parametrize(("frame", "step"), [("rectified", MIDPOINT), ("rectified", EXPLICIT),
                                             ("co-rotating", EXPLICIT)])
def test_fields_are_the_programs_own(folder, frame, step):
    fields, modes = both(folder, f"{frame}-{len(step)}", frame, step)
    assert modes.n_snapshots == 41
    for name in ("displacement", "velocity"):
        expected, found = np.asarray(fields.field(name)), modes.field(name)
        assert (found.shape, found.units) == (expected.shape, fields.field(name).units)
        scale = abs(expected).max()
        assert scale > 0
        np.testing.assert_allclose(found[:], expected, rtol=0, atol=1e-12 * scale)
        for key in (3, -1, slice(5, 20, 4), [7, 2, 2], (4, slice(None, None, 3), 1),
                    np.arange(41) > 38):
            part = found[key]
            assert part.shape == expected[key].shape
            np.testing.assert_allclose(part, expected[key], rtol=0, atol=1e-12 * scale)
    np.testing.assert_allclose(modes.position(-1), fields.position(-1), rtol=0, atol=1e-15)


def test_pictures_and_what_stress_says(folder, tmp_path):
    _, modes = both(folder, "pictures", "rectified", MIDPOINT)
    assert modes.field_names == ["displacement", "velocity"]
    modes.plot_field(0.01, "displacement_y")
    modes.plot_contact(0.01)
    film = modes.animate(tmp_path / "film.gif", quantity="displacement", frames=2)
    assert film.stat().st_size > 0
    with pytest.raises(rondo.Error, match="rondo run --snapshots fields"):
        modes.plot_field(0.01, "von_mises")
