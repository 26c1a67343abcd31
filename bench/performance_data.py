# SPDX-License-Identifier: BSD-3-Clause
"""What bench/performance.py knows: the machine, the build, and the figures of the benchmarks."""
import dataclasses
import json
import pathlib
import re
import statistics
import subprocess
from typing import Any, NamedTuple


class Spread(NamedTuple):
    """Of the repetitions of one benchmark."""
    median: float
    low: float
    high: float


class Step(NamedTuple):
    """Whose steps, on what: the parts of a benchmark's name."""
    mesh: str
    motion: str = "free_spin"
    damping: str = "beta"
    operator: str = "cyclic"
    threads: int = 1


@dataclasses.dataclass
class Figures:
    """Counters of all repetitions of one benchmark, and its error, if any."""
    counters: dict[str, list[float]] = dataclasses.field(default_factory=dict)
    error: str = ""

    def spread(self, counter: str) -> Spread:
        values = self.counters[counter]
        return Spread(statistics.median(values), min(values), max(values))

    def median(self, counter: str) -> float:
        return self.spread(counter).median


def read_benchmarks(file: pathlib.Path) -> dict[str, Figures]:
    """Benchmarks of one JSON file of Google Benchmark by name, repetitions together."""
    found: dict[str, Figures] = {}
    for entry in json.loads(file.read_text())["benchmarks"]:
        if entry["run_type"] != "iteration":
            continue
        figures = found.setdefault(entry["run_name"], Figures())
        figures.error = figures.error or entry.get("error_message", "")
        for name, value in entry.items():
            if isinstance(value, (int, float)) and not isinstance(value, bool):
                figures.counters.setdefault(name, []).append(float(value))
    return found


def step_of(name: str) -> Step | None:
    """The parts of "step/MESH/MOTION/DAMPING/OPERATOR/THREADS/..."."""
    parts = name.split("/")
    if parts[0] != "step":
        return None
    _, mesh, motion, damping, operator, threads, *_ = parts
    return Step(mesh, motion, damping, operator, int(threads))


class Results:
    """All that is in a folder of raw results."""

    def __init__(self, folder: pathlib.Path) -> None:
        self.steps: dict[Step, Figures] = {}
        self.errors: dict[Step, str] = {}
        for file in sorted(folder.glob("step-*.json")):
            for name, figures in read_benchmarks(file).items():
                step = step_of(name)
                if step is None:
                    continue
                if figures.error:
                    self.errors[step] = figures.error
                else:
                    self.steps[step] = figures
        kernels = folder / "kernels.json"
        self.kernels = read_benchmarks(kernels) if kernels.exists() else {}
        run = folder / "run.json"
        self.run: dict[str, Any] = json.loads(run.read_text()) if run.exists() else {}

    def meshes(self, kind: str) -> list[str]:
        """"smooth" or "treaded", ascending in degrees of freedom."""
        names = {step.mesh for step in self.steps if step.mesh.startswith(kind + "-")}
        return sorted(names, key=self.dofs)

    def dofs(self, mesh: str) -> int:
        return next(int(f.median("dofs")) for s, f in self.steps.items() if s.mesh == mesh)

    def nearest(self, kind: str, dofs: float) -> str | None:
        """The mesh nearest in size, if it is within a third of it."""
        off = {m: abs(self.dofs(m) / dofs - 1.0) for m in self.meshes(kind)}
        best = min(off, key=lambda m: off[m], default=None)
        return best if best is not None and off[best] < 1.0 / 3.0 else None

    def time(self, step: Step) -> float | None:
        """Median of the ns per degree of freedom and step."""
        return self.steps[step].median("ns_per_dof_step") if step in self.steps else None

    def ratio(self, over: Step, under: Step) -> float | None:
        """Time of `over` over that of `under`, medians."""
        a, b = self.time(over), self.time(under)
        return a / b if a is not None and b is not None else None


def output_of(*command: str, folder: pathlib.Path | None = None) -> str:
    return subprocess.run(command, capture_output=True, text=True, check=True,
                          cwd=folder).stdout.strip()


def machine() -> dict[str, str]:
    """Processor, cores, caches, memory, instruction sets that matter here."""
    fields = dict(re.findall(r"^([^:\n]+):\s*(.*)$", output_of("lscpu"), re.MULTILINE))
    info = pathlib.Path("/proc/cpuinfo").read_text()
    model = re.search(r"^model name\s*:\s*(.*)$", info, re.MULTILINE)
    clock = re.search(r"^cpu MHz\s*:\s*(.*)$", info, re.MULTILINE)
    memory = re.search(r"^MemTotal:\s*(\d+) kB", pathlib.Path("/proc/meminfo").read_text())
    flags = set(fields.get("Flags", "").split())
    return {
        "processor": model.group(1) if model else fields.get("Model name", "unknown"),
        "family, model, stepping": ", ".join(fields.get(k, "?")
                                             for k in ("CPU family", "Model", "Stepping")),
        "clock as told": f"{clock.group(1)} MHz" if clock else "unknown",
        "cores": fields.get("CPU(s)", "?")
        + (f", virtual ({fields['Hypervisor vendor']})" if "Hypervisor vendor" in fields else ""),
        "caches": ", ".join(f"{k.removesuffix(' cache')} {fields[k]}"
                            for k in ("L1d cache", "L2 cache", "L3 cache") if k in fields),
        "memory": f"{int(memory.group(1)) / 1048576:.0f} GiB" if memory else "unknown",
        "instruction sets": ", ".join(s for s in ("sse2", "avx2", "fma", "avx512f") if s in flags),
    }


def build(folder: pathlib.Path, source: pathlib.Path, written: tuple[str, ...]) -> dict[str, str]:
    """Compiler, flags and commit; `written` are the files that the script itself changes."""
    cache = dict(re.findall(r"^(\w+):\w+=(.*)$", (folder / "CMakeCache.txt").read_text(),
                            re.MULTILINE))
    kind = cache["CMAKE_BUILD_TYPE"]
    flags = f"{cache['CMAKE_CXX_FLAGS']} {cache['CMAKE_CXX_FLAGS_' + kind.upper()]}".strip()
    status = output_of("git", "status", "--porcelain", folder=source).splitlines()
    changed = [line for line in status if not line.endswith(written)]
    return {
        "compiler": output_of(cache["CMAKE_CXX_COMPILER"], "--version").splitlines()[0],
        "flags": f"{flags} ({kind}), -ffp-contract=off, OpenMP",
        "commit": output_of("git", "rev-parse", "--short=12", "HEAD", folder=source)
        + (", with changes not committed" if changed else ""),
    }
