// SPDX-License-Identifier: BSD-3-Clause
/// @file  From what a case says of a material to fem::Material.
#pragma once
#include "rondo/case/case.hpp"

namespace rondo::study {

/// μ of small strain, without branches, of a rubber                                     [Pa]
[[nodiscard]] double shear_modulus_of(const MaterialLaw& law) noexcept;

/// Quadrature; of rubber the parameters at finite strain, and E and ν of its small strains: by κ,
/// where the law has it, else by the ν that is there.
void fill_material(const MaterialLaw& law, fem::Material& material);

}  // namespace rondo::study
