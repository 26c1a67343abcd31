// SPDX-License-Identifier: BSD-3-Clause
/// @file  Eight doubles in one register.
#pragma once
#include <immintrin.h>

#include <cstdint>

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
inline Pack operator/(Pack a, Pack b) noexcept {
  return {_mm512_div_pd(a.v, b.v)};
}
/// a b + c
inline Pack fma(Pack a, Pack b, Pack c) noexcept {
  return {_mm512_fmadd_pd(a.v, b.v, c.v)};
}
/// c - a b
inline Pack fnma(Pack a, Pack b, Pack c) noexcept {
  return {_mm512_fnmadd_pd(a.v, b.v, c.v)};
}
inline Pack smaller(Pack a, Pack b) noexcept {
  return {_mm512_min_pd(a.v, b.v)};
}
inline Pack square_root(Pack a) noexcept {
  return {_mm512_sqrt_pd(a.v)};
}
inline Pack larger(Pack a, Pack b) noexcept {
  return {_mm512_max_pd(a.v, b.v)};
}
/// Guess of a^(-1/3): divides the exponent by three, using the bits of a float.
inline Pack cube_root_guess(Pack a) noexcept {
  const __m256i bits = _mm256_castps_si256(_mm512_cvtpd_ps(a.v));
  const __m256 third = _mm256_mul_ps(_mm256_cvtepi32_ps(bits), _mm256_set1_ps(1.0F / 3.0F));
  const __m256i guess = _mm256_sub_epi32(_mm256_set1_epi32(0x54a23400), _mm256_cvtps_epi32(third));
  return {_mm512_cvtps_pd(_mm256_castsi256_ps(guess))};
}
/// The first n lanes of a, the other lanes of b.
inline Pack first_lanes(int n, Pack a, Pack b) noexcept {
  return {_mm512_mask_blend_pd(static_cast<__mmask8>((1U << n) - 1U), b.v, a.v)};
}
/// Bit i is set if a <= b in lane i.
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

/// Loads N packs of sectors from u on, and for each the values of the last and the next sector. The
/// shifted packs are built from their neighbours: a load across two cache lines costs two loads.
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

/// Loads eight vectors stored one after the other (x, y).
inline void load_pairs(const double* p, Pack& x, Pack& y) noexcept {
  const __m512d a = _mm512_loadu_pd(p), b = _mm512_loadu_pd(p + 8);
  x.v = _mm512_permutex2var_pd(a, _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14), b);
  y.v = _mm512_permutex2var_pd(a, _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15), b);
}
inline void store_pairs(double* p, Pack x, Pack y) noexcept {
  const __m512i low = _mm512_setr_epi64(0, 8, 1, 9, 2, 10, 3, 11);
  const __m512i high = _mm512_setr_epi64(4, 12, 5, 13, 6, 14, 7, 15);
  _mm512_storeu_pd(p, _mm512_permutex2var_pd(x.v, low, y.v));
  _mm512_storeu_pd(p + 8, _mm512_permutex2var_pd(x.v, high, y.v));
}

/// Loads eight vectors from the offsets `at`, counted in doubles from p.
inline void gather_pairs(const double* p, const std::int32_t* at, Pack& x, Pack& y) noexcept {
  __m512d four[2];
#pragma GCC unroll 2
  for (int i = 0; i < 2; ++i) {
    const std::int32_t* a = at + 4 * i;
    const __m512d even = _mm512_broadcast_f64x2(_mm_loadu_pd(p + a[0]));
    const __m512d two = _mm512_mask_broadcast_f64x2(even, 0x0C, _mm_loadu_pd(p + a[1]));
    const __m512d three = _mm512_mask_broadcast_f64x2(two, 0x30, _mm_loadu_pd(p + a[2]));
    four[i] = _mm512_mask_broadcast_f64x2(three, 0xC0, _mm_loadu_pd(p + a[3]));
  }
  x.v = _mm512_permutex2var_pd(four[0], _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14), four[1]);
  y.v = _mm512_permutex2var_pd(four[0], _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15), four[1]);
}

/// K u of eight rows of `n` 2×2 blocks: k (n, rows, 4), column (n, rows) offset of the pair in u. A
/// register holds two rows, a load two columns: loads limit the speed of the loop.
inline void row_products(std::int64_t n, const double* k, const std::int32_t* column,
                         const double* u, Pack& x, Pack& y) noexcept {
  __m512d sums[4] = {};  // of rows 2i, 2i + 1: products with k_xx, k_xy, k_yx, k_yy
  for (; n > 0; --n, k += 32, column += 8) {
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) {
      std::uint64_t columns = 0;
      __builtin_memcpy(&columns, column + 2 * i, sizeof columns);
      const __m512d even = _mm512_broadcast_f64x2(_mm_loadu_pd(u + (columns & 0xFFFFFFFF)));
      const __m512d both =
          _mm512_mask_broadcast_f64x2(even, 0xF0, _mm_loadu_pd(u + (columns >> 32U)));
      sums[i] = _mm512_fmadd_pd(_mm512_loadu_pd(k + i * 8), both, sums[i]);
    }
  }
  // The order is x of rows 0, 2, y of 0, 2, x of 1, 3, y of 1, 3; then that of rows 4 to 7.
  const auto pairs = [](__m512d a, __m512d b) {
    return _mm512_add_pd(_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
  };
  const __m512d low = pairs(sums[0], sums[1]), high = pairs(sums[2], sums[3]);
  x.v = _mm512_permutex2var_pd(low, _mm512_setr_epi64(0, 4, 1, 5, 8, 12, 9, 13), high);
  y.v = _mm512_permutex2var_pd(low, _mm512_setr_epi64(2, 6, 3, 7, 10, 14, 11, 15), high);
}

/// Number of packs whose products are formed at once: as many as the registers hold.
constexpr int block_packs = 4;
/// Number of packs when neighbouring rows are processed together.
constexpr int strip_packs = 2;

}  // namespace
