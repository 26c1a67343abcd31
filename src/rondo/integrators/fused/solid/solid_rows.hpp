// SPDX-License-Identifier: BSD-3-Clause
/// @file  The stiffness of a sector of a wheel in three dimensions as the steps take it: each
/// vector in the frame of its own node, whose first axis points from the axle to X; and which of
/// its rows are mirrors of themselves.
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/integrators/fused/kernels/solid/layout.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

struct SolidBlock {
  int row;                  ///< row that the block acts on
  int shift;                ///< shift of the sector of that row
  std::array<double, 9> k;  ///< column-major [N/m]
};

/// The nodes that a row couples with: one of a sector, or three of the same radius and z.
struct SolidCoupling {
  struct Place {
    int row = 0, shift = 0;
    bool operator==(const Place&) const = default;
  };
  Place here, last, next;  ///< last and next: of mirrored rows
  std::vector<double> k;   ///< 9 numbers, or kernels::n_mirror

  [[nodiscard]] bool same_nodes(const SolidCoupling& b) const noexcept {
    return here == b.here && last == b.last && next == b.next;
  }
};

struct SolidStiffness {
  std::vector<Complex> frame;  ///< (n_local) of each row's node in that of its sector
  std::vector<Vec3> arm;       ///< (n_local) X in it                                        [m]
  /// (n_local) ascending by row and shift, symmetric to the last bit: the very blocks of the steps.
  std::vector<std::vector<SolidBlock>> blocks;
  std::vector<kernels::SolidKind> kind;               ///< (n_local)
  std::vector<std::vector<SolidCoupling>> couplings;  ///< (n_local) ascending by `here`
};

/// @param sector of the model, its rows in the order of the steps
SolidStiffness solid_stiffness(const Model& model, const fem::SolidSector& sector);

}  // namespace rondo::dynamics
