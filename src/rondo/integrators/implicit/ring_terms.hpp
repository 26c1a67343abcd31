// SPDX-License-Identifier: BSD-3-Clause
/// @file  The inner loop of block-circulant matrices, compiled once for each instruction set beside
/// the other loops (fused/kernels). Plain pointers and numbers only, as there.
#pragma once
#include <cstddef>

namespace rondo::dynamics {

/// out_i(j) = [in_i(j)] + Σ_t Σ_m matrix_t(i, m) in_m(j + offset_t), i a row of out, m of in, j the
/// sector. What is before the first sector of a row and after its last is there as far as the
/// offsets reach, and seven more numbers.
struct RingTerms {
  int rows;                 ///< rows of out
  int columns;              ///< rows of in
  int sectors;              ///< out holds up to seven more, which mean nothing
  int n_terms;              ///< at most 3
  bool with_self;           ///< in_i(j) is added: there are as many rows
  const double* matrix[3];  ///< (rows, columns) row-major
  std::ptrdiff_t offset[3];
  const double* in;
  double* out;
  std::ptrdiff_t stride;  ///< between rows of in, and of out
};

using RingProduct = void (*)(const RingTerms& terms) noexcept;

}  // namespace rondo::dynamics
