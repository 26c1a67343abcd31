// SPDX-License-Identifier: BSD-3-Clause
/// @file  A standing wheel under a load: its state by statics, and its small motions about that
/// state while the touching nodes stick.
#pragma once
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <vector>

#include "rondo/fem/stiffness_product.hpp"
#include "rondo/statics/crush.hpp"
#include "support/models.hpp"

namespace rondo::test {

struct LoadedWheel {
  double height = 0.0;        ///< of the center                                    [m]
  std::vector<Vec2> u;        ///< (n) fixed axes                                   [m]
  std::vector<int> touching;  ///< nodes
};

/// Presses the wheel down by `load` [N/m], finding the depth by secants. @param sunk depth of the
/// ground under each candidate; empty: it is flat [m]
inline LoadedWheel load_wheel(const Built& b, double load, double friction,
                              const std::vector<double>& sunk = {}) {
  auto model = statics::make_crush_model(b.mesh.coordinates, b.mesh.boundary, friction);
  for (std::size_t k = 0; k < sunk.size(); ++k) model.clearance[k] += sunk[k];
  statics::Condensation body(b.model.stiffness, b.model.free, model.nodes);
  statics::CrushState state;
  const auto force_at = [&](double depth) {
    statics::append_within(model, 2.0 * depth, body);
    state = statics::start_crush(model, b.model.n_nodes());
    EXPECT_TRUE(statics::bring_to(model, depth, 0.0, body, state).converged);
    double sum = 0.0;
    for (const Vec2 r : state.force) sum += r.x;
    return sum;
  };
  double before = 5e-3, depth = 6e-3, force_before = force_at(before), force = force_at(depth);
  for (int i = 0; i < 20 && std::abs(force - load) > 1e-11 * load; ++i) {
    const double next = depth + (load - force) * (depth - before) / (force - force_before);
    before = depth;
    force_before = force;
    depth = next;
    force = force_at(depth);
  }
  EXPECT_NEAR(force, load, 1e-10 * load);
  LoadedWheel found{0.0, state.u, {}};
  double lowest = 0.0;
  for (std::size_t k = 0; k < model.nodes.size(); ++k) {
    lowest = std::min(lowest, b.mesh.coordinates[static_cast<std::size_t>(model.nodes[k])].y);
    if (state.force[k].x > 0.0) found.touching.push_back(model.nodes[k]);
  }
  found.height = -lowest - depth;
  return found;
}

/// Small motions of the positions z of free nodes and of x, y, θ of the rim, with the kinetic
/// energy ½ Σ m ż² + ½ M ċ² + ½ I θ̇² (docs/theory.md, 10).
class WheelModes {
 public:
  struct Mode {
    double omega = 0.0;          ///< [rad/s]
    Eigen::VectorXd mass_times;  ///< M φ of (z, x, y, θ), φᵀ M φ = 1
  };

  /// The `count` lowest modes about `at`, where the wheel is in equilibrium.
  static std::vector<Mode> lowest(const Built& b, const LoadedWheel& at, int count) {
    const WheelModes system(b, at);
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(system.stiffness_);
    EXPECT_EQ(factor.info(), Eigen::Success);
    Eigen::MatrixXd v = Eigen::MatrixXd::Random(system.mass_.size(), 2 * count);
    Eigen::VectorXd squares;
    for (int i = 0; i < 60; ++i) {  // subspace iteration with inverse and Rayleigh-Ritz
      v = factor.solve(system.mass_.asDiagonal() * v).eval();
      const Eigen::MatrixXd k = v.transpose() * (system.stiffness_ * v);
      const Eigen::MatrixXd m = v.transpose() * (system.mass_.asDiagonal() * v);
      const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ritz(k, m);
      v = (v * ritz.eigenvectors()).eval();
      squares = ritz.eigenvalues();
    }
    std::vector<Mode> modes;
    for (int i = 0; i < count; ++i)
      modes.push_back({std::sqrt(squares[i]), system.mass_.asDiagonal() * v.col(i)});
    return modes;
  }

