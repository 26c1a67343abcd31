// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid/solid_residual.hpp"

#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <optional>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/solid/solid_dynamic.hpp"
#include "rondo/rom/wheel/creep/creep_pair.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

using Complexes = std::complex<double>;
using Eigen::Index, Eigen::MatrixXcd, Eigen::VectorXcd, Eigen::VectorXd;

MatrixXcd hermitian(const MatrixXcd& a) {
  return 0.5 * (a + a.adjoint());
}

/// A harmonic of a viscous ring: of the rate and its opposite both matrices of CreepPair, or, where
/// the terms of the creep lag alike or a matrix would not be positive, one matrix for all.
class CreepHarmonic {
 public:
  CreepHarmonic(const SolidRing& ring, const SparseComplex& stiffness, const RingHarmonic* h, int k,
                double spin, std::span<const CreepTerm> creep)
      : lags_(creep, k * spin),
        rolls_(spin > 0.0 && k > 0 && 2 * k < ring.n_sectors()),
        // Forces over g(iks) have the inertia over g too; of it this takes the part in phase.
        one_(standing_answer(ring, stiffness, h, k, spin, is_static_,
                             rolls_ ? lags_.all().real() : 1.0)) {
    const auto on_contact = [&](const MatrixXcd& u) -> MatrixXcd {
      return u(contact_rows(ring), Eigen::all);
    };
    if (rolls_ && !is_static_ && lags_.differ()) {
      two_.emplace(ring, stiffness, h, k, spin, 1.0 / lags_.all());
      const MatrixXcd ahead = on_contact(two_->ahead(unit_forces(ring)));
      pair_ = creep_pair(lags_, ahead, ahead.adjoint());
      if (is_semidefinite(pair_.at_once) && is_semidefinite(pair_.later)) return;
      two_.reset();
      one_matrix_ = true;
    }
    pair_.at_once = pair_.later = hermitian(on_contact(one_.beyond(unit_forces(ring))));
  }
  /// (3C, 3C) each.
  [[nodiscard]] const CreepPair& pair() const noexcept { return pair_; }
  /// Whether one matrix is taken in place of two that would not be positive.
  [[nodiscard]] bool is_one_matrix() const noexcept { return one_matrix_; }
  [[nodiscard]] bool is_static() const noexcept { return is_static_; }
  /// What forces on the rows do, whatever the creep.
  [[nodiscard]] MatrixXcd still(const MatrixXcd& forces) const { return one_.beyond(forces); }
  /// (rows) What forces do on which both matrices act.
  [[nodiscard]] VectorXcd field(const VectorXcd& at_once, const VectorXcd& later) const {
    if (!two_) return one_.beyond(at_once + later);
    const Complexes f = lags_.first, o = lags_.others, d = lags_.determinant();
    return two_->ahead((std::conj(o) * at_once - std::conj(f) * later) / d) +
           two_->back((f * later - o * at_once) / d);
  }

 private:
  CreepLags lags_;
  bool rolls_, is_static_ = false, one_matrix_ = false;
  StandingAnswer one_;
  CreepPair pair_;
  std::optional<ViscousAnswer> two_;
};

/// Sums harmonics up to the tables of all lags.
void sum_lags(const SolidRing& ring, std::span<const MatrixXcd> by_harmonic, RingResidual& out) {
  const int n = out.n_sectors = ring.n_sectors();
  const Index size = out.size = ring.n_contact();
  out.blocks.resize(at(n) * at(size * size));
#pragma omp parallel for num_threads(ring.threads) schedule(static)
  for (int d = 0; d < n; ++d) {
    Eigen::Map<Eigen::MatrixXd> lag(out.blocks.data() + d * size * size, size, size);
    lag.setZero();
    for (int k = 0; k <= n / 2; ++k) {
      const double weight = harmonic_weight(k, n) / n;
      const Complexes turn =
          weight * std::polar(1.0, 2.0 * std::numbers::pi *
                                       static_cast<int>(static_cast<long long>(k) * d % n) / n);
      lag += turn.real() * by_harmonic[at(k)].real() - turn.imag() * by_harmonic[at(k)].imag();
    }
  }
}

/// (rows) Centrifugal force and constant load, of harmonic 0.
VectorXcd pull_of(const SolidRing& ring, double spin_squared) {
  return spin_squared * (masses(ring).asDiagonal() * reference_of(ring)) + load_of(ring);
}

/// Those harmonics that are marked.
std::vector<int> marked(std::span<const char> marks) {
  std::vector<int> harmonics;
  for (std::size_t k = 0; k < marks.size(); ++k)
    if (marks[k] != 0) harmonics.push_back(static_cast<int>(k));
  return harmonics;
}

}  // namespace

