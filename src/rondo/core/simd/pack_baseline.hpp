// SPDX-License-Identifier: BSD-3-Clause
/// @file  Eight doubles in four registers of two, for any machine: products and sums are not fused.
/// Functions are always inlined because GCC considers functions of four registers too long, and a
/// call per product would make a step two to three times as slow.
#pragma once
#include <cstdint>
#include <cstring>

namespace {

typedef double Two __attribute__((vector_size(16)));

struct Pack {
  Two v[4];
};

[[gnu::always_inline]] inline Pack load(const double* p) noexcept {
  Pack a;
  std::memcpy(&a, p, sizeof a);
  return a;
}
[[gnu::always_inline]] inline void store(double* p, Pack a) noexcept {
  std::memcpy(p, &a, sizeof a);
}
[[gnu::always_inline]] inline Pack all(double x) noexcept {
  const Two two = {x, x};
  return {{two, two, two, two}};
}
[[gnu::always_inline]] inline Pack operator+(Pack a, Pack b) noexcept {
  for (int i = 0; i < 4; ++i) a.v[i] += b.v[i];
  return a;
}
[[gnu::always_inline]] inline Pack operator-(Pack a, Pack b) noexcept {
  for (int i = 0; i < 4; ++i) a.v[i] -= b.v[i];
  return a;
}
[[gnu::always_inline]] inline Pack operator*(Pack a, Pack b) noexcept {
  for (int i = 0; i < 4; ++i) a.v[i] *= b.v[i];
  return a;
}
[[gnu::always_inline]] inline Pack operator/(Pack a, Pack b) noexcept {
  for (int i = 0; i < 4; ++i) a.v[i] /= b.v[i];
  return a;
}
/// a b + c
[[gnu::always_inline]] inline Pack fma(Pack a, Pack b, Pack c) noexcept {
  return a * b + c;
}
/// c - a b
[[gnu::always_inline]] inline Pack fnma(Pack a, Pack b, Pack c) noexcept {
  return c - a * b;
}
[[gnu::always_inline]] inline Pack smaller(Pack a, Pack b) noexcept {
  for (int i = 0; i < 4; ++i) a.v[i] = a.v[i] < b.v[i] ? a.v[i] : b.v[i];
  return a;
}
[[gnu::always_inline]] inline Pack square_root(Pack a) noexcept {
  for (int i = 0; i < 4; ++i) a.v[i] = Two{__builtin_sqrt(a.v[i][0]), __builtin_sqrt(a.v[i][1])};
  return a;
}
[[gnu::always_inline]] inline Pack larger(Pack a, Pack b) noexcept {
  for (int i = 0; i < 4; ++i) a.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i];
  return a;
}
/// Guess of a^(-1/3): divides the exponent by three, using the bits of a float.
[[gnu::always_inline]] inline Pack cube_root_guess(Pack a) noexcept {
  double x[8];
  store(x, a);
  for (double& value : x) {
    auto f = static_cast<float>(value);
    std::int32_t bits = 0;
    std::memcpy(&bits, &f, sizeof bits);
    bits = 0x54a23400 - bits / 3;
    std::memcpy(&f, &bits, sizeof f);
    value = static_cast<double>(f);
  }
  return load(x);
}
/// The first n lanes of a, the other lanes of b.
[[gnu::always_inline]] inline Pack first_lanes(int n, Pack a, Pack b) noexcept {
  double x[8], y[8];
  store(x, a);
  store(y, b);
  for (int i = 0; i < n; ++i) y[i] = x[i];
  return load(y);
}
/// Bit i is set if a <= b in lane i.
[[gnu::always_inline]] inline unsigned not_above(Pack a, Pack b) noexcept {
  double x[8], y[8];
  store(x, a);
  store(y, b);
  unsigned bits = 0;
  for (int i = 0; i < 8; ++i) bits |= x[i] <= y[i] ? 1U << i : 0U;
  return bits;
}

/// Loads N packs of sectors from u on, with the values of the last and the next sectors.
template <int N>
[[gnu::always_inline]] inline void load_neighbours(const double* u, Pack* last, Pack* here,
                                                   Pack* next) noexcept {
  for (int i = 0; i < N; ++i) {
    last[i] = load(u + i * 8 - 1);
    here[i] = load(u + i * 8);
    next[i] = load(u + i * 8 + 1);
  }
}

/// Loads eight vectors stored one after the other (x, y).
[[gnu::always_inline]] inline void load_pairs(const double* p, Pack& x, Pack& y) noexcept {
  double a[8], b[8];
  for (int i = 0; i < 8; ++i) {
    a[i] = p[2 * i];
    b[i] = p[2 * i + 1];
  }
  x = load(a);
  y = load(b);
}
[[gnu::always_inline]] inline void store_pairs(double* p, Pack x, Pack y) noexcept {
  double a[8], b[8];
  store(a, x);
  store(b, y);
  for (int i = 0; i < 8; ++i) {
    p[2 * i] = a[i];
    p[2 * i + 1] = b[i];
  }
}

/// Loads eight vectors from the offsets `at`, counted in doubles from p.
[[gnu::always_inline]] inline void gather_pairs(const double* p, const std::int32_t* at, Pack& x,
                                                Pack& y) noexcept {
  double a[8], b[8];
  for (int i = 0; i < 8; ++i) {
    a[i] = p[at[i]];
    b[i] = p[at[i] + 1];
  }
  x = load(a);
  y = load(b);
}

/// K u of eight rows of `n` 2×2 blocks: k (n, rows, 4), column (n, rows) offset of the pair in u.
/// Four rows at a time, so that all sums stay in registers.
[[gnu::always_inline]] inline void row_products(std::int64_t n, const double* k,
                                                const std::int32_t* column, const double* u,
                                                Pack& x, Pack& y) noexcept {
  double to_x[8], to_y[8];
  for (int first = 0; first < 8; first += 4) {
    Two sums[4][2] = {};  // per row: products with k_xx and k_xy, with k_yx and k_yy
    for (std::int64_t at = 0; at < n; ++at) {
#pragma GCC unroll 4
      for (int i = 0; i < 4; ++i) {
        Two pair, block[2];
        std::memcpy(&pair, u + column[at * 8 + first + i], sizeof pair);
        std::memcpy(block, k + (at * 8 + first + i) * 4, sizeof block);
        sums[i][0] += block[0] * pair;
        sums[i][1] += block[1] * pair;
      }
    }
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) {
      to_x[first + i] = sums[i][0][0] + sums[i][0][1];
      to_y[first + i] = sums[i][1][0] + sums[i][1][1];
    }
  }
  x = load(to_x);
  y = load(to_y);
}

constexpr int block_packs = 1;
constexpr int strip_packs = 1;

}  // namespace
