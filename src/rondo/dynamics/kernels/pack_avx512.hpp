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

/// Packs whose product is formed at once: as many as the registers hold.
constexpr int block_packs = 4;
/// The same where neighbouring rows are worked on together.
constexpr int strip_packs = 2;

}  // namespace
