# SPDX-License-Identifier: BSD-3-Clause
"""Results as tables of pandas, datasets of xarray and HTML: the same numbers, with units; without the
packages an error that says what to install."""
import html.parser
import importlib.util
import sys

import numpy as np
import pytest
import sweeps

import rondo
from rondo.data.html import MOST

pandas_there = pytest.mark.skipif(importlib.util.find_spec("pandas") is None,
                                  reason="pandas is not installed: scripts/setup.sh --dev")
xarray_there = pytest.mark.skipif(importlib.util.find_spec("xarray") is None,
                                  reason="xarray is not installed: scripts/setup.sh --dev")


# pandas

@pandas_there
def test_a_history(smooth):
    history = rondo.open(smooth).history
    frame = history.to_pandas()
    assert frame.index.name == "time_s" and list(frame.columns) == history.names[1:]
    assert np.array_equal(frame.index, history["time_s"])
    for name in frame:
        assert np.array_equal(frame[name], history[name], equal_nan=True), name
    assert frame.attrs["units"] == dict(history.units)
    frame["force_y"] += 1.0  # a copy
    assert not np.array_equal(frame["force_y"], history["force_y"])


@pandas_there
def test_rows_of_contact(smooth):
    contact = rondo.open(smooth).contact
    frame = contact.to_pandas()
    assert list(frame.columns) == list(contact.rows) and len(frame) > 0
    assert frame["node"].dtype == np.int64 and set(frame["node"]) <= set(contact.nodes)
    assert np.array_equal(frame["pressure_pa"], contact.rows["pressure_pa"])
    assert frame.attrs["units"]["pressure_pa"] == "Pa" and frame.attrs["units"]["node"] == "1"


@pandas_there
def test_a_sweep(grid):
    frame = grid.to_pandas()
    assert frame.index.name == "run" and list(frame.index) == list(grid["run"])
    assert list(frame.columns) == grid.names[1:]
    for name in frame:
        numbers = {"equal_nan": True} if grid[name].dtype.kind == "f" else {}
        assert np.array_equal(frame[name], grid[name], **numbers), name
    assert (frame["status"] == "failed").sum() == 2
    assert frame["force_y_mean"].isna().sum() == 2  # figures of members without results
    assert frame.attrs["units"][sweeps.SPIN] == "rad/s"
    done = frame[frame["status"] == "done"]
    assert done.groupby(sweeps.FRICTION)["force_y_mean"].mean().notna().all()


# xarray

@xarray_there
def test_fields_over_time_node_and_component(smooth):
    run = rondo.open(smooth)
    data = run.to_xarray()
    assert set(data) == {"displacement", "velocity", "force"}
    assert data.displacement.dims == ("time", "node", "component")
    assert list(data.component.values) == ["x", "y"]
    assert np.array_equal(data.time, run.times) and data.time.attrs["units"] == "s"
    assert np.array_equal(data.reference_y, run.mesh.coordinates[:, 1])
    assert data.reference_y.attrs["units"] == "m"
    for name, field in (("displacement", run.displacement), ("velocity", run.velocity),
                        ("force", run.contact.force)):
        assert np.array_equal(data[name], field[:]), name
        assert data[name].attrs == {"units": field.units, "description": field.description}
    last = data.displacement.sel(component="y", node=[3, 5]).isel(time=-1)
    assert np.array_equal(last, run.displacement[-1][[3, 5], 1])
    load = data.force.sel(direction="normal").sum("contact_node")
    assert np.allclose(load, run.contact.force[:, :, 0].sum(axis=1))
    assert list(data.contact_node.values) == list(run.contact.nodes)


@xarray_there
def test_other_fields_by_name(smooth):
    run = rondo.open(smooth)
    data = run.to_xarray(["von_mises", "cauchy_stress", "contact_force", "traction"])
    assert data.cauchy_stress.dims == ("time", "node", "stress_component")
    assert np.array_equal(data.cauchy_stress.sel(stress_component="yy"), run.field("stress_yy")[:])
    assert data.contact_force.dims == ("time", "node", "component_fixed")
    assert np.array_equal(data.contact_force, run.field("contact_force")[:])
    assert np.array_equal(data.traction, run.contact.traction[:])
    assert data.von_mises.attrs["units"] == "Pa"
    with pytest.raises(rondo.UnknownNameError, match="no field 'pressure'; there are: .*von_mises"):
        run.to_xarray(["pressure"])


@xarray_there
def test_fields_stay_in_their_file_until_they_are_asked_for(copy, monkeypatch):
    from rondo.data.arrays import LazyArray
    read = []
    plain = LazyArray.__getitem__

    def noted(self, key):
        part = plain(self, key)
        read.append(np.shape(part))
        return part

    monkeypatch.setattr(LazyArray, "__getitem__", noted)
    run = rondo.open(copy)
    data = run.to_xarray()
    assert not read
    part = data.displacement.isel(time=slice(-1, None, -4), node=[7, 2])
    assert not read
    wanted = part.values
    assert read == [wanted.shape] and len(wanted) == 3
    assert np.array_equal(wanted, run.displacement[::-4, [7, 2]])


