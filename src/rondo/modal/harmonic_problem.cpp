// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/modal/harmonic_problem.hpp"

#include <cmath>
#include <optional>

#include "rondo/core/contract.hpp"
#include "rondo/modal/inertia.hpp"

namespace rondo::modal {

using Eigen::Index;
using Eigen::VectorXcd;

template <int D>
VectorXcd gyroscopic(const VectorXcd& w) {
  const std::complex<double> two_i(0.0, 2.0);
  VectorXcd out = VectorXcd::Zero(w.size());
  for (Index a = 0; a < w.size(); a += D) {
    out[a] = -two_i * w[a + 1];
    out[a + 1] = two_i * w[a];
  }
  return out;
}

template <int D>
HarmonicProblem<D>::HarmonicProblem(const CyclicBody<D>& body, double spin)
    : body_(body), spin_(spin), harmonics_(body.stiffness, body.mass) {
  choose(0);
}

/// A' + shift.
template <int D>
const typename HarmonicProblem<D>::Matrix& HarmonicProblem<D>::spun(double shift) {
  return harmonics_.lower(n_, 1.0, shift - spin_ * spin_, shift);
}

template <int D>
bool HarmonicProblem<D>::finite() {
  choose(0);
  return std::isfinite(spun(0.0).norm());
}

template <int D>
void HarmonicProblem<D>::choose(int n) {
  n_ = n;
  rigid_.resize(0);
  if (!body_.free() || n > 1) return;
  rigid_.resize(size());
  const Complex i(0.0, 1.0);
  for (Index a = 0; a < rigid_.size(); a += D) {
    // Polar components in sector 0 of J X and of e_x, which is Re (1, i) e^{iφ} in sector φ.
    const Vec2 x = body_.reference[body_.stiffness.node(static_cast<std::size_t>(a / D), 0)];
    rigid_[a] = n == 0 ? Complex(-x.y) : Complex(1.0);
    rigid_[a + 1] = n == 0 ? Complex(x.x) : i;
  }
  rigid_ = rigid_.cwiseProduct(harmonics_.root_mass().cast<Complex>()).eval();
  rigid_.normalize();
}

template <int D>
bool HarmonicProblem<D>::has_partner() const noexcept {
  return n_ > 0 && 2 * n_ < body_.stiffness.n_sectors;
}

template <int D>
void HarmonicProblem<D>::take_rigid_out(Eigen::Ref<VectorXcd> w) const {
  if (rigid_.size() > 0) w -= rigid_.dot(w) * rigid_;
}

/// Number of negative eigenvalues of A' - ω² + ω s G, without the rigid-body motion, whose value
/// there, -ω² or -(ω ± s)², is negative. If a pivot is exactly zero, an ω next to it is used.
template <int D>
int HarmonicProblem<D>::negative(double omega) {
  std::optional<int> found;
  for (int tries = 0; tries < 8 && !found; ++tries) {
    const double w = omega * (1.0 + tries * 1e-12);
    Matrix a = spun(-w * w);
    for (Index k = 0; k < a.cols(); k += D) {
      // In a column from its diagonal on, the next entry is that of y in the row of x's node.
      const Index next = a.outerIndexPtr()[k] + 1;
      RONDO_ASSERT(a.innerIndexPtr()[next] == k + 1, k);
      a.valuePtr()[next] += Complex(0.0, 2.0 * w * spin_);
    }
    found = negative_eigenvalues(a);
  }
  RONDO_DEMAND(found.has_value(), omega, spin_, n_);
  const int rigid = rigid_.size() > 0 && (omega != 0.0 || spin_ != 0.0) ? 1 : 0;
  return *found - rigid;
}

template <int D>
RootCounts HarmonicProblem<D>::count_below(double sigma) {
  if (spin_ == 0.0) return {negative(sigma), 0};
  return {negative(sigma), negative(-sigma)};
}

template <int D>
double HarmonicProblem<D>::sigma_with(int count) {
  const Matrix& a = spun(0.0);
  const double diagonal = a.diagonal().real().minCoeff();  // a Rayleigh quotient of A'
  const double scale = std::max(diagonal, 1e-6 * a.diagonal().real().maxCoeff());
  const int all = (spin_ == 0.0 ? 1 : 2) * (size() - (rigid_.size() > 0 ? 1 : 0));
  double sigma = std::sqrt(scale) / size();
  while (true) {
    const RootCounts counts = count_below(sigma);
    if (counts.positive + counts.negative >= std::min(count, all)) return sigma;
    sigma *= 2.0;
  }
}

/// Factorises A' + shift I.
template <int D>
void HarmonicProblem<D>::factorise(double shift) {
  lower_ = spun(0.0);
  Matrix a = lower_;
  for (Index k = 0; k < a.cols(); ++k) a.valuePtr()[a.outerIndexPtr()[k]] += shift;
  factor_.compute(a);
  RONDO_DEMAND(factor_.info() == Eigen::Success, n_, spin_);
}

/// T = (A + shift)⁻¹, with μ = 1/(ω² + shift).
template <int D>
Operator<std::complex<double>> HarmonicProblem<D>::at_rest(double shift) {
  factorise(shift);
  Operator<Complex> op;
  op.size = size();
  op.rank = size() - (rigid_.size() > 0 ? 1 : 0);
  op.apply = [this](const VectorXcd& x) {
    VectorXcd y = factor_.solve(x);
    take_rigid_out(y);
    return y;
  };
  op.metric = [](const VectorXcd& x) { return x; };
  return op;
}

/// T = P⁻¹ Q with P = diag(A', 1), Q = [-2isJ, 1; 1, 0], of (w, ω w), with μ = 1/ω (8.3).
template <int D>
Operator<std::complex<double>> HarmonicProblem<D>::in_spin() {
  factorise(0.0);
  const Index n = size();
  Operator<Complex> op;
  op.size = 2 * n;
  op.rank = 2 * (n - (rigid_.size() > 0 ? 1 : 0));
  op.apply = [this, n](const VectorXcd& x) {
    VectorXcd y(2 * n);
    y.head(n) = factor_.solve(VectorXcd(x.tail(n) - spin_ * gyroscopic<D>(x.head(n))));
    y.tail(n) = x.head(n);
    take_rigid_out(y.head(n));
    take_rigid_out(y.tail(n));
    return y;
  };
  op.metric = [this, n](const VectorXcd& x) {
    VectorXcd y(2 * n);
    y.head(n).noalias() = lower_.selfadjointView<Eigen::Lower>() * x.head(n);
    y.tail(n) = x.tail(n);
    return y;
  };
  return op;
}

template <int D>
std::vector<HarmonicRoot> HarmonicProblem<D>::roots_below(double sigma, RootCounts counts) {
  const bool rest = spin_ == 0.0;
  // A value below the lowest frequency, because rigid-body motions make A singular.
  const double shift = rest && rigid_.size() > 0 ? 0.1 * sigma * sigma / size() : 0.0;
  const Operator<Complex> op = rest ? at_rest(shift) : in_spin();
  const double limit = rest ? 1.0 / (sigma * sigma + shift) : 1.0 / sigma;
  Krylov<Complex> space(op);
  const Ritz ritz = eigenvalues_beyond(space, limit, counts.positive, counts.negative);
  dimension_ = std::max(dimension_, static_cast<int>(space.dimension()));
  std::vector<HarmonicRoot> roots;
  for (Index k = 0; k < ritz.value.size(); ++k) {
    const double mu = ritz.value[k];
    if (!(std::abs(mu) > limit) || (rest && mu < 0.0)) continue;
    HarmonicRoot root;
    root.omega = rest ? std::sqrt(std::max(0.0, 1.0 / mu - shift)) : 1.0 / mu;
    root.w = op.apply(space.vector(ritz, k)).head(size());  // again: improves the vector
    root.w.normalize();
    roots.push_back(std::move(root));
  }
  return roots;
}

template <int D>
Eigen::MatrixXd HarmonicProblem<D>::dense_rotational() {
  choose(0);
  const Eigen::MatrixXd lower = Eigen::MatrixXcd(spun(0.0)).real();
  return lower.selfadjointView<Eigen::Lower>();
}

template VectorXcd gyroscopic<2>(const VectorXcd&);
template VectorXcd gyroscopic<3>(const VectorXcd&);
template class HarmonicProblem<2>;
template class HarmonicProblem<3>;

}  // namespace rondo::modal
