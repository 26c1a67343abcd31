// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/rubber/following_loads.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

using kernels::lanes;

/// The place of the load of a row among those of its pack.
std::size_t place_of(const SparsePlan& plan, std::size_t row, int load) {
  auto at = static_cast<std::size_t>(plan.first_load[row / lanes]);
  const auto last = static_cast<std::size_t>(plan.first_load[row / lanes + 1]);
  while (at < last && plan.load_of[at] != load) ++at;
  RONDO_DEMAND(at < last, row, load);
  return at * 2 * lanes + row % lanes;
}

}  // namespace

FollowingLoads::FollowingLoads(const Model& model, const SparsePlan& plan) {
  RONDO_DEMAND(
      plan.row_of_node.size() == model.n_nodes() && plan.first_load.size() == plan.n_packs + 1,
      plan.row_of_node.size(), model.n_nodes(), plan.first_load.size(), plan.n_packs);
  for (std::size_t l = 0; l < model.pressures.size(); ++l)
    for (const mesh::Edge& edge : model.pressures[l].edges) {
      const auto end = [&](int node) {
        const int row = plan.row_of_node[at(node)];
        if (row < 0) return End{2 * plan.node.size(), 0, false};
        const auto r = static_cast<std::size_t>(row);
        return End{2 * r, place_of(plan, r, static_cast<int>(l)), true};
      };
      edges_.push_back({end(edge[0]), end(edge[1]),
                        model.reference[at(edge[1])] - model.reference[at(edge[0])]});
    }
}

/// Half of L n an end of each edge, as pressure_forces() has it.
void FollowingLoads::update(const double* now, SparsePlan& plan) const noexcept {
  double* loads = plan.loads.data();
  std::fill_n(loads, plan.loads.size(), 0.0);
  for (const Edge& e : edges_) {
    const Vec2 change{now[e.second.u] - now[e.first.u], now[e.second.u + 1] - now[e.first.u + 1]};
    const Vec2 share = 0.5 * turn90(e.along + change);
    for (const End& end : {e.first, e.second}) {
      if (!end.is_free) continue;
      loads[end.to] += share.x;
      loads[end.to + lanes] += share.y;
    }
  }
}

}  // namespace rondo::dynamics
