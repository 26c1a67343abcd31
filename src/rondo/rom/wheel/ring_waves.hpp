// SPDX-License-Identifier: BSD-3-Clause
/// @file  Waves e^{ikψ} of the harmonics of a ring, and small vectors, as the parts of RingWheel
/// need them.
#pragma once
#include <complex>
#include <span>

#include "rondo/rom/wheel/ring_harmonics.hpp"

namespace rondo::rom {

/// The normal turned by -90°.
constexpr Vec2 tangent_of(Vec2 normal) noexcept {
  return -turn90(normal);
}

/// Re(a b).
inline double real_product(Complex a, const std::complex<double>& b) noexcept {
  return a.re * b.real() - a.im * b.imag();
}

/// How often harmonic k stands in the sum over all waves of a real field on N sectors: harmonic 0
/// and, of an even N, N/2 stand in it once, all others twice.
constexpr double harmonic_weight(int k, int n) noexcept {
  return k == 0 || 2 * k == n ? 1.0 : 2.0;
}

/// Calls work(harmonic, e^{ikψ}) for all harmonics, whose k ascend.
template <class Work>
void for_waves(std::span<const RingHarmonic> harmonics, Complex turn, Work&& work) {
  Complex wave{1.0, 0.0};
  int k = 0;
  for (std::size_t h = 0; h < harmonics.size(); ++h) {
    for (; k < harmonics[h].k; ++k) wave = wave * turn;
    work(h, wave);
  }
}

}  // namespace rondo::rom
