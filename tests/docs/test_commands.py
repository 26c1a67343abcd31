# SPDX-License-Identifier: BSD-3-Clause
"""Runs every block of commands of README and docs/, each page in order in a copy of the project.

    RONDO=build/release/rondo python3 tests/docs/test_commands.py [--long] [PAGE...]

Without --long, blocks marked `long` are left for the test docs_commands_long. Blocks that no test
runs are those of NOT_RUN, which the pages must agree with: both lists are printed.
"""
import os
import pathlib
import sys
import time

from pages import ROOT, Block, PageError, blocks_of, page_name, pages_with_commands
from session import Session

ENVIRONMENT = "source scripts/env.sh"

# Page and beginning of the first command of the blocks that are marked `not run here`, in order.
NOT_RUN = [
    ("README.md", "bash scripts/demo.sh"),
    ("CONTRIBUTING.md", "bash scripts/setup.sh --dev"),
    ("CONTRIBUTING.md", "bash scripts/test.sh"),
    ("CONTRIBUTING.md", "bash scripts/docs.sh"),
    ("CONTRIBUTING.md", "bash scripts/lint.sh"),
    ("docs/clusters.md", "mpirun -n 64 rondo sweep cases/studies/traction.toml"),
    ("docs/clusters.md", "source ~/rondo/scripts/env.sh"),
    ("docs/clusters.md", "source ~/rondo/scripts/env.sh"),
    ("docs/clusters.md", "array=$(sbatch --parsable sweep.sh)"),
    ("docs/how-to.md", "paraview results/rolling/fields.vtkhdf"),
    ("docs/how-to.md", "cmake --build --preset release"),
    ("docs/install.md", "bash scripts/setup.sh"),
    ("docs/install.md", "cmake --build build/release --target pages"),
    ("docs/install.md", "cmake --build build/release --target package"),
    ("docs/install.md", "sudo apt remove rondo rondo-dev"),
    ("docs/install.md", "python3 -m venv --system-site-packages env"),
    ("docs/install.md", "cmake --install build/release --prefix ~/rondo"),
    ("docs/install.md", "xargs -d"),
    ("docs/machine.md", "npm install -g @taplo/cli"),
    ("docs/performance.md", "cmake --preset bench"),
    ("docs/performance.md", "rondo run cases/ledge-smooth.toml --set disk.mesh.radial=577"),
    ("docs/performance.md", "/usr/bin/python3 bench/steady.py"),
    ("docs/performance.md", "rondo run cases/tyre-cornering.toml --threads 1"),
    ("docs/performance.md", "cmake --build build/release --target bench_exceptions"),
    ("docs/performance.md", "cmake --build build/release --target bench_bodies"),
    ("docs/performance.md", "cmake --build build/release --target bench_rubber"),
    ("docs/performance.md", "cmake --build build/release --target bench_solid"),
    ("docs/python.md", "python3 -m venv --system-site-packages env"),
    ("docs/python.md", "cmake --install build/release"),
    ("docs/reduced3d.md", "rondo run cases/tyre-lane-change.toml"),
    ("docs/reliability.md", "build/release/tests/verification/verification_long"),
    ("docs/reliability.md", "rondo run cases/long-spin.toml"),
    ("docs/reliability.md", "bash scripts/fuzz.sh"),
    ("docs/results.md", "xvfb-run -a pvpython tests/cli/read_fields.py"),
    ("docs/roads.md", "cmake --build build/release --target bench_road"),
    ("docs/schemes.md", "/usr/bin/python3 bench/schemes.py"),
    ("docs/studies.md", "python3 bench/sweep.py"),
    ("docs/tyre.md", "rondo run cases/tyre-load.toml"),
    ("bench/README.md", "cmake --preset bench"),
    ("bench/README.md", "/usr/bin/python3 bench/instructions.py"),
    ("docs/decisions/023-batched-members.md", "for columns in 120 240 960"),
]


def mistakes(blocks: list[Block]) -> list[str]:
    """What is wrong with a page before anything of it is run."""
    wrong = []
    running = [block for block in blocks if block.runs and block.mark != "not run here"]
    if running and not any(ENVIRONMENT in block.text for block in blocks[:blocks.index(running[0]) + 1]):
        wrong.append(f"{running[0].place}: the first commands of a page begin with `{ENVIRONMENT}`")
    for block in blocks:
        if block.runs and block.mark != "not run here" and "build/release/rondo" in block.text:
            wrong.append(f"{block.place}: build/release/rondo; scripts/env.sh has put it on the path")
    return wrong


def run_page(program: pathlib.Path, blocks: list[Block], with_long: bool) -> list[str]:
    """Prints a line for each block that runs; returns what failed."""
    todo = [block for block in blocks if block.mark == "file" or (
        block.runs and (block.mark == "" or (block.mark == "long" and with_long)))]
    if not any(block.runs for block in todo):
        return []
    session, wrong = Session(program), []
    try:
        for block in todo:
            begin = time.monotonic()
            problem = session.run(block, 1800.0 if with_long else 300.0)
            print(f"{'FAILED' if problem else 'ok':6} {time.monotonic() - begin:6.1f} s  "
                  f"{block.place}  {block.head}", flush=True)
            if problem:
                wrong.append(f"{block.place}: {block.head}\n{problem}")
                break  # what follows takes what this one should have made
    finally:
        session.close()
    return wrong


def listed(title: str, blocks: list[Block]) -> None:
    print(f"\n{title}: {len(blocks)}")
    for block in blocks:
        print(f"       {block.place}  {block.head}: {block.reason}")


def main(arguments: list[str]) -> int:
    program = pathlib.Path(os.environ["RONDO"]).resolve()
    with_long = "--long" in arguments
    asked = [name for name in arguments if name != "--long"]
    blocks, wrong = [], []
    for page in pages_with_commands():
        name = page_name(page)
        if asked and name not in asked:
            continue
        try:
            of_page = blocks_of(name, page.read_text())
        except PageError as error:
            wrong.append(str(error))
            continue
        wrong += mistakes(of_page)
        wrong += run_page(program, of_page, with_long)
        blocks += of_page
    skipped = [block for block in blocks if block.mark == "not run here"]
    listed("not run here", skipped)
    listed("long" if with_long else "long, not run now", [b for b in blocks if b.mark == "long"])
    expected = [item for item in NOT_RUN if not asked or item[0] in asked]
    agree = len(expected) == len(skipped) and all(
        block.page == page and block.head.startswith(head)
        for block, (page, head) in zip(skipped, expected))
    if not agree and not wrong:
        wrong.append("what the pages mark `not run here`, above, is not the list NOT_RUN")
    for text in wrong:
        print(f"\n{text}", file=sys.stderr)
    print(f"\n{len(blocks)} blocks of {ROOT.name}'s pages, {len(wrong)} errors")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
