// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/modal/critical_speeds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "rondo/core/contract.hpp"
#include "rondo/modal/harmonic_problem.hpp"
#include "rondo/modal/inertia.hpp"

namespace rondo::modal {
namespace {

using Eigen::Index;
using StdComplex = std::complex<double>;
using Matrix = fem::Harmonics::Matrix;
using Eigen::VectorXcd;

/// A(n) w = s² Q w, Q = n² + P - 2inJ - A_σ(n) (8.6).
template <int D>
class CriticalProblem {
 public:
  CriticalProblem(const CyclicBody<D>& body, const fem::SectorBlocks<D>* stiffening)
      : elastic_(body.stiffness, body.mass) {
    if (stiffening) stiffening_.emplace(*stiffening, body.mass);
  }

  [[nodiscard]] int n_harmonics() const noexcept { return elastic_.count(); }

  /// Selects harmonic n for all following calls.
  void choose(int n) {
    n_ = n;
    a_ = elastic_.lower(n, 1.0, 0.0);
    if (stiffening_) a_sigma_ = stiffening_->lower(n, 1.0, 0.0);
  }
  /// Whether A - s² Q is positive definite: no wave of this harmonic stands still at s or below.
  [[nodiscard]] bool none_up_to(double squared) const {
    const double n = n_;
    Matrix m = a_;
    if (stiffening_) m += squared * a_sigma_;
    for (Index k = 0; k < m.cols(); ++k) m.coeffRef(k, k) -= squared * (n * n + in_plane<D>(k));
    for (Index k = 0; k < m.cols(); k += D)
      m.coeffRef(k + 1, k) += StdComplex(0.0, 2.0 * n * squared);
    return negative_eigenvalues(m) == 0;
  }

  CriticalSpeed lowest() {
    const int n = n_;
    factor_.compute(a_);
    RONDO_DEMAND(factor_.info() == Eigen::Success, n);
    Operator<StdComplex> op;
    op.size = op.rank = a_.rows();
    op.apply = [this](const VectorXcd& x) { return VectorXcd(factor_.solve(right(x))); };
    op.metric = [this](const VectorXcd& x) { return VectorXcd(left(x)); };
    Krylov<StdComplex> space(op);
    Ritz ritz = eigenvalues_beyond(space, 0.0, 1, 0);
    while (!space.complete() && ritz.value[0] > 0.0 && !is_lowest(ritz.value[0])) {
      space.widen();
      ritz = eigenvalues_beyond(space, ritz.value[0] * (1.0 + 1e-6), 1, 0);
    }
    if (ritz.value.size() == 0 || !(ritz.value[0] > 0.0)) return {n, 0.0, 0.0};
    const VectorXcd w = op.apply(space.vector(ritz, 0));
    const VectorXcd aw = left(w);
    return {n, 1.0 / std::sqrt(ritz.value[0]), (aw - right(w) / ritz.value[0]).norm() / aw.norm()};
  }

 private:
  [[nodiscard]] VectorXcd left(const VectorXcd& x) const {
    return a_.selfadjointView<Eigen::Lower>() * x;
  }
  [[nodiscard]] VectorXcd right(const VectorXcd& x) const {
    const double n = n_;
    VectorXcd y = n * n * x - n * gyroscopic<D>(x);
    for (Index k = 0; k < y.size(); ++k) y[k] += in_plane<D>(k) * x[k];
    if (stiffening_) y -= a_sigma_.selfadjointView<Eigen::Lower>() * x;
    return y;
  }
  /// Whether no root is lower than the one found.
  [[nodiscard]] bool is_lowest(double mu) const { return none_up_to((1.0 - 1e-6) / mu); }

  fem::Harmonics elastic_;
  std::optional<fem::Harmonics> stiffening_;
  int n_ = 0;
  Matrix a_, a_sigma_;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factor_;
};

}  // namespace

template <int D>
std::vector<CriticalSpeed> critical_speeds(
    const CyclicBody<D>& body, const std::type_identity_t<fem::SectorBlocks<D>>* stiffening,
    int last) {
  CriticalProblem<D> problem(body, stiffening);
  std::vector<CriticalSpeed> speeds;
  for (int n = body.free() ? 2 : 1; n <= std::min(last, problem.n_harmonics() - 1); ++n) {
    problem.choose(n);
    const CriticalSpeed found = problem.lowest();
    if (found.spin > 0.0) speeds.push_back(found);
  }
  return speeds;
}

template <int D>
std::vector<CriticalSpeed> critical_speeds_up_to(const CyclicBody<D>& body, double spin) {
  CriticalProblem<D> problem(body, nullptr);
  std::vector<CriticalSpeed> speeds;
  for (int n = 0; n < problem.n_harmonics(); ++n) {
    problem.choose(n);
    if (!problem.none_up_to(spin * spin)) speeds.push_back(problem.lowest());
  }
  return speeds;
}

template std::vector<CriticalSpeed> critical_speeds(const CyclicBody<2>&,
                                                    const fem::SectorBlocks<2>*, int);
template std::vector<CriticalSpeed> critical_speeds(const CyclicBody<3>&,
                                                    const fem::SectorBlocks<3>*, int);
template std::vector<CriticalSpeed> critical_speeds_up_to(const CyclicBody<2>&, double);
template std::vector<CriticalSpeed> critical_speeds_up_to(const CyclicBody<3>&, double);

}  // namespace rondo::modal
