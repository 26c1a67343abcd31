# SPDX-License-Identifier: BSD-3-Clause
"""rondo.files.read_tydex and write_tydex: a file written here by its columns, foreign ones, round trips, and
damaged ones, each refused with its line and reason."""
import numpy as np
import pytest
from damage import spoilt

import rondo
from rondo import files

# Columns:  1         11                            41        51        61        71
TEXT = """\
**HEADER
RELEASE   Release of the format         1.3
MEASID    Measurement                   steering sweep 4 kN
SUPPLIER  Data supplier                 The tests
**COMMENTS
Written by hand, by the columns of the format.
! a line of the comments
**CONSTANTS
NOMWIDTH  Nominal section width         mm        205
LOCATION  Location                                road 3, dry
INFLPRES  Inflation pressure            kPa       220
**MEASURCHANNELS
RUNTIME   Time                          s         1         0         0
SLIPANGL  Slip angle                    deg       1         0         0
LONGSLIP  Longitudinal slip             %         0.5       0         0
FYW       Lateral force                 kN        1
TEMP1     Temperature of the tread      degC
**MEASURDATA
 0.000    -1.0      0.0       0.7512    21.5
 0.010    0.0       2.0       -3.0e-3   NOTAVAIL
 0.020    1.0       -4.0      -0.7488   23.0
**MODELPARAMETERS
FNOMIN    Nominal load                  N         4000
**END
"""
LINES = TEXT.split("\n")


def written(folder, text, name="file.tdx", encoding="utf-8"):
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode(encoding))
    return path


def test_what_is_read(tmp_path):
    tydex = files.read_tydex(written(tmp_path, TEXT))
    assert tydex.header == {"RELEASE": "1.3", "MEASID": "steering sweep 4 kN", "SUPPLIER": "The tests"}
    assert tydex.comments == ("Written by hand, by the columns of the format.", "! a line of the comments")
    width = tydex.constants["NOMWIDTH"]
    assert (width.name, width.text, width.unit, width.si) == ("NOMWIDTH", "Nominal section width", "mm", "m")
    assert width.value == pytest.approx(0.205, rel=1e-15)
    assert tydex.constants["INFLPRES"].value == 220e3
    assert tydex.constants["LOCATION"].value == "road 3, dry"
    assert tydex.parameters["FNOMIN"].value == 4000.0
    assert list(tydex.channels) == ["RUNTIME", "SLIPANGL", "LONGSLIP", "FYW", "TEMP1"]
    assert [one.si for one in tydex.channels.values()] == ["s", "rad", "1", "N", "degC"]
    assert len(tydex) == 3 and tydex.data.shape == (3, 5) and "FYW" in tydex and "FX" not in tydex
    np.testing.assert_allclose(tydex["SLIPANGL"], np.radians([-1, 0, 1]))
    np.testing.assert_allclose(tydex["LONGSLIP"], [0, 0.01, -0.02])  # per cent, times its factor
    np.testing.assert_allclose(tydex["FYW"], [751.2, -3.0, -748.8])
    np.testing.assert_array_equal(tydex["TEMP1"], [21.5, np.nan, 23.0])
    with pytest.raises(rondo.UnknownNameError, match="FZW.*SLIPANGL"):
        tydex["FZW"]


def block(name):
    """The lines of a block, with its keyword."""
    begin = LINES.index(f"**{name}")
    end = next(k for k in range(begin + 1, len(LINES)) if LINES[k].startswith("**"))
    return LINES[begin:end]


