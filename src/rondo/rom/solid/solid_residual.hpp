// SPDX-License-Identifier: BSD-3-Clause
/// @file  What forces on the contact nodes of a wheel in three dimensions do beyond its modes
/// (docs/reduced3d.md).
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "rondo/rom/solid/solid_ring.hpp"

namespace rondo::rom {

/// Finds the tables that ring_residual() finds for a disk, in its convected form. `fields` of the
/// result stays empty.
[[nodiscard]] RingResidual solid_residual(const SolidRing& ring,
                                          std::span<const RingHarmonic> harmonics,
                                          double spin_squared);

/// Finds the tables that creep_residual() finds for a viscous disk, for a viscous ring.
[[nodiscard]] CreepResidual solid_creep_residual(const SolidRing& ring,
                                                 std::span<const RingHarmonic> harmonics,
                                                 double spin_squared,
                                                 std::span<const CreepTerm> creep);

/// Displacement of all rows beyond the modes by forces on the contact nodes that stand still in
/// space, harmonic by harmonic, at one spin.
class SolidFields {
 public:
  /// Ring and harmonics must outlive it. @param creep empty: the ring is elastic
  SolidFields(const SolidRing& ring, std::span<const RingHarmonic> harmonics, double spin,
              std::span<const CreepTerm> creep);

  [[nodiscard]] double spin() const noexcept { return spin_; }
  /// @param at_once, later (3C, N/2 + 1) forces that the matrices of CreepResidual act on; of an
  /// elastic ring `later` is 0 [N] @return (rows, N/2 + 1) [m]
  [[nodiscard]] Eigen::MatrixXcd operator()(const Eigen::MatrixXcd& at_once,
                                            const Eigen::MatrixXcd& later) const;

 private:
  using Rows = Eigen::VectorXcd;

  const SolidRing& ring_;
  double spin_;
  /// (N/2 + 1) What forces on the rows do beyond the modes.
  std::vector<std::function<Rows(const Rows& at_once, const Rows& later)>> beyond_;
};

}  // namespace rondo::rom
