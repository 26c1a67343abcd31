# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/performance.md, each as lines of Markdown by the name of its place there."""
import json
import pathlib
import re
from typing import Callable

from performance_data import Figures, Results, Spread, Step

OPERATORS = ("cyclic", "sparse", "eigen", "reference")
Rows = list[list[str]]


def table(head: list[str], rows: Rows) -> str:
    if not rows:
        return "*Not measured.*"
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def digits(x: float) -> str:
    """Three significant digits, without exponent."""
    if x >= 99.95:
        return f"{x:,.0f}"
    return f"{x:.1f}" if x >= 9.995 else f"{x:.2f}"


def spread(s: Spread) -> str:
    """Median (least to largest)."""
    return f"{digits(s.median)} ({digits(s.low)} to {digits(s.high)})"


def time(r: Results, step: Step) -> str:
    """Median of the repetitions (fastest batch of all to slowest repetition)."""
    if step in r.errors:
        return f"**{r.errors[step]}**"
    if step not in r.steps:
        return ""
    of_step, best = (r.steps[step].spread(c) for c in ("ns_per_dof_step", "best_ns_per_dof_step"))
    return spread(of_step._replace(low=best.low))


def ratio(r: Results, over: Step, under: Step) -> str:
    value = r.ratio(over, under)
    return "" if value is None else digits(value)


def name(r: Results, mesh: str) -> list[str]:
    return [mesh.split("-")[1].replace("x", "×"), f"{r.dofs(mesh):,}"]


def of_machine(r: Results) -> str:
    rows = [[key, str(value)] for part in ("machine", "build") for key, value in
            r.run.get(part, {}).items()]
    rows += [[key, str(r.run[key])] for key in ("date", "repetitions", "load at the start")
             if key in r.run]
    commands = "\n".join(r.run.get("commands", []))
    mark = "<!-- not run here: builds and runs the benchmarks, an hour -->"
    return table(["", ""], rows) + (f"\n\n{mark}\n```sh\n{commands}\n```" if commands else "")


def of_smooth(r: Results) -> str:
    rows = []
    for mesh in r.meshes("smooth"):
        steps = {o: Step(mesh, operator=o) for o in OPERATORS}
        rows.append(name(r, mesh) + [time(r, s) for s in steps.values()]
                    + [ratio(r, steps["eigen"], steps["cyclic"]),
                       ratio(r, steps["sparse"], steps["cyclic"])])
    return table(["mesh", "dofs", *OPERATORS, "eigen / cyclic", "sparse / cyclic"], rows)


def of_limits(r: Results) -> str:
    rows = []
    for mesh in r.meshes("smooth"):
        for damping in ("beta", "no_beta"):
            step = Step(mesh, damping=damping)
            if step not in r.steps:
                continue
            f = r.steps[step]
            rows.append(name(r, mesh) + [
                "yes" if damping == "beta" else "no", time(r, step),
                digits(f.median("bytes_per_dof")), digits(f.median("GB_per_s")),
                digits(f.median("stream_GB_per_s")), f"{100 * f.median('share_of_stream'):.0f} %",
                digits(f.median("flops_per_dof")), digits(f.median("GFLOP_per_s")),
                digits(f.median("peak_GFLOP_per_s")), f"{100 * f.median('share_of_peak'):.0f} %"])
    return table(["mesh", "dofs", "β", "ns", "bytes", "GB/s", "stream", "share", "flops", "GFLOP/s",
                  "peak", "share"], rows)


def of_rolling(r: Results) -> str:
    rows = []
    for mesh in r.meshes("smooth") + r.meshes("treaded"):
        row = [mesh.split("-")[0]] + name(r, mesh)
        for operator in ("cyclic", "sparse", "eigen"):
            free, rolling = (Step(mesh, motion, operator=operator)
                             for motion in ("free_spin", "rolling"))
            row += [time(r, rolling), ratio(r, rolling, free)]
        if any(row[3:]):
            rows.append(row)
    head = ["disk", "mesh", "dofs", "cyclic", "/ free", "sparse", "/ free", "eigen", "/ free"]
    return table(head, rows)


