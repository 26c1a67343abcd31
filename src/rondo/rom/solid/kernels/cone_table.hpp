// SPDX-License-Identifier: BSD-3-Clause
/// @file  Products of the law of contact in space (../cone_law.hpp), compiled once for each
/// instruction set. Plain pointers and numbers only. All levels give the same bits: sums have the
/// same lanes everywhere, and no product is fused with a sum.
#pragma once
#include <cstddef>

namespace rondo::rom::kernels {

/// Rows and vectors of single numbers have a multiple of these.
constexpr std::ptrdiff_t cone_lanes = 32;

struct ConeTable {
  const char* name;
  /// to = the sums of three rows, one `stride` after the other, times a vector of n numbers.
  /// @pre n is a multiple of cone_lanes
  void (*sums)(const float* rows, std::ptrdiff_t stride, const float* by, std::ptrdiff_t n,
               float* to) noexcept;
  /// to += three columns of n numbers times three factors.
  void (*add)(const double* const* columns, const double* by, std::ptrdiff_t n,
              double* to) noexcept;
};

extern const ConeTable avx512_cone, avx2_cone, baseline_cone;

}  // namespace rondo::rom::kernels
