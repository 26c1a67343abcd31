// SPDX-License-Identifier: BSD-3-Clause
/// @file  Eight doubles in two registers of four: the same bits as eight in one.
#pragma once
#include <immintrin.h>

#include <cstdint>

namespace {

struct Pack {
  __m256d a, b;
};

inline Pack load(const double* p) noexcept {
  return {_mm256_loadu_pd(p), _mm256_loadu_pd(p + 4)};
}
inline void store(double* p, Pack x) noexcept {
  _mm256_storeu_pd(p, x.a);
  _mm256_storeu_pd(p + 4, x.b);
}
inline Pack all(double x) noexcept {
  return {_mm256_set1_pd(x), _mm256_set1_pd(x)};
}
inline Pack operator+(Pack x, Pack y) noexcept {
  return {_mm256_add_pd(x.a, y.a), _mm256_add_pd(x.b, y.b)};
}
inline Pack operator-(Pack x, Pack y) noexcept {
  return {_mm256_sub_pd(x.a, y.a), _mm256_sub_pd(x.b, y.b)};
}
inline Pack operator*(Pack x, Pack y) noexcept {
  return {_mm256_mul_pd(x.a, y.a), _mm256_mul_pd(x.b, y.b)};
}
inline Pack operator/(Pack x, Pack y) noexcept {
  return {_mm256_div_pd(x.a, y.a), _mm256_div_pd(x.b, y.b)};
}
/// x y + z
inline Pack fma(Pack x, Pack y, Pack z) noexcept {
  return {_mm256_fmadd_pd(x.a, y.a, z.a), _mm256_fmadd_pd(x.b, y.b, z.b)};
}
/// z - x y
inline Pack fnma(Pack x, Pack y, Pack z) noexcept {
  return {_mm256_fnmadd_pd(x.a, y.a, z.a), _mm256_fnmadd_pd(x.b, y.b, z.b)};
}
inline Pack smaller(Pack x, Pack y) noexcept {
  return {_mm256_min_pd(x.a, y.a), _mm256_min_pd(x.b, y.b)};
}
inline Pack square_root(Pack x) noexcept {
  return {_mm256_sqrt_pd(x.a), _mm256_sqrt_pd(x.b)};
}
inline Pack larger(Pack x, Pack y) noexcept {
  return {_mm256_max_pd(x.a, y.a), _mm256_max_pd(x.b, y.b)};
}
inline __m256d guess_of_four(__m256d a) noexcept {
  const __m128i bits = _mm_castps_si128(_mm256_cvtpd_ps(a));
  const __m128 third = _mm_mul_ps(_mm_cvtepi32_ps(bits), _mm_set1_ps(1.0F / 3.0F));
  const __m128i guess = _mm_sub_epi32(_mm_set1_epi32(0x54a23400), _mm_cvtps_epi32(third));
  return _mm256_cvtps_pd(_mm_castsi128_ps(guess));
}
/// Guess of a^(-1/3): divides the exponent by three, using the bits of a float.
inline Pack cube_root_guess(Pack x) noexcept {
  return {guess_of_four(x.a), guess_of_four(x.b)};
}
inline __m256d first_of_four(int n, __m256d x, __m256d y) noexcept {
  const __m256i lane = _mm256_set_epi64x(3, 2, 1, 0);
  const __m256i taken = _mm256_cmpgt_epi64(_mm256_set1_epi64x(n), lane);
  return _mm256_blendv_pd(y, x, _mm256_castsi256_pd(taken));
}
/// The first n lanes of x, the other lanes of y.
inline Pack first_lanes(int n, Pack x, Pack y) noexcept {
  return {first_of_four(n, x.a, y.a), first_of_four(n - 4, x.b, y.b)};
}
/// Bit i is set if x <= y in lane i.
inline unsigned not_above(Pack x, Pack y) noexcept {
  const int low = _mm256_movemask_pd(_mm256_cmp_pd(x.a, y.a, _CMP_LE_OQ));
  const int high = _mm256_movemask_pd(_mm256_cmp_pd(x.b, y.b, _CMP_LE_OQ));
  return static_cast<unsigned>(low | (high << 4));
}

/// Loads N packs of sectors from u on, with the values of the last and the next sectors.
template <int N>
inline void load_neighbours(const double* u, Pack* last, Pack* here, Pack* next) noexcept {
  for (int i = 0; i < N; ++i) {
    last[i] = load(u + i * 8 - 1);
    here[i] = load(u + i * 8);
    next[i] = load(u + i * 8 + 1);
  }
}

/// Loads x and y of four vectors stored one after the other (x, y).
inline void load_four_pairs(const double* p, __m256d& x, __m256d& y) noexcept {
  const __m256d a = _mm256_loadu_pd(p), b = _mm256_loadu_pd(p + 4);
  const __m256d low = _mm256_permute2f128_pd(a, b, 0x20), high = _mm256_permute2f128_pd(a, b, 0x31);
  x = _mm256_unpacklo_pd(low, high);
  y = _mm256_unpackhi_pd(low, high);
}
inline void store_four_pairs(double* p, __m256d x, __m256d y) noexcept {
  const __m256d even = _mm256_unpacklo_pd(x, y), odd = _mm256_unpackhi_pd(x, y);
  _mm256_storeu_pd(p, _mm256_permute2f128_pd(even, odd, 0x20));
  _mm256_storeu_pd(p + 4, _mm256_permute2f128_pd(even, odd, 0x31));
}
/// Loads eight vectors stored one after the other (x, y).
inline void load_pairs(const double* p, Pack& x, Pack& y) noexcept {
  load_four_pairs(p, x.a, y.a);
  load_four_pairs(p + 8, x.b, y.b);
}
inline void store_pairs(double* p, Pack x, Pack y) noexcept {
  store_four_pairs(p, x.a, y.a);
  store_four_pairs(p + 8, x.b, y.b);
}

inline void gather_four_pairs(const double* p, const std::int32_t* at, __m256d& x,
                              __m256d& y) noexcept {
  const __m256d even = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(p + at[0])),
                                            _mm_loadu_pd(p + at[2]), 1);
  const __m256d odd = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(p + at[1])),
                                           _mm_loadu_pd(p + at[3]), 1);
  x = _mm256_unpacklo_pd(even, odd);
  y = _mm256_unpackhi_pd(even, odd);
}
/// Loads eight vectors from the offsets `at`, counted in doubles from p.
inline void gather_pairs(const double* p, const std::int32_t* at, Pack& x, Pack& y) noexcept {
  gather_four_pairs(p, at, x.a, y.a);
  gather_four_pairs(p, at + 4, x.b, y.b);
}

