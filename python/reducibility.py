# SPDX-License-Identifier: BSD-3-Clause
"""How reducible rolling is, against a quasi-static crush: the table and the picture of
docs/validation.md.

    /usr/bin/python3 python/reducibility.py build/release/rondo FOLDER

Runs one turn of steady rolling of the smooth and of the treaded disk and their crush into FOLDER,
decomposes displacement, velocity and contact force in the rotating and the rectified frame, prints
the numbers of modes and draws FOLDER/reducibility.png. About half a minute.
"""
import csv
import json
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

CASES = pathlib.Path(__file__).resolve().parents[1] / "cases"
TURN = ["--set", "output.snapshots_from=0.07", "--set", "output.stress=false"]
RUNS = {  # name: settings; ten snapshots a pitch of the treaded disk
    "ledge-smooth": TURN + ["--set", "time.end=0.2585", "--set", "output.snapshots=595"],
    "ledge-treaded": TURN + ["--set", "time.end=0.2584956", "--set", "output.snapshots=601"],
    "crush-smooth": [],
    "crush-treaded": [],
}
FIELDS = ("displacement", "velocity", "contact")
MOTIONS = (("rolling, rotating frame", "ledge", "rotating", "#d55e00"),
           ("rolling, rectified", "ledge", "rectified", "#0072b2"),
           ("crush", "crush", "rotating", "#000000"))


def decompose(program, folder):
    for name, settings in RUNS.items():
        subprocess.run([program, "run", CASES / f"{name}.toml", "-o", folder / name, "--overwrite",
                        "--quiet", *settings], check=True)
        for field in FIELDS:
            for frame in ("rotating", "rectified"):
                subprocess.run([program, "pod", folder / name, "--field", field, "--frame", frame,
                                "--quiet"], check=True, stdout=subprocess.DEVNULL)


def pod(folder, motion, body, field, frame):
    return folder / f"{motion}-{body}" / "pod" / f"{field}-{frame}"


def counts(directory):
    found = json.loads((directory / "pod.json").read_text())["modes_for"]
    return " / ".join(str(found[share]) for share in ("1e-02", "1e-04", "1e-06"))


def print_table(folder):
    print("| body | | displacement | velocity | contact force |")
    print("|---|---|---|---|---|")
    for body in ("smooth", "treaded"):
        for label, motion, frame, _ in MOTIONS:
            cells = [counts(pod(folder, motion, body, field, frame)) for field in FIELDS]
            print(f"| {body} | {label} | {' | '.join(cells)} |")


def discarded(directory):
    with open(directory / "spectrum.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return [(int(row["mode"]), float(row["discarded_energy"])) for row in rows
            if float(row["discarded_energy"]) > 1e-16]


def draw(folder, picture):
    figure, axes = plt.subplots(2, 3, figsize=(7.2, 4.6), sharex=True, sharey=True,
                                layout="constrained")
    for row, body in zip(axes, ("smooth", "treaded")):
        for panel, field in zip(row, FIELDS):
            for share in (1e-2, 1e-4, 1e-6):
                panel.axhline(share, color="0.85", lw=0.8, zorder=0)
            for label, motion, frame, colour in MOTIONS:
                modes, rest = zip(*discarded(pod(folder, motion, body, field, frame)))
                panel.loglog(modes, rest, color=colour, lw=1.4, label=label,
                             ls="--" if motion == "crush" else "-")
            panel.set_title(f"{field}{' force' if field == 'contact' else ''}, {body}", fontsize=9)
            panel.set_ylim(1e-12, 1.5)
            panel.set_xlim(1, 700)
    for panel in axes[1]:
        panel.set_xlabel("modes kept")
    figure.supylabel("share of the energy left out", fontsize=10)
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, frameon=False, loc="upper center", ncol=3)
    figure.get_layout_engine().set(rect=(0, 0, 1, 0.94))  # room for the legend
    figure.savefig(picture, dpi=150)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    decompose(pathlib.Path(sys.argv[1]).resolve(), folder)
    print_table(folder)
    draw(folder, folder / "reducibility.png")


if __name__ == "__main__":
    main()
