// SPDX-License-Identifier: BSD-3-Clause
/// @file  A wheel that rolls on a rail in the plane under a creep, with friction that falls with
/// the slip speed (docs/validation.md, V44). Source: E. A. H. Vollebregt, H. M. Schuttelaars, J.
/// Sound Vib. 331 (2012) 2141; numbers and elements are those of CONTACT: examples/veldep_fric;
/// eve70a/CONTACT, Apache-2.0.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rondo/statics/steady/law/rolling_friction.hpp"
#include "rondo/statics/steady/rolling_newton.hpp"
#include "support/half_space.hpp"

namespace rondo::test {

/// Two half-spaces that touch along a line: one row of rectangles that are as long as it, in mm, N
/// and s. Rectangles are the samples of one candidate.
struct LineContact {
  double radius = 460.0, length = 200.0, load = 622216.0;
  double shear_modulus = 82000.0, poissons_ratio = 0.28;
  double speed = 45000.0;  ///< of rolling
  double element = 0.1;
  int elements = 91;  ///< around the middle

  /// A pair is touched by tractions on all others; the earlier place of a point is one rectangle
  /// ahead.
  [[nodiscard]] statics::RollingProblem<2> problem() const {
    using Eigen::Index;
    const HalfSpaces spaces{.shear_modulus = shear_modulus, .poissons_ratio = poissons_ratio};
    statics::RollingProblem<2> p;
    p.time = element / speed;
    p.back = 1;
    const Index n = elements;
    std::vector<double> normal, along;  // by the distance
    for (Index k = -n; k <= n; ++k) {
      const double x = static_cast<double>(k) * element;
      const SurfaceInfluence u = influence(spaces, x, 0.0, element, length);
      normal.push_back(u.normal / (element * length));
      along.push_back(u.along / (element * length));
    }
    p.base = Eigen::VectorXd::Zero(2 * n);
    p.weight = p.base;
    p.base_place = Eigen::VectorXd::Zero(n);
    p.matrix = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    p.matrix_place = Eigen::MatrixXd::Zero(n, 2 * n);
    for (Index j = 0; j < n; ++j) {
      p.pairs.push_back({0, static_cast<int>(j)});
      const double x = (static_cast<double>(j) - 0.5 * static_cast<double>(n - 1)) * element;
      p.base[2 * j] = 0.5 * x * x / radius;
      p.base[2 * j + 1] = -element;
      p.base_place[j] = x;
      for (Index q = 0; q < n; ++q) {
        const auto at = static_cast<std::size_t>(j - q + n);
        p.matrix(2 * j, 2 * q) = normal[at];
        p.matrix(2 * j + 1, 2 * q + 1) = along[at] - along[at + 1];
      }
    }
    return p;
  }
  /// At a creep, under the load.
  [[nodiscard]] statics::RollingDrive drive(double creep, double friction) const {
    statics::RollingDrive d;
    d.speed = speed * (1.0 + creep);
    d.friction = friction;
    d.load = load;
    return d;
  }
  /// From where the bodies are pressed together.
  [[nodiscard]] statics::RollingState solved(const statics::RollingProblem<2>& problem,
                                             const statics::RollingDrive& drive) const {
    statics::RollingState s;
    s.point = {Eigen::VectorXd::Zero(problem.size()), -0.05, drive.speed};
    solve_rolling(problem, drive, s);
    EXPECT_TRUE(s.solved()) << s.residual << " at a share of " << s.friction.share;
    return s;
  }
};

/// Friction of .18 + .12 · 2^(-v/(100 mm/s)) over .3.
inline contact::FrictionTable falling_friction() {
  contact::FrictionTable table{.coefficient = 1.0, .slip = {}, .patches = {}};
  for (int v = 0; v <= 1000; ++v)
    table.slip.push_back({double(v), (0.18 + 0.12 * std::exp2(-v / 100.0)) / 0.3});
  return table;
}

}  // namespace rondo::test
