#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# From nothing to a disk rolling over a ledge: installs, builds, runs, says where the results are.
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/setup.sh
cmake --preset release
cmake --build --preset release --target rondo rondo_python
out=results/ledge-smooth
build/release/rondo run cases/ledge-smooth.toml -o "$out" --overwrite
build/release/rondo pod "$out" --frame rectified --from 0.07 --quiet
build/release/rondo figures "$out"
build/release/rondo report "$out"

cat <<EOT

The results are in $out:
  report.html   all of it in one file: open it in a browser and press play; it can be mailed
  figures/      pictures of the run, PNG and SVG: the disk, the forces, the energy, the modes
  history.csv   contact forces and the energy balance over time (any spreadsheet, pandas)
  fields.xdmf   the rolling disk: open it in ParaView and press play
  results.h5    every array (HDF5: h5py, MATLAB, Julia), described in docs/results.md
  pod/          modes of the displacement as seen from the ground: modes.xdmf for ParaView
  run.json      the figures of the run: steps, speed, largest imbalance of the ledger
Next: source scripts/env.sh puts rondo and its Python package on the paths of a shell; then
docs/tutorial.md, or rondo paper -o results/paper, the study of the paper (docs/paper.md);
rondo run --help, the other files in cases/, and docs/cases.md.
EOT
