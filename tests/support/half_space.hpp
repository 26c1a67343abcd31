// SPDX-License-Identifier: BSD-3-Clause
/// @file  A rolling contact of two equal elastic half-spaces as a problem of steady rolling:
/// Hertzian gaps, and the displacements of Boussinesq and Cerruti by tractions that are constant on
/// rectangles (K. L. Johnson, Contact Mechanics, 1985, 3.2 and 3.6; J. J. Kalker,
/// Three-Dimensional Elastic Bodies in Rolling Contact, 1990). Normal and tangential parts do not
/// interact, because the bodies are equal.
#pragma once
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "rondo/statics/steady/rolling_problem.hpp"

namespace rondo::test {

/// An ellipse that rolls along +x, in any system of units.
struct HalfSpaces {
  double rolling = 0.0, across = 0.0;    ///< half axes of Hertz's ellipse, along x and y
  double along_curve = 0.0, side = 0.0;  ///< A, B of the gap A x² + B y²
  double shear_modulus = 0.0, poissons_ratio = 0.0;  ///< of each
  int elements = 20;                                 ///< over each axis of the ellipse
  std::vector<double> slip{1.5, -2.0, 0.5};  ///< weights of a point's own and its earlier places
};

/// Displacements at a place, over the traction on a rectangle about the origin: normal, along x
/// and along y by a traction along the same, and across by one along the other.
struct SurfaceInfluence {
  double normal = 0.0, along = 0.0, side = 0.0, cross = 0.0;
};
inline SurfaceInfluence influence(const HalfSpaces& of, double x, double y, double dx, double dy) {
  double by_x = 0.0, by_y = 0.0, mixed = 0.0;  // ∬ x²/R³, y²/R³, xy/R³
  for (const double ex : {-0.5, 0.5})
    for (const double ey : {-0.5, 0.5}) {
      const double u = x + ex * dx, v = y + ey * dy, r = std::hypot(u, v), sign = ex * ey * 4.0;
      by_x += sign * v * std::asinh(u / std::abs(v));
      by_y += sign * u * std::asinh(v / std::abs(u));
      mixed -= sign * r;
    }
  const double nu = of.poissons_ratio, factor = 1.0 / (std::numbers::pi * of.shear_modulus);
  const double both = (1.0 - nu) * (by_x + by_y);
  return {factor * both, factor * (both + nu * by_x), factor * (both + nu * by_y),
          factor * nu * mixed};
}

/// Pairs are rectangles in and around the ellipse: candidates are lines along x, samples are places
/// on them, a rectangle apart. The time of a sample is 1, so that rolling without creep is at the
/// speed of a rectangle's length. Places are those of the undeformed ground.
inline statics::RollingProblem<3> half_spaces(const HalfSpaces& of) {
  using Eigen::Index;
  const double dx = 2.0 * of.rolling / of.elements, dy = 2.0 * of.across / of.elements;
  statics::RollingProblem<3> p;
  p.time = 1.0;
  p.back = 1;
  std::vector<Vec2> place;
  for (int k = -1; k <= of.elements; ++k)
    for (int i = -1; i <= of.elements; ++i) {
      const Vec2 at{(i + 0.5) * dx - of.rolling, (k + 0.5) * dy - of.across};
      if (std::hypot(at.x / of.rolling, at.y / of.across) > 1.0 + 2.0 / of.elements) continue;
      p.pairs.push_back({static_cast<std::size_t>(k + 1), i});
      place.push_back(at);
    }
  const auto n = static_cast<Index>(place.size());
  p.base = Eigen::VectorXd::Zero(3 * n);
  p.weight = p.base;
  p.base_place = Eigen::VectorXd::Zero(2 * n);
  p.matrix = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  p.matrix_place = Eigen::MatrixXd::Zero(2 * n, 3 * n);
  for (Index j = 0; j < n; ++j) {
    const Vec2 at = place[static_cast<std::size_t>(j)];
    p.base[3 * j] = of.along_curve * at.x * at.x + of.side * at.y * at.y;
    p.base[3 * j + 1] = -dx;
    p.base_place[2 * j] = at.x;
    p.base_place[2 * j + 1] = at.y;
    for (Index q = 0; q < n; ++q) {
      const Vec2 from = place[static_cast<std::size_t>(q)];
      Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
      for (std::size_t w = 0; w < of.slip.size(); ++w) {
        const double ahead = dx * static_cast<double>(w);
        const SurfaceInfluence u = influence(of, at.x + ahead - from.x, at.y - from.y, dx, dy);
        if (w == 0) block(0, 0) = u.normal;
        block(1, 1) += of.slip[w] * u.along;
        block(2, 2) += of.slip[w] * u.side;
        block(1, 2) += of.slip[w] * u.cross;
      }
      block(2, 1) = block(1, 2);
      p.matrix.block<3, 3>(3 * j, 3 * q) = block / (dx * dy);
    }
  }
  return p;
}

/// The same half-spaces while they begin to roll: a point's earlier place is one by the forces of
/// the step before (rolling_transient.hpp).
inline statics::RollingProblem<3> rolling_half_spaces(HalfSpaces of) {
  of.slip = {0.0, 1.0};
  Eigen::MatrixXd upstream = half_spaces(of).matrix;
  for (Eigen::Index j = 0; j < upstream.rows(); j += 3) upstream.row(j).setZero();
  of.slip = {1.0};
  statics::RollingProblem<3> p = half_spaces(of);
  p.upstream = std::move(upstream);
  p.before = Eigen::VectorXd::Zero(p.size());
  return p;
}

}  // namespace rondo::test
