# SPDX-License-Identifier: BSD-3-Clause
"""Rolling disks of bench/schemes.py: the smooth one of cases/rolling-flat.toml, and the one with a
belt of cases/belt.toml, without stiffness damping."""
import numpy as np
from schemes_common import MASSLESS, ROOT, SECONDS, history, ledger, panels, steps

NODES = 180 * 33.333333 / (2.0 * np.pi)  # 1/s: that come down


def noise(h, after):
    """N/m: rms of the vertical force above twice the rate of nodes that come down, in the time after."""
    seen = h["time_s"] > after
    force, step = h["force_y"][seen], np.diff(h["time_s"][seen]).mean()
    window = np.hanning(len(force))
    spectrum = np.fft.rfft((force - force.mean()) * window)
    spectrum[np.fft.rfftfreq(len(force), step) < 2.0 * NODES] = 0.0
    high = np.fft.irfft(spectrum, len(force))
    return np.sqrt((high**2).sum() / (window**2).sum())


def changed(text, **lines):
    """The case with lines that begin so replaced."""
    rows = text.splitlines()
    for start, line in lines.items():
        place = [i for i, row in enumerate(rows) if row.startswith(start + " =")]
        rows[place[0]] = line
    return "\n".join(rows) + "\n"


class Disk:
    NAME, TITLE, AFTER = "disk", "A disk rolls", 0.1
    COLUMNS = ("steps", SECONDS, "F_y (N/m)", "F_x (N/m)", "noise of F_y (N/m)", "lost in impacts (J/m)",
               "ledger")

    def cases(self, _):
        case = changed((ROOT / "cases" / "rolling-flat.toml").read_text(), snapshots="snapshots = 2",
                       history_interval="history_interval = 0")
        yield "plain", case
        yield "massless", case + "[solver]\n" + MASSLESS
        for factor in (2, 3):
            fine = changed(case, radial=f"radial = {12 * factor}",
                           circumferential=f"circumferential = {180 * factor}")
            yield f"plain, {12 * factor}×{180 * factor}", fine

    def measure(self, out):
        h = history(out)
        seen = h["time_s"] > self.AFTER
        return {"steps": steps(out), "F_y (N/m)": f"{h['force_y'][seen].mean():,.0f}",
                "F_x (N/m)": f"{h['force_x'][seen].mean():,.0f}",
                "noise of F_y (N/m)": f"{noise(h, self.AFTER):.0f}",
                "lost in impacts (J/m)": f"{h['loss_impact'][-1]:.3g}", "ledger": ledger(out)}

    def draw(self, rows, folder):
        def force(out):
            h = history(out)
            return h["time_s"], 1e-5 * h["force_y"]
        panels(folder / f"schemes-{self.NAME}", rows, force,
               ("time (s)", "vertical force (100 kN/m)"), self.LIMITS)

    LIMITS = ((0.16, 0.17), (1.85, 1.95))


class Belt(Disk):
    NAME, TITLE, AFTER = "belt", "A disk with a steel belt rolls", 0.06
    LIMITS = ((0.09, 0.1), (2.6, 2.8))

    def cases(self, _):
        case = changed((ROOT / "cases" / "belt.toml").read_text(), snapshots="snapshots = 2",
                       history_interval="history_interval = 0", stiffness="stiffness = 0.0")
        explicit = case.replace("[[solver.implicit]]\nlayers = [10]\n", "")
        yield "plain", explicit
        yield "implicit elements", case
        fine = "[solver.hati]\nfine = {layers = [4, 5, 6, 7, 8, 9, 10, 11, 12]}\nratio = 9\n"
        yield "asynchronous, ratio 9", changed(explicit, end='end = 0.1\nscheme = "hati"') + fine
        # A belt so heavy that by itself it has the step of the others.
        yield "mass scaling", explicit.replace("density = 1370.0", "density = 111000.0")
        yield "massless", explicit.replace("[solver]\n", "[solver]\n" + MASSLESS)
