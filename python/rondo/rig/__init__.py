# SPDX-License-Identifier: BSD-3-Clause
"""What is made of the points of a tyre test rig: tyre.tir, figures, report, comparison (docs/rig.md)."""