  /// φᵀ M (z - X - u_0, c - c_0, θ)
  static double coordinate(const Mode& mode, const Built& b, const LoadedWheel& at,
                           const dynamics::State& state) {
    const dynamics::FrameStep& f = state.frame;
    const Vec2 c = f.center.plane() - Vec2{0.0, at.height};
    const Eigen::Index n = mode.mass_times.size() - 3;
    double sum =
        mode.mass_times[n] * c.x + mode.mass_times[n + 1] * c.y + mode.mass_times[n + 2] * f.angle;
    for (Eigen::Index i = 0; i < n / 2; ++i) {
      const auto k = static_cast<std::size_t>(b.model.free[static_cast<std::size_t>(i)]);
      const Vec2 z = c + f.rotation * (b.model.reference[k] + state.u.plane()[k]) -
                     (b.model.reference[k] + at.u[k]);
      sum += mode.mass_times[2 * i] * z.x + mode.mass_times[2 * i + 1] * z.y;
    }
    return sum;
  }

 private:
  /// ½ uᵀKu to second order in z - z_0, c - c_0 and θ: with p = K u_0, the forces of the ground, δu
  /// = δz - δc - θ J y_0, and the additional term -p·[θ J (δz - δc) + ½ θ² y_0].
  WheelModes(const Built& b, const LoadedWheel& at) {
    const auto n = static_cast<Eigen::Index>(2 * b.model.free.size());
    std::vector<Vec2> p(b.model.n_nodes());
    fem::apply(b.model.stiffness, at.u, p, 1);
    std::vector<bool> sticks(b.model.n_nodes());
    for (const int node : at.touching) sticks[static_cast<std::size_t>(node)] = true;
    std::vector<Eigen::Triplet<double>> entries;
    mass_.resize(n + 3);
    Vec2 pull;
    double bend = 0.0;
    for (Eigen::Index i = 0; i < n / 2; ++i) {
      const auto k = static_cast<std::size_t>(b.model.free[static_cast<std::size_t>(i)]);
      const Vec2 y = b.model.reference[k] + at.u[k];
      for (Eigen::Index a = 0; a < 2; ++a) {
        mass_[2 * i + a] = b.model.mass[k];
        if (!sticks[k]) entries.emplace_back(2 * i + a, 2 * i + a, 1.0);
        entries.emplace_back(2 * i + a, n + a, -1.0);
      }
      entries.emplace_back(2 * i, n + 2, y.y);
      entries.emplace_back(2 * i + 1, n + 2, -y.x);
      pull += p[k];
      bend += dot(p[k], y);
    }
    Eigen::SparseMatrix<double> strain(n, n + 3);
    strain.setFromTriplets(entries.begin(), entries.end());
    entries.clear();
    entries.emplace_back(n, n + 2, pull.y);
    entries.emplace_back(n + 2, n, pull.y);
    entries.emplace_back(n + 1, n + 2, -pull.x);
    entries.emplace_back(n + 2, n + 1, -pull.x);
    entries.emplace_back(n + 2, n + 2, -bend);
    hold(b, at, entries);
    Eigen::SparseMatrix<double> prestress(n + 3, n + 3);
    prestress.setFromTriplets(entries.begin(), entries.end());
    stiffness_ = strain.transpose() * fem::free_matrix(b.model.stiffness, b.model.free) * strain;
    stiffness_ += prestress;
    mass_[n] = mass_[n + 1] = b.model.rim->mass;
    mass_[n + 2] = b.model.rim->inertia;
  }

  /// Sticking nodes are fixed: their coordinates are separate unknowns without mass.
  void hold(const Built& b, const LoadedWheel& at, std::vector<Eigen::Triplet<double>>& entries) {
    for (const int node : at.touching) {
      const auto place = std::lower_bound(b.model.free.begin(), b.model.free.end(), node);
      const Eigen::Index i = place - b.model.free.begin();
      for (Eigen::Index a = 0; a < 2; ++a) {
        entries.emplace_back(2 * i + a, 2 * i + a, 1e12);
        mass_[2 * i + a] = 0.0;
      }
    }
  }

  Eigen::SparseMatrix<double> stiffness_;
  Eigen::VectorXd mass_;
};

}  // namespace rondo::test
