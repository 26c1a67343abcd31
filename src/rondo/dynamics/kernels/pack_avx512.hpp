// SPDX-License-Identifier: BSD-3-Clause
/// @file  Eight doubles in one register.
#pragma once
#include <immintrin.h>

namespace {

struct Pack {
  __m512d v;
};

inline Pack load(const double* p) noexcept {
  return {_mm512_loadu_pd(p)};
}
inline void store(double* p, Pack a) noexcept {
  _mm512_storeu_pd(p, a.v);
}
inline Pack all(double x) noexcept {
  return {_mm512_set1_pd(x)};
}
inline Pack operator+(Pack a, Pack b) noexcept {
  return {_mm512_add_pd(a.v, b.v)};
}
inline Pack operator-(Pack a, Pack b) noexcept {
  return {_mm512_sub_pd(a.v, b.v)};
}
inline Pack operator*(Pack a, Pack b) noexcept {
  return {_mm512_mul_pd(a.v, b.v)};
}
/// a b + c
inline Pack fma(Pack a, Pack b, Pack c) noexcept {
  return {_mm512_fmadd_pd(a.v, b.v, c.v)};
}
/// c - a b
inline Pack fnma(Pack a, Pack b, Pack c) noexcept {
  return {_mm512_fnmadd_pd(a.v, b.v, c.v)};
}
/// The first n lanes of a, the others of b.
inline Pack first_lanes(int n, Pack a, Pack b) noexcept {
  return {_mm512_mask_blend_pd(static_cast<__mmask8>((1U << n) - 1U), b.v, a.v)};
}
/// Bit i is set where lane i of a <= b.
inline unsigned not_above(Pack a, Pack b) noexcept {
  return _mm512_cmp_pd_mask(a.v, b.v, _CMP_LE_OQ);
}

/// The last lane of a and the first seven of b; the last seven of b and the first of c.
inline Pack shifted_down(Pack a, Pack b) noexcept {
  return {_mm512_castsi512_pd(
      _mm512_alignr_epi64(_mm512_castpd_si512(b.v), _mm512_castpd_si512(a.v), 7))};
}
inline Pack shifted_up(Pack b, Pack c) noexcept {
  return {_mm512_castsi512_pd(
      _mm512_alignr_epi64(_mm512_castpd_si512(c.v), _mm512_castpd_si512(b.v), 1))};
}

/// N packs of sectors from u on, with the last and the next sector of each. A load that crosses two
/// cache lines costs two: the shifted ones are put together from the packs beside.
template <int N>
inline void load_neighbours(const double* u, Pack* last, Pack* here, Pack* next) noexcept {
  Pack packs[N + 2];
#pragma GCC unroll 4
  for (int i = 0; i < N + 2; ++i) packs[i] = load(u + (i - 1) * 8);
#pragma GCC unroll 4
  for (int i = 0; i < N; ++i) {
    last[i] = shifted_down(packs[i], packs[i + 1]);
    here[i] = packs[i + 1];
    next[i] = shifted_up(packs[i + 1], packs[i + 2]);
  }
}

/// Packs whose product is formed at once: as many as the registers hold.
constexpr int block_packs = 4;
/// The same where neighbouring rows are worked on together.
constexpr int strip_packs = 2;

}  // namespace
