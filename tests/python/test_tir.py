# SPDX-License-Identifier: BSD-3-Clause
"""rondo.files.read_tir and write_tir: units, sections, comments and tables of files as other programs write them,
round trips, and files that are refused with their line and reason."""
import numpy as np
import pytest
from damage import spoilt
from tyre_sets import APPENDIX_3, appendix_3

import rondo
from rondo import files

TEXT = """\
$---------------------------------------------------header
! a tyre of the tests
[MDI_HEADER]
FILE_TYPE                ='tir'
FILE_VERSION             = 3.0
FILE_FORMAT              ='ASCII'
! : COMMENT :  a comment inside a section
[UNITS]
 LENGTH  = 'mm'
 FORCE   = 'kN'
 ANGLE   = 'radians'
 MASS    = 'gram'
 TIME    = 'second'
[MODEL]
PROPERTY_FILE_FORMAT     = 'MF-TYRE'
FITTYP                   = 61                $version
TYRESIDE                 = 'LEFT'
LONGVL                   = 16700.0           ! mm/s
[DIMENSION]
UNLOADED_RADIUS          = 313.5
[SHAPE]
{radial width}
 1.0    0.0
 1.0    0.4
[OPERATING_CONDITIONS]
NOMPRES                  = 2.2D-4            $kN/mm2
[INERTIA]
MASS                     = 9300
[VERTICAL]
FNOMIN                   = 4
VERTICAL_STIFFNESS       = 0.2               $kN/mm
OWN_KEY                  = 7
[SCALING_COEFFICIENTS]
LMUX                     = 0.9
[LATERAL_COEFFICIENTS]
PKY1                     = -15.324
pky2                     = 1.715
"""
LINES = TEXT.split("\n")


def written(folder, text, name="file.tir"):
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def test_what_is_read(tmp_path):
    tir = files.read_tir(written(tmp_path, TEXT))
    assert tir.fittyp == 61 and tir.version == "MF 6.1"
    assert tir["UNLOADED_RADIUS"] == pytest.approx(0.3135) and tir["FNOMIN"] == pytest.approx(4000.0)
    assert tir["LONGVL"] == pytest.approx(16.7) and tir["NOMPRES"] == pytest.approx(2.2e5)
    assert tir["MASS"] == pytest.approx(9.3) and tir["VERTICAL_STIFFNESS"] == pytest.approx(2e5)
    assert tir["PKY1"] == -15.324 and tir["PKY2"] == 1.715 and tir["TYRESIDE"] == "LEFT"
    assert tir.number("LMUX") == 0.9 and tir.number("LMUY") == 1.0 and tir.number("PKY4") == 2.0 and tir.number("PCX1") == 0.0
    assert tir.tables == {"SHAPE": ("{radial width}", " 1.0    0.0", " 1.0    0.4")}
    assert tir.unknown == ("VERTICAL/OWN_KEY",) and tir["OWN_KEY"] == 7.0
    assert "a tyre of the tests" in tir.comments[1]
    with pytest.raises(rondo.UnknownNameError, match="PCX1.*PKY1"):
        tir["PCX1"]
    with pytest.raises(rondo.InputError, match="TYRESIDE = 'LEFT' is no number"):
        tir.number("TYRESIDE")


@pytest.mark.parametrize("change", [
    pytest.param(lambda: TEXT.replace("\n", "\r\n"), id="CRLF"),
    pytest.param(lambda: TEXT.replace("[MODEL]", "[MODEL] $ the model").replace("pky2", "  PKY2"), id="comments, blanks"),
    pytest.param(lambda: TEXT.replace("'MF-TYRE'", "\"mf-tyre\"").replace("'mm'", "mm"), id="quotes"),
    pytest.param(lambda: TEXT.replace("[VERTICAL]", "[vertical]"), id="small letters"),
    pytest.param(lambda: "\ufeff" + TEXT + "\x1a", id="marks")])
