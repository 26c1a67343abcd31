// SPDX-License-Identifier: BSD-3-Clause
/// @file  Volumetric strain of triangles averaged at the nodes: B-bar for a mesh of triangles
/// (Bonet and Burton 1998; docs/theory.md, 2.3b). A linear triangle has one strain and almost no
/// motion that keeps its area; the triangles around a node together have many.
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/core/vec2.hpp"
#include "rondo/fem/elasticity.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::fem {

/// The triangles of one material around a node share one dilatation θ, their mean weighted by area.
/// Materials are not mixed: at a node between materials, each has its own patch.
class NodalDilatation {
 public:
  /// A term of θ = Σ gradient · u(node).
  struct Term {
    int node;
    Vec2 gradient;  ///< [1/m]
  };
  /// Indices of the patches at the corners of a triangle.
  using Corners = std::array<int, 3>;

  NodalDilatation() = default;
  /// @param materials one for each region of the mesh (material_of).
  NodalDilatation(const mesh::Mesh& mesh, std::span<const Material> materials);

  /// No cell is averaged: all are quadrilaterals, fully integrated or in plane stress.
  [[nodiscard]] bool empty() const noexcept { return patches_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return patches_.size(); }
  /// Whether the volumetric energy of this cell is that of the patches.
  [[nodiscard]] bool holds(std::size_t cell) const noexcept {
    return !empty() && corners_[cell][0] >= 0;
  }
  /// @pre holds(cell)
  [[nodiscard]] const Corners& patches_of(std::size_t cell) const noexcept {
    return corners_[cell];
  }
  /// Terms of a patch by node, ascending.
  [[nodiscard]] std::span<const Term> terms(std::size_t patch) const noexcept {
    return std::span(terms_).subspan(patches_[patch].first,
                                     patches_[patch].last - patches_[patch].first);
  }
  /// The triangles of a patch, as indices of cells in the mesh, ascending.
  [[nodiscard]] std::span<const int> cells(std::size_t patch) const noexcept {
    return std::span(cells_).subspan(patches_[patch].first_cell,
                                     patches_[patch].last_cell - patches_[patch].first_cell);
  }
  /// V: a third of the area of its triangles [m²].
  [[nodiscard]] double area(std::size_t patch) const noexcept { return patches_[patch].area; }
  /// κ V: the energy of a patch is ½ κ V θ² [N].
  [[nodiscard]] double stiffness(std::size_t patch) const noexcept {
    return patches_[patch].bulk * patches_[patch].area;
  }
  /// κ θ, added to the deviatoric stress on xx, yy, zz [Pa]. @param u displacement of a node [m]
  template <class Displacement>
  [[nodiscard]] double mean_stress(std::size_t patch, Displacement&& u) const {
    double theta = 0.0;
    for (const Term& t : terms(patch)) theta += dot(t.gradient, u(t.node));
    return patches_[patch].bulk * theta;
  }
  /// The pressure in a triangle: the mean over its corners. @pre holds(cell)
  template <class Displacement>
  [[nodiscard]] double mean_stress_of_cell(std::size_t cell, Displacement&& u) const {
    double sum = 0.0;
    for (const int patch : corners_[cell]) sum += mean_stress(static_cast<std::size_t>(patch), u);
    return sum / 3.0;
  }

 private:
  struct Patch {
    double bulk = 0.0;                          ///< κ [Pa]
    double area = 0.0;                          ///< V: a third of the area of its triangles [m²]
    std::size_t first = 0, last = 0;            ///< range in terms_
    std::size_t first_cell = 0, last_cell = 0;  ///< range in cells_
  };

  std::vector<Patch> patches_;
  std::vector<Term> terms_;
  std::vector<int> cells_;
  std::vector<Corners> corners_;  ///< (e) -1: a cell with its own volumetric strain
};

}  // namespace rondo::fem