@pytest.mark.parametrize("change", [
    pytest.param(lambda: TEXT.replace("\n", "\r\n"), id="CRLF"),
    pytest.param(lambda: TEXT.replace("\n", "\r"), id="CR"),
    pytest.param(lambda: "\n".join([*block("MEASURDATA"), *block("MODELPARAMETERS"), *block("MEASURCHANNELS"),
                                    *block("CONSTANTS"), *block("COMMENTS"), *block("HEADER"), "**END"]), id="other order"),
    pytest.param(lambda: TEXT.replace("**MEASURDATA", "! said\n**measurdata 3\n\n! and done"), id="comments, counted rows"),
    pytest.param(lambda: "\ufeff" + TEXT, id="mark of UTF-8"),
    pytest.param(lambda: TEXT + "\n\n\x1a", id="end of DOS"),
    pytest.param(lambda: TEXT.replace("-3.0e-3   ", "-3.0D-03  "), id="exponent of Fortran"),
    pytest.param(lambda: TEXT.replace("-1.0      0.0       0.7512    ", "\t-1.0 0.0\t0.7512  "), id="tabulators between numbers"),
    pytest.param(lambda: TEXT.replace(" 0.010    0.0       2.0       -3.0e-3   NOTAVAIL",
                                      " 0.0100000       0.02.00000000-0.0030000  NOTAVAIL"), id="numbers that touch")])
def test_foreign_files(tmp_path, change):
    usual, other = files.read_tydex(written(tmp_path, TEXT)), files.read_tydex(written(tmp_path, change(), "o.tdx"))
    np.testing.assert_array_equal(other.data, usual.data)
    assert other.channels == usual.channels and other.header == usual.header and other.constants == usual.constants


def test_missing_blocks_and_latin_1(tmp_path):
    text = "\n".join([*block("MEASURCHANNELS"), *block("MEASURDATA"), "**END"])
    few = files.read_tydex(written(tmp_path, text))
    assert few.header == {} and few.comments == () and few.constants == {} and few.data.shape == (3, 5)
    none = files.read_tydex(written(tmp_path, "**HEADER\n**END\n"))
    assert none.data.shape == (0, 0) and len(none) == 0
    degrees = files.read_tydex(written(tmp_path, TEXT.replace("deg       1", "\u00b0         1"), encoding="latin-1"))
    np.testing.assert_allclose(degrees["SLIPANGL"], np.radians([-1, 0, 1]))


def test_rows_in_lines_of_eight(tmp_path):
    """Ten channels: a row in one line, or in lines of at most 80 columns."""
    names = [f"C{k}" for k in range(10)]
    channels = "\n".join(f"{name:<10}{'':<30}{'m':<10}1" for name in names)
    rows = np.arange(20.0).reshape(2, 10)
    one = "\n".join("".join(f"{x:10.3f}" for x in row) for row in rows)
    wrapped = "\n".join(part for row in rows for part in ("".join(f"{x:10.3f}" for x in row[:8]),
                                                          "".join(f"{x:10.3f}" for x in row[8:])))
    for data in (one, wrapped):
        path = written(tmp_path, f"**MEASURCHANNELS\n{channels}\n**MEASURDATA\n{data}\n**END\n")
        np.testing.assert_array_equal(files.read_tydex(path).data, rows)


def line_of(text):
    return next(k for k, line in enumerate(LINES, start=1) if text in line)


