// SPDX-License-Identifier: BSD-3-Clause
/// @file  K u of some packs of the rows of a strip, in three dimensions. Included after a
/// pack_*.hpp. Whether all of it is in place, K in every lane and the sums in registers, decides
/// between 2 and 5 ns: hence no calls, no arrays of arrays, loops unrolled.
#pragma once
#include "rondo/integrators/fused/kernels/solid/layout.hpp"

namespace {

using rondo::dynamics::kernels::lanes;
using rondo::dynamics::kernels::solid_packs;
using rondo::dynamics::kernels::solid_rows;
using rondo::dynamics::kernels::SolidEntry;
using rondo::dynamics::kernels::SolidKind;
using rondo::dynamics::kernels::SolidStrip;

/// Packs of a group, and the halo on both sides.
constexpr int most_packs = solid_packs + 2;

static_assert(sizeof(Pack) == lanes * sizeof(double) && solid_packs / 2 <= 3);

/// K u of some packs, by rows and components.
struct SolidForces {
  alignas(64) double f[solid_rows][3][most_packs * lanes];
};

/// Sums of N packs of a row.
template <int N>
struct SolidSum {
  Pack r[N], t[N], z[N];
};

template <int N>
[[gnu::always_inline]] inline void add_product(const double* k, const Pack* u, Pack* sum) noexcept {
  const Pack every = all(*k);
#pragma GCC unroll 3
  for (int i = 0; i < N; ++i) sum[i] = fma(every, u[i], sum[i]);
}

/// One component of three nodes beside each other, N packs of it.
template <int N>
struct SolidLayer {
  Pack here[N], sum[N], difference[N];
};

/// Loads that cross two cache lines, and yet faster than packs put together from those beside,
/// which take the place of products.
template <int N>
[[gnu::always_inline]] inline void load_layer(const SolidEntry& e, const double* u,
                                              SolidLayer<N>& layer) noexcept {
#pragma GCC unroll 3
  for (int i = 0; i < N; ++i) {
    layer.here[i] = load(u + e.here + i * lanes);
    const Pack last = load(u + e.last + i * lanes), next = load(u + e.next + i * lanes);
    layer.sum[i] = next + last;
    layer.difference[i] = next - last;
  }
}

/// Each adds the force on a row by the radial, tangential or axial component of three nodes.
template <int N>
[[gnu::always_inline]] inline void add_radial(const double* k, const SolidLayer<N>& u,
                                              SolidSum<N>& sum) noexcept {
  using namespace rondo::dynamics::kernels;
  add_product<N>(k + mirror_rr, u.here, sum.r);
  add_product<N>(k + mirror_zr, u.here, sum.z);
  add_product<N>(k + mirror_rr1, u.sum, sum.r);
  add_product<N>(k + mirror_zr1, u.sum, sum.z);
  add_product<N>(k + mirror_tr1, u.difference, sum.t);
}
template <int N>
[[gnu::always_inline]] inline void add_tangential(const double* k, const SolidLayer<N>& u,
                                                  SolidSum<N>& sum) noexcept {
  using namespace rondo::dynamics::kernels;
  add_product<N>(k + mirror_tt, u.here, sum.t);
  add_product<N>(k + mirror_tt1, u.sum, sum.t);
  add_product<N>(k + mirror_rt1, u.difference, sum.r);
  add_product<N>(k + mirror_zt1, u.difference, sum.z);
}
template <int N>
[[gnu::always_inline]] inline void add_axial(const double* k, const SolidLayer<N>& u,
                                             SolidSum<N>& sum) noexcept {
  using namespace rondo::dynamics::kernels;
  add_product<N>(k + mirror_rz, u.here, sum.r);
  add_product<N>(k + mirror_zz, u.here, sum.z);
  add_product<N>(k + mirror_rz1, u.sum, sum.r);
  add_product<N>(k + mirror_zz1, u.sum, sum.z);
  add_product<N>(k + mirror_tz1, u.difference, sum.t);
}

/// Adds the forces of an entry's nodes on the rows that the bits of Rows name; `k` and `l` are the
/// blocks of the first and of the second row.
template <int Rows, int N>
[[gnu::always_inline]] inline void add_mirrored(const SolidEntry& e, const double* u,
                                                std::ptrdiff_t stride, const double* k,
                                                const double* l, SolidSum<N>& one,
                                                SolidSum<N>& two) noexcept {
  SolidLayer<N> layer;
  load_layer<N>(e, u, layer);
  if constexpr (Rows & 1) add_radial<N>(k, layer, one);
  if constexpr (Rows & 2) add_radial<N>(l, layer, two);
  load_layer<N>(e, u + stride, layer);
  if constexpr (Rows & 1) add_tangential<N>(k, layer, one);
  if constexpr (Rows & 2) add_tangential<N>(l, layer, two);
  load_layer<N>(e, u + 2 * stride, layer);
  if constexpr (Rows & 1) add_axial<N>(k, layer, one);
  if constexpr (Rows & 2) add_axial<N>(l, layer, two);
}

template <int N>
[[gnu::always_inline]] inline void add_column(const double* k, const Pack* u,
                                              SolidSum<N>& sum) noexcept {
  add_product<N>(k, u, sum.r);
  add_product<N>(k + 1, u, sum.t);
  add_product<N>(k + 2, u, sum.z);
}

/// Does the same for one node, column by column of its blocks.
template <int Rows, int N>
[[gnu::always_inline]] inline void add_general(const SolidEntry& e, const double* u,
                                               std::ptrdiff_t stride, const double* k,
                                               const double* l, SolidSum<N>& one,
                                               SolidSum<N>& two) noexcept {
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    Pack here[N];
#pragma GCC unroll 3
    for (int i = 0; i < N; ++i) here[i] = load(u + c * stride + e.here + i * lanes);
    if constexpr (Rows & 1) add_column<N>(k + 3 * c, here, one);
    if constexpr (Rows & 2) add_column<N>(l + 3 * c, here, two);
  }
}

