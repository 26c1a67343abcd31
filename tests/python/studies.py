# SPDX-License-Identifier: BSD-3-Clause
"""What tests of `rondo paper` share: its calls, its record, a study of small runs."""
import json
import pathlib
import subprocess
import sys

from program import SMALL

# A run with two PODs, one that blows up by its numbers, as it should, and one that takes long.
SMALL_STUDY = """title = "small"
[[run]]
name = "long"
case = "small.toml"
set = ["time.end=END", "output.snapshots=0"]
[[run]]
name = "rolls"
case = "small.toml"
full = ["output.snapshots=41"]
[[run]]
name = "blows-up"
case = "small.toml"
set = ["motion.angular_velocity=2000", "time.end=0.3", "output.snapshots=0"]
may_fail = true
[pod]
modes = 2
fields = ["velocity", "contact"]
frames = { rolls = ["rotating"] }
[counts]
figure = 2
shares = ["1e-02"]
source = "none"
of = []
[[row]]
figure = 1
name = "force"
quantity = "mean vertical force"
unit = "N/m"
ours = ["mean", "force_y", "rolls", 0.01]
at_least = 1e4
source = "it is pressed on the ground"
[[row]]
figure = 1
name = "ledger"
quantity = "ledger"
unit = "1"
ours = ["largest", "energy_residual_relative", "rolls", "long"]
at_most = 1e-11
source = "round-off"
"""


def small_study(folder: pathlib.Path, end: float = 0.02) -> pathlib.Path:
    folder.mkdir(exist_ok=True)
    (folder / "small.toml").write_text(SMALL)
    (folder / "study.toml").write_text(SMALL_STUDY.replace("END", str(end)))
    return folder


def command(*arguments: object) -> list[str]:
    return [sys.executable, "-m", "rondo", "paper", *map(str, arguments)]


def paper(*arguments: object, **options: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command(*arguments), capture_output=True, text=True, timeout=300,
                          **options)  # type: ignore[call-overload,no-any-return]


def record(folder: pathlib.Path) -> dict:
    return json.loads((folder / "paper.json").read_text())


def table(folder: pathlib.Path) -> dict:
    return {row["name"]: row for row in record(folder)["table"]}


def parts(folder: pathlib.Path) -> list[dict]:
    found = record(folder)
    return found["runs"] + found["pods"]