inline void sums_of_four_rows(const __m256d* rows, __m256d& x, __m256d& y) noexcept {
  const __m256d a = _mm256_hadd_pd(rows[0], rows[1]), b = _mm256_hadd_pd(rows[2], rows[3]);
  x = _mm256_permute2f128_pd(a, b, 0x20);
  y = _mm256_permute2f128_pd(a, b, 0x31);
}
/// K u of eight rows of `n` 2×2 blocks: k (n, rows, 4), column (n, rows) offset of the pair in u.
inline void row_products(std::int64_t n, const double* k, const std::int32_t* column,
                         const double* u, Pack& x, Pack& y) noexcept {
  __m256d sums[8] = {};  // per row: products with k_xx, k_xy, k_yx, k_yy
  for (; n > 0; --n, k += 32, column += 8) {
#pragma GCC unroll 8
    for (int i = 0; i < 8; ++i) {
      const __m256d pair = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(u + column[i]));
      sums[i] = _mm256_fmadd_pd(_mm256_loadu_pd(k + i * 4), pair, sums[i]);
    }
  }
  sums_of_four_rows(sums, x.a, y.a);
  sums_of_four_rows(sums + 4, x.b, y.b);
}

constexpr int block_packs = 1;
constexpr int strip_packs = 1;

}  // namespace
