// SPDX-License-Identifier: BSD-3-Clause
/// @file  Makes fem::Material from the material of a case.
#pragma once
#include "rondo/case/case.hpp"

namespace rondo::study {

/// μ of a rubber at small strain, without branches                                      [Pa]
[[nodiscard]] double shear_modulus_of(const MaterialLaw& law) noexcept;

/// Largest ratio of the frequencies of a band, and their own bounds [Hz].
inline constexpr double widest_band = 1e8, slowest_band = 1e-9, fastest_band = 1e12;
/// The band of a loss factor is one.
[[nodiscard]] bool has_band(const MaterialLaw& law) noexcept;

/// Some material has branches.
[[nodiscard]] bool has_viscosity(const Case& c) noexcept;

/// Sets the quadrature, the branches and, for rubber, the parameters at finite strain and E and ν
/// of its small strains, by κ if the law has it, else by the given ν.
void fill_material(const MaterialLaw& law, fem::Material& material);

}  // namespace rondo::study
