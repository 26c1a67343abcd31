// SPDX-License-Identifier: BSD-3-Clause
/// @file  Loops of the cyclic operator over packs of sectors. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/update.hpp"

namespace {

using rondo::dynamics::kernels::CyclicEntry;
using rondo::dynamics::kernels::CyclicRow;
using rondo::dynamics::kernels::CyclicStrip;
using rondo::dynamics::kernels::group_packs;
using rondo::dynamics::kernels::lanes;
using rondo::dynamics::kernels::MirrorBlock;
using rondo::dynamics::kernels::most_rows;
using rondo::dynamics::kernels::n_sums;

static_assert(strip_packs <= group_packs && block_packs <= group_packs && group_packs <= 4);

/// K u of a group of packs, row by row.
using Forces = Vectors[most_rows][group_packs];

/// K u of N packs of one row, entry by entry.
template <int N>
inline void row_product(const CyclicStrip& s, const CyclicRow& row, std::ptrdiff_t column,
                        Vectors* out) noexcept {
  Vectors sum[N];
#pragma GCC unroll 4
  for (int i = 0; i < N; ++i) sum[i] = {all(0.0), all(0.0)};
  for (const CyclicEntry* e = row.entries; e != row.entries + row.n_entries; ++e) {
    const double* u = s.now + e->at + column;
    const Pack xx = all(e->k[0]), yx = all(e->k[1]), xy = all(e->k[2]), yy = all(e->k[3]);
#pragma GCC unroll 4
    for (int i = 0; i < N; ++i) {
      const Vectors c = load_vectors(u + i * lanes, s.stride);
      sum[i].x = fma(xx, c.x, fma(xy, c.y, sum[i].x));
      sum[i].y = fma(yx, c.x, fma(yy, c.y, sum[i].y));
    }
  }
#pragma GCC unroll 4
  for (int i = 0; i < N; ++i) out[i] = sum[i];
}

/// A layer's vectors: here, sum and difference of the next and the last sector.
struct Layer {
  Vectors here, sum, difference;
};

template <int N>
inline void load_layer(const double* u, std::ptrdiff_t stride, Layer* layer) noexcept {
  Pack last_x[N], here_x[N], next_x[N], last_y[N], here_y[N], next_y[N];
  load_neighbours<N>(u, last_x, here_x, next_x);
  load_neighbours<N>(u + stride, last_y, here_y, next_y);
#pragma GCC unroll 4
  for (int i = 0; i < N; ++i)
    layer[i] = {{here_x[i], here_y[i]},
                {next_x[i] + last_x[i], next_y[i] + last_y[i]},
                {next_x[i] - last_x[i], next_y[i] - last_y[i]}};
}

template <int N>
inline void add_layer(const MirrorBlock& k, const Layer* u, Vectors* sum) noexcept {
  const Pack rr = all(k.rr), tt = all(k.tt), rr1 = all(k.rr1), tt1 = all(k.tt1);
  const Pack rt1 = all(k.rt1), tr1 = all(k.tr1);
#pragma GCC unroll 4
  for (int i = 0; i < N; ++i) {
    sum[i].x = fma(rr, u[i].here.x, sum[i].x);
    sum[i].y = fma(tt, u[i].here.y, sum[i].y);
    sum[i].x = fma(rr1, u[i].sum.x, sum[i].x);
    sum[i].y = fma(tt1, u[i].sum.y, sum[i].y);
    sum[i].x = fma(rt1, u[i].difference.y, sum[i].x);
    sum[i].y = fma(tr1, u[i].difference.x, sum[i].y);
  }
}

/// K u of N packs of all rows of a strip: each layer is read once for the rows below, at and above
/// it.
template <int N>
inline void mirror_product(const CyclicStrip& s, std::ptrdiff_t column, Forces out,
                           int pack) noexcept {
  Vectors below[N], here[N], above[N];  // sums of the rows around the layer in hand
  const Vectors zero = {all(0.0), all(0.0)};
#pragma GCC unroll 4
  for (int i = 0; i < N; ++i) below[i] = here[i] = above[i] = zero;
  const double* u = s.now + s.rows[0].at + column;
  Layer layer[N];
  const auto read = [&](int row) { load_layer<N>(u + row * s.row_size, s.stride, layer); };
  if (!s.lowest) {
    read(-1);
    add_layer<N>(s.mirror[0].below, layer, here);
  }
  for (int r = 0; r < s.n_rows; ++r) {
    read(r);
    if (r > 0) {
      add_layer<N>(s.mirror[r - 1].above, layer, below);
#pragma GCC unroll 4
      for (int i = 0; i < N; ++i) out[r - 1][pack + i] = below[i];
    }
    add_layer<N>(s.mirror[r].here, layer, here);
    if (r + 1 < s.n_rows) add_layer<N>(s.mirror[r + 1].below, layer, above);
#pragma GCC unroll 4
    for (int i = 0; i < N; ++i) below[i] = here[i], here[i] = above[i], above[i] = zero;
  }
  if (!s.highest) {
    read(s.n_rows);
    add_layer<N>(s.mirror[s.n_rows - 1].above, layer, below);
  }
#pragma GCC unroll 4
  for (int i = 0; i < N; ++i) out[s.n_rows - 1][pack + i] = below[i];
}

/// K u of `n` packs from `pack` on, all rows.
inline void product(const CyclicStrip& s, int pack, int n, Forces out) noexcept {
  const auto column = [&](int i) { return static_cast<std::ptrdiff_t>(pack + i) * lanes; };
  if (s.mirror) {
    int i = 0;
    for (; i + strip_packs <= n; i += strip_packs)
      mirror_product<strip_packs>(s, column(i), out, i);
    for (; i < n; ++i) mirror_product<1>(s, column(i), out, i);
    return;
  }
  for (int r = 0; r < s.n_rows; ++r) {
    int i = 0;
    for (; i + block_packs <= n; i += block_packs)
      row_product<block_packs>(s, s.rows[r], column(i), out[r] + i);
    for (; i < n; ++i) row_product<1>(s, s.rows[r], column(i), out[r] + i);
  }
}

/// The row in hand; its constants in every lane.
struct RowInHand {
  std::ptrdiff_t at;  ///< place of the row, see CyclicRow
  Vectors frame;  ///< Δt(ṡJ - s²)X; Δt Rᵀ(c̈ - g), in each sector another, is added to it
  Pack dt_over_mass;
  int first_load, n_loads;
};

/// The force of the loads of a row on one pack.
inline Vectors load_on(const CyclicStrip& s, const RowInHand& row, std::ptrdiff_t column) noexcept {
  Vectors load = {all(0.0), all(0.0)};
  for (int i = row.first_load; i < row.first_load + row.n_loads; ++i) {
    const Vectors force = load_vectors(s.loads + 2 * i * s.stride + column, s.stride);
    const Pack pressure = all(s.pressures[s.load_of[i]]);
    load = {fma(pressure, force.x, load.x), fma(pressure, force.y, load.y)};
  }
  return load;
}

/// Update and sums of one pack of a row. Tail: the last own pack, of which only `columns` count.
template <bool Tail, bool Loaded, bool Beta, bool Unsteady>
inline void update_pack(const CyclicStrip& s, const Factors& f, const RowInHand& row,
                        std::ptrdiff_t column, Vectors force, Sums& sums) noexcept {
  const std::ptrdiff_t at = row.at + column;
  double* v = s.velocity + at;
  double* p = s.force + at;
  double* u_next = s.next + at;
  Nodes n;
  n.u = load_vectors(s.now + at, s.stride);
  n.v = load_vectors(v, s.stride);
  n.force = force;
  n.before = Beta ? load_vectors(p, s.stride) : force;
  n.frame = row.frame;
  n.dt_over_mass = row.dt_over_mass;
  if constexpr (Unsteady) {  // turned into the frame of each sector
    const Pack cosine = load(s.turn_x + column), sine = load(s.turn_y + column);
    const Pack px = all(s.step->pull_x), py = all(s.step->pull_y);
    n.frame = {n.frame.x + fma(py, sine, px * cosine), n.frame.y + fnma(px, sine, py * cosine)};
  }
  if constexpr (Loaded) n.load = load_on(s, row, column);
  if constexpr (!Tail) {
    const Vectors after = update<Loaded, Beta, Unsteady>(f, n, sums);
    store_vectors(v, s.stride, after);
    store_vectors(u_next, s.stride, {fma(f.dt, after.x, n.u.x), fma(f.dt, after.y, n.u.y)});
    if constexpr (Beta) store_vectors(p, s.stride, n.force);
  } else {
    const int own = s.columns - static_cast<int>(column);
    Sums part = no_sums();
    Vectors after = update<Loaded, Beta, Unsteady>(f, n, part);
    add_first_lanes(own, part, sums);
    if (s.keep_tail) {
      after = first_of(own, after, n.v);
      n.force = first_of(own, n.force, n.before);
    }
    store_vectors(v, s.stride, after);
    store_vectors(u_next, s.stride, {fma(f.dt, after.x, n.u.x), fma(f.dt, after.y, n.u.y)});
    if constexpr (Beta) store_vectors(p, s.stride, n.force);
  }
}

/// All rows of the strip on packs [first, last), at most a group. `sums` null: the halo.
template <bool Loaded, bool Beta, bool Unsteady>
inline void group(const CyclicStrip& s, const Factors& f, int first, int last,
                  double* sums) noexcept {
  Forces force;
  product(s, first, last - first, force);
  for (int r = 0; r < s.n_rows; ++r) {
    const CyclicRow& row = s.rows[r];
    const double rate_x = s.step->rate_x, rate_y = s.step->rate_y;
    const RowInHand in_hand = {
        row.at,
        {all(rate_x * row.x - rate_y * row.y), all(rate_x * row.y + rate_y * row.x)},
        all(row.dt_over_mass),
        row.first_load,
        row.n_loads};
    Sums own = no_sums();
    for (int pack = first; pack < last; ++pack) {
      const std::ptrdiff_t column = static_cast<std::ptrdiff_t>(pack) * lanes;
      const Vectors g = force[r][pack - first];
      if (sums && (pack + 1) * lanes > s.columns)
        update_pack<true, Loaded, Beta, Unsteady>(s, f, in_hand, column, g, own);
      else
        update_pack<false, Loaded, Beta, Unsteady>(s, f, in_hand, column, g, own);
    }
    if (sums) add_row_sums<Loaded>(sums, row.mass, own);
  }
}

template <bool Loaded, bool Beta, bool Unsteady>
void cyclic_strip(const CyclicStrip& s) noexcept {
  const Factors f(*s.step);
  const int own = (s.columns + lanes - 1) / lanes;
  if (s.first_pack < 0) group<Loaded, Beta, Unsteady>(s, f, -1, 0, nullptr);
  double* sums = s.sums;
  for (int pack = 0; pack < own; pack += group_packs, sums += n_sums * lanes)
    group<Loaded, Beta, Unsteady>(s, f, pack, pack + group_packs < own ? pack + group_packs : own,
                                  sums);
  if (own < s.last_pack) group<Loaded, Beta, Unsteady>(s, f, own, s.last_pack, nullptr);
}

}  // namespace