def of_treads(r: Results) -> str:
    rows = []
    for mesh in r.meshes("treaded"):
        smooth = r.nearest("smooth", r.dofs(mesh))
        step = Step(mesh)
        rows.append(name(r, mesh) + [time(r, step),
                                     ratio(r, step, Step(smooth)) if smooth else "",
                                     time(r, Step(mesh, operator="sparse")),
                                     time(r, Step(mesh, operator="eigen")),
                                     ratio(r, Step(mesh, operator="eigen"), step)])
    return table(["pitches × columns", "dofs", "cyclic", "/ smooth disk nearest in size", "sparse",
                  "eigen", "eigen / cyclic"], rows)


def of_threads(r: Results) -> str:
    rows = []
    for mesh in r.meshes("smooth"):
        row = name(r, mesh)
        for operator in ("cyclic", "sparse", "eigen"):
            one, two = (Step(mesh, operator=operator, threads=n) for n in (1, 2))
            row += [time(r, two), ratio(r, one, two)]
        if any(row[2:]):
            rows.append(row)
    head = ["mesh", "dofs", "cyclic on 2", "gain", "sparse on 2", "gain", "eigen on 2", "gain"]
    return table(head, rows)


def sorted_kernels(r: Results) -> list[tuple[str, list[int], Figures]]:
    """Name, arguments and figures, by name and size: the runs were in random order."""
    kernels = []
    for full, figures in r.kernels.items():
        kernel, *rest = full.split("/")
        kernels.append((kernel, [int(size) for size in rest if size.isdigit()], figures))
    return sorted(kernels, key=lambda k: (k[0], k[1]))


def of_kernels(r: Results) -> str:
    rows = []
    for kernel, sizes, f in sorted_kernels(r):
        if f.error:
            rows.append([kernel.replace("_", " "), "", "", f"**{f.error}**", "", "", "", ""])
        elif kernel.startswith("product_"):
            rows.append([kernel.replace("_", " "), f"{int(f.median('dofs')):,}", str(sizes[1]),
                         spread(f.spread("ns_per_dof")), digits(f.median("GB_per_s")),
                         f"{100 * f.median('share_of_stream'):.0f} %",
                         digits(f.median("GFLOP_per_s")),
                         f"{100 * f.median('share_of_peak'):.0f} %"])
        elif kernel == "contact_search":
            rows.append(["contact search, per candidate", f"{int(f.median('candidates')):,}", "1",
                         spread(f.spread("ns_per_candidate")), "", "", "", ""])
    return table(["", "dofs (candidates)", "threads", "ns per dof", "GB/s", "of stream", "GFLOP/s",
                  "of peak"], rows)


def of_machine_limits(r: Results) -> str:
    rows = []
    for kernel, sizes, f in sorted_kernels(r):
        if kernel == "stream":
            n, arrays, threads = sizes
            rows.append([f"{arrays} arrays of {n:,} in place", f"{8e-6 * n * arrays:,.2f} MB",
                         str(threads), spread(f.spread("stream_GB_per_s")) + " GB/s"])
        if kernel == "multiply_adds":
            rows.append(["multiply-adds in registers", "", str(sizes[0]),
                         spread(f.spread("peak_GFLOP_per_s")) + " GFLOP/s"])
    return table(["", "working set", "threads", "measured"], rows)


def of_instructions(record: pathlib.Path) -> str:
    if not record.exists():
        return "*Not recorded.*"
    known = json.loads(record.read_text())
    rows = [key.split("/") + [f"{n:,}", f"{n / 4320:.1f}"]
            for key, n in known["instructions_per_step"].items()]
    return (f"{known['compiler']}, {known['flags']}, valgrind {known['valgrind']}, mesh "
            f"{known['mesh'].replace('x', '×')} (4,320 dofs):\n\n"
            + table(["operator", "motion", "level", "instructions a step", "a dof"], rows))


