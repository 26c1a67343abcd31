# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of docs/paper.md beside those of a study: each number that a study makes has its place in
STUDY, with what makes it; all other numbers of the page stand in GIVEN. A number in neither is a fault,
so that none can grow old unseen."""
from __future__ import annotations

import json
import math
import pathlib
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from program import ROOT

import rondo
from rondo.data.pod import Pod
from rondo.data.run import Run
from rondo.studies.paper_measures import Measures
from rondo.studies.paper_plan import read_plan

PAGE = ROOT / "docs" / "paper.md"
POWER = "10[⁻⁺⁰¹²³⁴⁵⁶⁷⁸⁹]+"
NUMBER = rf"([+−-]? ?(?:{POWER}|\d+(?:,\d{{3}})*(?:\.\d+)?(?:·{POWER})?))"
RAISED = str.maketrans("⁻⁺⁰¹²³⁴⁵⁶⁷⁸⁹", "-+0123456789")
SHARES = ("1e-02", "1e-04", "1e-06")
BODIES = ("smooth", "treaded")


class Study:
    """A whole study, and what the page says of it beside the table."""

    def __init__(self, directory: pathlib.Path) -> None:
        self.directory = directory
        self.plan = read_plan(ROOT / "studies" / "paper", quick=False)
        self.rows = {row["name"]: row for row in json.loads((directory / "paper.json").read_text())["table"]}
        self._measures = Measures(directory, self.plan)

    def measure(self, *measure: object) -> float:
        return self._measures.of(list(measure))

    @cached_property
    def paper(self) -> rondo.Paper:
        return rondo.open_paper(self.directory)

    def run(self, name: str) -> Run:
        return self.paper.run(name)

    def pod(self, run: str, field: str, frame: str) -> Pod:
        return self.paper.pod(run, field, frame)

    def size(self) -> float:
        """[GB]"""
        return 1e-9 * sum(file.stat().st_size for file in self.directory.rglob("*") if file.is_file())

    def snapshots_against_history(self) -> float:
        """Largest difference of the mean forces of the snapshots from those of the history, each over
        itself."""
        found = []
        for friction in ("0.0", "0.2", "0.4", "0.6"):
            run = self.run(f"friction-{friction}")
            assert run.contact is not None
            normal, shear = np.asarray(run.contact.force[:]).sum(axis=1).mean(axis=0)
            x, y = (abs(run.history.mean(name, run.times[0], None)) for name in ("force_x", "force_y"))
            found += [abs(normal / y - 1.0), abs(abs(shear) / x - 1.0) if x > 0.0 else abs(shear)]
        return float(max(found))

    def share_of_first_mode(self, body: str) -> float:
        return float(self.pod(f"turn-{body}", "velocity", "rectified").energy[0])

    def first_mode_varies(self, body: str) -> float:
        """Largest deviation of its coefficient from the mean, over the mean."""
        coefficient = self.pod(f"turn-{body}", "velocity", "rectified").coefficients[:, 0]
        return float(np.abs(coefficient / coefficient.mean() - 1.0).max())


@dataclass(frozen=True)
class Value:
    """What a study has where the page has a number: to the last digit of the page, and by `slack` of it
    where another compiler may give another one; `round_off`: not more than ten times the page's."""
    of: Callable[[Study], float]
    slack: float = 0.0
    round_off: bool = False


@dataclass(frozen=True)
class Piece:
    """A text of the page, with # where a number stands."""
    text: str
    values: tuple[Value, ...] = ()

    @property
    def pattern(self) -> str:
        return NUMBER.join(re.escape(part) for part in self.text.split("#"))


def ours(row: str, factor: float = 1.0, slack: float = 0.0) -> Value:
    return Value(lambda study: factor * study.rows[row]["ours"], slack)


def round_off(row: str) -> Value:
    return Value(lambda study: study.rows[row]["ours"], round_off=True)


def expected(row: str, factor: float = 1.0) -> Value:
    return Value(lambda study: factor * study.rows[row]["expected"])


def allowed(row: str, factor: float = 1.0) -> Value:
    """Of what is expected."""
    return Value(lambda study: factor * study.rows[row]["tolerance"] / abs(study.rows[row]["expected"]))


