// SPDX-License-Identifier: BSD-3-Clause
/// @file  The products of one instruction set. Included after `register_bytes`, the size of its
/// registers: 64, 32 or 16.
#pragma once
#include <cstring>

#include "rondo/rom/solid/kernels/cone_table.hpp"

namespace {

typedef float Floats __attribute__((vector_size(register_bytes)));
typedef float FourFloats __attribute__((vector_size(16)));
typedef double Doubles __attribute__((vector_size(register_bytes)));
constexpr std::ptrdiff_t width = register_bytes / sizeof(float);
constexpr std::ptrdiff_t parts = rondo::rom::kernels::cone_lanes / width;
/// Rows whose sums stay in registers.
constexpr int rows_at_once = register_bytes == 16 ? 1 : 3;

/// The sum of all lanes: halves are added to each other until one lane is left.
inline float sum_of_lanes(Floats* sums) noexcept {
#pragma GCC unroll 3
  for (std::ptrdiff_t half = parts / 2; half > 0; half /= 2)
#pragma GCC unroll 4
    for (std::ptrdiff_t p = 0; p < half; ++p) sums[p] += sums[p + half];
  const Floats sum = sums[0];
  FourFloats fours[width / 4];
  std::memcpy(fours, &sum, sizeof sum);
  FourFloats four = fours[0];
  if constexpr (width == 8) four = fours[0] + fours[1];
  if constexpr (width == 16) four = (fours[0] + fours[2]) + (fours[1] + fours[3]);
  return (four[0] + four[2]) + (four[1] + four[3]);
}

inline void sums_of_some(const float* rows, std::ptrdiff_t stride, const float* by,
                         std::ptrdiff_t n, float* to) noexcept {
  Floats sums[rows_at_once][parts] = {};
  for (std::ptrdiff_t i = 0; i < n; i += rondo::rom::kernels::cone_lanes)
#pragma GCC unroll 8
    for (std::ptrdiff_t p = 0; p < parts; ++p) {
      Floats factor;
      std::memcpy(&factor, by + i + p * width, sizeof factor);
#pragma GCC unroll 3
      for (int r = 0; r < rows_at_once; ++r) {
        Floats entry;
        std::memcpy(&entry, rows + r * stride + i + p * width, sizeof entry);
        sums[r][p] += entry * factor;
      }
    }
#pragma GCC unroll 3
  for (int r = 0; r < rows_at_once; ++r) {
    Floats own[parts];
#pragma GCC unroll 8
    for (std::ptrdiff_t p = 0; p < parts; ++p) own[p] = sums[r][p];
    to[r] = sum_of_lanes(own);
  }
}

void sums_of_rows(const float* rows, std::ptrdiff_t stride, const float* by, std::ptrdiff_t n,
                  float* to) noexcept {
  for (int r = 0; r < 3; r += rows_at_once) sums_of_some(rows + r * stride, stride, by, n, to + r);
}

void add_three_columns(const double* const* columns, const double* by, std::ptrdiff_t n,
                       double* __restrict to) noexcept {
  constexpr std::ptrdiff_t pack = register_bytes / sizeof(double);
  const double *a = columns[0], *b = columns[1], *c = columns[2];
  const double x = by[0], y = by[1], z = by[2];
  std::ptrdiff_t i = 0;
  for (; i + pack <= n; i += pack) {
    Doubles p, q, r, sum;
    std::memcpy(&p, a + i, sizeof p);
    std::memcpy(&q, b + i, sizeof q);
    std::memcpy(&r, c + i, sizeof r);
    std::memcpy(&sum, to + i, sizeof sum);
    sum += (x * p + y * q) + z * r;
    std::memcpy(to + i, &sum, sizeof sum);
  }
  for (; i < n; ++i) to[i] += (x * a[i] + y * b[i]) + z * c[i];
}

constexpr rondo::rom::kernels::ConeTable cone_table_of(const char* name) noexcept {
  return {name, sums_of_rows, add_three_columns};
}

}  // namespace
