# SPDX-License-Identifier: BSD-3-Clause
"""What the program rondo writes, as it is read. Nothing here draws."""
