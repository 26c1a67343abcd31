// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/stability/rim_step.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

namespace rondo::dynamics {
namespace {

/// D^-½ (Gᵀ K G + springs) D^-½, D the inertia; 0 where held [1/s²].
Eigen::Matrix3d scaled_stiffness(const StiffnessProduct& k, std::span<const Vec2> reference,
                                 std::span<const int> free, const RimDofs& rim) {
  const auto rigid = [&](std::size_t dof, std::size_t node) {
    return dof == 0 ? Vec2{1.0, 0.0} : dof == 1 ? Vec2{0.0, 1.0} : turn90(reference[node]);
  };
  std::vector<Vec2> u(reference.size()), force(reference.size());
  Eigen::Matrix3d scaled = Eigen::Matrix3d::Zero();
  for (std::size_t b = 0; b < 3; ++b) {
    for (const int node : free)
      u[static_cast<std::size_t>(node)] = rigid(b, static_cast<std::size_t>(node));
    k(u, force);
    for (std::size_t a = 0; a < 3; ++a) {
      double sum = a == b && a < 2 ? rim.spring[a] : 0.0;
      for (const int node : free)
        sum += dot(rigid(a, static_cast<std::size_t>(node)), force[static_cast<std::size_t>(node)]);
      scaled(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) =
          sum / std::sqrt(rim.inertia[a]) / std::sqrt(rim.inertia[b]);
    }
  }
  return 0.5 * (scaled + scaled.transpose());
}

double largest_eigenvalue(const Eigen::MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a, Eigen::EigenvaluesOnly);
  return std::max(0.0, solver.eigenvalues().maxCoeff());
}

/// @param squared ω̂²; `beside` what the element bound of ω² grows by [1/s²]
CriticalStep raised(CriticalStep of, double squared, double beside, LaggedDamping damping) {
  of.omega = std::max(of.omega, std::sqrt(squared));
  of.element_bound = std::max(of.omega, std::sqrt(of.element_bound * of.element_bound + beside));
  of.step = critical_step_of(of.omega, damping);
  return of;
}

}  // namespace

RimFrequencies rim_frequencies(const StiffnessProduct& k, std::span<const Vec2> reference,
                               std::span<const int> free, const RimDofs& rim) {
  const Eigen::Matrix3d scaled = scaled_stiffness(k, reference, free, rim);
  return {largest_eigenvalue(scaled.topLeftCorner<2, 2>()), std::max(0.0, scaled(2, 2)),
          largest_eigenvalue(scaled)};
}

CriticalStep with_rim(const CriticalStep& held, const RimFrequencies& rim, LaggedDamping damping) {
  return raised(held, held.omega * held.omega + rim.largest, rim.largest, damping);
}

CriticalStep with_rim(const CriticalStep& held, const fem::SectorStiffness& k,
                      std::span<const double> mass, const RimFrequencies& rim,
                      LaggedDamping damping) {
  const double bound = held.element_bound * held.element_bound;
  double squared = 0.0;
  const auto include = [&](int harmonic, double of_rim) {
    if (of_rim > 0.0)
      squared = std::max(squared, harmonic_eigenvalue_bound(k, mass, harmonic, bound) + of_rim);
  };
  include(1, rim.translation);
  include(0, rim.rotation);
  return raised(held, squared, std::max(rim.translation, rim.rotation), damping);
}

}  // namespace rondo::dynamics