template <SolidKind Kind, int Rows, int N>
[[gnu::always_inline]] inline void add_entry(const SolidEntry& e, const double* u,
                                             std::ptrdiff_t stride, const double* k,
                                             const double* l, SolidSum<N>& one,
                                             SolidSum<N>& two) noexcept {
  if constexpr (Kind == SolidKind::general)
    add_general<Rows, N>(e, u, stride, k, l, one, two);
  else
    add_mirrored<Rows, N>(e, u, stride, k, l, one, two);
}

template <int N>
[[gnu::always_inline]] inline void store_sum(const SolidSum<N>& sum,
                                             double (*f)[most_packs * lanes], int pack) noexcept {
#pragma GCC unroll 3
  for (int i = 0; i < N; ++i) {
    store(f[0] + (pack + i) * lanes, sum.r[i]);
    store(f[1] + (pack + i) * lanes, sum.t[i]);
    store(f[2] + (pack + i) * lanes, sum.z[i]);
  }
}

/// K u of the N packs from `column` on, to the places of packs from `pack` on; of the rows that
/// Rows tells, by bits.
template <SolidKind Kind, int Rows, int N>
[[gnu::noinline]] void solid_product(const SolidStrip& s, std::ptrdiff_t column, int pack,
                                     SolidForces& out) noexcept {
  constexpr int size =
      Kind == SolidKind::general ? 9 : static_cast<int>(rondo::dynamics::kernels::n_mirror);
  SolidSum<N> one, two;
#pragma GCC unroll 3
  for (int i = 0; i < N; ++i)
    one.r[i] = one.t[i] = one.z[i] = two.r[i] = two.t[i] = two.z[i] = all(0.0);
  const double* const u = s.now + column;
  const std::ptrdiff_t stride = s.stride;
  const double* k = s.blocks;
  for (const SolidEntry *e = s.entries, *end = e + s.n_entries; e != end; ++e) {
    const double* const l = k + (e->rows & 1) * size;
    const int rows = e->rows & Rows;
    if (Rows == 3 && rows == 3)
      add_entry<Kind, 3, N>(*e, u, stride, k, l, one, two);
    else if ((Rows & 1) && rows == 1)
      add_entry<Kind, 1, N>(*e, u, stride, k, l, one, two);
    else if ((Rows & 2) && rows == 2)
      add_entry<Kind, 2, N>(*e, u, stride, k, l, one, two);
    k = l + (e->rows >> 1) * size;
  }
  if constexpr (Rows & 1) store_sum<N>(one, out.f[0], pack);
  if constexpr (Rows & 2) store_sum<N>(two, out.f[1], pack);
}

/// Finds the forces of `n` packs, N at a time; the last four as two and two, not three and one.
template <SolidKind Kind, int Rows, int N>
inline void packs_product(const SolidStrip& s, int first, int n, SolidForces& out) noexcept {
  const std::ptrdiff_t column = static_cast<std::ptrdiff_t>(first) * lanes;
  int i = 0;
  for (; i + N <= n && (N < 3 || i + 4 != n); i += N)
    solid_product<Kind, Rows, N>(s, column + i * lanes, i, out);
  if constexpr (N > 2)
    for (; i + 2 <= n; i += 2) solid_product<Kind, Rows, 2>(s, column + i * lanes, i, out);
  for (; i < n; ++i) solid_product<Kind, Rows, 1>(s, column + i * lanes, i, out);
}

/// Finds the forces of as many packs at a time as the registers hold.
template <SolidKind Kind>
inline void rows_product(const SolidStrip& s, int first, int n, SolidForces& out) noexcept {
  if constexpr (strip_packs > 1) {
    if (s.n_rows == 2) return packs_product<Kind, 3, solid_packs / 2>(s, first, n, out);
    packs_product<Kind, 1, solid_packs / 2>(s, first, n, out);
  } else {
    packs_product<Kind, 1, 1>(s, first, n, out);
    if (s.n_rows == 2) packs_product<Kind, 2, 1>(s, first, n, out);
  }
}

/// K u of the packs [first, first + n), at most most_packs.
inline void strip_product(const SolidStrip& s, int first, int n, SolidForces& out) noexcept {
  if (s.kind == SolidKind::general) return rows_product<SolidKind::general>(s, first, n, out);
  rows_product<SolidKind::mirrored>(s, first, n, out);
}

}  // namespace
