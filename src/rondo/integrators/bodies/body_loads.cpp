// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/bodies/body_loads.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {
namespace {

using kernels::lanes;

}  // namespace

BodyLoads::BodyLoads(const Model& model, const BodyPlan& plan) : model_(model) {
  if (model.pressures.empty()) return;
  at_.assign(plan.n_packs, -1);
  RONDO_DEMAND(plan.row.size() == model.n_nodes(), plan.row.size(), model.n_nodes());
  int n = 0;
  const auto place = [&](int row) {
    if (row < 0) return -1;
    int& at = at_[static_cast<std::size_t>(row) / lanes];
    if (at < 0) at = n++;
    return static_cast<int>(static_cast<std::size_t>(at) * 2 * lanes +
                            static_cast<std::size_t>(row) % lanes);
  };
  for (std::size_t l = 0; l < model.pressures.size(); ++l)
    for (const mesh::Edge& e : model.pressures[l].edges) {
      const auto a = static_cast<std::size_t>(e[0]), b = static_cast<std::size_t>(e[1]);
      const std::array row{plan.row[a], plan.row[b]};
      edges_.push_back({row,
                        {place(row[0]), place(row[1])},
                        model.reference[b] - model.reference[a],
                        in_fixed_frame(model, a),
                        l});
    }
  loads_ = LargeArray(static_cast<std::size_t>(n) * 2 * lanes);
}

void BodyLoads::find(const double* motion, double t) noexcept {
  if (edges_.empty()) return;
  std::fill_n(loads_.data(), loads_.size(), 0.0);
  std::size_t load = model_.pressures.size();
  double half = 0.0;
  for (const Edge& e : edges_) {
    if (e.load != load) half = 0.5 * model_.pressures[load = e.load].pressure.at(t);
    Vec2 along = e.along;
    if (e.follows) {
      const double *a = motion + BodyPlan::at(e.row[0]), *b = motion + BodyPlan::at(e.row[1]);
      along += Vec2{b[0] - a[0], b[lanes] - a[lanes]};
    }
    // The body is on the left of a → b: J along points into it, L times the inward normal.
    const Vec2 share = half * turn90(along);
    for (const int place : e.place) {
      if (place < 0) continue;
      loads_.data()[place] += share.x;
      loads_.data()[static_cast<std::size_t>(place) + lanes] += share.y;
    }
  }
}

Vec2 BodyLoads::on(int row) const noexcept {
  const auto i = static_cast<std::size_t>(row);
  RONDO_ASSERT(row >= 0 && (at_.empty() || i / lanes < at_.size()), row, at_.size());
  const int at = at_.empty() ? -1 : at_[i / lanes];
  if (at < 0) return {};
  const double* load = loads_.data() + static_cast<std::size_t>(at) * 2 * lanes + i % lanes;
  return {load[0], load[lanes]};
}

}  // namespace rondo::dynamics
