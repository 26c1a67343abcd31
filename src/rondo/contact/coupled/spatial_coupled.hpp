// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contacts in space that share nodes: one problem for all of them, and its solver
/// (docs/wheel3d.md, docs/theory.md, 4.7). What coupled.hpp is in the plane, with two tangential
/// directions. Block Gauss–Seidel: Jourdan, Alart, Jean, CMAME 155 (1998) 31, accelerated as by
/// D. G. Anderson, J. ACM 12 (1965) 547; least squares where that is slow (spatial_squares.hpp).
#pragma once
#include <array>
#include <span>
#include <vector>

#include "rondo/contact/cone.hpp"
#include "rondo/contact/coupled/coupled.hpp"

namespace rondo::contact {

/// A 3×3 matrix by rows.
using SpatialBlock = std::array<Vec3, 3>;

constexpr Vec3 apply(const SpatialBlock& a, Vec3 b) noexcept {
  return {dot(a[0], b), dot(a[1], b), dot(a[2], b)};
}
/// Aᵀ b.
constexpr Vec3 transposed(const SpatialBlock& a, Vec3 b) noexcept {
  return b.x * a[0] + b.y * a[1] + b.z * a[2];
}

/// Relative velocities w = free + W r; each contact obeys the law of cone.hpp with its own bounce
/// and friction.
struct SpatialCoupled {
  std::vector<Vec3> free;            ///< (nc) w without impulses                      [m/s]
  std::vector<double> bounce;        ///< (nc) see SpatialProblem                       [m/s]
  std::vector<double> friction;      ///< (nc) μ                                        [-]
  std::vector<SpatialBlock> blocks;  ///< (nc, nc) W, row by row; on the diagonal see
                                     ///< solve_spatial()                              [1/kg]

  [[nodiscard]] std::size_t size() const noexcept { return free.size(); }
  [[nodiscard]] const SpatialBlock& block(std::size_t j, std::size_t l) const noexcept {
    return blocks[j * size() + l];
  }
  /// Scale of the residual: the inverse of the mean of W_jj's diagonal [kg].
  [[nodiscard]] double mass(std::size_t j) const noexcept {
    const SpatialBlock& w = block(j, j);
    return 3.0 / (w[0].x + w[1].y + w[2].z);
  }
};

/// Memory of the solver, kept from one problem to the next: it only grows.
struct SpatialWorkspace {
  std::vector<Vec3> from, found;            ///< (nc) iterates
  std::vector<Vec3> change, change_before;  ///< (nc) found - from
  std::vector<Vec3> found_before;           ///< (nc)
  std::vector<Vec3> of_change, of_found;    ///< (depth, nc) differences of two iterates
  std::vector<Status> status;               ///< (nc)
  // Least squares use these:
  std::vector<Vec3> value, trial;  ///< (nc)
  std::vector<double> slope;       ///< (3 nc, 3 nc)
  std::vector<double> matrix;      ///< (3 nc, 3 nc)
  std::vector<double> step;        ///< (3 nc)
};

/// Impulses that obey the law at all contacts together. `impulse` (nc) comes in as a warm start and
/// leaves, with `status` (nc), as the best iterate; the residual is the largest law residual over
/// the largest mass |free|.
/// @post r_n >= 0, |r_t| <= μ r_n to round-off.
[[nodiscard]] CoupledResult solve_coupled(const SpatialCoupled& problem,
                                          const CoupledLimits& limits, std::span<Vec3> impulse,
                                          std::span<Status> status, SpatialWorkspace& work);

}  // namespace rondo::contact
