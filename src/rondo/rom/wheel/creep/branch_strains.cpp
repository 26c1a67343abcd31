// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/creep/branch_strains.hpp"

namespace rondo::rom {

using Complexes = std::complex<double>;
using Eigen::Index, Eigen::VectorXcd;

void BranchStep::add_to(Eigen::MatrixXcd& step) const {
  const double half = 0.5 * dt;
  for (std::size_t b = 0; b < branches.size(); ++b)
    step.diagonal() += (half * half * branches[b].relative_modulus * share(b)) * squares;
}

void BranchStrains::take_from(const BranchStep& step, VectorXcd& velocities) const {
  for (std::size_t b = 0; b < step.branches.size(); ++b)
    velocities -= (0.5 * step.dt * step.branches[b].relative_modulus * step.share(b)) *
                  step.squares.cwiseProduct(end.col(static_cast<Index>(b)));
}

void BranchStrains::relax(const BranchStep& step, const VectorXcd& before, const VectorXcd& state) {
  const Index r = step.squares.size();
  const double half = 0.5 * step.dt;
  for (std::size_t b = 0; b < step.branches.size(); ++b) {
    const auto column = static_cast<Index>(b);
    const Complexes share = step.share(b);
    for (Index j = 0; j < r; ++j) {
      const Complexes middle = 0.5 * (before[r + j] + state[r + j]), e = end(j, column);
      mean(j, column) = share * (half * middle + e);
      end(j, column) = 2.0 * mean(j, column) - e;
    }
  }
}

void BranchStrains::account(const BranchStep& step, const VectorXcd& before, const VectorXcd& state,
                            double n, WheelEnergy& to) const {
  for (Index j = 0, r = step.squares.size(); j < r; ++j) {
    const double square = n * step.squares[j];
    Complexes strain = 0.5 * (before[j] + state[j]);
    to.stored += 0.5 * square * std::norm(state[j]);
    for (std::size_t b = 0; b < step.branches.size(); ++b) {
      const fem::ViscousBranch& branch = step.branches[b];
      const auto column = static_cast<Index>(b);
      const double stiffness = branch.relative_modulus * square;
      const double energy = 0.5 * stiffness * std::norm(end(j, column));
      to.elastic += energy;
      to.stored += energy;
      to.viscous += step.dt / branch.time * stiffness * std::norm(mean(j, column));
      strain += branch.relative_modulus * mean(j, column);
    }
    to.internal +=
        step.dt * square * (std::conj(0.5 * (before[r + j] + state[r + j])) * strain).real();
  }
}

}  // namespace rondo::rom
