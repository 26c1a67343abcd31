// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/stability/rim_step.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

double largest_eigenvalue(const Eigen::MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a, Eigen::EigenvaluesOnly);
  return std::max(0.0, solver.eigenvalues().maxCoeff());
}

/// Values of D^-½ (Gᵀ A G + springs) D^-½.
RimValues values_of(const StiffnessProduct& a_times, std::span<const Vec2> reference,
                    std::span<const int> free, const RimDofs& rim) {
  const auto rigid = [&](std::size_t dof, std::size_t node) {
    return dof == 0 ? Vec2{1.0, 0.0} : dof == 1 ? Vec2{0.0, 1.0} : turn90(reference[node]);
  };
  std::vector<Vec2> u(reference.size()), force(reference.size());
  Eigen::Matrix3d scaled = Eigen::Matrix3d::Zero();
  for (std::size_t b = 0; b < 3; ++b) {
    for (const int node : free) u[at(node)] = rigid(b, static_cast<std::size_t>(node));
    a_times(u, force);
    for (std::size_t a = 0; a < 3; ++a) {
      double sum = a == b && a < 2 ? rim.spring[a] : 0.0;
      for (const int node : free)
        sum += dot(rigid(a, static_cast<std::size_t>(node)), force[at(node)]);
      scaled(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) =
          sum / std::sqrt(rim.inertia[a]) / std::sqrt(rim.inertia[b]);
    }
  }
  scaled = (0.5 * (scaled + scaled.transpose())).eval();
  return {largest_eigenvalue(scaled.topLeftCorner<2, 2>()), std::max(0.0, scaled(2, 2)),
          largest_eigenvalue(scaled)};
}

/// Lowers the step for modes whose ω² and damping are at most the sums of body and rim.
void lower(CriticalStep& of, double body_square, double rim_square, double rim_mass,
           LaggedDamping damping) {
  damping.mass *= 1.0 + rim_mass;
  const double omega = std::sqrt(body_square + rim_square);
  of.omega = std::max(of.omega, omega);
  of.element_bound = std::max(
      {of.element_bound, of.omega, std::sqrt(of.element_bound * of.element_bound + rim_square)});
  of.step = std::min(of.step, critical_step_of(omega, damping));
}

}  // namespace

RimFrequencies rim_frequencies(const StiffnessProduct& k, std::span<const double> mass,
                               std::span<const Vec2> reference, std::span<const int> free,
                               const RimDofs& rim) {
  const auto mass_times = [&](std::span<const Vec2> u, std::span<Vec2> out) {
    for (std::size_t i = 0; i < mass.size(); ++i) out[i] = mass[i] * u[i];
  };
  RimDofs without_springs = rim;
  without_springs.spring = {};
  return {values_of(k, reference, free, rim),
          values_of(mass_times, reference, free, without_springs)};
}

CriticalStep with_rim(const CriticalStep& held, const RimFrequencies& rim, LaggedDamping damping) {
  CriticalStep step = held;
  step.step = critical_step_of(held.omega, damping);
  lower(step, held.omega * held.omega, rim.stiffness.largest, rim.mass.largest, damping);
  return step;
}

CriticalStep with_rim(const CriticalStep& held, const fem::SectorStiffness& k,
                      std::span<const double> mass, const RimFrequencies& rim,
                      LaggedDamping damping) {
  const double bound = held.element_bound * held.element_bound;
  CriticalStep step = held;
  step.step = critical_step_of(held.omega, damping);
  const auto include = [&](int harmonic, double of_rim, double of_mass) {
    if (of_mass > 0.0)
      lower(step, harmonic_eigenvalue_bound(k, mass, harmonic, bound), of_rim, of_mass, damping);
  };
  include(1, rim.stiffness.translation, rim.mass.translation);
  include(0, rim.stiffness.rotation, rim.mass.rotation);
  return step;
}

}  // namespace rondo::dynamics
