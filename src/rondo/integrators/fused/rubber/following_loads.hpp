// SPDX-License-Identifier: BSD-3-Clause
/// @file  Pressures that follow the deformed boundary of rubber: the loads of the sparse plan, anew
/// at each u_{n+1}.
#pragma once
#include <vector>

#include "rondo/integrators/fused/sparse_plan.hpp"

namespace rondo::dynamics {

class FollowingLoads {
 public:
  /// @param plan with its loads and row_of_node
  FollowingLoads(const Model& model, const SparsePlan& plan);

  /// @param now (rows, 2) u_{n+1}, zeros behind the last row
  void update(const double* now, SparsePlan& plan) const noexcept;

 private:
  struct End {
    std::size_t u = 0;    ///< where its pair is
    std::size_t to = 0;   ///< where its x is among the loads
    bool is_free = true;  ///< else there is none
  };
  struct Edge {
    End first, second;
    Vec2 along;  ///< undeformed                                                        [m]
  };
  std::vector<Edge> edges_;
};

}  // namespace rondo::dynamics
