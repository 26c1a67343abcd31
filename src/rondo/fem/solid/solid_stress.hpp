// SPDX-License-Identifier: BSD-3-Clause
/// @file  Stress at the nodes of a wheel in three dimensions.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/fem/solid/hexahedron.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::fem {

class SolidStressRecovery {
 public:
  /// @param materials one for each region of the mesh (material_of).
  /// @pre the mesh has equal sectors; nodes and elements are numbered sector after sector in the
  /// same order, as revolve() does.
  SolidStressRecovery(const mesh::Mesh& mesh, std::span<const Material> materials);

  /// (n) σ at the nodes in the frame of u [Pa]: means over the elements around a node, weighted by
  /// the volume that each element has at that corner; u (n) [m]. Allocates nothing.
  std::span<const SolidStress> operator()(std::span<const Vec3> u);

 private:
  /// An element of sector 0; its nodes may also belong to the next sector.
  struct Element {
    mesh::Hexahedron nodes;
    std::array<double, 8> weight;  ///< weight of a corner in its node's mean
    HexahedronPoints points;
    std::size_t material;  ///< index in materials_
  };
  std::vector<Material> materials_;
  std::vector<Element> elements_;
  std::vector<Complex> turn_;  ///< (N) rotation from sector 0 to each sector
  std::size_t nodes_per_sector_ = 0;
  std::vector<SolidStress> nodal_;
};

/// Recovers the stress once, for a single evaluation.
std::vector<SolidStress> solid_stress(const mesh::Mesh& mesh, std::span<const Material> materials,
                                      std::span<const Vec3> u);

/// R σ Rᵀ: the stress in axes turned back about the axle by the angle of r = e^{iθ}.
SolidStress turned(const SolidStress& stress, Complex r) noexcept;

/// √(½[(σxx-σyy)² + (σyy-σzz)² + (σzz-σxx)²] + 3(σxy² + σyz² + σzx²)) [Pa].
double von_mises(const SolidStress& stress) noexcept;

}  // namespace rondo::fem
