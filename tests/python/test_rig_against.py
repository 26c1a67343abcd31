# SPDX-License-Identifier: BSD-3-Clause
"""Measurements beside a rig: TYDEX and CSV, rms differences by test and channel, states beyond the rig, refusals."""
import csv

import numpy as np
import pytest
import rigs

import rondo
from rondo import files, magic_formula
from rondo.rig import report
from rondo.rig.against import compare, rows_near

# A file of another machine: its channels, and what they are here.
CHANNELS = {"SLIPANGL": "slip_angle", "LONGSLIP": "slip_ratio", "INCLANGL": "camber", "INFLPRES": "pressure", "FX": "Fx",
            "FYW": "Fy", "FZW": "Fz", "MXW": "Mx", "MZW": "Mz"}


@pytest.fixture(scope="module")
def rig(tmp_path_factory):
    return rondo.open_rig(rigs.write(tmp_path_factory.mktemp("against") / "rig", rigs.all_tests()))


def measured(name, **factors):
    """Columns of the rows of a test, in TYDEX's names, each times a factor."""
    rows = rigs.all_tests()[name]
    return {channel: factors.get(channel, 1.0) * np.array([row[key] for row in rows]) for channel, key in CHANNELS.items()}


def write_csv(path, columns):
    with path.open("w", newline="") as stream:
        table = csv.writer(stream)
        table.writerow(columns)
        table.writerows(zip(*(values.tolist() for values in columns.values())))
    return path


def by_channel(comparison, test):
    return {one.channel: one for one in comparison.differences if one.test == test}


def test_a_factor_is_found_in_a_tydex_file(rig, tmp_path):
    """F_y 10 % larger: rms .1/1.1 of the rms of what is measured; all else as the rig to the digits of the file."""
    file = tmp_path / "measured.tdx"
    columns = measured("lateral", FYW=1.1)
    files.write_tydex(file, files.tydex(columns))
    found = by_channel(compare(rig, file), "lateral")
    assert set(found) == {"Fy", "Mx", "Mz"}
    rms = np.sqrt(np.mean((columns["FYW"] / 11) ** 2))
    assert found["Fy"].rms == pytest.approx(rms, rel=1e-3) and found["Fy"].rows == 195 and found["Fy"].beyond == 0
    assert found["Fy"].of_largest == pytest.approx(rms / np.abs(columns["FYW"]).max(), rel=1e-3)
    assert found["Mz"].of_largest < 1e-4 and found["Fy"].unit == "N"


@pytest.mark.parametrize("test, channel, words", [
    ("lateral", "MZW", "MZW has the other sign than the rig at 195 states (correlation -1.00)"),
    ("combined", "MZW", "combined: MZW has the other sign"), ("longitudinal", "FX", "a force that brakes is < 0")])
def test_a_sign_of_other_axes_is_told(rig, tmp_path, test, channel, words):
    """In the comparison, in the report and in the summary for rig.json; a file in our axes has no warning."""
    assert compare(rig, write_csv(tmp_path / "ours.csv", measured(test))).warnings == ()
    found = compare(rig, write_csv(tmp_path / "theirs.csv", measured(test, **{channel: -0.8})))
    text, = found.warnings
    assert words in text and "rondo.axes.convert" in text and found.summary["warnings"] == [text]
    assert "has the other sign than the rig" in report.write(rig, tmp_path / "report.html", found).read_text()


def test_all_tests_that_a_file_holds(rig, tmp_path):
    parts = [measured(name) for name in ("lateral", "longitudinal", "combined")]
    file = write_csv(tmp_path / "m.csv", {name: np.concatenate([part[name] for part in parts]) for name in CHANNELS})
    found = compare(rig, file)
    assert {one.test for one in found.differences} == {"lateral", "longitudinal", "combined"}
    assert [one for one in found.differences if one.of_largest > 1e-9] == []


