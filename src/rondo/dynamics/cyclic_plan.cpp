// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/dynamics/cyclic_plan.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {
namespace {

using fem::SectorStiffness;

constexpr int group_columns = kernels::group_packs * kernels::lanes;
/// Fields below this stay in the cache of a core from step to step: no passes of several steps.
constexpr std::size_t cache_bytes = 1'200'000;
/// Columns of a chunk that several steps pass over: their rows stay in the cache, the halo is
/// small.
constexpr int chunk_columns = 512;

void cut(CyclicPlan& plan, int n_chunks) {
  const int groups = static_cast<int>(plan.n_groups);
  for (int c = 0; c < n_chunks; ++c) {
    const int from = groups * c / n_chunks, to = groups * (c + 1) / n_chunks;
    CyclicChunkRange range;
    range.first = from * group_columns;
    range.columns = std::min(to * group_columns, plan.n_sectors) - range.first;
    range.first_group = static_cast<std::size_t>(from);
    range.n_groups = static_cast<std::size_t>(to - from);
    plan.chunks.push_back(range);
  }
}

/// Chunks for the threads and for the cache; many steps in a pass where the fields are larger than
/// it.
void choose_chunks(CyclicPlan& plan, int threads) {
  plan.n_groups = static_cast<std::size_t>((plan.n_sectors + group_columns - 1) / group_columns);
  const int groups = static_cast<int>(plan.n_groups);
  const std::size_t bytes = static_cast<std::size_t>(plan.n_local) *
                            static_cast<std::size_t>(plan.n_sectors * plan.n_fields) *
                            sizeof(double);
  const bool in_cache = bytes < cache_bytes * static_cast<std::size_t>(threads);
  const int for_threads = std::min(threads, groups);
  const int for_cache = in_cache ? 1 : std::max(1, plan.n_sectors / chunk_columns);
  const int n_chunks =
      (std::max(for_threads, for_cache) + for_threads - 1) / for_threads * for_threads;
  cut(plan, std::min(n_chunks, groups));
  const auto narrowest =
      std::min_element(plan.chunks.begin(), plan.chunks.end(),
                       [](const auto& a, const auto& b) { return a.columns < b.columns; });
  constexpr int worth_a_wide_halo = 16 * halo_columns;
  if (plan.chunks.size() == 1)
    plan.halo = Halo::ring;
  else
    plan.halo = !in_cache && narrowest->columns >= worth_a_wide_halo ? Halo::wide : Halo::narrow;
  plan.depth = in_cache || plan.halo == Halo::narrow ? 1 : most_steps_in_a_pass;
}

void add_entries(const SectorStiffness& k, CyclicPlan& plan) {
  plan.entry_start.push_back(0);
  for (std::size_t a = 0; a < k.n_local(); ++a) {
    for (const SectorStiffness::Entry& e : k.row(a)) {
      kernels::CyclicEntry entry{plan.row_at(e.column) + e.shift, {}};
      std::copy(e.block.begin(), e.block.end(), entry.k);
      plan.entries.push_back(entry);
    }
    plan.entry_start.push_back(static_cast<int>(plan.entries.size()));
  }
}

/// u of row b is advanced after the last row that couples with it; the next step does row a when
/// all that couple with a are advanced.
void add_order(const SectorStiffness& k, CyclicPlan& plan) {
  const auto n = k.n_local();
  std::vector<int> last_use(n);
  for (std::size_t a = 0; a < n; ++a) {
    last_use[a] = std::max(last_use[a], static_cast<int>(a));
    for (const SectorStiffness::Entry& e : k.row(a)) {
      int& last = last_use[static_cast<std::size_t>(e.column)];
      last = std::max(last, static_cast<int>(a));
    }
  }
  plan.advanced_start.assign(n + 1, 0);
  for (const int a : last_use) ++plan.advanced_start[static_cast<std::size_t>(a) + 1];
  for (std::size_t a = 0; a < n; ++a) plan.advanced_start[a + 1] += plan.advanced_start[a];
  plan.advanced.resize(n);
  std::vector<int> next(plan.advanced_start.begin(), plan.advanced_start.end() - 1);
  for (std::size_t b = 0; b < n; ++b)
    plan.advanced[static_cast<std::size_t>(next[static_cast<std::size_t>(last_use[b])]++)] =
        static_cast<int>(b);
  for (std::size_t a = 0; a < n; ++a) {
    int needed = last_use[a];
    for (const SectorStiffness::Entry& e : k.row(a))
      needed = std::max(needed, last_use[static_cast<std::size_t>(e.column)]);
    plan.needs.push_back(needed);
  }
}

void add_rows(const Model& model, const SectorStiffness& k, CyclicPlan& plan) {
  for (std::size_t a = 0; a < k.n_local(); ++a)
    plan.rows.push_back({model.mass[k.node(a, 0)], model.reference[k.node(a, 0)], -1});
  if (!model.contact) return;
  std::vector<int> row_of(static_cast<std::size_t>(k.nodes_per_sector), -1);
  for (std::size_t a = 0; a < k.n_local(); ++a)
    row_of[static_cast<std::size_t>(k.nodes[a])] = static_cast<int>(a);
  for (std::size_t i = 0; i < model.contact->nodes.size(); ++i) {
    const int node = model.contact->nodes[i];
    const int a = row_of[static_cast<std::size_t>(node % k.nodes_per_sector)];
    RONDO_DEMAND(a >= 0, node);
    CyclicRowData& row = plan.rows[static_cast<std::size_t>(a)];
    if (row.contact_row < 0) {
      row.contact_row = static_cast<int>(plan.candidate.size());
      plan.candidate.emplace_back(static_cast<std::size_t>(k.n_sectors), -1);
    }
    plan.candidate[static_cast<std::size_t>(row.contact_row)]
                  [static_cast<std::size_t>(node / k.nodes_per_sector)] = static_cast<int>(i);
  }
}

/// Room for the columns of the widest chunk, whole packs, and the halo on both sides. Fields whose
/// distance is near a multiple of 4096 B would hinder each other in the first cache.
std::ptrdiff_t choose_stride(const CyclicPlan& plan) {
  int widest = 0;
  for (const CyclicChunkRange& chunk : plan.chunks) widest = std::max(widest, chunk.columns);
  std::ptrdiff_t stride =
      (widest + 2 * kernels::lanes - 1) / kernels::lanes * kernels::lanes + 2 * halo_columns;
  constexpr std::ptrdiff_t page = 4096 / sizeof(double), apart = page / 8;
  while (stride % page < apart || stride % page > page - apart) stride += kernels::lanes;
  return stride;
}

}  // namespace

CyclicPlan make_cyclic_plan(const Model& model) {
  RONDO_DEMAND(model.sector.has_value());
  const SectorStiffness& k = *model.sector;
  CyclicPlan plan;
  plan.n_local = static_cast<int>(k.n_local());
  plan.n_sectors = k.n_sectors;
  plan.n_fields = model.stiffness_damping > 0.0 ? 6 : 4;
  choose_chunks(plan, model.threads);
  plan.stride = choose_stride(plan);
  add_entries(k, plan);
  add_order(k, plan);
  add_rows(model, k, plan);
  return plan;
}

}  // namespace rondo::dynamics