@xarray_there
def test_any_part_is_the_part_of_the_whole(smooth):
    """As xarray gives it of arrays in memory."""
    data = rondo.open(smooth).to_xarray().displacement
    whole, random = data.copy(data=data.values), np.random.default_rng(1)
    t, n = data.shape[:2]
    data = rondo.open(smooth).to_xarray().displacement
    for _ in range(200):
        kinds = [slice(*random.integers(-t - 2, t + 2, 2), random.choice([-5, -3, -2, -1, 1, 2, 4])),
                 random.integers(-t, t, 4), int(random.integers(-t, t))]
        part = {"time": kinds[random.integers(3)], "node": random.integers(0, n, 3)}
        assert np.array_equal(data.isel(part).values, whole.isel(part).values), part
        again = {"time": slice(None, None, -2)} if data.isel(part).ndim == 3 else {}
        assert np.array_equal(data.isel(part).isel(again).values,
                              whole.isel(part).isel(again).values), part
    import xarray
    places = {"time": xarray.DataArray([[2, 0], [5, 2]], dims=("a", "b")),
              "node": xarray.DataArray([7, 3], dims="a")}
    pairs = {"node": places["node"], "component": places["node"] // 6, "time": slice(None, None, -3)}
    for part in (places, pairs):
        assert np.array_equal(data.isel(part).values, whole.isel(part).values), part


@xarray_there
def test_runs_without_contact_or_snapshots(air, tmp_path):
    from conftest import IN_THE_AIR, ok
    assert set(rondo.open(air).to_xarray()) == {"displacement", "velocity"}
    with pytest.raises(rondo.UnknownNameError, match="no field 'force'"):
        rondo.open(air).to_xarray(["force"])
    (tmp_path / "case.toml").write_text(IN_THE_AIR)
    ok("run", tmp_path / "case.toml", "-o", tmp_path / "out", "--set", "output.snapshots=0")
    with pytest.raises(rondo.Error, match="output.snapshots was 0"):
        rondo.open(tmp_path / "out").to_xarray()


@xarray_there
def test_a_pod(smooth):
    for pod in rondo.open(smooth).pods.values():
        data = pod.to_xarray()
        assert data.spatial.dims == ("mode", "node", "component")
        assert np.array_equal(data.spatial, pod.spatial)
        assert list(data.mode.values) == [1, 2, 3] and np.array_equal(data.node, pod.points)
        again = data.coefficients.isel(snapshot=2) @ data.spatial
        assert np.allclose(again, pod.reconstruct(2))
        assert data.attrs["unit"] == pod.unit
    assert list(data.component.values) == ["x", "y"] or pod.field == "contact"


# Without the packages

def test_without_pandas(smooth, grid, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    run = rondo.open(smooth)
    for call in (run.history.to_pandas, run.contact.to_pandas, grid.to_pandas):
        with pytest.raises(rondo.Error, match=r"needs the package pandas, which is not installed "
                           r"for this Python: apt-get install python3-pandas \(Debian\), or pip"):
            call()


def test_without_xarray(smooth, monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    run = rondo.open(smooth)
    for call in (run.to_xarray, run.pod("velocity", "rectified").to_xarray):
        with pytest.raises(rondo.Error, match="apt-get install python3-xarray"):
            call()


# HTML

class Table(html.parser.HTMLParser):
    """Rows of cells of a table whose tags are all closed."""

    def __init__(self, text):
        super().__init__()
        self.open, self.rows = [], []
        self.feed(text)
        assert not self.open

    def handle_starttag(self, tag, attrs):
        self.open.append(tag)
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open[-1] in ("td", "th"):
            self.rows[-1][-1] += data


def test_tables_of_a_run_its_history_and_its_pod(smooth):
    run = rondo.open(smooth)
    assert ["nodes", str(run.mesh.n_nodes)] in Table(run._repr_html_()).rows
    rows = Table(run.history._repr_html_()).rows
    assert [row[0] for row in rows[1:]] == run.history.names
    force = rows[1 + run.history.names.index("force_y")]
    assert force[1] == "N/m" and float(force[3]) == pytest.approx(run.history["force_y"].max(), 1e-5)
    pod = run.pod("velocity", "rectified")
    assert [row[0] for row in Table(pod._repr_html_()).rows] == ["mode", "1", "2", "3"]


def test_texts_are_escaped(copy):
    text = (copy / "case.toml").read_text()
    title = next(line for line in text.splitlines() if line.startswith("title"))
    (copy / "case.toml").write_text(text.replace(title, 'title = "<script>1 & 2</script>"'))
    status = (copy / "run.json").read_text()
    (copy / "run.json").write_text(status.replace('"status"', '"message": "<b>", "status"', 1))
    shown = rondo.open(copy)._repr_html_()
    assert "<b>" not in shown and "<td>&lt;b&gt;</td>" in shown
    assert "<script>" not in shown and "&lt;script&gt;1 &amp; 2" in shown


def test_a_long_sweep_is_cut(tmp_path):
    members = [{sweeps.FRICTION: k / 1e4, **sweeps.forces(0.2, 33.0)} for k in range(10000)]
    sweep = rondo.open_sweep(sweeps.write(tmp_path / "long", [(sweeps.FRICTION, "-", "uniform")],
                                          members))
    text = sweep._repr_html_()
    rows = Table(text).rows
    assert len(rows) == 1 + MOST + 1 and len(text) < 20000
    assert rows[1][0] == "1" and rows[-1][0] == "10000" and set(rows[1 + MOST // 2]) == {"…"}
