# SPDX-License-Identifier: BSD-3-Clause
"""What is refused before anything is tested: mistakes in the case, and values that no wheel can bear."""
