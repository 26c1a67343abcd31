// SPDX-License-Identifier: BSD-3-Clause
/// @file  The step of a wheel in three dimensions by assembled rows of 3×3 blocks, as a program for
/// any mesh would do it: one pass over rows, with the same spin, dampings and energy sums, without
/// ground and gravity.
#pragma once
#include <cstdint>
#include <vector>

#include "rondo/model/model.hpp"

namespace rondo::bench {

class SolidBlocks {
 public:
  /// Starts from rest.
  explicit SolidBlocks(const dynamics::Model& model);
  void advance(int steps);
  /// Kinetic energy before the last step [J].
  [[nodiscard]] double kinetic() const noexcept { return kinetic_; }

 private:
  double dt_, beta_, alpha_, spin_;
  std::vector<std::int64_t> start_;
  std::vector<double> blocks_;                ///< column-major, 9 each, and 3 unused at the end
  std::vector<std::int32_t> column_;          ///< 3 × node number
  std::vector<double> u_, next_, v_, force_;  ///< (nodes, 3), and one unused
  std::vector<double> constants_;             ///< (nodes, 3) X in the plane, m
  double kinetic_ = 0.0, sums_[4]{};
};

}  // namespace rondo::bench
