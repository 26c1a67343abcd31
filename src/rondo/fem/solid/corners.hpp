// SPDX-License-Identifier: BSD-3-Clause
/// @file  Corners of an element of a mesh.
#pragma once
#include <cstddef>

#include "rondo/fem/solid/hexahedron.hpp"
#include "rondo/mesh/solid/face.hpp"

namespace rondo::fem {

inline HexahedronCorners corners_of(const mesh::Mesh& mesh, std::size_t element) noexcept {
  HexahedronCorners x;
  for (std::size_t i = 0; i < 8; ++i) x[i] = mesh::place_of(mesh, mesh.hexahedra[element][i]);
  return x;
}

}  // namespace rondo::fem
