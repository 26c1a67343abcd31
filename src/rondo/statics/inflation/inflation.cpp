// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/inflation/inflation.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::statics {
namespace {

using Eigen::Index;
using fem::finite::SectorEnergy;
using fem::finite::SectorLoads;
using fem::finite::SectorState;
using Sparse = Eigen::SparseMatrix<double>;

constexpr int most_turns = 30;
constexpr int most_halvings = 10;
constexpr double least_pivot = 1e-12;  ///< of a stable harmonic, over the largest
constexpr double round_off = 1e-14;
constexpr double solved = 1e-10;  ///< residual over the largest reaction or load

/// (3n) Numbers of the free displacements among all free ones; -1: it is given.
std::vector<Index> free_rows(const SectorEnergy& wheel) {
  std::vector<Index> rows;
  Index n = 0;
  for (const char held : wheel.section().held) rows.push_back(held ? -1 : n++);
  return rows;
}

template <class Scalar>
struct Part {
  const Sparse& block;
  Scalar weight;
  bool transposed = false;
};
/// Sum of weight · block over the free rows and columns.
template <class Scalar>
Eigen::SparseMatrix<Scalar> gather(std::initializer_list<Part<Scalar>> parts,
                                   const Eigen::VectorXd& diagonal,
                                   const std::vector<Index>& rows) {
  std::vector<Eigen::Triplet<Scalar>> entries;
  Index size = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] < 0) continue;
    size = rows[i] + 1;
    entries.emplace_back(static_cast<int>(rows[i]), static_cast<int>(rows[i]),
                         diagonal[static_cast<Index>(i)]);
  }
  for (const Part<Scalar>& part : parts)
    for (Index j = 0; j < part.block.outerSize(); ++j)
      for (Sparse::InnerIterator it(part.block, j); it; ++it) {
        const Index row = rows[at(part.transposed ? it.col() : it.row())],
                    column = rows[at(part.transposed ? it.row() : it.col())];
        if (row >= 0 && column >= 0)
          entries.emplace_back(static_cast<int>(row), static_cast<int>(column),
                               part.weight * it.value());
      }
  Eigen::SparseMatrix<Scalar> k(size, size);
  k.setFromTriplets(entries.begin(), entries.end());
  return k;
}

/// (3n) -s² m across the axle, 0 along it.
Eigen::VectorXd softening(const SectorEnergy& wheel, double spin_squared) {
  Eigen::VectorXd d = Eigen::VectorXd::Zero(static_cast<Index>(3 * wheel.n_nodes()));
  for (std::size_t a = 0; a < wheel.n_nodes(); ++a)
    d.segment<2>(static_cast<Index>(3 * a)).setConstant(-spin_squared * wheel.mass()[a]);
  return d;
}

Sparse tangent(const SectorEnergy& wheel, const SectorState& state, double spin_squared,
               const std::vector<Index>& rows) {
  return gather<double>({{state.here, 1.0}, {state.next, 1.0}, {state.next, 1.0, true}},
                        softening(wheel, spin_squared), rows);
}

}  // namespace

/// Newton's method at one share of the loads, from the equilibrium at another.
class InflationSteps::Step {
 public:
  Step(const SectorEnergy& wheel, const InflationLoads& loads)
      : wheel_(wheel), loads_(loads), rows_(free_rows(wheel)) {}

  /// Number of turns; 0: it did not converge.
  int go_to(double share, Inflation& out) {
    out.inverted.reset();
    const SectorLoads now{share * loads_.sector.pressure, share * loads_.sector.spin_squared};
    std::vector<Vec3> u = out.u;
    SectorState state = wheel_.state(u, now);
    Eigen::VectorXd given = mounted(share, u);  // and the others go as the tangent says
    for (int turn = 1; turn <= most_turns; ++turn) {
      if (!move(state, now.spin_squared, given, u)) return 0;
      given.setZero();
      state = wheel_.state(u, now);
      if (!(state.least > 0.0)) {
        out.inverted = state.of_quad;
        return 0;
      }
      if (!state.force.allFinite()) return 0;
      const double residual = lack(state);
      if (!(residual <= solved)) continue;
      out.u = std::move(u);
      out.state = std::move(state);
      out.residual = residual;
      return turn;
    }
    return 0;
  }

