// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/modal/held_modes.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/core/dense.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/fem/harmonics.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/modal/inertia.hpp"
#include "rondo/modal/krylov.hpp"
#include "rondo/modal/shapes.hpp"

namespace rondo::modal {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Factor = Eigen::SimplicialLDLT<fem::Harmonics::Matrix, Eigen::Lower>;

/// (A - σ²)⁻¹ on vectors of all nodes in polar components, a column a sector.
class CyclicInverse {
 public:
  CyclicInverse(fem::Harmonics& harmonics, int n_sectors, double sigma)
      : sectors_(n_sectors), waves_(n_sectors, harmonics.count()) {
    for (Index j = 0; j < waves_.rows(); ++j)
      for (Index k = 0; k < waves_.cols(); ++k)
        waves_(j, k) =
            std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(j * k % sectors_) /
                                static_cast<double>(sectors_));
    for (int k = 0; k < harmonics.count(); ++k)
      factors_.push_back(std::make_unique<Factor>(harmonics.lower(k, 1.0, -sigma * sigma)));
  }

  /// False: a pivot was zero.
  [[nodiscard]] bool found() const {
    return std::ranges::all_of(factors_, [](const auto& f) { return f->info() == Eigen::Success; });
  }
  /// Number of negative eigenvalues of A - σ².
  [[nodiscard]] int negative() const {
    int sum = 0;
    for (Index k = 0; k < waves_.cols(); ++k) {
      const auto pivots = factors_[static_cast<std::size_t>(k)]->vectorD();
      const auto below = static_cast<int>((pivots.real().array() < 0.0).count());
      sum += is_pair(k) ? 2 * below : below;
    }
    return sum;
  }
  /// @param x (D n_local · N) sector after sector
  [[nodiscard]] VectorXd solve(const VectorXd& x) const {
    const Index rows = x.size() / sectors_;
    MatrixXcd spectrum = Eigen::Map<const MatrixXd>(x.data(), rows, sectors_) * waves_;
    for (Index k = 0; k < waves_.cols(); ++k) {
      spectrum.col(k) = factors_[static_cast<std::size_t>(k)]->solve(spectrum.col(k)).eval();
      spectrum.col(k) *= (is_pair(k) ? 2.0 : 1.0) / static_cast<double>(sectors_);
    }
    VectorXd y(x.size());
    Eigen::Map<MatrixXd>(y.data(), rows, sectors_) = (spectrum * waves_.adjoint()).real();
    return y;
  }

 private:
  /// Harmonic N - k is the conjugate.
  [[nodiscard]] bool is_pair(Index k) const { return k > 0 && 2 * k < sectors_; }

  Index sectors_;
  MatrixXcd waves_;  ///< (N, N/2 + 1) e^{-i 2π jk/N}
  std::vector<std::unique_ptr<Factor>> factors_;
};

template <int D>
class HeldProblem {
 public:
  HeldProblem(const CyclicBody<D>& body, std::span<const HeldDirection<D>> held)
      : body_(body), harmonics_(body.stiffness, body.mass), elastic_(harmonics_, sectors(), 0.0) {
    place_of_.assign(body.mass.size(), -1);
    for (std::size_t j = 0; j < body.stiffness.turn.size(); ++j)
      for (std::size_t a = 0; a < body.stiffness.n_local(); ++a)
        place_of_[body.stiffness.node(a, j)] =
            static_cast<Index>(D * (j * body.stiffness.n_local() + a));
    for (const HeldDirection<D>& h : held) rows_.push_back(row_of(h));
    factor_.compute(compliance(elastic_, &columns_));
  }