def test_between_the_points_of_the_rig(rig, tmp_path):
    """Between two loads and two slip angles the rig is a straight line, which is a few percent off."""
    angle, load = np.radians(np.linspace(-4, 4, 33)), np.full(33, 3000.0)
    force = magic_formula.evaluate(rigs.truth(), slip_angle=angle, load=load, pressure=rigs.PRESSURE).Fy
    found = compare(rig, write_csv(tmp_path / "m.csv", {"SLIPANGL": angle, "FZW": load, "FYW": force}))
    one = by_channel(found, "lateral")["Fy"]
    low, high = (magic_formula.evaluate(rigs.truth(), slip_angle=np.radians(2.0), load=at, pressure=rigs.PRESSURE).Fy
                 for at in (2000.0, 4000.0))
    wanted = 0.5 * (low + high) - force[np.argmin(np.abs(angle - np.radians(2.0)))]
    assert 0.003 < one.of_largest < 0.05 and abs(one.mean) < one.rms and np.abs(wanted) < 3 * one.rms


def test_units_of_a_csv_file(rig, tmp_path):
    columns = measured("lateral")
    told = {"SLIPANGL [deg]": np.degrees(columns["SLIPANGL"]), "FZW (kN)": 1e-3 * columns["FZW"], "FYW [kN]": 1e-3 * columns["FYW"],
            "INFLPRES [bar]": 1e-5 * columns["INFLPRES"], "INCLANGL [deg]": np.degrees(columns["INCLANGL"]),
            "tread temperature": columns["FX"]}
    assert by_channel(compare(rig, write_csv(tmp_path / "m.csv", told)), "lateral")["Fy"].of_largest < 1e-9


def test_states_beyond_the_rig_are_counted(rig, tmp_path):
    columns = measured("lateral")
    columns["FZW"] = np.where(columns["FZW"] == 6000.0, 9000.0, columns["FZW"])
    one = by_channel(compare(rig, write_csv(tmp_path / "m.csv", columns)), "lateral")["Fy"]
    assert (one.rows, one.beyond) == (130, 65) and one.of_largest < 1e-9


def test_numbers_rounded_by_a_file_are_not_beyond(rig, tmp_path):
    """The last slip angle to four digits is larger than that of the rig; half a degree more is beyond it."""
    columns = measured("lateral")
    columns["SLIPANGL"] = np.sign(columns["SLIPANGL"]) * np.ceil(1e4 * np.abs(columns["SLIPANGL"])) * 1e-4
    assert by_channel(compare(rig, write_csv(tmp_path / "m.csv", columns)), "lateral")["Fy"].beyond == 0
    columns["SLIPANGL"] = columns["SLIPANGL"] + np.radians(0.5)
    assert by_channel(compare(rig, write_csv(tmp_path / "m.csv", columns)), "lateral")["Fy"].beyond == 15


def test_another_camber_is_not_compared(rig, tmp_path):
    columns = measured("lateral")
    columns["INCLANGL"] = columns["INCLANGL"] + np.radians(2.0)
    with pytest.raises(rondo.InputError, match=r"no state within the points of the rig.*camber.*run the rig with the loads"):
        compare(rig, write_csv(tmp_path / "m.csv", columns))


def test_standing_wheel(rig, tmp_path):
    """Heights 1 mm larger: the load is that of a deflection of 1 mm less."""
    depth = np.linspace(.007, .028, 12)
    load = rigs.SOFT * depth + rigs.STIFF * depth ** 2
    file = write_csv(tmp_path / "m.csv", {"DSTGRWHC": rigs.RADIUS - depth + .001, "FZW": load, "INFLPRES": np.full(12, rigs.PRESSURE)})
    one = by_channel(compare(rig, file), "vertical")["Fz"]
    assert one.mean == pytest.approx(-(rigs.SOFT + 2 * rigs.STIFF * .0165) * .001, rel=0.02)


def test_a_wheel_without_air_agrees_with_any_pressure(tmp_path):
    rows = [row | {"pressure": ""} for row in rigs.all_tests()["lateral"] if row["pressure"] == rigs.PRESSURE]
    found = compare(rondo.open_rig(rigs.write(tmp_path / "rig", {"lateral": rows})),
                    write_csv(tmp_path / "m.csv", measured("lateral")))
    one = by_channel(found, "lateral")["Fy"]
    assert one.rows == 195 and 0 < one.of_largest < 0.1  # as the rows at other pressures differ


