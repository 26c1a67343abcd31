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

std::vector<CyclicChunkRange> cut(int n_sectors, int columns_of_group, int groups, int n_chunks) {
  std::vector<CyclicChunkRange> chunks;
  for (int c = 0; c < n_chunks; ++c) {
    const int from = groups * c / n_chunks, to = groups * (c + 1) / n_chunks;
    CyclicChunkRange range;
    range.first = from * columns_of_group;
    range.columns = std::min(to * columns_of_group, n_sectors) - range.first;
    range.first_group = static_cast<std::size_t>(from);
    range.n_groups = static_cast<std::size_t>(to - from);
    chunks.push_back(range);
  }
  return chunks;
}

void choose_chunks(CyclicPlan& plan, int threads, const CyclicTuning& tuning) {
  const std::size_t bytes = static_cast<std::size_t>(plan.n_local) *
                            static_cast<std::size_t>(plan.n_sectors * plan.n_fields()) *
                            sizeof(double);
  RingCut ring = cut_ring(plan.n_sectors, group_columns, bytes, plan.stepwise, threads, tuning);
  plan.n_groups = ring.n_groups;
  plan.halo = ring.halo;
  plan.depth = ring.depth;
  plan.chunks = std::move(ring.chunks);
}

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
  plan.needs.assign(static_cast<std::size_t>(plan.n_strips()), 0);
  for (std::size_t a = 0; a < k.n_local(); ++a)
    for (const SectorStiffness::Entry& e : k.row(a)) {
      int& needed = plan.needs[a / kernels::most_rows];
      needed = std::max(needed, e.column / kernels::most_rows);
    }
}

/// (nodes_per_sector) row of each node of a sector; n_local where it is held.
std::vector<std::size_t> rows_of(const SectorStiffness& k) {
  std::vector<std::size_t> row_of(static_cast<std::size_t>(k.nodes_per_sector), k.n_local());
  for (std::size_t a = 0; a < k.n_local(); ++a) row_of[at(k.nodes[a])] = a;
  return row_of;
}

/// The rows tell which of their strip's loads are theirs.
void add_loads(const Model& model, const SectorStiffness& k, CyclicPlan& plan) {
  const std::vector<std::size_t> row_of = rows_of(k);
  std::map<std::pair<std::size_t, int>, CyclicLoad> loads;  // by row and load
  for (const NodalLoad& l : nodal_loads(model)) {
    const std::size_t a = row_of[at(l.node % k.nodes_per_sector)];
    RONDO_ASSERT(l.node / k.nodes_per_sector < k.n_sectors, l.node, k.n_sectors);
    if (a == k.n_local()) continue;
    CyclicLoad& on_row = loads[{a, l.load}];
    on_row.row = static_cast<int>(a);
    on_row.load = l.load;
    on_row.force.resize(static_cast<std::size_t>(k.n_sectors));
    const auto sector = static_cast<std::size_t>(l.node / k.nodes_per_sector);
    on_row.force[sector] = conj(k.turn[sector]) * l.force;
  }
  for (auto& [key, load] : loads) {
    kernels::CyclicRow& row = plan.rows[key.first];
    const auto strip = static_cast<int>(key.first) / kernels::most_rows;
    if (row.n_loads++ == 0)
      row.first_load = static_cast<int>(plan.loads.size() - plan.first_load(strip));
    plan.load_of.push_back(load.load);
    plan.loads.push_back(std::move(load));
  }
}

void add_contact(const Model& model, const SectorStiffness& k, CyclicPlan& plan) {
  plan.contact_row.assign(k.n_local(), -1);
  if (!model.contact) return;
  const std::vector<std::size_t> row_of = rows_of(k);
  for (std::size_t i = 0; i < model.contact->nodes.size(); ++i) {
    const int node = model.contact->nodes[i];
    const std::size_t a = row_of[at(node % k.nodes_per_sector)];
    RONDO_DEMAND(a < k.n_local(), node);
    int& row = plan.contact_row[a];
    if (row < 0) {
      row = static_cast<int>(plan.candidate.size());
      plan.candidate.emplace_back(static_cast<std::size_t>(k.n_sectors), -1);
    }
    const int sector = node / k.nodes_per_sector;
    plan.candidate[at(row)][at(sector)] = static_cast<int>(i);
    plan.place.push_back({static_cast<int>(a), sector});
  }
  for (int a = 0; a < plan.n_local; ++a) {
    if (plan.contact_row[at(a)] < 0) continue;
    const int strip = a / kernels::most_rows;
    if (plan.last_contact_strip < 0) plan.first_contact_strip = strip;
    plan.last_contact_strip = strip;
  }
  if (has_sharp_corners(model))  // these are held after the last one: before, none is read again
    for (int& needed : plan.needs)
      if (needed >= plan.first_contact_strip) needed = std::max(needed, plan.last_contact_strip);
  for (const std::vector<int>& ring : plan.candidate)  // the same nodes in every sector
    RONDO_DEMAND(std::find(ring.begin(), ring.end(), -1) == ring.end(), ring.size());
}

}  // namespace