def test_foreign_files(tmp_path, change):
    usual, other = files.read_tir(written(tmp_path, TEXT)), files.read_tir(written(tmp_path, change(), "o.tir"))
    assert {key: value for key, value in other.items() if key != "PROPERTY_FILE_FORMAT"} == \
        {key: value for key, value in usual.items() if key != "PROPERTY_FILE_FORMAT"}


def test_what_other_programs_leave_open(tmp_path):
    """Values that are missing, empty texts, tables without a head, keys behind a table."""
    text = TEXT.replace("{radial width}\n", "").replace(" 1.0    0.4\n", " 1.0    0.4\nSHAPE_KEY = 3\n")
    text = text.replace("MASS                     = 9300", "MASS = $ not measured\nIXX =").replace("'LEFT'", "''")
    tir = files.read_tir(written(tmp_path, text))
    assert tir.tables == {"SHAPE": (" 1.0    0.0", " 1.0    0.4")} and tir["SHAPE_KEY"] == 3.0
    assert "MASS" not in tir and "IXX" not in tir and tir["TYRESIDE"] == ""
    again = files.read_tir(files.write_tir(tmp_path / "again.tir", tir))
    assert again.sections == tir.sections and again.tables == tir.tables


@pytest.mark.parametrize("model, fittyp, version", [
    ("PROPERTY_FILE_FORMAT = 'PAC2002'", 6, "MF 5.2"), ("PROPERTY_FILE_FORMAT = 'PAC2002'\nFITTYP = 6", 6, "MF 5.2"),
    ("PROPERTY_FILE_FORMAT = 'MF-TYRE'\nFITTYP = 6", 6, "MF 5.2"), ("FITTYP = 62", 62, "MF 6.2")])
def test_versions(tmp_path, model, fittyp, version):
    text = TEXT.replace("PROPERTY_FILE_FORMAT     = 'MF-TYRE'\nFITTYP                   = 61                $version", model)
    tir = files.read_tir(written(tmp_path, text))
    assert (tir.fittyp, tir.version) == (fittyp, version)


def line_of(text):
    return next(k for k, line in enumerate(LINES, start=1) if text in line)


REFUSED = {
    "another model": (lambda: TEXT.replace("'MF-TYRE'", "'FTIRE'"), line_of("FITTYP"), "another tyre model"),
    "another version": (lambda: TEXT.replace("= 61 ", "= 5 "), line_of("FITTYP"), "FITTYP 5.0"),
    "no version": (lambda: TEXT.replace("FITTYP  ", "FITTYPE "), line_of("PROPERTY"), "61 or 62"),
    "no model": (lambda: TEXT.replace("[MODEL]", "[MODELS]"), line_of("FITTYP"), "neither PROPERTY_FILE_FORMAT nor"),
    "no units": (lambda: TEXT[:TEXT.index("[UNITS]")] + TEXT[TEXT.index("[MODEL]"):], 0, r"no section \[UNITS\]"),
    "a unit missing": (lambda: TEXT.replace(" FORCE   = 'kN'\n", ""), line_of("[UNITS]"), "FORCE = 'missing'"),
    "unknown unit": (lambda: TEXT.replace("'kN'", "'ton'"), line_of("FORCE"), "FORCE = 'ton'"),
    "degrees": (lambda: TEXT.replace("'radians'", "'degrees'"), line_of("ANGLE"), "convert the file to radians"),
    "no load": (lambda: TEXT.replace("FNOMIN ", "FNOMN "), 0, "no FNOMIN"),
    "load 0": (lambda: TEXT.replace("= 4\n", "= 0\n"), line_of("FNOMIN"), "above 0"),
    "radius below 0": (lambda: TEXT.replace("313.5", "-313.5"), line_of("UNLOADED"), "above 0"),
    "no number": (lambda: TEXT.replace("-15.324", "-15.3x4"), line_of("PKY1"), "PKY1 = '-15.3x4' is no number"),
    "decimal comma": (lambda: TEXT.replace("-15.324", "-15,324"), line_of("PKY1"), "decimal point"),
    "no value": (lambda: TEXT.replace("= -15.324", "= $ none"), line_of("PKY1"), "PKY1 has no value"),
    "no equals": (lambda: TEXT.replace("PKY1                     =", "PKY1"), line_of("PKY1"), "KEY = value"),
    "too large": (lambda: TEXT.replace("-15.324", "-1e999"), line_of("PKY1"), "too large"),
    "key twice": (lambda: TEXT.replace("pky2", "PKY1"), line_of("pky2"), f"line {line_of('PKY1')}"),
    "two values": (lambda: TEXT.replace("OWN_KEY                  = 7", "PKY1 = 3"), line_of("PKY1"), r"one value"),
    "section twice": (lambda: TEXT.replace("[SCALING_COEFFICIENTS]", "[MODEL]"), line_of("[SCALING"), f"line {line_of('[MODEL]')}"),
    "no section": (lambda: TEXT.replace("[MDI_HEADER]\n", ""), line_of("FILE_TYPE") - 1, "before the first section"),
    "open bracket": (lambda: TEXT.replace("[INERTIA]", "[INERTIA"), line_of("[INERTIA]"), "is no section"),
    "bytes": (lambda: TEXT.encode() + b"\0", 0, "no text")}


