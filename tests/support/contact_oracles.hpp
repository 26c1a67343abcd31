// SPDX-License-Identifier: BSD-3-Clause
/// @file  Reference for tests of coupled contacts: enumeration of all statuses.
#pragma once
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "rondo/contact/coupled/coupled_residual.hpp"
#include "rondo/contact/residual.hpp"
#include "support/contact_problems.hpp"

namespace rondo::test {

struct Solved {
  std::vector<Vec2> impulse, velocity;
  std::vector<contact::Status> status;
  contact::CoupledResult result;
};

inline Solved solved(const CoupledProblem& p, std::vector<Vec2> start = {}) {
  Solved s;
  s.impulse = std::move(start);
  s.impulse.resize(p.size());
  s.status.resize(p.size());
  s.velocity.resize(p.size());
  contact::CoupledWorkspace work;
  s.result = contact::solve_coupled(p, {}, s.impulse, s.status, work);
  contact::coupled_velocities(p, s.impulse, s.velocity);
  return s;
}

inline double largest_difference(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double worst = 0.0;
  for (std::size_t j = 0; j < a.size(); ++j) worst = std::max(worst, norm(a[j] - b[j]));
  return worst;
}

/// The contacts in another order: contact j is contact order[j] of the scene.
inline Scene permuted(const Scene& scene, const std::vector<std::size_t>& order) {
  Scene out = scene;
  for (std::size_t j = 0; j < order.size(); ++j) {
    out.contacts[j] = scene.contacts[order[j]];
    out.friction[j] = scene.friction[order[j]];
    out.bounce[j] = scene.bounce[order[j]];
  }
  return out;
}

/// W as a dense matrix (2 nc, 2 nc).
inline Eigen::MatrixXd dense(const CoupledProblem& p) {
  const auto n = static_cast<Eigen::Index>(2 * p.size());
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t j = 0; j < p.size(); ++j)
    for (auto k = static_cast<std::size_t>(p.row_start[j]);
         k < static_cast<std::size_t>(p.row_start[j + 1]); ++k) {
      const contact::Block& b = p.blocks[k];
      w.block<2, 2>(static_cast<Eigen::Index>(2 * j), 2 * p.column[k]) << b[0], b[1], b[2], b[3];
    }
  return w;
}

/// Velocities for all statuses (open, stick, slip either way) whose equations, solved by least
/// squares, give impulses with a residual up to the tolerance. 4^nc systems.
inline std::vector<std::vector<Vec2>> enumerate(const CoupledProblem& p, double tolerance) {
  const std::size_t nc = p.size();
  const Eigen::MatrixXd w = dense(p);
  std::vector<std::vector<Vec2>> found;
  for (std::size_t code = 0; code < (std::size_t{1} << (2 * nc)); ++code) {
    Eigen::MatrixXd a = w;
    Eigen::VectorXd b(w.rows());
    for (std::size_t j = 0; j < nc; ++j) {
      const auto n = static_cast<Eigen::Index>(2 * j), t = n + 1;
      const int status = static_cast<int>(code >> (2 * j)) & 3;
      b[n] = -p.free[j].x - p.bounce[j];
      b[t] = -p.free[j].y;
      if (status == 1) continue;  // sticks
      a.row(t).setZero();
      a(t, t) = 1.0 / p.mass[j];
      b[t] = 0.0;
      if (status >= 2) a(t, n) = (status == 2 ? -1.0 : 1.0) * p.friction[j] / p.mass[j];
      if (status >= 2) continue;  // slips
      a.row(n).setZero();
      a(n, n) = 1.0 / p.mass[j];
      b[n] = 0.0;
    }
    const Eigen::VectorXd x = a.completeOrthogonalDecomposition().solve(b);
    std::vector<Vec2> r(nc), v(nc);
    for (std::size_t j = 0; j < nc; ++j)
      r[j] = contact::project_on_cone(
          {x[static_cast<Eigen::Index>(2 * j)], x[static_cast<Eigen::Index>(2 * j + 1)]},
          p.friction[j]);
    if (contact::coupled_residual(p, r) > tolerance) continue;
    contact::coupled_velocities(p, r, v);
    found.push_back(v);
  }
  return found;
}

}  // namespace rondo::test
