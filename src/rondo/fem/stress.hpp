// SPDX-License-Identifier: BSD-3-Clause
/// @file  Nodal stress for output: corner stresses of the cells around a node, averaged with the
/// cells' corner masses as weights (docs/theory.md, 2.6).
#pragma once
#include <span>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/fem/element.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::fem {

class StressRecovery {
 public:
  /// @param materials one for each region of the mesh (material_of).
  StressRecovery(const mesh::Mesh& mesh, std::span<const Material> materials);

  /// (n) Cauchy stress xx, yy, zz, xy at the nodes in the frame of u [Pa]; `u` is (n) [m].
  /// Allocates nothing. The mesh must outlive the object.
  std::span<const Stress> operator()(std::span<const Vec2> u);

 private:
  const mesh::Mesh& mesh_;
  std::vector<ElementLaw> law_;                ///< of each material
  std::vector<std::array<double, 4>> weight_;  ///< (e) share of a corner in its node's mean
  std::vector<Stress> nodal_;
};

/// R σ Rᵀ: the stress along axes turned back by the angle of r = e^{iθ}.
Stress turned(const Stress& stress, Complex r) noexcept;

/// √(½[(σxx-σyy)² + (σyy-σzz)² + (σzz-σxx)²] + 3σxy²) [Pa].
double von_mises(const Stress& stress) noexcept;

}  // namespace rondo::fem