def against_expected(row: str, factor: float = 1.0, slack: float = 0.0) -> Value:
    return Value(lambda study: factor * (study.rows[row]["ours"] / study.rows[row]["expected"] - 1.0), slack)


def modes(run: str, pod: str) -> list[Value]:
    """Where the spectrum is flat a mode more or less is round-off."""
    def count(share: str) -> Value:
        def of(study: Study) -> float:
            return study.measure("modes_for", share, run, pod)
        return Value(of, 0.02)
    return [count(share) for share in SHARES]


def modes_of_pgd(body: str) -> list[Value]:
    def count(share: str) -> Value:
        return Value(lambda study: study.measure("modes_of_pgd", share, f"latin-{body}", f"crush-{body}"))
    return [count(share) for share in SHARES]


def info(run: str, key: str, slack: float) -> Value:
    return Value(lambda study: study.run(run).info[key], slack)


FORCE = 5e-5  # slack of forces: another compiler
COUNTS = "# / # / #"
BY_FIELD = f"{COUNTS} | {COUNTS} | {COUNTS} |"


def _table_of_modes() -> Iterator[Piece]:
    """Figure 5."""
    for body, n_snapshots in zip(BODIES, (595, 601)):
        for label, run, frame in (("rolling, co-rotating frame", "turn", "rotating"),
                                  ("rolling, rectified", "turn", "rectified"), ("crush", "crush", "rotating")):
            counts = [modes(f"{run}-{body}", f"{field}-{frame}") for field in
                      ("displacement", "velocity", "contact")]
            yield Piece(f"| {body} | {label} | {BY_FIELD}", tuple(sum(counts, [])))
        yield Piece(f"| {body} | crush, modes of LATIN-PGD | {COUNTS} |", tuple(modes_of_pgd(body)))
        turn = f"turn-{body}"
        yield Piece(f"| {body} | {n_snapshots} | {COUNTS} | {COUNTS} | {COUNTS} | {COUNTS} |", (
            *modes(turn, "velocity-rotating"), *modes(turn, "velocity-rectified"),
            *modes(turn, "displacement-rectified"), *modes(turn, "contact-rectified")))


def _table_of_friction() -> Iterator[Piece]:
    """Figure 4."""
    for friction in ("0.2", "0.4", "0.6"):
        y, x = (f"friction-{friction}-force-{axis}" for axis in "yx")
        yield Piece(f"| {friction} | # | # | # | # |",
                    (expected(y), ours(y, slack=FORCE), expected(x), ours(x, slack=FORCE)))


