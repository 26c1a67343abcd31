// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/bodies/body_plan.hpp"

#include <algorithm>
#include <span>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/sum.hpp"

namespace rondo::dynamics {
namespace {

using kernels::lanes;
/// Packs of a block at least, and blocks of a group at most.
constexpr std::size_t fewest_packs = 16, most_blocks = 128;
void add_group(const Model& model, int body, std::span<const int> nodes, BodyPlan& plan) {
  if (nodes.empty()) return;
  std::vector<int> order = row_order(model.stiffness, nodes);
  sort_by_length(model.stiffness, order);
  BodyGroup group;
  group.body = body;
  group.first_pack = plan.n_packs;
  plan.node.insert(plan.node.end(), order.begin(), order.end());
  plan.n_packs += (order.size() + lanes - 1) / lanes;
  plan.node.resize(plan.n_packs * lanes, -1);
  group.last_pack = plan.n_packs;
  const std::size_t packs = group.last_pack - group.first_pack;
  const std::size_t blocks = std::clamp(packs / fewest_packs, std::size_t{1}, most_blocks);
  group.first_block = plan.blocks.size();
  for (std::size_t i = 0; i < blocks; ++i)
    plan.blocks.push_back({plan.groups.size(), group.first_pack + packs * i / blocks,
                           group.first_pack + packs * (i + 1) / blocks});
  group.last_block = plan.blocks.size();
  plan.groups.push_back(group);
}

void add_groups(const Model& model, BodyPlan& plan) {
  std::vector<int> held;
  std::size_t n_free = 0;
  for (const int node : model.free)
    if (!in_fixed_frame(model, static_cast<std::size_t>(node))) held.push_back(node);
  add_group(model, -1, held, plan);
  for (std::size_t b = 0; b < model.free_bodies.size(); ++b) {
    add_group(model, static_cast<int>(b), model.free_bodies[b].nodes, plan);
    n_free += model.free_bodies[b].nodes.size();
  }
  RONDO_DEMAND(held.size() + n_free == model.free.size(), held.size(), n_free, model.free.size());
  plan.row.assign(model.n_nodes(), -1);
  for (std::size_t i = 0; i < plan.node.size(); ++i)
    if (plan.node[i] >= 0) plan.row[at(plan.node[i])] = static_cast<int>(i);
}

/// Adds the constants of a row of a group.
void add_constant(const Model& model, const BodyGroup& group, int row, BodyPlan& plan) {
  const auto node = static_cast<std::size_t>(plan.node[at(row)]);
  RONDO_ASSERT(model.mass[node] > 0.0, node, model.mass[node]);
  const Vec2 arm = model.reference[node] - group.center;
  double* c = plan.constants.data() + BodyPlan::at(row);
  c[0] = arm.x;
  c[lanes] = arm.y;
  c[2 * lanes] = model.mass[node];
  c[3 * lanes] = model.dt / model.mass[node];
}

void add_constants(const Model& model, BodyPlan& plan) {
  plan.constants = LargeArray(plan.n_packs * 4 * lanes);
  for (BodyGroup& group : plan.groups) {
    if (!group.held()) {
      const FreeBody& body = model.free_bodies[at(group.body)];
      group.mass = body.mass;
      group.center = body.center;
    }
    CompensatedSum x, y, inertia;
    for (std::size_t i = group.first_pack * lanes; i < group.last_pack * lanes; ++i) {
      if (plan.node[i] < 0) continue;
      add_constant(model, group, static_cast<int>(i), plan);
      const double* c = plan.constants.data() + BodyPlan::at(static_cast<int>(i));
      const Vec2 arm{c[0], c[lanes]};
      const double mass = c[2 * lanes];
      x.add(mass * arm.x);
      y.add(mass * arm.y);
      inertia.add(mass * dot(arm, arm));
    }
    group.offset = {x.value(), y.value()};
    group.inertia = inertia.value();
    RONDO_DEMAND(group.held() || (group.mass > 0.0 && group.inertia > 0.0), group.body, group.mass,
                 group.inertia);
  }
}

}  // namespace

std::size_t BodyPlan::group_of(int at_row) const noexcept {
  const std::size_t pack = static_cast<std::size_t>(at_row) / lanes;
  const auto group = std::ranges::upper_bound(groups, pack, {}, &BodyGroup::last_pack);
  RONDO_ASSERT(at_row >= 0 && group != groups.end(), at_row, n_packs);
  return static_cast<std::size_t>(group - groups.begin());
}

BodyPlan make_body_plan(const Model& model) {
  const fem::BlockCsr& k = model.stiffness;
  RONDO_DEMAND(k.row_start.size() == model.n_nodes() + 1, k.row_start.size(), model.n_nodes());
  constexpr std::size_t most_nodes = 1U << 29U;  // twice the row, padding included, is a column
  RONDO_DEMAND(model.free.size() < most_nodes, model.free.size());
  BodyPlan plan;
  add_groups(model, plan);
  RONDO_DEMAND(!plan.blocks.empty() && plan.blocks.front().first_pack == 0 &&
                   plan.blocks.back().last_pack == plan.n_packs,
               plan.blocks.size(), plan.n_packs);  // every row in exactly one block
  plan.matrix = make_row_packs(k, plan.node, plan.n_packs, plan.row);
  add_constants(model, plan);
  return plan;
}

}  // namespace rondo::dynamics