DAMAGED = {  # what is done to the file: the line that is named (0: none), and words of the reason
    "no END": (lambda: TEXT.replace("**END\n", ""), len(LINES) - 1, r"without \*\*END"),
    "behind END": (lambda: TEXT + "1.0\n", len(LINES), r"behind \*\*END"),
    "text before": (lambda: "some text\n" + TEXT, 1, "before the first keyword"),
    "unknown keyword": (lambda: TEXT.replace("**MEASURDATA", "**MESURDATA"), line_of("**MEASURDATA"), r"\*\*MEASURDATA\?"),
    "keyword twice": (lambda: TEXT.replace("**MODELPARAMETERS", "**CONSTANTS"), line_of("**MODELP"), "line 8"),
    "no data": (lambda: "\n".join([*block("MEASURCHANNELS"), "**END"]), 1, "there is no"),
    "no channels": (lambda: "\n".join([*block("MEASURDATA"), "**END"]), 1, "nothing says what"),
    "a number less": (lambda: TEXT.replace(" 0.7512    21.5", " 21.5"), line_of("0.7512"), "4 numbers in a row of 5"),
    "a number more": (lambda: TEXT.replace("21.5", "21.5 1"), line_of("21.5"), "6 numbers in a row of 5"),
    "no number": (lambda: TEXT.replace("0.7512", "0.75l2"), line_of("0.7512"), "field 4 of 5"),
    "decimal comma": (lambda: TEXT.replace("0.7512", "0,7512"), line_of("0.7512"), "decimal point"),
    "not finite": (lambda: TEXT.replace("0.7512", "1e999 "), line_of("0.7512"), "too large"),
    "nan": (lambda: TEXT.replace("0.7512", "nan   "), line_of("0.7512"), "is no number"),
    "hexadecimal": (lambda: TEXT.replace("0.7512", "0x1.8p"), line_of("0.7512"), "is no number"),
    "unknown unit": (lambda: TEXT.replace("kN        1", "kilo      1"), line_of("FYW"), "'kilo' of FYW"),
    "unit of two meanings": (lambda: TEXT.replace("kN        1", "g         1"), line_of("FYW"), "'g' of FYW"),
    "unit of constant": (lambda: TEXT.replace("kPa       220", "Pask      220"), line_of("INFLPRES"), "'Pask' of INFLPRES"),
    "text too long": (lambda: TEXT.replace("Lateral force                 kN", "Lateral force of the ground on it kN"),
                      line_of("FYW"), "is not known"),
    "factor 0": (lambda: TEXT.replace("%         0.5", "%         0.0"), line_of("LONGSLIP"), "any number but 0"),
    "factor a text": (lambda: TEXT.replace("%         0.5", "%         x.5"), line_of("LONGSLIP"), "conversion factor of LONGSLIP"),
    "offset": (lambda: TEXT.replace("s         1         0", "s         1         5"), line_of("RUNTIME"), "offset 5 of RUNTIME"),
    "too many numbers": (lambda: TEXT.replace("s         1 ", "s         1 2 "), line_of("RUNTIME"), "4 numbers behind"),
    "channel twice": (lambda: TEXT.replace("TEMP1 ", "FYW   "), line_of("TEMP1"), f"line {line_of('FYW')}"),
    "shifted columns": (lambda: TEXT.replace("FYW       Lateral", "FYW Lateral"), line_of("FYW"), "is no name"),
    "indented": (lambda: TEXT.replace("NOMWIDTH  ", "          "), line_of("NOMWIDTH"), "is no name"),
    "tabulator": (lambda: TEXT.replace("FYW       Lat", "FYW\tLat"), line_of("FYW"), "tabulator"),
    "no value": (lambda: TEXT.replace("kPa       220", "220"), line_of("INFLPRES"), "has no value"),
    "constant with comma": (lambda: TEXT.replace("kPa       220", "kPa       2,20"), line_of("INFLPRES"), "decimal point"),
    "rows missing": (lambda: TEXT.replace("**MEASURDATA", "**MEASURDATA 4"), line_of("**MEASURDATA"), "3 rows"),
    "cut row": (lambda: "**MEASURCHANNELS\n" + "".join(f"C{k:<9}{'':<30}m\n" for k in range(9)) +
                "**MEASURDATA\n1 2 3 4 5 6 7 8\n**END\n", 12, "8 of 9 numbers"),
    "bytes": (lambda: TEXT.encode() + b"\0\0", 0, "no text")}


@pytest.mark.parametrize("name", DAMAGED)
def test_damaged_files(tmp_path, name):
    change, line, words = DAMAGED[name]
    path = written(tmp_path, change())
    with pytest.raises(rondo.FileError, match=words) as caught:
        files.read_tydex(path)
    assert str(caught.value).startswith(f"{path}, line {line}: " if line else f"{path}: ")
    assert "allowed: " in str(caught.value)


def test_there_are_twenty():
    assert len(DAMAGED) >= 20


