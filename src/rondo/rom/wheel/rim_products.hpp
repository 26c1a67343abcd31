// SPDX-License-Identifier: BSD-3-Clause
/// @file  Products of the modes of a wheel with each other, which its momenta are made of
/// (docs/reduced.md, R.32), for disks and for wheels in three dimensions.
#pragma once
#include <complex>

#include "rondo/rom/wheel/ring_harmonics.hpp"

namespace rondo::rom {

/// Re(aᴴ b).
template <class A, class B>
[[nodiscard]] double product_of(const A& a, const B& b) {
  return a.dot(b).real();
}

/// Re((J y)ᴴ p) without temporary vectors.
template <class Y, class P>
[[nodiscard]] double twisted_by(const Eigen::MatrixXcd& turn, const Y& y, const P& p) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < turn.rows(); ++i)
    for (Eigen::Index j = 0; j < turn.cols(); ++j)
      sum += (std::conj(turn(i, j) * y[j]) * p[i]).real();
  return sum;
}

/// conj(lᵀ x): the sum over the sectors that translates with the rim, over N.
template <class X>
[[nodiscard]] std::complex<double> along_rim(const RingHarmonic& h, const X& x) {
  return std::conj((h.translation.transpose() * x)(0));
}

}  // namespace rondo::rom