std::size_t n_cyclic_groups(int n_sectors) noexcept {
  return static_cast<std::size_t>((n_sectors + group_columns - 1) / group_columns);
}

RingCut cut_ring(int n_sectors, int columns_of_group, std::size_t bytes, bool stepwise, int threads,
                 const CyclicTuning& tuning) {
  RONDO_DEMAND(n_sectors > 0 && columns_of_group > 0 && threads >= 1 && tuning.chunk_columns > 0,
               n_sectors, columns_of_group, threads, tuning.chunk_columns);
  RingCut ring;
  const int groups = (n_sectors + columns_of_group - 1) / columns_of_group;
  ring.n_groups = static_cast<std::size_t>(groups);
  const bool in_cache = stepwise || bytes < tuning.cache_bytes * static_cast<std::size_t>(threads);
  const int for_threads = std::min(threads, groups);
  const int for_cache = in_cache ? 1 : std::max(1, n_sectors / tuning.chunk_columns);
  const int n_chunks =
      (std::max(for_threads, for_cache) + for_threads - 1) / for_threads * for_threads;
  ring.chunks = cut(n_sectors, columns_of_group, groups, std::min(n_chunks, groups));
  const auto narrowest =
      std::min_element(ring.chunks.begin(), ring.chunks.end(),
                       [](const auto& a, const auto& b) { return a.columns < b.columns; });
  const CyclicChunkRange& last = ring.chunks.back();  // every sector and group in one chunk
  RONDO_DEMAND(narrowest->columns > 0 && last.first + last.columns == n_sectors &&
                   last.first_group + last.n_groups == ring.n_groups,
               narrowest->columns, last.first, last.columns, n_sectors);
  if (ring.chunks.size() == 1)
    ring.halo = Halo::ring;
  else if (stepwise)
    ring.halo = Halo::narrow;
  else
    ring.halo = narrowest->columns >= tuning.wide_halo_columns ? Halo::wide : Halo::narrow;
  const bool one_by_one = ring.halo == Halo::ring ? in_cache : ring.halo == Halo::narrow;
  ring.depth = one_by_one ? 1 : most_steps_in_a_pass;
  RONDO_DEMAND(ring.halo != Halo::wide || narrowest->columns >= halo_columns, narrowest->columns);
  return ring;
}

/// Room for the columns of the widest chunk, whole packs, and the halo on both sides. Fields whose
/// distance is near a multiple of 4096 B would hinder each other in the first cache.
std::ptrdiff_t cyclic_stride(const std::vector<CyclicChunkRange>& chunks) noexcept {
  int widest = 0;
  for (const CyclicChunkRange& chunk : chunks) widest = std::max(widest, chunk.columns);
  std::ptrdiff_t stride =
      (widest + 2 * kernels::lanes - 1) / kernels::lanes * kernels::lanes + 2 * halo_columns;
  constexpr std::ptrdiff_t page = 4096 / sizeof(double), apart = page / 8;
  static_assert(page % kernels::lanes == 0 && 2 * apart < page);
  while (stride % page < apart || stride % page > page - apart) stride += kernels::lanes;
  RONDO_DEMAND(widest > 0 && stride % kernels::lanes == 0, widest, stride);
  return stride;
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
  plan.wheel = model.rim.has_value();
  plan.stepwise = plan.wheel || model.implicit.has_value() || has_massless_contact(model);
  plan.keeps_force = plan.wheel || model.stiffness_damping > 0.0;
  choose_chunks(plan, model.threads, tuning);
  plan.stride = cyclic_stride(plan.chunks);
  add_rows(model, k, plan);
  add_mirror(k, plan);
  add_order(k, plan);
  add_contact(model, k, plan);
  add_loads(model, k, plan);
  return plan;
}

}  // namespace rondo::dynamics