def test_table_and_summary(rig, tmp_path):
    found = compare(rig, write_csv(tmp_path / "m.csv", measured("lateral", FYW=1.1)))
    rows = list(csv.DictReader(found.write(tmp_path / "against.csv").open()))
    assert [row["channel"] for row in rows] == ["Fy", "Mx", "Mz"] and float(rows[0]["rms"]) == found.differences[0].rms
    assert found.summary["file"].endswith("m.csv") and found.summary["differences"][0]["rows"] == 195
    assert found.lines[0].startswith("lateral: Fy: rms ") and "% of the largest measured" in found.lines[0]


def test_measurements_near_a_curve(rig, tmp_path):
    """What is drawn beside the curves of 4 kN."""
    found = compare(rig, write_csv(tmp_path / "m.csv", measured("lateral")))
    near = rows_near(found, "lateral", {"load": 4000.0, "camber": 0.0, "pressure": rigs.PRESSURE})
    assert len(near["Fy"]) == 13 and set(near["load"]) == {4000.0}
    assert rows_near(found, "combined", {"load": 4000.0}) is None


@pytest.mark.parametrize("columns, told", [
    ({"TIME": [0.0], "TEMP": [20.0]}, "its channels are TIME, TEMP.*needed: one or more of SLIPANGL, LONGSLIP.*FYW"),
    ({"SLIPANGL": [0.1], "FZW": [4e3]}, "its channels are SLIPANGL, FZW.*needed"),
    ({"DSTGRWHC": [.3, .29], "FX": [4e3, 1e3]}, "no channel in common.*found DSTGRWHC, FX.*needed: vertical: DSTGRWHC, FZW"),
    ({"SLIPANGL": [-8.0, 8.0], "FZW": [4e3, 4e3], "FYW": [3e3, -3e3]}, r"SLIPANGL reaches 8 rad.*SLIPANGL \[deg\]"),
    ({"SLIPANGL": [-.1, .1], "FZW": [4e3, 4e3], "FYW": [3e3, -3e3], "INFLPRES": [2.2, 2.2]}, r"2.2 Pa.*INFLPRES \[kPa\]"),
    ({"SLIPANGL": [-.1, .1], "FZW": [-4e3, -4e3], "FYW": [3e3, -3e3]}, "FZW is below 0.*rondo.axes.convert"),
    ({"SLIPANGL": [-.05, 0.0, .05], "FZW": [4e3] * 3, "FYW": [-3e3, 0.0, 3e3]}, "FYW grows with SLIPANGL.*rondo.axes.convert"),
    ({"SLIPANGL [furlong]": [-.1], "FZW": [4e3], "FYW": [3e3]}, "column 'SLIPANGL.*unit 'furlong'.*allowed.*rad"),
])
def test_refusals(rig, tmp_path, columns, told):
    file = write_csv(tmp_path / "m.csv", {name: np.array(values) for name, values in columns.items()})
    with pytest.raises(rondo.InputError, match=told):
        compare(rig, file)


@pytest.mark.parametrize("name, text, told", [
    ("m.csv", "SLIPANGL,FZW,FYW\n0.1,4000,x\n", "row 2.*column 'FYW': 'x' is no number"),
    ("m.tdx", "**HEADER\n", "m.tdx.*line"), ("m.xlsx", "", "measurements as .xlsx.*TYDEX, .tdx, or .csv")])
def test_damaged_files(rig, tmp_path, name, text, told):
    (tmp_path / name).write_text(text)
    with pytest.raises(rondo.Error, match=told):
        compare(rig, tmp_path / name)


def test_a_missing_file(rig, tmp_path):
    with pytest.raises(rondo.Error, match="missing.csv"):
        compare(rig, tmp_path / "missing.csv")


def test_a_rig_without_points(tmp_path):
    empty = rondo.open_rig(rigs.write(tmp_path / "rig", {}))
    with pytest.raises(rondo.InputError, match="needed: a rig with points"):
        compare(empty, write_csv(tmp_path / "m.csv", measured("lateral")))