 private:
  /// (3n) What is left of the ways of held nodes to their places.
  Eigen::VectorXd mounted(double share, std::span<const Vec3> u) const {
    Eigen::VectorXd given = Eigen::VectorXd::Zero(static_cast<Index>(3 * u.size()));
    for (std::size_t a = 0; a < u.size() && !loads_.mounting.empty(); ++a) {
      const Vec3 step = share * loads_.mounting[a] - u[a];
      given.segment<3>(static_cast<Index>(3 * a)) << step.x, step.y, step.z;
    }
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (rows_[i] >= 0) given[static_cast<Index>(i)] = 0.0;
    return given;
  }
  bool move(const SectorState& state, double spin_squared, const Eigen::VectorXd& given,
            std::vector<Vec3>& u) {
    Eigen::VectorXd pull =
        state.force + state.here * given + state.next * given + state.next.transpose() * given;
    Eigen::VectorXd right(rows_.empty() ? 0 : *std::ranges::max_element(rows_) + 1);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (rows_[i] >= 0) right[rows_[i]] = -pull[static_cast<Index>(i)];
    const Sparse k = tangent(wheel_, state, spin_squared, rows_);
    if (!analysed_) factor_.analyzePattern(k);
    analysed_ = true;
    factor_.factorize(k);
    if (factor_.info() != Eigen::Success) return false;
    const Eigen::VectorXd step = factor_.solve(right);
    if (!step.allFinite()) return false;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double by = rows_[i] >= 0 ? step[rows_[i]] : given[static_cast<Index>(i)];
      Vec3& to = u[i / 3];
      (i % 3 == 0 ? to.x : i % 3 == 1 ? to.y : to.z) += by;
    }
    return true;
  }
  /// Largest force at a free node over the largest reaction or load.
  double lack(const SectorState& state) const {
    double worst = 0.0, largest = state.load;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      double& most = rows_[i] >= 0 ? worst : largest;
      most = std::max(most, std::abs(state.force[static_cast<Index>(i)]));
    }
    // Without loads there is but the round-off of forces.
    const double noise =
        round_off * state.here.diagonal().cwiseAbs().maxCoeff() * wheel_.section().place[0].x;
    return worst <= noise ? 0.0 : worst / largest;
  }

  const SectorEnergy& wheel_;
  const InflationLoads& loads_;
  std::vector<Index> rows_;
  Eigen::SimplicialLDLT<Sparse> factor_;
  bool analysed_ = false;
};

InflationSteps::InflationSteps(const SectorEnergy& wheel, const InflationLoads& loads)
    : step_(std::make_unique<Step>(wheel, loads)), parts_(loads.steps), size_(1.0 / loads.steps) {
  RONDO_DEMAND(
      loads.steps >= 1 && (loads.mounting.empty() || loads.mounting.size() == wheel.n_nodes()),
      loads.steps, loads.mounting.size());
  now_.u.resize(wheel.n_nodes());
}
InflationSteps::~InflationSteps() = default;

bool InflationSteps::advance() {
  RONDO_DEMAND(!now_.found, now_.share);
  constexpr double same = 1e-9;
  const double part = std::floor(now_.share * parts_ + same) + 1.0;  // the next whole one
  for (; halvings_ <= most_halvings; size_ *= 0.5, ++halvings_) {
    const bool whole = now_.share + size_ > part / parts_ - same;
    const double to = whole ? part / parts_ : now_.share + size_;
    const int turns = step_->go_to(to, now_);
    if (turns == 0) continue;
    now_.share = to;
    now_.turns.push_back(turns);
    now_.found = whole && part >= parts_;
    size_ = std::min(2.0 * size_, 1.0 / parts_);
    return true;
  }
  return false;
}

Inflation inflate(const SectorEnergy& wheel, const InflationLoads& loads) {
  InflationSteps steps(wheel, loads);
  while (!steps.now().found && steps.advance()) {
  }
  return steps.now();
}

std::optional<int> unstable_harmonic(const SectorEnergy& wheel, const SectorState& state,
                                     double spin_squared, int most) {
  using Complexes = std::complex<double>;
  RONDO_DEMAND(state.here.rows() == static_cast<Index>(3 * wheel.n_nodes()) && state.least > 0.0,
               state.here.rows(), state.least);
  const std::vector<Index> rows = free_rows(wheel);
  const Eigen::VectorXd softer = softening(wheel, spin_squared);
  const int n = wheel.section().n_sectors;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<Complexes>> factor;
  for (int k = 0; k <= (most < 0 ? n / 2 : most); ++k) {
    const double angle = 2.0 * std::numbers::pi * k / n;
    const Complexes wave(std::cos(angle), std::sin(angle));
    const auto matrix = gather<Complexes>(
        {{state.here, 1.0}, {state.next, wave}, {state.next, std::conj(wave), true}}, softer, rows);
    if (k == 0) factor.analyzePattern(matrix);
    factor.factorize(matrix);
    if (factor.info() != Eigen::Success) return k;
    const Eigen::VectorXd pivots = factor.vectorD().real();
    if (!(pivots.minCoeff() > least_pivot * pivots.maxCoeff())) return k;
  }
  return std::nullopt;
}

}  // namespace rondo::statics
