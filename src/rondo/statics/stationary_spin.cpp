// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/stationary_spin.hpp"

#include <Eigen/CholmodSupport>

#include "rondo/core/blas_threads.hpp"

namespace rondo::statics {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

Eigen::VectorXd mass_vector(std::span<const double> mass, std::span<const int> free) {
  Eigen::VectorXd m(static_cast<Eigen::Index>(2 * free.size()));
  for (std::size_t i = 0; i < free.size(); ++i)
    m.segment<2>(static_cast<Eigen::Index>(2 * i))
        .setConstant(mass[static_cast<std::size_t>(free[i])]);
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
    const Vec2 x = reference[static_cast<std::size_t>(free[i])];
    load.segment<2>(static_cast<Eigen::Index>(2 * i)) = Eigen::Vector2d(x.x, x.y);
  }
  load.array() *= spin * spin * m.array();
  StationarySpin out;
  out.u.assign(reference.size(), Vec2{});
  const OneBlasThread one_thread;
  Cholesky solver;
  if (!factorise(solver, a)) return out;
  Eigen::VectorXd u = solver.solve(load);
  u += solver.solve(load - a * u);  // one refinement: round-off of the solve, not of the factor
  out.status = SpinStatus::solved;
  out.residual = load.norm() > 0.0 ? (a * u - load).norm() / load.norm() : 0.0;
  for (std::size_t i = 0; i < free.size(); ++i)
    out.u[static_cast<std::size_t>(free[i])] = {u[static_cast<Eigen::Index>(2 * i)],
                                                u[static_cast<Eigen::Index>(2 * i + 1)]};
  return out;
}

}  // namespace

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
