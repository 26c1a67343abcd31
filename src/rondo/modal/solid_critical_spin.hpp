// SPDX-License-Identifier: BSD-3-Clause
/// @file  The spin from which on a wave of a wheel in three dimensions stands still in the fixed
/// frame (docs/theory.md, 8.6, with axial components beside: docs/wheel3d.md).
#pragma once
#include <optional>
#include <span>

#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/modal/critical_speeds.hpp"

namespace rondo::modal {

/// Relative error of the spin found.
inline constexpr double solid_critical_tolerance = 1e-3;

/// The lowest critical spin where it is at |spin| or below, of the waves with n = 0 … N/2 nodal
/// diameters; else nothing. By counts of negative eigenvalues, one for each n, and bisection; there
/// is no residual. @param mass (n) of every node of the mesh [kg] @pre the wheel is clamped
[[nodiscard]] std::optional<CriticalSpeed> lowest_critical_spin(const fem::SolidSector& sector,
                                                                std::span<const double> mass,
                                                                double spin);

}  // namespace rondo::modal