def worst(values: list[float | None], least: bool) -> float | None:
    """The one nearest to missing the target; None if any is missing."""
    known = [v for v in values if v is not None]
    if len(known) < len(values) or not known:
        return None
    return min(known) if least else max(known)


def target(text: str, bound: float, least: bool, values: dict[str, float | None],
           unit: str = "") -> list[str]:
    """A row: what, bound, each value, and whether all keep to the bound."""
    shown = "; ".join(f"{key}: {digits(v)}{unit}" if v is not None else f"{key}: not measured"
                      for key, v in values.items())
    decisive = worst(list(values.values()), least)
    if decisive is None:
        met = "open"
    else:
        met = "yes" if (decisive >= bound if least else decisive <= bound) else "**no**"
    return [text, f"{'≥' if least else '≤'} {bound:g}{unit}", shown, met]


SIZES = {"2·10⁴": 2e4, "2·10⁵": 2e5, "2·10⁶": 2e6, "10⁷": 1e7}


def of_targets(r: Results) -> str:
    def at_sizes(value: Callable[[str], float | None], sizes: dict[str, float] | None = None
                 ) -> dict[str, float | None]:
        named: dict[str, float | None] = {}
        for text, dofs in (sizes or SIZES).items():
            mesh = r.nearest("smooth", dofs)
            named[text] = value(mesh) if mesh else None
        return named

    def share(mesh: str, damping: str) -> float | None:
        figures = r.steps.get(Step(mesh, damping=damping))
        return 100 * figures.median("share_of_stream") if figures else None

    def tread(dofs: float) -> float | None:
        names = [m for m in r.meshes("treaded") if re.match(r"treaded-60x", m)
                 and abs(r.dofs(m) / dofs - 1) < 1 / 3]
        smooth = r.nearest("smooth", dofs)
        return r.ratio(Step(names[0]), Step(smooth)) if names and smooth else None

    large = {"2·10⁶": 2e6, "4·10⁷": 4e7}
    first, fifth = {"2·10⁴": 2e4}, {"2·10⁵": 2e5}
    rows = [
        target("plain Eigen step / cyclic step", 8, True,
               at_sizes(lambda m: r.ratio(Step(m, operator="eigen"), Step(m)))),
        target("own sparse step / cyclic step", 4, True,
               at_sizes(lambda m: r.ratio(Step(m, operator="sparse"), Step(m)))),
        target("cyclic, per dof and step", 1.0, False, at_sizes(lambda m: r.time(Step(m)), first),
               " ns"),
        target("share of the stream bandwidth, β = 0", 70, True,
               at_sizes(lambda m: share(m, "no_beta"), large), " %"),
        target("the same with β", 70, True, at_sizes(lambda m: share(m, "beta"), large), " %"),
        target("tread of 60 pitches / smooth, per dof", 1.5, False,
               {text: tread(dofs) for text, dofs in list(SIZES.items())[:3]}),
        target("rolling / free spin, cyclic", 1.10, False,
               at_sizes(lambda m: r.ratio(Step(m, "rolling"), Step(m)))),
        target("gain by 2 threads, cyclic", 1.8, True,
               at_sizes(lambda m: r.ratio(Step(m), Step(m, threads=2)), fifth)),
        target("the study of the paper", 60, False, {"wall time": r.run.get("paper_seconds")}, " s"),
    ]
    return table(["", "target", "measured", "met"], rows)


def all_tables(r: Results, record: pathlib.Path) -> dict[str, str]:
    """Markdown by the name of its markers."""
    return {"machine": of_machine(r), "targets": of_targets(r), "smooth": of_smooth(r),
            "limits": of_limits(r), "machine-limits": of_machine_limits(r),
            "rolling": of_rolling(r), "treads": of_treads(r), "threads": of_threads(r),
            "kernels": of_kernels(r), "instructions": of_instructions(record)}
