// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/latin/latin.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/contact/residual.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/dense.hpp"

namespace rondo::statics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The residual (6.4d) of a candidate at an increment, without its scale [N/m].
double law_residual_of(const LatinProblem& p, const LatinPair& pair, Index j, Index k) {
  const Index n = 2 * j, t = n + 1;
  const double before = k > 0 ? pair.place(t, k - 1) : 0.0;
  return contact::law_residual({pair.force(n, k), pair.force(t, k)},
                               {pair.place(n, k), pair.place(t, k) - before}, 0.0, p.friction,
                               1.0 / p.compliance(n, n));
}

}  // namespace

double chosen_direction(const MatrixXd& compliance, bool slides) {
  const Eigen::VectorXd values = eigenvalues_of(compliance);
  RONDO_DEMAND(values[0] > 0.0, values[0]);
  const double k = 1.0 / (std::sqrt(values[0]) * std::sqrt(values[values.size() - 1]));
  return slides ? 2.0 / 3.0 * k : k;
}

void obey_laws(const LatinPair& elastic, double k, double friction, LatinPair& lawful) {
  const Index m = elastic.force.rows() / 2, increments = elastic.force.cols();
  lawful.force.resizeLike(elastic.force);
  lawful.place.resizeLike(elastic.force);
  Eigen::VectorXd slip = Eigen::VectorXd::Zero(m);  // of the increment before
  for (Index i = 0; i < increments; ++i)
    for (Index j = 0; j < m; ++j) {
      const Index n = 2 * j, t = n + 1;
      const double normal = elastic.force(n, i) - k * elastic.place(n, i);
      const double tangential = elastic.force(t, i) - k * elastic.place(t, i);
      const double pressed = std::max(normal, 0.0), limit = friction * pressed;
      const double sticking = tangential + k * slip[j];  // with no slip within the increment
      const double held = std::clamp(sticking, -limit, limit);
      if (std::abs(sticking) > limit) slip[j] = (held - tangential) / k;
      lawful.force(n, i) = pressed;
      lawful.place(n, i) = std::max(-normal, 0.0) / k;
      lawful.force(t, i) = held;
      lawful.place(t, i) = slip[j];
    }
}

double history_residual(const LatinProblem& problem, const LatinPair& pair) {
  double squares = 0.0;
  for (Index k = 0; k < pair.force.cols(); ++k)
    for (Index j = 0; j < pair.force.rows() / 2; ++j) {
      const double residual = law_residual_of(problem, pair, j, k);
      squares += residual * residual;
    }
  return squares == 0.0 ? 0.0 : std::sqrt(squares) / pair.force.norm();
}

Eigen::VectorXd increment_residuals(const LatinProblem& problem, const LatinPair& pair) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(pair.force.cols());
  double force = 0.0;
  for (Index k = 0; k < pair.force.cols(); ++k)
    for (Index j = 0; j < pair.force.rows() / 2; ++j) {
      largest[k] = std::max(largest[k], law_residual_of(problem, pair, j, k));
      force = std::max(force, pair.force.col(k).segment<2>(2 * j).norm());
    }
  if (force > 0.0) largest /= force;
  return largest;
}

CondensedElasticity::CondensedElasticity(const MatrixXd& compliance, double direction)
    : direction_(direction) {
  const Index size = compliance.rows();
  const MatrixXd a = MatrixXd::Identity(size, size) + direction * compliance;
  stiffened_ = solve_definite(a, compliance);
}

void CondensedElasticity::solve(const MatrixXd& load, double /*indicator*/,
                                MatrixXd& displacement) {
  displacement.noalias() = stiffened_ * load;
}

MatrixXd CondensedElasticity::balanced_force(const MatrixXd& load,
                                             const MatrixXd& displacement) const {
  return load - direction_ * displacement;
}

Latin::Latin(const LatinProblem& problem, Elasticity& elasticity, double direction,
             double relaxation)
    : problem_(problem), elasticity_(elasticity), direction_(direction), relaxation_(relaxation) {
  RONDO_DEMAND(direction > 0.0 && relaxation > 0.0 && relaxation <= 1.0, direction, relaxation);
  RONDO_DEMAND(problem.free.rows() == problem.compliance.rows() && problem.free.cols() > 0,
               problem.free.rows(), problem.compliance.rows(), problem.free.cols());
  elastic_.force = MatrixXd::Zero(problem.free.rows(), problem.free.cols());
  elastic_.place = problem.free;
}

LatinReport Latin::iterate() {
  obey_laws(elastic_, direction_, problem_.friction, lawful_);
  const double apart = (elastic_.force - lawful_.force).squaredNorm();
  const double size = elastic_.force.squaredNorm() + lawful_.force.squaredNorm();
  if (report_.iterations > 0) report_.indicator = size > 0.0 ? std::sqrt(apart / size) : 0.0;
  load_ = lawful_.force + direction_ * (lawful_.place - problem_.free);
  elasticity_.solve(load_, report_.indicator, displacement_);
  balanced_.force = elasticity_.balanced_force(load_, displacement_);
  balanced_.place = problem_.free + displacement_;
  report_.residual = history_residual(problem_, balanced_);
  elastic_.force += relaxation_ * (load_ - direction_ * displacement_ - elastic_.force);
  elastic_.place += relaxation_ * (balanced_.place - elastic_.place);
  ++report_.iterations;
  return report_;
}

}  // namespace rondo::statics
