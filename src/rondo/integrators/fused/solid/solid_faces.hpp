// SPDX-License-Identifier: BSD-3-Clause
/// @file  Cords and air of a tyre whose motion is not linear in them, as the fused steps take them
/// (kernels/solid/faces.hpp, docs/tyre.md).
#pragma once
#include <vector>

#include "rondo/integrators/fused/kernels/solid/layout.hpp"
#include "rondo/integrators/fused/ring_layout.hpp"

namespace rondo::dynamics {

struct SolidFacesPlan {
  std::vector<kernels::SolidCordFace> cords;
  std::vector<kernels::SolidAirFace> air;
  std::vector<int> place;  ///< (n_local) of a row among those with faces; -1: it has none
  int n_rows = 0;          ///< with faces
  double pressure = 0.0;   ///< [Pa]

  /// Doubles of the forces of a chunk.
  [[nodiscard]] std::size_t size(const RingLayout& layout) const noexcept {
    return static_cast<std::size_t>(RingLayout::lead + 6 * n_rows * layout.stride + halo_columns);
  }
  /// All but the fields, the energy of the state and the sums.
  [[nodiscard]] kernels::SolidFaces faces() const noexcept;
};

/// @param layout with stride and frames. @pre model.solid->swept
SolidFacesPlan make_faces_plan(const Model& model, const RingLayout& layout);

/// Forces and energy in the state, by the very loops of the steps.
struct StateOfFaces {
  std::vector<Vec3> force;  ///< (n_local) on a node of a row, in its frame                  [N]
  double energy = 0.0;      ///< of a sector                                             [J]
};
StateOfFaces state_of_faces(const SolidFacesPlan& plan, const RingLayout& layout,
                            const kernels::SolidTable& table);

}  // namespace rondo::dynamics