  [[nodiscard]] bool found() const {
    return elastic_.found() && (rows_.empty() || factor_.info() == Eigen::Success);
  }
  [[nodiscard]] Index size() const {
    return static_cast<Index>(D * body_.stiffness.n_local()) * sectors();
  }
  [[nodiscard]] VectorXd apply(const VectorXd& x) const {
    VectorXd y = elastic_.solve(x);
    if (!rows_.empty()) y -= columns_ * factor_.solve(along(y)).eval();
    return y;
  }
  /// (8.8), which the problem must outlive.
  [[nodiscard]] Operator<double> inverse() const {
    Operator<double> op;
    op.size = size();
    op.rank = op.size - static_cast<Index>(rows_.size());
    op.apply = [this](const VectorXd& x) { return apply(x); };
    op.metric = [](const VectorXd& x) { return x; };
    return op;
  }
  /// Nothing: a pivot was zero.
  [[nodiscard]] std::optional<int> count_below(double sigma) {
    const CyclicInverse inverse(harmonics_, sectors(), sigma);
    if (!inverse.found()) return std::nullopt;
    if (rows_.empty()) return inverse.negative();
    const VectorXd values = eigenvalues_of(compliance(inverse, nullptr));
    return inverse.negative() - static_cast<int>((values.array() < 0.0).count());
  }
  /// φ = M^-½ w in the axes of X.
  [[nodiscard]] Mode mode_of(const VectorXd& w, double omega) const {
    using Vec = std::conditional_t<D == 2, Vec2, Vec3>;
    std::vector<Vec> shape(body_.mass.size());
    for (std::size_t j = 0; j < body_.stiffness.turn.size(); ++j)
      for (std::size_t a = 0; a < body_.stiffness.n_local(); ++a) {
        const std::size_t node = body_.stiffness.node(a, j);
        const auto of = w.segment<D>(place_of_[node]) / std::sqrt(body_.mass[node]);
        if constexpr (D == 2)
          shape[node] = body_.stiffness.turn[j] * Vec2{of[0], of[1]};
        else
          shape[node] = body_.stiffness.turn[j] * Vec3{of[0], of[1], of[2]};
      }
    Mode mode;
    mode.omega = omega;
    mode.real = Field(std::move(shape));
    mode.imaginary = Field(body_.mass.size(), D);
    normalise(mode, body_.mass);
    return mode;
  }

 private:
  /// H of a held direction: where it is in a vector, and its polar components over √m.
  struct Row {
    Index place;
    Eigen::Matrix<double, D, 1> of;
  };
  [[nodiscard]] int sectors() const { return body_.stiffness.n_sectors; }
  [[nodiscard]] Row row_of(const HeldDirection<D>& h) const {
    const Index place = place_of_[h.node];
    RONDO_DEMAND(place >= 0, h.node);
    const auto sector = static_cast<std::size_t>(place) / (D * body_.stiffness.n_local());
    const auto polar = conj(body_.stiffness.turn[sector]) * h.direction;
    Row row{place, {}};
    row.of[0] = polar.x;
    row.of[1] = polar.y;
    if constexpr (D == 3) row.of[2] = polar.z;
    row.of /= std::sqrt(body_.mass[h.node]);
    return row;
  }
  /// H y
  [[nodiscard]] VectorXd along(const VectorXd& y) const {
    VectorXd out(static_cast<Index>(rows_.size()));
    for (std::size_t i = 0; i < rows_.size(); ++i)
      out[static_cast<Index>(i)] = rows_[i].of.dot(y.segment<D>(rows_[i].place));
    return out;
  }
  /// H X⁻¹ Hᵀ. @param columns X⁻¹ Hᵀ
  [[nodiscard]] MatrixXd compliance(const CyclicInverse& inverse, MatrixXd* columns) const {
    const auto n = static_cast<Index>(rows_.size());
    MatrixXd sum(n, n);
    if (columns) columns->resize(size(), n);
    for (Index i = 0; i < n; ++i) {
      VectorXd load = VectorXd::Zero(size());
      load.segment<D>(rows_[static_cast<std::size_t>(i)].place) =
          rows_[static_cast<std::size_t>(i)].of;
      const VectorXd moved = inverse.solve(load);
      sum.col(i) = along(moved);
      if (columns) columns->col(i) = moved;
    }
    return 0.5 * (sum + sum.transpose());
  }

