# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a wheel in three dimensions (docs/wheel3d.md)."""