STUDY = (
    Piece("# GB of disk", (Value(Study.size),)),
    Piece("The table has # rows; all are as expected",
          (Value(lambda study: sum(row["pass"] for row in study.rows.values())),)),
    Piece("closed form # m, ± # % for the mesh | # m (# %)",
          (expected("damped-closed-form"), allowed("damped-closed-form", 100),
           ours("damped-closed-form", slack=1e-5), against_expected("damped-closed-form", 100))),
    Piece("stationary spin of the same mesh, ± # | # |",
          (allowed("damped-stationary"), against_expected("damped-stationary", slack=0.1))),
    Piece("undamped, swing of the last 0.1 s over that of the first | # | # (",
          (expected("undamped-swing"), ours("undamped-swing", slack=0.004))),
    Piece("| # m ± # % (axisymmetric solution by an independent code) | # m |",
          (expected("undamped-tangential"), allowed("undamped-tangential", 100),
           ours("undamped-tangential", slack=4e-4))),
    Piece("| undamped, mean | stationary spin of the same mesh | # % |",
          (against_expected("undamped-mean", 100),)),
    Piece("| ledger of energy | round-off | # of the energy |", (round_off("spin-up-ledger"),)),
    Piece("# % of the largest energy with the symplectic scheme (panel g;",
          (ours("printed-creates", 100),)),
    Piece("At 200 rad/s it is # times that energy by # s, where the run is stopped (panel h)",
          (ours("printed-blows-up", slack=0.1),
           Value(lambda study: study.run("spin-up-fast-as-printed").info["end_time"], 0.02))),
    Piece("| F_y, F_x, smooth, mean over t > 0.1 s | #, # N/m ± # % (independent code) | #, # |",
          (expected("turn-smooth-force-y"), expected("turn-smooth-force-x"),
           allowed("turn-smooth-force-y", 100),
           ours("turn-smooth-force-y", slack=FORCE), ours("turn-smooth-force-x", slack=FORCE))),
    Piece("| F_y, F_x, treaded | #, # N/m ± # % (independent code) | #, # |",
          (expected("turn-treaded-force-y"), expected("turn-treaded-force-x"),
           allowed("turn-treaded-force-y", 100),
           ours("turn-treaded-force-y", slack=FORCE), ours("turn-treaded-force-x", slack=FORCE))),
    Piece("| none but the polygon of the mesh | # %, at the passing of nodes, # Hz |",
          (ours("smooth-stationary", 100, 0.01),
           Value(lambda study: 180 * study.run("turn-smooth").case["motion"]["angular_velocity"]
                 / (2 * math.pi)))),
    Piece("pitch frequency 60 ω/2π = # Hz ± # Hz | # Hz |",
          (expected("treaded-frequency"), Value(lambda study: study.rows["treaded-frequency"]["tolerance"]),
           ours("treaded-frequency", slack=5e-4))),
    Piece("| that line, treaded over smooth | > # | # |",
          (expected("treaded-line"), ours("treaded-line", slack=0.05))),
    Piece("| ledger of energy, law of contact, all rolling runs | round-off | #, # |",
          (round_off("rolling-ledger"), round_off("contact-law"))),
    Piece("cause a ripple of # % that falls", (ours("smooth-stationary", 100),)),
    Piece("| 0 | # | # | 0 | 0 |",
          (expected("friction-0.0-force-y"), ours("friction-0.0-force-y", slack=FORCE))),
    *_table_of_friction(),
    Piece("(N/m, means over t > 0.095 s; independent code, ± # %.)", (allowed("friction-0.2-force-y", 100),)),
    Piece("which is that of the history to # %", (Value(lambda s: 100 * s.snapshots_against_history()),)),
    Piece(f"the velocity of the smooth disk takes {COUNTS} modes of # snapshots, of the treaded one {COUNTS} "
          f"of #; the crush {COUNTS} and {COUNTS}.",
          (*modes("turn-smooth", "velocity-rotating"), Value(lambda study: study.run("turn-smooth").n_snapshots),
           *modes("turn-treaded", "velocity-rotating"), Value(lambda study: study.run("turn-treaded").n_snapshots),
           *modes("crush-smooth", "velocity-rotating"), *modes("crush-treaded", "velocity-rotating"))),
    *_table_of_modes(),
    Piece(f"the direct crush, {COUNTS} and {COUNTS} of their modes",
          (*modes_of_pgd("smooth"), *modes_of_pgd("treaded"))),
    Piece("LATIN-PGD has # and # modes in the end, # and # at most on the way, and solves the body # and # times.",
          tuple(info(f"latin-{body}", key, 0.05) for key in ("modes", "modes_max", "solves") for body in BODIES)),
    Piece("The # and # snapshots are those of the code",
          tuple(Value(lambda study, run=f"turn-{body}": study.run(run).n_snapshots)  # type: ignore[misc]
                for body in BODIES)),
    Piece("The first mode, # % of the energy, is the steady rolling, constant in time to # %;",
          (Value(lambda study: 100 * study.share_of_first_mode("treaded")),
           Value(lambda study: 100 * study.first_mode_varies("treaded")))),
    Piece("the first mode holds # %", (Value(lambda study: 100 * study.share_of_first_mode("smooth")),)),
)

