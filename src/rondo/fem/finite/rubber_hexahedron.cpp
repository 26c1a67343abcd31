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

/// det(1 + h) - 1: it keeps its digits as a sum of the invariants of h.
double volume_change(const Eigen::Matrix3d& h) noexcept {
  const double trace = h.trace();
  return trace + 0.5 * (trace * trace - (h * h).trace()) + h.determinant();
}

/// U = κ/4 (J² - 1 - 2 ln J) of the mean J, and its derivatives.
struct VolumeEnergy {
  VolumeEnergy(double less_one, double bulk) noexcept {
    const double mean = 1.0 + less_one, square = less_one * (2.0 + less_one);  // J² - 1
    energy = 0.25 * bulk * (square - 2.0 * std::log1p(less_one));
    pressure = 0.5 * bulk * square / mean;
    modulus = 0.5 * bulk * (1.0 + 1.0 / (mean * mean));
  }
  double energy, pressure, modulus;  ///< [Pa]
};

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

RubberForce rubber_force(const HexahedronPoints& points, const HexahedronCorners& u,
                         const Rubber& rubber) noexcept {
  const Eigen::Matrix<double, 3, 8> move = moves_of(u);
  std::array<Eigen::Matrix3d, 8> f;
  double volume = 0.0, change = 0.0;
  for (std::size_t q = 0; q < 8; ++q) {
    const Eigen::Matrix3d h = move * gradients_at(points, q);  // ∇u
    f[q] = Eigen::Matrix3d::Identity() + h;
    volume += points.volume[q];
    change += points.volume[q] * volume_change(h);
  }
  const VolumeEnergy swell(change / volume, rubber.bulk_modulus);
  RubberForce out;
  out.energy = volume * swell.energy;
  Eigen::Matrix<double, 3, 8> force = Eigen::Matrix<double, 3, 8>::Zero();
  for (std::size_t q = 0; q < 8; ++q) {
    const IsochoricStress shear = isochoric_stress(rubber, f[q]);
    const Eigen::Matrix3d by_volume = f[q].determinant() * f[q].inverse().transpose();
    out.energy += points.volume[q] * shear.energy;
    force.noalias() += points.volume[q] * (shear.stress + swell.pressure * by_volume) *
                       gradients_at(points, q).transpose();
  }
  for (std::size_t a = 0; a < 8; ++a) {
    const auto f_a = force.col(static_cast<Eigen::Index>(a));
    out.force[a] = {f_a[0], f_a[1], f_a[2]};
  }
  return out;
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
    const double less_one = volume_change(h);
    if (!(1.0 + less_one >= out.least)) out.least = 1.0 + less_one;  // also not a number
    volume += points.volume[q];
    change += points.volume[q] * less_one;
  }
  if (!(out.least > 0.0)) return out;
  const VolumeEnergy mean(change / volume, rubber.bulk_modulus);
  out.value = volume * mean.energy;
  Eigen::Vector<double, 24> swell = Eigen::Vector<double, 24>::Zero();
  for (std::size_t q = 0; q < 8; ++q) {
    const double w = points.volume[q];
    const IsochoricState shear = isochoric_state(rubber, f[q]);
    const VolumeState v = volume_state(f[q]);
    out.value += w * shear.energy;
    out.force += w * (slopes[q].transpose() * shear.stress);
    swell += w * (slopes[q].transpose() * v.slope);
    out.stiffness.noalias() +=
        w * slopes[q].transpose() * (shear.modulus + mean.pressure * v.bend) * slopes[q];
  }
  out.force += mean.pressure * swell;
  out.stiffness += mean.modulus / volume * swell * swell.transpose();
  return out;
}

}  // namespace rondo::fem::finite