def test_round_trip_to_the_printed_digits(tmp_path):
    """What is read and written again is the same numbers to the last bit, and the second file is the first."""
    rng = np.random.default_rng(5)
    columns = {"RUNTIME": np.arange(200) / 100, "SLIPANGL": np.radians(rng.uniform(-12, 12, 200)),
               "FYW": rng.normal(0, 3000, 200) * 10.0 ** rng.integers(-6, 6, 200), "FZW": 4000.0,
               "MZW": np.where(rng.random(200) < 0.1, np.nan, rng.normal(0, 50, 200)), "LONGSLIP": np.zeros(200),
               "INFLPRES": 2.2e5, "INCLANGL": 0.0, "WHROTSPD": np.full(200, 1 / 3)}
    made = files.tydex(columns, header={"RELEASE": "1.3"}, comments=["Made by a test", "", "of two lines"],
                       constants=[files.Constant("NOMWIDTH", "Nominal width", "mm", 0.205, "m"),
                                  files.Constant("NOTE", "", "", "a text")], units={"WHROTSPD": "1/min"})
    first = files.write_tydex(tmp_path / "first.tdx", made)
    read = files.read_tydex(first)
    second = files.write_tydex(tmp_path / "second.tdx", read)
    assert second.read_bytes() == first.read_bytes()
    again = files.read_tydex(second)
    np.testing.assert_array_equal(again.data, read.data)
    np.testing.assert_allclose(read.data, made.data, rtol=5e-4)  # sign, point and exponent leave four digits
    assert read.comments == made.comments and read.header == made.header
    assert read.constants["NOMWIDTH"].value == pytest.approx(0.205, rel=1e-15)
    assert all(len(line) <= 80 for line in first.read_text().splitlines()[:30] if not line.startswith(" "))
    assert {line[10 * k] for line in first.read_text().splitlines() if line.startswith(" ") for k in range(9)} == {" "}


def test_round_trip_of_a_foreign_file(tmp_path):
    read = files.read_tydex(written(tmp_path, TEXT))
    again = files.read_tydex(files.write_tydex(tmp_path / "again.tdx", read))
    np.testing.assert_array_equal(again.data, read.data)
    assert again.channels == read.channels and again.constants == read.constants and again.parameters == read.parameters


@pytest.mark.parametrize("make, words", [
    (lambda: files.tydex({"LONGNAMES": [1.0]}), "1 to 8 characters"),
    (lambda: files.tydex({"F X": [1.0]}), "without blanks"),
    (lambda: files.tydex({"FX": [1.0]}, texts={"FX": "x" * 31}), "at most 30"),
    (lambda: files.tydex({"FX": [1.0]}, comments=["**END"]), "COMMENTS"),
    (lambda: files.tydex({"FX": [1.0]}, comments=["x" * 81]), "COMMENTS"),
    (lambda: files.tydex({"FX": [1.0]}, header={"RELEASE": "x" * 41}), "at most 40"),
    (lambda: files.tydex({"FX": [np.inf]}), "finite"),
    (lambda: files.tydex({"FX": [1.0]}, units={"FX": "stone"}), "'stone' is not known"),
    (lambda: files.tydex({"FX": [1.0, 2.0], "FYW": [1.0, 2.0, 3.0]}), r"shape \(2,\)")])
def test_what_does_not_fit(tmp_path, make, words):
    with pytest.raises(rondo.InputError, match=words):
        files.write_tydex(tmp_path / "file.tdx", make())
    assert not (tmp_path / "file.tdx").exists()


def test_no_file(tmp_path):
    with pytest.raises(rondo.Error, match="no such file"):
        files.read_tydex(tmp_path / "none.tdx")
    with pytest.raises(rondo.FileError, match="directory"):
        files.read_tydex(tmp_path)
    with pytest.raises(rondo.FileError, match="cannot be written"):
        files.write_tydex(tmp_path / "none" / "file.tdx", files.tydex({"FX": [1.0]}))


def test_any_damage_is_read_or_refused(tmp_path):
    """Bytes, lines and pieces of the file changed at random, seeded: a Tydex or a FileError, and nothing else."""
    rng = np.random.default_rng(8)
    refused = 0
    for _ in range(600):
        path = written(tmp_path, spoilt(TEXT, rng))
        try:
            assert files.read_tydex(path).data.ndim == 2
        except rondo.FileError as reason:
            refused += 1
            assert str(reason).startswith(str(path))
    assert 200 < refused < 600
