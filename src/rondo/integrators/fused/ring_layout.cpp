// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/ring_layout.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

std::vector<CyclicChunkRange> chunks_of(const RingLayout& ring, int n_chunks) {
  const auto groups = static_cast<int>(ring.cut.n_groups);
  std::vector<CyclicChunkRange> chunks;
  for (int c = 0; c < n_chunks; ++c) {
    const int from = groups * c / n_chunks, to = groups * (c + 1) / n_chunks;
    CyclicChunkRange range;
    range.first = from * ring.group_columns;
    range.columns = std::min(to * ring.group_columns, ring.n_sectors) - range.first;
    range.first_group = at(from);
    range.n_groups = at(to - from);
    chunks.push_back(range);
  }
  return chunks;
}

int narrowest(const std::vector<CyclicChunkRange>& chunks) noexcept {
  return std::ranges::min(chunks, {}, &CyclicChunkRange::columns).columns;
}

}  // namespace

std::size_t n_groups_of(int n_sectors, int group_columns) noexcept {
  RONDO_ASSERT(n_sectors > 0 && group_columns > 0, n_sectors, group_columns);
  return at((n_sectors + group_columns - 1) / group_columns);
}

void cut_ring(int threads, int depth, const CyclicTuning& tuning, RingLayout& layout) {
  RONDO_DEMAND(layout.n_sectors > 0 && layout.group_columns > 0 && threads >= 1 &&
                   tuning.chunk_columns > 0 && depth >= 1 && depth <= halo_columns,
               layout.n_sectors, layout.group_columns, threads, tuning.chunk_columns, depth);
  RingCut& ring = layout.cut;
  ring.n_groups = n_groups_of(layout.n_sectors, layout.group_columns);
  const auto groups = static_cast<int>(ring.n_groups);
  const bool in_cache =
      layout.stepwise || layout.bytes() < tuning.cache_bytes * static_cast<std::size_t>(threads);
  const int for_threads = std::min(threads, groups);
  const int for_cache = in_cache ? 1 : std::max(1, layout.n_sectors / tuning.chunk_columns);
  const int n_chunks =
      (std::max(for_threads, for_cache) + for_threads - 1) / for_threads * for_threads;
  ring.chunks = chunks_of(layout, std::min(n_chunks, groups));
  const int columns = narrowest(ring.chunks);
  const CyclicChunkRange& last = ring.chunks.back();  // every sector and group in one chunk
  RONDO_DEMAND(columns > 0 && last.first + last.columns == layout.n_sectors &&
                   last.first_group + last.n_groups == ring.n_groups,
               columns, last.first, last.columns, layout.n_sectors);
  if (ring.chunks.size() == 1)
    ring.halo = Halo::ring;
  else if (layout.stepwise)
    ring.halo = Halo::narrow;
  else
    ring.halo = columns >= tuning.wide_halo_columns ? Halo::wide : Halo::narrow;
  const bool one_by_one = ring.halo == Halo::ring ? in_cache : ring.halo == Halo::narrow;
  ring.depth = one_by_one ? 1 : depth;
  RONDO_DEMAND(ring.halo != Halo::wide || columns >= halo_columns, columns);
}

/// Whole packs, and the halo on both sides. Fields whose distance is near a multiple of 4096 B
/// would hinder each other in the first cache.
void set_stride(RingLayout& layout) noexcept {
  int widest = 0;
  for (const CyclicChunkRange& chunk : layout.cut.chunks) widest = std::max(widest, chunk.columns);
  std::ptrdiff_t stride =
      (widest + 2 * kernels::lanes - 1) / kernels::lanes * kernels::lanes + 2 * halo_columns;
  constexpr std::ptrdiff_t page = 4096 / sizeof(double), apart = page / 8;
  static_assert(page % kernels::lanes == 0 && 2 * apart < page);
  while (stride % page < apart || stride % page > page - apart) stride += kernels::lanes;
  RONDO_DEMAND(widest > 0 && stride % kernels::lanes == 0, widest, stride);
  layout.stride = stride;
}

std::vector<int> rows_of_nodes(const RingLayout& layout) {
  RONDO_DEMAND(layout.nodes.size() == at(layout.n_local), layout.nodes.size(), layout.n_local);
  std::vector<int> row_of(at(layout.nodes_per_sector), -1);
  for (int a = 0; a < layout.n_local; ++a) row_of[at(layout.nodes[at(a)])] = a;
  return row_of;
}

void find_candidates(const Model& model, RingLayout& layout) {
  layout.contact_row.assign(layout.nodes.size(), -1);
  if (!model.contact) return;
  const std::vector<int> row_of = rows_of_nodes(layout);
  for (std::size_t i = 0; i < model.contact->nodes.size(); ++i) {
    const int node = model.contact->nodes[i], a = row_of[at(node % layout.nodes_per_sector)];
    RONDO_DEMAND(a >= 0, node);
    int& row = layout.contact_row[at(a)];
    if (row < 0) {
      row = static_cast<int>(layout.candidate.size());
      layout.candidate.emplace_back(at(layout.n_sectors), -1);
    }
    layout.candidate[at(row)][at(node / layout.nodes_per_sector)] = static_cast<int>(i);
    layout.place.push_back({a, node / layout.nodes_per_sector});
  }
  for (const std::vector<int>& ring : layout.candidate)
    RONDO_DEMAND(std::find(ring.begin(), ring.end(), -1) == ring.end(), ring.size());
}

}  // namespace rondo::dynamics
