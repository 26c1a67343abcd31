// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/stationary_spin.hpp"

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rondo/core/index.hpp"
#include "rondo/core/process_wide.hpp"

namespace rondo::statics {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

Eigen::VectorXd mass_vector(std::span<const double> mass, std::span<const int> free) {
  Eigen::VectorXd m(static_cast<Eigen::Index>(2 * free.size()));
  for (std::size_t i = 0; i < free.size(); ++i)
    m.segment<2>(static_cast<Eigen::Index>(2 * i)).setConstant(mass[at(free[i])]);
  return m;
}

Matrix shifted(const fem::BlockCsr& k, const Eigen::VectorXd& mass, std::span<const int> free,
               double shift) {
  Matrix a = fem::free_matrix(k, free);
  for (Eigen::Index i = 0; i < a.rows(); ++i) a.coeffRef(i, i) -= shift * mass[i];
  return a;
}

using Cholesky = Eigen::CholmodDecomposition<Matrix, Eigen::Lower>;

/// Factorises; false where the matrix is not positive definite.
bool factorise(Cholesky& solver, const Matrix& a) {
  solver.setMode(Eigen::CholmodSupernodalLLt);
  solver.cholmod().print = 0;  // "not positive definite" is an answer here, not a message
  solver.compute(a);
  return solver.info() == Eigen::Success;
}

/// (K - softening M) u = s² M X.
StationarySpin solve(const fem::BlockCsr& k, std::span<const double> mass,
                     std::span<const Vec2> reference, std::span<const int> free, double spin,
                     double softening) {
  const Eigen::VectorXd m = mass_vector(mass, free);
  const Matrix a = shifted(k, m, free, softening);
  Eigen::VectorXd load(m.size());
  for (std::size_t i = 0; i < free.size(); ++i) {
    const Vec2 x = reference[at(free[i])];
    load.segment<2>(static_cast<Eigen::Index>(2 * i)) = Eigen::Vector2d(x.x, x.y);
  }
  load.array() *= spin * spin * m.array();
  StationarySpin out;
  out.u = Field(reference.size(), 2);
  const OneBlasThread one_thread;
  Cholesky solver;
  if (!factorise(solver, a)) return out;
  Eigen::VectorXd u = solver.solve(load);
  u += solver.solve(load - a * u);  // one refinement: round-off of the solve, not of the factor
  out.status = SpinStatus::solved;
  out.residual = load.norm() > 0.0 ? (a * u - load).norm() / load.norm() : 0.0;
  for (std::size_t i = 0; i < free.size(); ++i)
    out.u.plane()[at(free[i])] = {u[static_cast<Eigen::Index>(2 * i)],
                                  u[static_cast<Eigen::Index>(2 * i + 1)]};
  return out;
}

/// A body of rubber that turns.
struct TurningRubber {
  const fem::Hyperelasticity& body;
  std::span<const double> mass;
  std::span<const Vec2> reference;
  std::span<const int> free;
};

/// s² M (X + u) - f(u) on the free nodes, and how large its first part is.
struct Unbalanced {
  Eigen::VectorXd force;
  double relative = 0.0;
  bool inverted = false;
};

Unbalanced unbalanced(const TurningRubber& r, double square, std::span<const Vec2> u) {
  fem::Hyperelasticity::Pass pass;
  std::vector<Vec2> gradient(u.size());
  Unbalanced out{Eigen::VectorXd(static_cast<Eigen::Index>(2 * r.free.size()))};
  out.inverted = !(r.body.gradient(u, {}, gradient, pass).least.ratio > 0.0);
  double pull = 0.0;
  for (std::size_t i = 0; i < r.free.size(); ++i) {
    const auto k = static_cast<std::size_t>(r.free[i]);
    const Vec2 load = square * r.mass[k] * (r.reference[k] + u[k]), rest = load - gradient[k];
    out.force.segment<2>(static_cast<Eigen::Index>(2 * i)) << rest.x, rest.y;
    pull += dot(load, load);
  }
  out.relative = pull > 0.0 ? out.force.norm() / std::sqrt(pull) : 0.0;
  return out;
}

/// Newton's method from u on; false where it does not get there.
bool balance(const TurningRubber& r, double square, StationarySpin& out) {
  constexpr int most_iterations = 40;
  constexpr double enough = 1e-13;
  constexpr double round_off = 1e-12;  // of a step, over the size of the body
  const Eigen::VectorXd mass = mass_vector(r.mass, r.free);
  double size = 0.0;
  for (const Vec2 x : r.reference) size = std::max(size, norm(x));
  double best = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Unbalanced rest = unbalanced(r, square, out.u);
    if (rest.inverted || !rest.force.allFinite()) return false;
    out.residual = rest.relative;
    Cholesky solver;
    if (!factorise(solver, shifted(r.body.tangent(out.u), mass, r.free, square))) return false;
    const Eigen::VectorXd step = solver.solve(rest.force);
    if (rest.relative <= enough ||
        (rest.relative >= 0.5 * best && step.lpNorm<Eigen::Infinity>() <= round_off * size))
      return true;  // and stable
    best = std::min(best, rest.relative);
    for (std::size_t i = 0; i < r.free.size(); ++i)
      out.u.plane()[at(r.free[i])] +=
          Vec2{step[static_cast<Eigen::Index>(2 * i)], step[static_cast<Eigen::Index>(2 * i + 1)]};
  }
  return false;
}

}  // namespace

StationarySpin stationary_spin(const fem::Hyperelasticity& body, std::span<const double> mass,
                               std::span<const Vec2> reference, std::span<const int> free,
                               double spin) {
  constexpr double smallest_part = 1.0 / 256.0;  // of s²
  const TurningRubber rubber{body, mass, reference, free};
  const OneBlasThread one_thread;
  StationarySpin found;
  found.u = Field(reference.size(), 2);
  double done = 0.0, part = 1.0;
  while (done < 1.0) {
    const double next = std::min(1.0, done + part);
    StationarySpin trial = found;
    if (balance(rubber, next * spin * spin, trial)) {
      found = std::move(trial);
      done = next;
    } else if ((part *= 0.5) < smallest_part) {
      return {SpinStatus::unstable, std::vector<Vec2>(reference.size()), trial.residual};
    }
  }
  found.status = SpinStatus::solved;
  return found;
}

StationarySpin stationary_spin(const fem::BlockCsr& k, std::span<const double> mass,
                               std::span<const Vec2> reference, std::span<const int> free,
                               double spin) {
  return solve(k, mass, reference, free, spin, spin * spin);
}

StationarySpin centrifugal_prestress(const fem::BlockCsr& k, std::span<const double> mass,
                                     std::span<const Vec2> reference, std::span<const int> free,
                                     double spin) {
  return solve(k, mass, reference, free, spin, 0.0);
}

bool eigenvalues_above(const fem::BlockCsr& k, std::span<const double> mass,
                       std::span<const int> free, double shift) {
  Cholesky solver;
  return factorise(solver, shifted(k, mass_vector(mass, free), free, shift));
}

}  // namespace rondo::statics
