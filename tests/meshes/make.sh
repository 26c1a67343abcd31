#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the meshes of this folder again, with Gmsh 4.8.4.
set -euo pipefail
cd "$(dirname "$0")"
gmsh -2 -v 2 -nt 1 mixed.geo -format msh22 -o mixed-22.msh
gmsh -2 -v 2 -nt 1 mixed.geo -format msh22 -bin -o mixed-22-binary.msh
gmsh -2 -v 2 -nt 1 mixed.geo -format msh41 -o mixed-41.msh
gmsh -2 -v 2 -nt 1 mixed.geo -format msh41 -bin -o mixed-41-binary.msh
