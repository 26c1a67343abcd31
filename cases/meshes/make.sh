#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the meshes of this folder again; arguments go to gmsh, for example: bash make.sh -setnumber N 40
set -euo pipefail
cd "$(dirname "$0")"
for geometry in *.geo; do
  gmsh -2 -v 2 -nt 1 "$@" "$geometry" -format msh41 -o "${geometry%.geo}.msh"
done