@pytest.mark.parametrize("name", REFUSED)
def test_refused_files(tmp_path, name):
    change, line, words = REFUSED[name]
    path = written(tmp_path, change())
    with pytest.raises(rondo.FileError, match=words) as caught:
        files.read_tir(path)
    assert str(caught.value).startswith(f"{path}, line {line}: " if line else f"{path}: ")
    assert "allowed: " in str(caught.value)


def test_round_trip(tmp_path):
    """All digits, tables and foreign keys; sections and keys in the order of the format."""
    for tir in (files.read_tir(written(tmp_path, TEXT)), appendix_3(), files.tir({"FNOMIN": 1e3 / 3, "UNLOADED_RADIUS": 0.3}, 62)):
        first = files.write_tir(tmp_path / "first.tir", tir)
        again = files.read_tir(first)
        assert again.sections == tir.sections and again.fittyp == tir.fittyp and again.tables == tir.tables
        assert files.write_tir(tmp_path / "second.tir", again).read_bytes() == first.read_bytes()
    text = files.write_tir(tmp_path / "order.tir", files.tir(dict(reversed(APPENDIX_3.items())))).read_text()
    places = [text.index(word) for word in ("[UNITS]", "[MODEL]", "LONGVL", "FNOMIN", "PCX1", "PDX1", "QSX1", "PCY1", "QSY1",
                                            "QBZ1", "SSZ1")]
    assert places == sorted(places)


def test_with_values(tmp_path):
    tir = appendix_3().with_values({"PKY1": -20.0, "LMUX": 0.5})
    assert tir["PKY1"] == -20.0 and tir.sections["SCALING_COEFFICIENTS"] == {"LMUX": 0.5}
    assert appendix_3()["PKY1"] == APPENDIX_3["PKY1"]
    with pytest.raises(rondo.InputError, match="PKY99: no key"):
        tir.with_values({"PKY99": 1.0})
    with pytest.raises(rondo.InputError, match="FITTYP 5"):
        files.tir({}, 5)
    for wrong in (np.nan, "it's"):
        with pytest.raises(rondo.InputError, match="allowed"):
            files.write_tir(tmp_path / "file.tir", tir.with_values({"PKY1": wrong}))


def test_any_damage_is_read_or_refused(tmp_path):
    """As of TYDEX files."""
    rng = np.random.default_rng(9)
    refused = 0
    for _ in range(600):
        path = written(tmp_path, spoilt(TEXT, rng))
        try:
            assert files.read_tir(path).number("FNOMIN") > 0
        except rondo.FileError as reason:
            refused += 1
            assert str(reason).startswith(str(path))
    assert 100 < refused < 600
