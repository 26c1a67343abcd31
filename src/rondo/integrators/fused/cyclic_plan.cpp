// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/cyclic_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/pressure.hpp"

namespace rondo::dynamics {
namespace {

using fem::SectorStiffness;

constexpr int group_columns = kernels::group_packs * kernels::lanes;

void add_rows(const Model& model, const SectorStiffness& k, CyclicPlan& plan) {
  for (const SectorStiffness::Entry& e : k.entries) {
    RONDO_ASSERT(e.shift >= -1 && e.shift <= 1, e.column, e.shift);
    kernels::CyclicEntry entry{e.column * plan.row_size() + e.shift, {}};
    std::copy(e.block.begin(), e.block.end(), entry.k);
    plan.entries.push_back(entry);
  }
  for (std::size_t a = 0; a < k.n_local(); ++a) {
    const double mass = model.mass[k.node(a, 0)];
    RONDO_ASSERT(mass > 0.0 || has_massless_contact(model), a, mass);
    const Vec2 reference = model.reference[k.node(a, 0)];
    plan.rows.push_back({.entries = plan.entries.data() + k.row_start[a],
                         .n_entries = static_cast<int>(k.row(a).size()),
                         .at = static_cast<std::ptrdiff_t>(a) * plan.row_size(),
                         .mass = mass,
                         .dt_over_mass = mass > 0.0 ? model.dt / mass : 0.0,
                         .x = reference.x,
                         .y = reference.y});
  }
}

/// The mirrored part of a row's blocks on one layer: D k(-s) D is k(s), D = diag(1, -1). Summed so
/// that symmetry is kept to the last bit. `left` and `right` are the blocks of the last and the
/// next sector.
kernels::MirrorBlock mirrored(const std::array<double, 4>& here, const std::array<double, 4>& left,
                              const std::array<double, 4>& right) noexcept {
  return {.rr = here[0],
          .tt = here[3],
          .rr1 = 0.5 * (left[0] + right[0]),
          .tt1 = 0.5 * (left[3] + right[3]),
          .rt1 = 0.5 * (right[2] - left[2]),
          .tr1 = 0.5 * (right[1] - left[1])};
}

/// Largest part of the blocks that is not mirrored.
double deviation(const std::array<double, 4>& here, const std::array<double, 4>& left,
                 const std::array<double, 4>& right) noexcept {
  return std::max({std::abs(here[1]), std::abs(here[2]), std::abs(left[0] - right[0]),
                   std::abs(left[3] - right[3]), std::abs(left[1] + right[1]),
                   std::abs(left[2] + right[2])});
}

/// If a sector is one line of nodes and its own mirror, as that of a smooth disk, a row needs
/// half of the products.
void add_mirror(const SectorStiffness& k, CyclicPlan& plan) {
  const int n = plan.n_local;
  std::vector<kernels::MirrorRow> rows(static_cast<std::size_t>(n));
  double largest = 0.0, worst = 0.0;
  for (int a = 0; a < n; ++a) {
    std::array<std::array<std::array<double, 4>, 3>, 3> blocks{};  // [layer][shift]
    for (const SectorStiffness::Entry& e : k.row(static_cast<std::size_t>(a))) {
      if (std::abs(e.column - a) > 1) return;
      const int layer = e.column - a + 1, place = e.shift + 1;
      blocks[at(layer)][at(place)] = e.block;
      largest = std::max(largest, std::abs(e.block[0]));
    }
    const auto block = [&](std::size_t layer) {
      const auto& [left, here, right] = blocks[layer];
      worst = std::max(worst, deviation(here, left, right));
      return mirrored(here, left, right);
    };
    rows[at(a)] = {block(0), block(1), block(2)};
  }
  constexpr double round_off = 1e-11;  // of the coordinates, over the size of an element
  if (worst <= round_off * largest) plan.mirror = std::move(rows);
}

/// A strip reads u of the rows that couple with its own, and overwrites what these read in the step
/// before: that step must have done them.
void add_order(const SectorStiffness& k, CyclicPlan& plan) {
  plan.needs.assign((k.n_local() + kernels::most_rows - 1) / kernels::most_rows, 0);
  for (std::size_t a = 0; a < k.n_local(); ++a)
    for (const SectorStiffness::Entry& e : k.row(a)) {
      int& needed = plan.needs[a / kernels::most_rows];
      needed = std::max(needed, e.column / kernels::most_rows);
    }
}

/// The rows tell which of their strip's loads are theirs.
void add_loads(const Model& model, const SectorStiffness& k, CyclicPlan& plan) {
  const std::vector<int> row_of = rows_of_nodes(plan);
  std::map<std::pair<int, int>, CyclicLoad> loads;  // by row and load
  for (const NodalLoad& l : nodal_loads(model)) {
    const int a = row_of[at(l.node % k.nodes_per_sector)];
    RONDO_ASSERT(l.node / k.nodes_per_sector < k.n_sectors, l.node, k.n_sectors);
    if (a < 0) continue;
    CyclicLoad& on_row = loads[{a, l.load}];
    on_row.row = a;
    on_row.load = l.load;
    on_row.force.resize(static_cast<std::size_t>(k.n_sectors));
    const auto sector = static_cast<std::size_t>(l.node / k.nodes_per_sector);
    on_row.force[sector] = conj(k.turn[sector]) * l.force;
  }
  for (auto& [key, load] : loads) {
    kernels::CyclicRow& row = plan.rows[at(key.first)];
    const int strip = key.first / kernels::most_rows;
    if (row.n_loads++ == 0)
      row.first_load = static_cast<int>(plan.loads.size() - plan.first_load(strip));
    plan.load_of.push_back(load.load);
    plan.loads.push_back(std::move(load));
  }
}

/// Strips with candidates.
void add_contact(const Model& model, CyclicPlan& plan) {
  find_candidates(model, plan);
  for (int a = 0; a < plan.n_local; ++a) {
    if (plan.contact_row[at(a)] < 0) continue;
    const int strip = a / kernels::most_rows;
    if (plan.last_contact_strip < 0) plan.first_contact_strip = strip;
    plan.last_contact_strip = strip;
  }
  if (has_sharp_corners(model))  // these are held after the last one: before, none is read again
    for (int& needed : plan.needs)
      if (needed >= plan.first_contact_strip) needed = std::max(needed, plan.last_contact_strip);
}

}  // namespace

std::size_t n_cyclic_groups(int n_sectors) noexcept {
  return n_groups_of(n_sectors, group_columns);
}

std::size_t CyclicPlan::first_load(int strip) const noexcept {
  const auto first =
      std::lower_bound(loads.begin(), loads.end(), strip * kernels::most_rows,
                       [](const CyclicLoad& load, int row) { return load.row < row; });
  return static_cast<std::size_t>(first - loads.begin());
}

CyclicPlan make_cyclic_plan(const Model& model, const CyclicTuning& tuning) {
  RONDO_DEMAND(model.sector.has_value());
  const SectorStiffness& k = *model.sector;
  RONDO_DEMAND(k.n_local() > 0 && model.mass.size() == model.n_nodes() &&
                   k.n_local() * static_cast<std::size_t>(k.n_sectors) == model.free.size(),
               k.n_local(), k.n_sectors, model.mass.size(), model.free.size());
  CyclicPlan plan;
  plan.n_local = static_cast<int>(k.n_local());
  plan.n_sectors = k.n_sectors;
  plan.nodes_per_sector = k.nodes_per_sector;
  plan.nodes = k.nodes;
  plan.wheel = model.rim.has_value();
  plan.stepwise = plan.wheel || model.implicit.has_value() || has_massless_contact(model);
  plan.keeps_force = plan.wheel || model.stiffness_damping > 0.0;
  plan.keeps_impulse = has_friction_law(model);
  plan.n_sums = plan.wheel ? int{kernels::n_wheel_sums} : int{kernels::n_sums};
  plan.group_columns = group_columns;
  cut_ring(model.threads, most_steps_in_a_pass, tuning, plan);
  set_stride(plan);
  add_rows(model, k, plan);
  add_mirror(k, plan);
  add_order(k, plan);
  add_contact(model, plan);
  add_loads(model, k, plan);
  return plan;
}

}  // namespace rondo::dynamics
