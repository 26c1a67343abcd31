// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/condensation.hpp"

#include <Eigen/CholmodSupport>
#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/process_wide.hpp"

namespace rondo::statics {

using Eigen::Index;

struct Condensation::Impl {
  Eigen::SparseMatrix<double> k;  ///< free nodes [N/m²]
  Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>, Eigen::Lower> factor;
  std::vector<int> free;         ///< (free) node
  std::size_t n_nodes = 0;       ///< of the mesh
  std::vector<Index> place;      ///< (nb) of a candidate in `free`
  std::vector<std::size_t> set;  ///< (m)
  Eigen::MatrixXd compliance;    ///< (2m, 2m) [m²/N]

  /// Row of K for the component c of the set's j-th candidate, and the sign with which H takes it.
  [[nodiscard]] Index row(std::size_t j, int c) const {
    return 2 * place[set[j]] + (c == 0 ? 1 : 0);
  }
  static double sign(int c) { return c == 0 ? 1.0 : -1.0; }

  [[nodiscard]] Eigen::VectorXd load(const Eigen::VectorXd& r) const {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(k.rows());
    for (std::size_t j = 0; j < set.size(); ++j)
      for (int c = 0; c < 2; ++c) f[row(j, c)] += sign(c) * r[static_cast<Index>(2 * j) + c];
    return f;
  }

  /// (n) 0 on the others.
  [[nodiscard]] std::vector<Vec2> of_nodes(const Eigen::VectorXd& u) const {
    std::vector<Vec2> field(n_nodes);
    for (std::size_t i = 0; i < free.size(); ++i) {
      const auto row = static_cast<Index>(2 * i);
      field[at(free[i])] = {u[row], u[row + 1]};
    }
    return field;
  }

  /// Columns of G for the candidates [begin, end) of the set, all rows.
  [[nodiscard]] Eigen::MatrixXd columns(std::size_t begin, std::size_t end) const {
    const auto width = static_cast<Index>(2 * (end - begin));
    Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(k.rows(), width);
    for (Index i = 0; i < width; ++i) {
      const int c = static_cast<int>(i % 2);
      loads(row(begin + static_cast<std::size_t>(i / 2), c), i) = sign(c);
    }
    const OneBlasThread one_thread;
    const Eigen::MatrixXd u = factor.solve(loads);
    Eigen::MatrixXd g(static_cast<Index>(2 * set.size()), width);
    for (std::size_t j = 0; j < set.size(); ++j)
      for (int c = 0; c < 2; ++c) g.row(static_cast<Index>(2 * j) + c) = sign(c) * u.row(row(j, c));
    return g;
  }
};

Condensation::Condensation(const fem::BlockCsr& k, std::span<const int> free,
                           std::span<const int> nodes)
    : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  m.k = fem::free_matrix(k, free);
  m.free.assign(free.begin(), free.end());
  m.n_nodes = k.n_rows();
  for (const int node : nodes) {
    const auto found = std::lower_bound(free.begin(), free.end(), node);
    RONDO_DEMAND(found != free.end() && *found == node, node);
    m.place.push_back(found - free.begin());
  }
  m.factor.setMode(Eigen::CholmodSupernodalLLt);
  m.factor.cholmod().print = 0;  // "not positive definite" is an answer here, not a message
  const OneBlasThread one_thread;
  m.factor.compute(m.k);
}

Condensation::~Condensation() = default;

bool Condensation::factorised() const noexcept {
  return impl_->factor.info() == Eigen::Success;
}

void Condensation::append(std::span<const std::size_t> candidates) {
  Impl& m = *impl_;
  const std::size_t before = m.set.size();
  m.set.insert(m.set.end(), candidates.begin(), candidates.end());
  const auto size = static_cast<Index>(2 * m.set.size());
  m.compliance.conservativeResize(size, size);
  constexpr std::size_t batch = 16;  // candidates at once: fields of the whole body in memory
  for (std::size_t begin = before; begin < m.set.size(); begin += batch) {
    const std::size_t end = std::min(begin + batch, m.set.size());
    m.compliance.middleCols(static_cast<Index>(2 * begin), static_cast<Index>(2 * (end - begin))) =
        m.columns(begin, end);
  }
  // The new columns hold the old rows too; symmetric to the last bit.
  const auto old = static_cast<Index>(2 * before);
  m.compliance.bottomLeftCorner(size - old, old) =
      m.compliance.topRightCorner(old, size - old).transpose();
  const Eigen::MatrixXd added = m.compliance.bottomRightCorner(size - old, size - old);
  m.compliance.bottomRightCorner(size - old, size - old) = 0.5 * (added + added.transpose());
}

void Condensation::clear() {
  impl_->set.clear();
  impl_->compliance.resize(0, 0);
}

std::size_t Condensation::n_nodes() const noexcept {
  return impl_->n_nodes;
}

const std::vector<std::size_t>& Condensation::set() const noexcept {
  return impl_->set;
}

std::vector<std::size_t> Condensation::outside() const {
  std::vector<char> inside(impl_->place.size(), 0);
  for (const std::size_t k : impl_->set) inside[k] = 1;
  std::vector<std::size_t> rest;
  for (std::size_t k = 0; k < inside.size(); ++k)
    if (!inside[k]) rest.push_back(k);
  return rest;
}

const Eigen::MatrixXd& Condensation::compliance() const noexcept {
  return impl_->compliance;
}

CondensedField Condensation::field(const Eigen::VectorXd& r) const {
  const Impl& m = *impl_;
  const Eigen::VectorXd load = m.load(r);
  const OneBlasThread one_thread;
  Eigen::VectorXd u = m.factor.solve(load);
  u += m.factor.solve(load - m.k * u);  // one refinement: round-off of the solve, not of the factor
  const Eigen::VectorXd force = m.k * u;
  CondensedField out;
  out.u = m.of_nodes(u);
  out.strain = 0.5 * u.dot(force);
  out.residual = load.norm() > 0.0 ? (force - load).norm() / load.norm() : 0.0;
  return out;
}

std::vector<Vec2> Condensation::displacement(std::span<const Vec2> force) const {
  const Impl& m = *impl_;
  Eigen::VectorXd f(m.k.rows());
  for (std::size_t i = 0; i < m.free.size(); ++i) {
    const Vec2 of_node = force[at(m.free[i])];
    f.segment<2>(static_cast<Index>(2 * i)) << of_node.x, of_node.y;
  }
  const OneBlasThread one_thread;
  Eigen::VectorXd u = m.factor.solve(f);
  u += m.factor.solve(f - m.k * u);
  return m.of_nodes(u);
}

}  // namespace rondo::statics
