// SPDX-License-Identifier: BSD-3-Clause
/// @file  Between which radii a wheel rolls freely, before any run: the effective radius V/w itself
/// is a result (docs/conventions.md, "Which way will it be pushed?").
#pragma once
#include "rondo/analysis/build/physical.hpp"

namespace rondo::study {

struct FreeRadii {
  double least = 0.0, largest = 0.0;  ///< bounds of V/w of free rolling                     [m]
};

/// With a height that is not known before the run, the deflection is taken as deep_share of the
/// wall, or as a tenth of the outer radius if that is less. @pre there is a ground
[[nodiscard]] FreeRadii free_radii(const Case& c, const mesh::Mesh& mesh, const Wall& wall);

}  // namespace rondo::study
