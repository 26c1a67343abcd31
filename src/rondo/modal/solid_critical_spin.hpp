// SPDX-License-Identifier: BSD-3-Clause
/// @file  The lowest spin at which a wave of a wheel in three dimensions stands still in the fixed
/// frame (docs/theory.md, 8.6, with axial components added: docs/wheel3d.md).
#pragma once
#include <optional>
#include <span>

#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/modal/critical_speeds.hpp"

namespace rondo::modal {

/// Relative error of the spin found.
inline constexpr double solid_critical_tolerance = 1e-3;

/// The lowest critical spin of the waves with n = 0 … N/2 nodal diameters, if it is at most |spin|;
/// else nothing. It is found by counts of negative eigenvalues, one for each n, and by bisection;
/// no residual is computed. @param mass (n) of all nodes of the mesh [kg] @pre the wheel is clamped
[[nodiscard]] std::optional<CriticalSpeed> lowest_critical_spin(const fem::SolidSector& sector,
                                                                std::span<const double> mass,
                                                                double spin);

}  // namespace rondo::modal
