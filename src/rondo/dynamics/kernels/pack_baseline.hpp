// SPDX-License-Identifier: BSD-3-Clause
/// @file  Eight doubles in four registers of two, for any machine: products are not fused with
/// sums.
#pragma once
#include <cstring>

namespace {

typedef double Two __attribute__((vector_size(16)));

struct Pack {
  Two v[4];
};

inline Pack load(const double* p) noexcept {
  Pack a;
  std::memcpy(&a, p, sizeof a);
  return a;
}
inline void store(double* p, Pack a) noexcept {
  std::memcpy(p, &a, sizeof a);
}
inline Pack all(double x) noexcept {
  const Two two = {x, x};
  return {{two, two, two, two}};
}
inline Pack operator+(Pack a, Pack b) noexcept {
  for (int i = 0; i < 4; ++i) a.v[i] += b.v[i];
  return a;
}
inline Pack operator-(Pack a, Pack b) noexcept {
  for (int i = 0; i < 4; ++i) a.v[i] -= b.v[i];
  return a;
}
inline Pack operator*(Pack a, Pack b) noexcept {
  for (int i = 0; i < 4; ++i) a.v[i] *= b.v[i];
  return a;
}
/// a b + c
inline Pack fma(Pack a, Pack b, Pack c) noexcept {
  return a * b + c;
}
/// c - a b
inline Pack fnma(Pack a, Pack b, Pack c) noexcept {
  return c - a * b;
}
/// The first n lanes of a, the others of b.
inline Pack first_lanes(int n, Pack a, Pack b) noexcept {
  double x[8], y[8];
  store(x, a);
  store(y, b);
  for (int i = 0; i < n; ++i) y[i] = x[i];
  return load(y);
}
/// Bit i is set where lane i of a <= b.
inline unsigned not_above(Pack a, Pack b) noexcept {
  double x[8], y[8];
  store(x, a);
  store(y, b);
  unsigned bits = 0;
  for (int i = 0; i < 8; ++i) bits |= x[i] <= y[i] ? 1U << i : 0U;
  return bits;
}

/// N packs of sectors from u on, with the last and the next sector of each.
template <int N>
inline void load_neighbours(const double* u, Pack* last, Pack* here, Pack* next) noexcept {
  for (int i = 0; i < N; ++i) {
    last[i] = load(u + i * 8 - 1);
    here[i] = load(u + i * 8);
    next[i] = load(u + i * 8 + 1);
  }
}

constexpr int block_packs = 1;
constexpr int strip_packs = 1;

}  // namespace
