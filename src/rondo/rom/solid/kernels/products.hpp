// SPDX-License-Identifier: BSD-3-Clause
/// @file  The products of one instruction set. The compiler makes registers of the machine from
/// registers of 64 bytes, lane by lane, so that all machines give the same bits.
#pragma once
#include <cstring>

#include "rondo/rom/solid/kernels/cone_table.hpp"

namespace {

typedef float Sixteen __attribute__((vector_size(64)));
typedef float EightFloats __attribute__((vector_size(32)));
typedef float FourFloats __attribute__((vector_size(16)));
typedef double EightDoubles __attribute__((vector_size(64)));

/// The sum of the lanes, halves first.
[[gnu::always_inline]] inline float sum_of(const Sixteen& lanes) noexcept {
  EightFloats low, high;
  std::memcpy(&low, &lanes, sizeof low);
  std::memcpy(&high, reinterpret_cast<const char*>(&lanes) + sizeof low, sizeof high);
  low += high;
  FourFloats a, b;
  std::memcpy(&a, &low, sizeof a);
  std::memcpy(&b, reinterpret_cast<const char*>(&low) + sizeof a, sizeof b);
  a += b;
  return (a[0] + a[2]) + (a[1] + a[3]);
}

void sums_of_rows(const float* rows, std::ptrdiff_t stride, const float* by, std::ptrdiff_t n,
                  float* to) noexcept {
  Sixteen first = {}, second = {}, third = {};
  for (std::ptrdiff_t i = 0; i < n; i += rondo::rom::kernels::cone_lanes) {
    Sixteen factor, a, b, c;
    std::memcpy(&factor, by + i, sizeof factor);
    std::memcpy(&a, rows + i, sizeof a);
    std::memcpy(&b, rows + stride + i, sizeof b);
    std::memcpy(&c, rows + 2 * stride + i, sizeof c);
    first += a * factor;
    second += b * factor;
    third += c * factor;
  }
  to[0] = sum_of(first);
  to[1] = sum_of(second);
  to[2] = sum_of(third);
}

void add_three_columns(const double* const* columns, const double* by, std::ptrdiff_t n,
                       double* __restrict to) noexcept {
  const double *a = columns[0], *b = columns[1], *c = columns[2];
  const double x = by[0], y = by[1], z = by[2];
  std::ptrdiff_t i = 0;
  for (; i + 8 <= n; i += 8) {
    EightDoubles p, q, r, sum;
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
