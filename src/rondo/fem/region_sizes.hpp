// SPDX-License-Identifier: BSD-3-Clause
/// @file  Size of each region of a mesh.
#pragma once
#include <vector>

#include "rondo/mesh/mesh.hpp"

namespace rondo::fem {

/// (n_regions) Area of each region [m²], in three dimensions its volume [m³], by the quadrature of
/// the lumped mass, so that size × density is the mass of the region's elements.
/// @pre regions of the mesh are below n_regions; a mesh without regions is region 0
[[nodiscard]] std::vector<double> region_sizes(const mesh::Mesh& mesh, std::size_t n_regions);

}  // namespace rondo::fem
