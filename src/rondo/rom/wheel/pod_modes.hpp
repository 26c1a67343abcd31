// SPDX-License-Identifier: BSD-3-Clause
/// @file  Modes of a ring from fields that its runs went through (docs/reduced.md): the POD of
/// these fields together with the same fields turned by any number of sectors. Its modes are
/// harmonics, so that steps and residual are those of eigenmodes.
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "rondo/rom/wheel/ring_harmonics.hpp"

namespace rondo::rom {

struct PodModes {
  std::vector<RingHarmonic> harmonics;  ///< that have modes, ascending
  double left = 0.0;  ///< share of the energy of the fields outside the modes, in the mass norm
};

/// Sums up fields, for their POD in the mass norm of the nodes with mass.
class FieldHarmonics {
 public:
  /// The ring must outlive it. @pre it has more than one sector
  explicit FieldHarmonics(const Ring& ring);

  /// @param field (n) on all nodes of the body, in the co-rotating frame
  void add(std::span<const Vec2> field);
  /// Σ over fields of their squared mass norm. The harmonic N/2 is in it, but has no modes.
  [[nodiscard]] double energy() const noexcept { return energy_; }
  /// The modes with most energy, at least `wanted` where the fields have so many; a mode of a
  /// harmonic k > 0 counts for two.
  [[nodiscard]] PodModes modes(int wanted) const;

 private:
  const Ring& ring_;
  std::vector<Eigen::Index> rows_;  ///< of the nodes with mass
  Eigen::VectorXd root_;            ///< (inner) √M
  Eigen::MatrixXcd waves_;          ///< (harmonics, N) e^{-ikφ_j}/N
  Eigen::MatrixXd field_;           ///< (N, inner) √M u in the frames of the sectors
  double energy_ = 0.0;
  std::vector<Eigen::MatrixXcd> sums_;  ///< (inner, inner) Σ M^½ U_k U_kᴴ M^½ of each harmonic
};

}  // namespace rondo::rom
