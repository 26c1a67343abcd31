// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/sparse_plan.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/fused/numbering.hpp"
#include "rondo/model/pressure.hpp"

namespace rondo::dynamics {
namespace {

using kernels::lanes;
/// Packs of a block: few enough that threads share a small body evenly, and on large bodies so many
/// that the sums of blocks are few.
constexpr std::size_t fewest_packs = 16, most_blocks = 512;

/// (n) row of each node; -1: clamped.
std::vector<int> row_of(const Model& model, const SparsePlan& plan) {
  std::vector<int> row(model.n_nodes(), -1);
  for (std::size_t i = 0; i < plan.node.size(); ++i)
    row[static_cast<std::size_t>(plan.node[i])] = static_cast<int>(i);
  return row;
}

void add_constants(const Model& model, SparsePlan& plan) {
  plan.constants = LargeArray(plan.n_packs * 4 * lanes);
  for (std::size_t i = 0; i < plan.node.size(); ++i) {
    const auto node = static_cast<std::size_t>(plan.node[i]);
    double* c = plan.constants.data() + i / lanes * 4 * lanes + i % lanes;
    c[0] = model.reference[node].x;
    c[lanes] = model.reference[node].y;
    RONDO_ASSERT(model.mass[node] > 0.0 || has_massless_contact(model), node, model.mass[node]);
    c[2 * lanes] = model.mass[node];
    c[3 * lanes] = model.mass[node] > 0.0 ? model.dt / model.mass[node] : 0.0;
  }
}

std::size_t packs_of(std::size_t n_rows) noexcept {
  return (n_rows + lanes - 1) / lanes;
}

void add_contact(const Model& model, const std::vector<int>& row, SparsePlan& plan) {
  if (!model.contact) return;
  const std::vector<int>& nodes = model.contact->nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto node = static_cast<std::size_t>(nodes[i]);
    RONDO_DEMAND(row[node] >= 0, nodes[i]);
    plan.candidates.push_back({model.reference[node], row[node], static_cast<int>(i)});
    plan.row.push_back(row[node]);
  }
  std::sort(plan.candidates.begin(), plan.candidates.end(),
            [](const auto& a, const auto& b) { return a.row < b.row; });
  plan.first_candidate.resize(plan.n_blocks + 1);
  std::size_t c = 0;
  for (std::size_t b = 0; b <= plan.n_blocks; ++b) {
    while (c < plan.candidates.size() &&
           static_cast<std::size_t>(plan.candidates[c].row) < plan.first_pack(b) * lanes)
      ++c;
    plan.first_candidate[b] = c;
  }
  RONDO_DEMAND(c == nodes.size(), c, nodes.size());  // every candidate in exactly one block
}

/// Adds the forces of each load on each pack that it acts on.
void add_loads(const Model& model, const std::vector<int>& row, SparsePlan& plan) {
  std::map<std::pair<std::size_t, int>, std::array<Vec2, lanes>> loads;  // by pack and load
  for (const NodalLoad& l : nodal_loads(model)) {
    const int at = row[static_cast<std::size_t>(l.node)];
    if (at < 0) continue;
    const auto i = static_cast<std::size_t>(at);
    loads[{i / lanes, l.load}][i % lanes] = l.force;
  }
  if (loads.empty()) return;
  plan.loads = LargeArray(loads.size() * 2 * lanes);
  plan.first_load.assign(plan.n_packs + 1, 0);
  double* to = plan.loads.data();
  for (const auto& [key, forces] : loads) {
    plan.load_of.push_back(key.second);
    ++plan.first_load[key.first + 1];
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      to[lane] = forces[lane].x;
      to[lane + lanes] = forces[lane].y;
    }
    to += 2 * lanes;
  }
  std::partial_sum(plan.first_load.begin(), plan.first_load.end(), plan.first_load.begin());
  RONDO_DEMAND(static_cast<std::size_t>(plan.first_load.back()) == plan.load_of.size(),
               plan.first_load.back(), plan.load_of.size());
}

}  // namespace

/// A multiple of four, where there are so many: of two or four threads none has one block more.
std::size_t n_sparse_blocks(std::size_t n_rows) noexcept {
  const std::size_t n = std::clamp(packs_of(n_rows) / fewest_packs, std::size_t{1}, most_blocks);
  return n < 4 ? n : n / 4 * 4;
}

SparsePlan make_sparse_plan(const Model& model) {
  const fem::BlockCsr& k = model.rubber ? model.rubber->linear : model.stiffness;
  RONDO_DEMAND(k.row_start.size() == model.n_nodes() + 1, k.row_start.size(), model.n_nodes());
  constexpr std::size_t most_nodes = 1U << 30U;  // twice the node is a column
  RONDO_DEMAND(model.free.size() < most_nodes, model.free.size());
  SparsePlan plan;
  plan.wheel = model.rim.has_value();
  plan.keeps_force = plan.wheel || model.stiffness_damping > 0.0;
  plan.node = row_order(model.stiffness, model.free);
  sort_by_length(k, plan.node);
  plan.n_packs = packs_of(plan.node.size() + (model.rubber ? 1 : 0));  // a row of zeros is there
  plan.n_blocks = n_sparse_blocks(plan.node.size());
  RONDO_DEMAND(plan.node.size() == model.free.size() && model.mass.size() == model.n_nodes(),
               plan.node.size(), model.free.size(), model.mass.size(), model.n_nodes());
  const std::vector<int> row = row_of(model, plan);
  RONDO_ASSERT(static_cast<std::size_t>(std::ranges::count_if(row, [](int r) { return r >= 0; })) ==
                   model.free.size(),
               model.free.size());  // every free node in exactly one row
  plan.matrix = make_row_packs(k, plan.node, plan.n_packs, row);
  add_constants(model, plan);
  add_contact(model, row, plan);
  add_loads(model, row, plan);
  if (model.rubber) plan.row_of_node = row;
  return plan;
}

}  // namespace rondo::dynamics