  const CyclicBody<D>& body_;
  fem::Harmonics harmonics_;
  CyclicInverse elastic_;
  std::vector<Index> place_of_;  ///< (n) of a node's unknowns in a vector; -1: clamped
  std::vector<Row> rows_;
  MatrixXd columns_;  ///< A⁻¹ Hᵀ
  Eigen::LLT<MatrixXd> factor_;
};

/// The frequencies of the lowest `count` modes and of all others as low, and whether a count has
/// shown that none is missing.
template <int D>
Ritz find(HeldProblem<D>& problem, Krylov<double>& space, Index count, Modes& out, Index& n) {
  Ritz ritz = eigenvalues_beyond(space, 0.0, count + 1, 0);
  n = std::min(count, ritz.value.size());
  while (n < ritz.value.size() && ritz.value[n] > ritz.value[n - 1] * (1.0 - 1e-6)) ++n;
  if (n == 0 || n >= ritz.value.size() || !(ritz.value[n] > 0.0)) return ritz;
  const double sigma = 0.5 * (1.0 / std::sqrt(ritz.value[n - 1]) + 1.0 / std::sqrt(ritz.value[n]));
  const std::optional<int> all = problem.count_below(sigma);
  if (!all) return ritz;
  ritz = eigenvalues_beyond(space, 1.0 / (sigma * sigma), *all, 0);
  n = std::min<Index>(*all, ritz.value.size());
  out.counted = n == *all;
  return ritz;
}

}  // namespace

template <int D>
Modes held_modes(const CyclicBody<D>& body, std::span<const HeldDirection<D>> held, int count) {
  RONDO_DEMAND(!body.free() && count >= 1, count);
  const OneBlasThread one_thread;
  Modes out;
  HeldProblem<D> problem(body, held);
  if (!problem.found()) {
    out.unstable = 1;
    return out;
  }
  const Operator<double> op = problem.inverse();
  Krylov<double> space(op);
  Index n = 0;
  const Ritz ritz = find(problem, space, std::min<Index>(count, op.rank), out, n);
  for (Index i = 0; i < n; ++i) {
    const VectorXd better = op.apply(space.vector(ritz, i).real());
    out.modes.push_back(problem.mode_of(better, 1.0 / std::sqrt(ritz.value[i])));
  }
  out.dimension = static_cast<int>(space.dimension());
  return out;
}

template <int D>
double residual(const CyclicBody<D>& body, std::span<const HeldDirection<D>> held,
                const Mode& mode) {
  using Vec = std::conditional_t<D == 2, Vec2, Vec3>;
  const std::span<const Vec> shape = mode.real;
  std::vector<Vec> elastic(shape.size());
  fem::apply(body.stiffness, shape, elastic);
  std::vector<Vec> rest = elastic;
  double largest = 0.0, moved = 0.0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    rest[i] -= mode.omega * mode.omega * body.mass[i] * shape[i];
    if (elastic[i] == Vec{}) rest[i] = {};  // clamped
    largest = std::max(largest, norm(shape[i]));
  }
  for (const HeldDirection<D>& h : held) {
    moved = std::max(moved, std::abs(dot(h.direction, shape[h.node])));
    for (std::vector<Vec>* f : {&elastic, &rest})
      (*f)[h.node] -= dot(h.direction, (*f)[h.node]) * h.direction;
  }
  double left = 0.0, size = 0.0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    left += dot(rest[i], rest[i]);
    size += dot(elastic[i], elastic[i]);
  }
  return std::max(std::sqrt(left / size), moved / largest);
}

template Modes held_modes(const CyclicBody<2>&, std::span<const HeldDirection<2>>, int);
template Modes held_modes(const CyclicBody<3>&, std::span<const HeldDirection<3>>, int);
template double residual(const CyclicBody<2>&, std::span<const HeldDirection<2>>, const Mode&);
template double residual(const CyclicBody<3>&, std::span<const HeldDirection<3>>, const Mode&);

}  // namespace rondo::modal
