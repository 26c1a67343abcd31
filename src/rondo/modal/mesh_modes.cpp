// SPDX-License-Identifier: BSD-3-Clause
/// Modes of any mesh by sparse factorisations (docs/theory.md, 8.3 and 8.4).
#include <Eigen/CholmodSupport>
#include <algorithm>
#include <cmath>
#include <optional>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/modal/inertia.hpp"
#include "rondo/modal/krylov.hpp"
#include "rondo/modal/shapes.hpp"

namespace rondo::modal {
namespace {

using Eigen::Index;
using SparseMatrix = Eigen::SparseMatrix<double>;
using Eigen::VectorXd;
using Cholesky = Eigen::CholmodDecomposition<SparseMatrix, Eigen::Lower>;

/// The equation on the free nodes; an unknown has the number 2·(index in `free`) + component.
struct ReducedBody {
  std::vector<int> free;
  SparseMatrix k;  ///< K' = K - s² M
  VectorXd mass;
  double spin = 0.0;
  Eigen::MatrixXd rigid;  ///< M-orthonormal rigid-body motions of the free bodies
};

/// Three M-orthonormal columns for each body: along x, along y, about the center of mass.
Eigen::MatrixXd rigid_motions(const MeshBody& body, const ReducedBody& r) {
  const std::vector<int> bodies = free_bodies(body.mesh);
  const mesh::Bodies all = mesh::find_bodies(body.mesh);
  Eigen::MatrixXd motions =
      Eigen::MatrixXd::Zero(r.mass.size(), 3 * static_cast<Index>(bodies.size()));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto column = static_cast<Index>(3 * b);
    double mass = 0.0;
    Vec2 center;
    const auto each_node = [&](auto&& act) {
      for (std::size_t i = 0; i < r.free.size(); ++i) {
        const auto node = static_cast<std::size_t>(r.free[i]);
        if (all.of_node[node] == bodies[b]) act(static_cast<Index>(2 * i), node);
      }
    };
    each_node([&](Index, std::size_t node) {
      mass += body.mass[node];
      center += body.mass[node] * body.mesh.coordinates[node];
    });
    center = center / mass;
    each_node([&](Index at, std::size_t node) {
      const Vec2 turn = turn90(body.mesh.coordinates[node] - center);
      motions(at, column) = motions(at + 1, column + 1) = 1.0;
      motions.col(column + 2).segment<2>(at) = Eigen::Vector2d(turn.x, turn.y);
    });
  }
  for (Index j = 0; j < motions.cols(); ++j)
    motions.col(j) /= std::sqrt(motions.col(j).cwiseAbs2().dot(r.mass));
  return motions;
}

ReducedBody reduce(const MeshBody& body, double spin) {
  ReducedBody r;
  r.spin = spin;
  r.free = fem::free_nodes(body.mesh);
  r.k = fem::free_matrix(body.stiffness, r.free);
  r.mass.resize(r.k.rows());
  for (std::size_t i = 0; i < r.free.size(); ++i)
    r.mass.segment<2>(static_cast<Index>(2 * i)).setConstant(body.mass[at(r.free[i])]);
  for (Index i = 0; i < r.k.rows(); ++i) r.k.coeffRef(i, i) -= spin * spin * r.mass[i];
  r.rigid = rigid_motions(body, r);
  return r;
}

/// J x at each node.
VectorXd turned(const VectorXd& x) {
  VectorXd y(x.size());
  for (Index a = 0; a < x.size(); a += 2) {
    y[a] = -x[a + 1];
    y[a + 1] = x[a];
  }
  return y;
}

/// T = (K + τM)⁻¹ M in the inner product of M, with μ = 1/(ω² + τ); without rigid-body motions.
Operator<double> at_rest(const ReducedBody& r, const Cholesky& factor) {
  Operator<double> op;
  op.size = r.k.rows();
  op.rank = r.k.rows() - r.rigid.cols();
  op.apply = [&r, &factor](const VectorXd& x) {
    VectorXd y = factor.solve(VectorXd(r.mass.cwiseProduct(x)));
    for (int pass = 0; pass < 2; ++pass)
      y -= r.rigid * (r.rigid.transpose() * r.mass.cwiseProduct(y)).eval();
    return y;
  };
  op.metric = [&r](const VectorXd& x) { return VectorXd(r.mass.cwiseProduct(x)); };
  return op;
}

/// T = S⁻¹ P of x = (u, u̇), P = diag(K', M), S = [0, K'; -K', -2sMJ]: skew in the inner product of
/// P, and iT has μ = 1/ω (8.3a).
Operator<double> in_spin(const ReducedBody& r, const Cholesky& factor) {
  const Index n = r.k.rows();
  Operator<double> op;
  op.size = op.rank = 2 * n;
  op.skew = true;
  op.apply = [&r, &factor, n](const VectorXd& x) {
    const VectorXd load = r.mass.cwiseProduct(x.tail(n) + 2.0 * r.spin * turned(x.head(n)));
    VectorXd y(2 * n);
    y.head(n) = -factor.solve(load);
    y.tail(n) = x.head(n);
    return y;
  };
  op.metric = [&r, n](const VectorXd& x) {
    VectorXd y(2 * n);
    y.head(n).noalias() = r.k * x.head(n);
    y.tail(n) = r.mass.cwiseProduct(x.tail(n));
    return y;
  };
  return op;
}

/// Number of roots with 0 < ω < σ: negative eigenvalues of K' - σ²M + 2iσsMJ without those of the
/// rigid-body motions. Nothing if the factorisation fails.
std::optional<int> count_below(const ReducedBody& r, double sigma) {
  SparseMatrix shifted = r.k;
  for (Index i = 0; i < shifted.rows(); ++i) shifted.coeffRef(i, i) -= sigma * sigma * r.mass[i];
  std::optional<int> found;
  if (r.spin == 0.0) {
    found = negative_eigenvalues(shifted);
  } else {
    Eigen::SparseMatrix<std::complex<double>> complex = shifted.cast<std::complex<double>>();
    for (Index i = 0; i < complex.rows(); i += 2)
      complex.coeffRef(i + 1, i) += std::complex<double>(0.0, 2.0 * sigma * r.spin * r.mass[i]);
    found = negative_eigenvalues(complex);
  }
  if (found) *found -= static_cast<int>(r.rigid.cols());
  return found;
}

/// The operator and the factor with which the eigenvalues are sought.
struct Search {
  double shift = 0.0;  ///< τ
  [[nodiscard]] double omega(double mu, bool rest) const {
    return rest ? std::sqrt(std::max(0.0, 1.0 / mu - shift)) : 1.0 / mu;
  }
  [[nodiscard]] double mu(double omega, bool rest) const {
    return rest ? 1.0 / (omega * omega + shift) : 1.0 / omega;
  }
};

/// Number of values, at least `count`, from the first one up to a gap.
Index up_to_gap(const Ritz& r, Index count) {
  while (count < r.value.size() && r.value[count] > r.value[count - 1] * (1.0 - 1e-6)) ++count;
  return count;
}

/// Finds the lowest `count` and any others equal to the last; then as many as the count of all
/// roots below that requires.
Ritz find(const ReducedBody& r, const Search& search, Krylov<double>& space, Index count,
          std::vector<double>& omegas, bool& counted) {
  const bool rest = r.spin == 0.0;
  Ritz ritz = eigenvalues_beyond(space, 0.0, count + 1, 0);
  Index n = std::min(up_to_gap(ritz, count), ritz.value.size());
  counted = false;
  if (static_cast<std::size_t>(r.k.rows()) <= most_dofs_counted && n < ritz.value.size() &&
      ritz.value[n] > 0.0) {
    const double sigma =
        0.5 * (search.omega(ritz.value[n - 1], rest) + search.omega(ritz.value[n], rest));
    if (const std::optional<int> all = count_below(r, sigma)) {
      ritz = eigenvalues_beyond(space, search.mu(sigma, rest), *all, 0);
      counted = true;
      n = *all;
    }
  }
  omegas.clear();
  for (Index i = 0; i < std::min(n, ritz.value.size()); ++i)
    if (ritz.value[i] > 0.0) omegas.push_back(search.omega(ritz.value[i], rest));
  counted = space.complete() || (counted && static_cast<Index>(omegas.size()) == n);
  return ritz;
}

Mode mode_of(const ReducedBody& r, std::span<const double> mass, const Eigen::VectorXcd& x) {
  std::vector<Vec2> real(mass.size()), imaginary(mass.size());
  for (std::size_t i = 0; i < r.free.size(); ++i) {
    const auto node = static_cast<std::size_t>(r.free[i]);
    const auto at = static_cast<Index>(2 * i);
    real[node] = {x[at].real(), x[at + 1].real()};
    imaginary[node] = {x[at].imag(), x[at + 1].imag()};
  }
  Mode mode;
  mode.real = Field(std::move(real));
  mode.imaginary = Field(std::move(imaginary));
  normalise(mode, mass);
  return mode;
}

/// Rough lower estimate of the squared lowest frequency, smaller by the ratio of element to body.
/// It is based on the softest part: with that of a steel core, the shift would be far above all
/// frequencies of rubber on it, and their μ would be too close. Rounding of the factor limits it.
double low_eigenvalue(const ReducedBody& r) {
  constexpr double rounding = 1e-13;
  const VectorXd of_node = r.k.diagonal().cwiseQuotient(r.mass);
  return std::max(of_node.minCoeff() / static_cast<double>(r.mass.size()),
                  rounding * of_node.maxCoeff());
}

}  // namespace

