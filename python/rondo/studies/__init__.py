# SPDX-License-Identifier: BSD-3-Clause
"""Studies: what starts the program rondo many times, or compares what it left."""
