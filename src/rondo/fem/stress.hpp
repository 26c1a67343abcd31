// SPDX-License-Identifier: BSD-3-Clause
/// @file  Nodal stress for output: corner stresses of the cells around a node, averaged with the
/// cells' corner masses as weights (docs/theory.md, 2.6).
#pragma once
#include <span>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/element.hpp"
#include "rondo/fem/hyperelastic/stress.hpp"
#include "rondo/fem/nodal_dilatation.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::fem {

/// The law that gives the stress of a cell.
struct StressLaw {
  ElementLaw linear;
  const Rubber* rubber = nullptr;  ///< at finite strain; null: linear
};

/// @param material must outlive the result
inline StressLaw stress_law(const Material& material) noexcept {
  return {element_law(material), material.rubber ? &*material.rubber : nullptr};
}

/// Stress at the corners of a cell, consistent with its forces: element_stress(), with the mean
/// stress of each corner on a triangle held by `dilatation`; for rubber the Cauchy stress without
/// viscous branches. @param u displacement of a node
template <class Displacement>
std::array<Stress, 4> cell_stress(const mesh::Mesh& mesh, std::size_t cell, const StressLaw& of,
                                  const NodalDilatation& dilatation, Displacement&& u) {
  if (of.rubber) return hyperelastic::cell_stress(mesh, cell, *of.rubber, dilatation, u);
  ElementLaw law = of.linear;
  const mesh::Cell& nodes = mesh.cells[cell];
  const auto n = static_cast<std::size_t>(mesh::n_corners(nodes));
  std::array<Vec2, 4> x, of_corner;
  for (std::size_t a = 0; a < n; ++a) {
    x[a] = mesh.coordinates[at(nodes[a])];
    of_corner[a] = u(nodes[a]);
  }
  const bool nodal = dilatation.holds(cell);
  if (nodal) law.mean_bulk = 0.0;
  std::array<Stress, 4> stress = element_stress({x.data(), n}, {of_corner.data(), n}, law);
  for (std::size_t a = 0; nodal && a < n; ++a) {
    const double mean =
        dilatation.mean_stress(static_cast<std::size_t>(dilatation.patches_of(cell)[a]), u);
    for (std::size_t k = 0; k < 3; ++k) stress[a][k] += mean;
  }
  return stress;
}

class StressRecovery {
 public:
  /// @param materials one for each region of the mesh (material_of).
  StressRecovery(const mesh::Mesh& mesh, std::span<const Material> materials);
  StressRecovery(const StressRecovery&) = delete;  // the laws point to the materials
  StressRecovery& operator=(const StressRecovery&) = delete;

  /// (n) Cauchy stress xx, yy, zz, xy at the nodes in the frame of u [Pa]; `u` is (n) [m].
  /// Allocates nothing. The mesh must outlive the object.
  std::span<const Stress> operator()(std::span<const Vec2> u);

 private:
  const mesh::Mesh& mesh_;
  NodalDilatation dilatation_;
  std::vector<Material> materials_;
  std::vector<StressLaw> law_;                 ///< of each material
  std::vector<std::array<double, 4>> weight_;  ///< (e) weight of a corner in its node's mean
  std::vector<Stress> nodal_;
};

/// R σ Rᵀ: the stress in axes turned back by the angle of r = e^{iθ}.
Stress turned(const Stress& stress, Complex r) noexcept;

/// √(½[(σxx-σyy)² + (σyy-σzz)² + (σzz-σxx)²] + 3σxy²) [Pa].
double von_mises(const Stress& stress) noexcept;

}  // namespace rondo::fem
