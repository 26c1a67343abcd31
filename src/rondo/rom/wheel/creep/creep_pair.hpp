// SPDX-License-Identifier: BSD-3-Clause
/// @file  The two matrices by which forces on contact nodes creep, of one harmonic
/// (docs/reduced.md, R.34).
#pragma once
#include <Eigen/Core>
#include <complex>
#include <span>

#include "rondo/rom/wheel/creep/creep.hpp"

namespace rondo::rom {

/// How the first term of a creep and all others answer at a rate.
struct CreepLags {
  std::complex<double> first, others;

  CreepLags(std::span<const CreepTerm> terms, double rate) noexcept
      : first(terms.front().at(rate)), others(creep_at(terms.subspan(1), rate)) {}
  [[nodiscard]] std::complex<double> all() const noexcept { return first + others; }
  /// Whether their phases differ: where they do not, one matrix says all.
  [[nodiscard]] bool differ() const noexcept {
    return std::abs((first * std::conj(others)).imag()) > 1e-6 * std::abs(first) * std::abs(others);
  }
  [[nodiscard]] std::complex<double> determinant() const noexcept {
    return first * std::conj(others) - std::conj(first) * others;
  }
};

/// The Hermitian matrices A and B with A j_0 h_0 + B Σ j_b h_b = the answer at a rate; of all rows,
/// or of those of the contact nodes alone.
struct CreepPair {
  Eigen::MatrixXcd at_once, later;
};
/// The rate and its opposite are two equations for them, because the answer to the opposite rate is
/// the adjoint one. @param ahead, back answers to both @pre the lags differ
[[nodiscard]] CreepPair creep_pair(const CreepLags& lags, const Eigen::MatrixXcd& ahead,
                                   const Eigen::MatrixXcd& back);

/// Whether a Hermitian matrix has no eigenvalue below 0 but for round-off.
[[nodiscard]] bool is_semidefinite(const Eigen::MatrixXcd& a);

}  // namespace rondo::rom
