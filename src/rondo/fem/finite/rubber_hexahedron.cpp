// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/finite/rubber_hexahedron.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "rondo/core/index.hpp"
#include "rondo/fem/finite/isotropic_law.hpp"

namespace rondo::fem::finite {
namespace {

using Slopes = Eigen::Matrix<double, 9, 24>;  ///< ∂F/∂u

/// Gradients of the corners at a point, (8, 3) [1/m].
Eigen::Matrix<double, 8, 3> gradients_at(const HexahedronPoints& points, std::size_t q) {
  Eigen::Matrix<double, 8, 3> n;
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t j = 0; j < 3; ++j)
      n(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(j)) = points.gradient[a][j][q];
  return n;
}

Slopes slopes_of(const Eigen::Matrix<double, 8, 3>& n) {
  Slopes b = Slopes::Zero();
  for (Eigen::Index a = 0; a < 8; ++a)
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j < 3; ++j) b(3 * i + j, 3 * a + i) = n(a, j);
  return b;
}

Eigen::Matrix<double, 3, 8> moves_of(const HexahedronCorners& u) {
  Eigen::Matrix<double, 3, 8> move;
  for (std::size_t a = 0; a < 8; ++a)
    move.col(static_cast<Eigen::Index>(a)) << u[a].x, u[a].y, u[a].z;
  return move;
}

}  // namespace

double largest_stretch(const HexahedronPoints& points, const HexahedronCorners& u) {
  const Eigen::Matrix<double, 3, 8> move = moves_of(u);
  double largest = 0.0;
  for (std::size_t q = 0; q < 8; ++q) {
    const Eigen::Matrix3d f = Eigen::Matrix3d::Identity() + move * gradients_at(points, q);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> of(f.transpose() * f,
                                                            Eigen::EigenvaluesOnly);
    largest = std::max(largest, std::sqrt(of.eigenvalues()[2]));
  }
  return largest;
}

RubberEnergy rubber_hexahedron(const HexahedronPoints& points, const HexahedronCorners& u,
                               const Rubber& rubber) {
  const Eigen::Matrix<double, 3, 8> move = moves_of(u);
  RubberEnergy out;
  out.least = 1e300;
  std::array<Slopes, 8> slopes;
  std::array<Eigen::Matrix3d, 8> f;
  double volume = 0.0, change = 0.0;
  for (std::size_t q = 0; q < 8; ++q) {
    const Eigen::Matrix<double, 8, 3> n = gradients_at(points, q);
    const Eigen::Matrix3d h = move * n;  // ∇u
    slopes[q] = slopes_of(n);
    f[q] = Eigen::Matrix3d::Identity() + h;
    // det(1 + h) - 1 keeps its digits as a sum of the invariants of h.
    const double less_one =
        h.trace() + 0.5 * (h.trace() * h.trace() - (h * h).trace()) + h.determinant();
    if (!(1.0 + less_one >= out.least)) out.least = 1.0 + less_one;  // also not a number
    volume += points.volume[q];
    change += points.volume[q] * less_one;
  }
  if (!(out.least > 0.0)) return out;
  // U = κ/4 (J² - 1 - 2 ln J) of the mean J
  const double less_one = change / volume, mean = 1.0 + less_one, k = rubber.bulk_modulus;
  const double square = less_one * (2.0 + less_one);  // J² - 1
  const double pressure = 0.5 * k * square / mean, stiff = 0.5 * k * (1.0 + 1.0 / (mean * mean));
  out.value = volume * 0.25 * k * (square - 2.0 * std::log1p(less_one));
  Eigen::Vector<double, 24> swell = Eigen::Vector<double, 24>::Zero();
  for (std::size_t q = 0; q < 8; ++q) {
    const double w = points.volume[q];
    const IsochoricState shear = isochoric_state(rubber, f[q]);
    const VolumeState v = volume_state(f[q]);
    out.value += w * shear.energy;
    out.force += w * (slopes[q].transpose() * shear.stress);
    swell += w * (slopes[q].transpose() * v.slope);
    out.stiffness.noalias() +=
        w * slopes[q].transpose() * (shear.modulus + pressure * v.bend) * slopes[q];
  }
  out.force += pressure * swell;
  out.stiffness += stiff / volume * swell * swell.transpose();
  return out;
}

}  // namespace rondo::fem::finite
