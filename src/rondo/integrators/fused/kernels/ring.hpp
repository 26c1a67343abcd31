// SPDX-License-Identifier: BSD-3-Clause
/// @file  Loop of block-circulant matrices over packs of sectors. Included after a pack_*.hpp.
#pragma once
#include "rondo/integrators/fused/kernels/kernels.hpp"

namespace {

using rondo::dynamics::RingTerms;
static_assert(rondo::dynamics::kernels::lanes - 1 <= 7);  // rows hold seven numbers more

/// Product for a pack of sectors, all rows at once: each number is read once.
template <int Rows>
inline void ring_pack(const RingTerms& t, std::ptrdiff_t j) noexcept {
  Pack sum[Rows];
  for (int i = 0; i < Rows; ++i) sum[i] = t.with_self ? load(t.in + i * t.stride + j) : all(0.0);
  for (int term = 0; term < t.n_terms; ++term) {
    const double* matrix = t.matrix[term];
    const double* in = t.in + t.offset[term] + j;
    for (int m = 0; m < Rows; ++m) {
      const Pack other = load(in + m * t.stride);
      for (int i = 0; i < Rows; ++i) sum[i] = fma(all(matrix[i * Rows + m]), other, sum[i]);
    }
  }
  for (int i = 0; i < Rows; ++i) store(t.out + i * t.stride + j, sum[i]);
}

/// The product with any number of rows and columns, row by row.
template <>
inline void ring_pack<0>(const RingTerms& t, std::ptrdiff_t j) noexcept {
  for (int i = 0; i < t.rows; ++i) {
    Pack sum = t.with_self ? load(t.in + i * t.stride + j) : all(0.0);
    for (int term = 0; term < t.n_terms; ++term) {
      const double* matrix = t.matrix[term] + std::ptrdiff_t{i} * t.columns;
      const double* in = t.in + t.offset[term] + j;
      for (int m = 0; m < t.columns; ++m) sum = fma(all(matrix[m]), load(in + m * t.stride), sum);
    }
    store(t.out + i * t.stride + j, sum);
  }
}

template <int Rows>
inline void ring_rows(const RingTerms& t) noexcept {
  for (std::ptrdiff_t j = 0; j < t.sectors; j += rondo::dynamics::kernels::lanes)
    ring_pack<Rows>(t, j);
}

/// @pre in and out are apart
void ring_product(const RingTerms& t) noexcept {
  if (t.rows != t.columns) return ring_rows<0>(t);
  if (t.rows == 2) return ring_rows<2>(t);
  if (t.rows == 4) return ring_rows<4>(t);
  if (t.rows == 6) return ring_rows<6>(t);
  if (t.rows == 8) return ring_rows<8>(t);
  ring_rows<0>(t);
}

}  // namespace
