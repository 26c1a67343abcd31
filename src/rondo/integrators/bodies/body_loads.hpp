// SPDX-License-Identifier: BSD-3-Clause
/// @file  Pressures on bodies laid out in packs (docs/theory.md, 9.8).
#pragma once
#include <vector>

#include "rondo/integrators/bodies/body_plan.hpp"

namespace rondo::dynamics {

class BodyLoads {
 public:
  BodyLoads(const Model& model, const BodyPlan& plan);

  /// Forces at t and the displacements of `motion`, as in kernels::BodyFields.
  void find(const double* motion, double t) noexcept;
  /// Force on a row                                                                      [N/m]
  [[nodiscard]] Vec2 on(int row) const noexcept;

  /// Members of kernels::BodyFields; null: there are none.
  [[nodiscard]] const int* load_at() const noexcept { return at_.empty() ? nullptr : at_.data(); }
  [[nodiscard]] const double* loads() const noexcept { return loads_.data(); }

 private:
  /// Its ends: rows and places among the loads; -1: clamped. `along`: b - a of X.
  struct Edge {
    std::array<int, 2> row;
    std::array<int, 2> place;
    Vec2 along;
    bool follows = false;  ///< it pushes as it lies, in the fixed frame
    std::size_t load = 0;
  };
  const Model& model_;
  std::vector<int> at_;
  std::vector<Edge> edges_;
  LargeArray loads_;
};

}  // namespace rondo::dynamics