RingResidual solid_residual(const SolidRing& ring, std::span<const RingHarmonic> harmonics,
                            double spin_squared) {
  const double spin = std::sqrt(spin_squared);
  const HarmonicStiffness stiffness(ring.stiffness);
  const std::vector<Index> rows = contact_rows(ring);
  const MatrixXcd forces = unit_forces(ring);
  RingResidual out;
  const int half = ring.n_sectors() / 2;
  std::vector<MatrixXcd> by_harmonic(at(half + 1));
  std::vector<char> made_static(by_harmonic.size());
#pragma omp parallel for num_threads(ring.threads) schedule(dynamic)
  for (int k = 0; k <= half; ++k) {
    const RingHarmonic* h = find_harmonic(harmonics, k);
    bool is_static = false;
    const StandingAnswer z = standing_answer(ring, stiffness.at_harmonic(k), h, k, spin, is_static);
    made_static[at(k)] = is_static ? 1 : 0;
    by_harmonic[at(k)] = hermitian(z.beyond(forces)(rows, Eigen::all));
    if (k == 0) out.centrifugal = z.beyond(pull_of(ring, spin_squared)).real();
  }
  out.made_static = marked(made_static);
  sum_lags(ring, by_harmonic, out);
  return out;
}

CreepResidual solid_creep_residual(const SolidRing& ring, std::span<const RingHarmonic> harmonics,
                                   double spin_squared, std::span<const CreepTerm> creep) {
  RONDO_DEMAND(creep.size() >= 2, creep.size());
  const double spin = std::sqrt(spin_squared);
  const HarmonicStiffness stiffness(ring.stiffness);
  CreepResidual out;
  const int half = ring.n_sectors() / 2;
  std::vector<MatrixXcd> at_once(at(half + 1)), later(at_once.size());
  std::vector<char> made_static(at_once.size()), one_matrix(at_once.size());
#pragma omp parallel for num_threads(ring.threads) schedule(dynamic)
  for (int k = 0; k <= half; ++k) {
    const CreepHarmonic of(ring, stiffness.at_harmonic(k), find_harmonic(harmonics, k), k, spin,
                           creep);
    made_static[at(k)] = of.is_static() ? 1 : 0;
    one_matrix[at(k)] = of.is_one_matrix() ? 1 : 0;
    at_once[at(k)] = hermitian(of.pair().at_once);
    later[at(k)] = hermitian(of.pair().later);
    if (k == 0) out.at_once.centrifugal = of.still(pull_of(ring, spin_squared)).real();
  }
  out.at_once.made_static = marked(made_static);
  out.one_matrix = marked(one_matrix);
  sum_lags(ring, at_once, out.at_once);
  sum_lags(ring, later, out.later);
  return out;
}

SolidFields::SolidFields(const SolidRing& ring, std::span<const RingHarmonic> harmonics,
                         double spin, std::span<const CreepTerm> creep)
    : ring_(ring), spin_(spin) {
  const HarmonicStiffness stiffness(ring.stiffness);
  for (int k = 0; k <= ring.n_sectors() / 2; ++k) {
    const RingHarmonic* h = find_harmonic(harmonics, k);
    if (!creep.empty()) {
      const auto of = std::make_shared<CreepHarmonic>(ring, stiffness.at_harmonic(k), h, k,
                                                      std::abs(spin), creep);
      beyond_.emplace_back([of](const Rows& a, const Rows& b) -> Rows { return of->field(a, b); });
      continue;
    }
    bool is_static = false;
    const auto z = std::make_shared<StandingAnswer>(
        standing_answer(ring, stiffness.at_harmonic(k), h, k, spin, is_static));
    beyond_.emplace_back([z](const Rows& a, const Rows& /*b*/) -> Rows { return z->beyond(a); });
  }
}

MatrixXcd SolidFields::operator()(const MatrixXcd& at_once, const MatrixXcd& later) const {
  const std::vector<Index> rows = contact_rows(ring_);
  MatrixXcd out(ring_.n_rows(), at_once.cols());
  VectorXcd a = VectorXcd::Zero(ring_.n_rows()), b = a;
  for (Index k = 0; k < at_once.cols(); ++k) {
    for (std::size_t c = 0; c < rows.size(); ++c) {
      a[rows[c]] = at_once(static_cast<Index>(c), k);
      b[rows[c]] = later(static_cast<Index>(c), k);
    }
    out.col(k) = beyond_[at(k)](a, b);
  }
  return out;
}

}  // namespace rondo::rom