std::vector<int> free_bodies(const mesh::Mesh& mesh) {
  const mesh::Bodies all = mesh::find_bodies(mesh);
  std::vector<char> held(static_cast<std::size_t>(all.count), 0);
  for (const int node : mesh.clamped)
    if (const int b = all.of_node[at(node)]; b >= 0) held[at(b)] = 1;
  std::vector<int> bodies;
  for (int b = 0; b < all.count; ++b)
    if (!held[at(b)]) bodies.push_back(b);
  return bodies;
}

Modes mesh_modes(const MeshBody& body, double spin, int count) {
  const OneBlasThread one_thread;
  const ReducedBody r = reduce(body, spin);
  const bool rest = spin == 0.0;
  RONDO_DEMAND(rest || r.rigid.cols() == 0, spin, r.rigid.cols());
  RONDO_DEMAND(std::isfinite(r.k.norm()), spin);
  Search search;
  search.shift = r.rigid.cols() > 0 ? low_eigenvalue(r) : 0.0;
  SparseMatrix held = r.k;
  for (Index i = 0; i < held.rows(); ++i) held.coeffRef(i, i) += search.shift * r.mass[i];
  Cholesky factor;
  factor.setMode(Eigen::CholmodSupernodalLLt);
  factor.cholmod().print = 0;
  factor.compute(held);
  Modes out;
  if (factor.info() != Eigen::Success) {
    out.unstable = std::max(1, negative_eigenvalues(r.k).value_or(1));
    return out;
  }
  for (Index j = 0; j < r.rigid.cols(); ++j) {
    out.modes.push_back(mode_of(r, body.mass, r.rigid.col(j).cast<std::complex<double>>()));
    out.modes.back().wave = Wave::rigid;
  }
  const Operator<double> op = rest ? at_rest(r, factor) : in_spin(r, factor);
  Krylov<double> space(op);
  std::vector<double> omegas;
  const Index most = r.k.rows() - r.rigid.cols();
  const Ritz ritz = find(r, search, space, std::min<Index>(count, most), omegas, out.counted);
  for (std::size_t i = 0; i < omegas.size(); ++i) {
    const Eigen::VectorXcd x = space.vector(ritz, static_cast<Index>(i));
    // One more application of T reduces the parts of distant eigenvectors.
    const Eigen::VectorXcd better = op.apply(x.real()).cast<std::complex<double>>() +
                                    std::complex<double>(0.0, 1.0) * op.apply(x.imag());
    Mode mode = mode_of(r, body.mass, better.head(r.k.rows()));
    mode.omega = omegas[i];
    out.modes.push_back(std::move(mode));
  }
  out.dimension = static_cast<int>(space.dimension());
  return out;
}

}  // namespace rondo::modal