# What no study makes: what it is given (studies/paper/study.toml and the cases), what the paper says, what
# other commands make that stand beside it or in validation.md (V18, V20), times of a machine.
# In regular expressions, longer ones first.
GIVEN = (
    r"CSMA 2017", r"hal-\d+", r"Giacoma et al\. 2014", r"[Ff]igures? \d( to \d)?", r"decision \[007\b", r"\b7\.3\b",
    r"\bV\d+", r"about 15 s on two cores", r"elements: 6 s", r"second about 20 s", r"for μ = 0, 0\.2, 0\.4, 0\.6",
    r"\| 0\.2 m to 0\.3 m \| 0\.15 m to 0\.3 m \|",
    r"\| 12 layers, 180 columns \(90 where undamped at 50 rad/s: .*?0\.02 m deep \|",
    r"\| 5 MPa, ν = 0\.45, 1100 kg/m³ \| 20 MPa, ν = 0\.3, 1100 kg/m³ \|",
    r"150 1/s of mass \| 200 1/s of mass, 2·10⁻⁵ s of stiffness",
    r"\| 50 rad/s at once from rest; 200 rad/s \| 33\.3 rad/s, 10 m/s: 1 turn in 0\.1885 s; center 0\.01 m",
    r"ledge 0\.1 m high, corner rounded by 0\.02 m, friction 0\.3",
    r"damped, edge at 0\.3 s", r"displacement, first 0\.1 s", r"fastest at 88\.6 1/s at 200 rad/s", r"At 50 rad/s",
    r"at 0\.0125, 0\.0625 and 0\.1 s", r"0\.15 m before the ledge", r"0\.35 m before the ledge and touches it at 29 ms",
    r"the 180 nodes of the edge", r"center is held 0\.01 m", r"last snapshot, 0\.12 s", r"means over 251 snapshots",
    r"12 to 14 % below its limit: .*?1\.8978·10⁵ without friction",
    r"crush of the same disks to 0\.02 m", r"10⁻² / 10⁻⁴ / 10⁻⁶", r"10⁻[²⁴]", r"601 snapshots, ten a pitch",
    r"\| (smooth|treaded) \| (1190|2380|1201|2401) \|( \d+ / \d+ / \d+ \|){4}",
    r"is about 69 for the smooth and 31 for", r"modes 2 and 3 once a pitch",
)


def _words(text: str) -> str:
    return " ".join(text.split())


def page_text() -> str:
    """Its words in one line, without commands, comments, equations and targets of links."""
    text = PAGE.read_text()
    for out in (r"```.*?```", r"<!--.*?-->", r"`[^`\n]*`", r"\$.*?\$", r"\]\(.*?\)"):
        text = re.sub(out, " ", text, flags=re.DOTALL)
    return _words(text)


def number_of(text: str) -> tuple[float, float]:
    """A number of the page and half a unit of its last digit."""
    text = text.replace(" ", "").replace(",", "").replace("−", "-")
    if re.fullmatch(POWER, text):
        text = "1·" + text
    mantissa, _, power = text.partition("·10")
    scale = 10.0 ** int(power.translate(RAISED)) if power else 1.0
    decimals = len(mantissa.partition(".")[2])
    return float(mantissa) * scale, 0.5 * scale * 10.0 ** -decimals


def _is(found: str, value: Value, study: Study) -> bool:
    said, half = number_of(found)
    is_now = value.of(study)
    if value.round_off:
        return bool(0.0 <= is_now <= 10.0 * said)
    return bool(abs(said - is_now) <= 1.001 * half + value.slack * abs(is_now))


def stale(study: Study) -> list[str]:
    """Numbers of the page that this study does not find."""
    text, wrong = page_text(), []
    for piece in STUDY:
        found = re.search(_words(piece.pattern), text)
        assert found is not None, piece.text
        wrong += [f"{piece.text}: {said} on the page, {value.of(study):.6g} by the study"
                  for said, value in zip(found.groups(), piece.values, strict=True)
                  if not _is(said, value, study)]
    return wrong


def unplaced(text: str) -> list[str]:
    """Numbers of a text that are neither in STUDY nor in GIVEN, with the words around them; pieces that
    are not in it, or a piece of a study that is there twice."""
    wrong = []
    for piece in STUDY:
        text, count = re.subn(_words(piece.pattern), " … ", text)
        wrong += [f"{piece.text}: {count} times on the page, not once"] if count != 1 else []
    for given in GIVEN:
        text, count = re.subn(given, " … ", text)
        wrong += [f"{given}: is not on the page"] if count == 0 else []
    return wrong + [text[max(0, found.start() - 60):found.end() + 40]
                    for found in re.finditer(r"\d[\d.,]*", text)]
