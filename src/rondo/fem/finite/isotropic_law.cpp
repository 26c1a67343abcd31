// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/finite/isotropic_law.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::fem::finite {
namespace {

using Eigen::Matrix3d;
using Nine = Eigen::Vector<double, 9>;
using Nines = Eigen::Matrix<double, 9, 9>;

Nine flat(const Matrix3d& a) {
  Nine v;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) v[3 * i + j] = a(i, j);
  return v;
}

/// a_ij b_kl + b_ij a_kl
Nines both(const Nine& a, const Nine& b) {
  return a * b.transpose() + b * a.transpose();
}

/// a_il a_kj
Nines crossed(const Matrix3d& a) {
  Nines x;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) x(3 * i + j, 3 * k + l) = a(i, l) * a(k, j);
  return x;
}

/// a_ik b_jl
Nines paired(const Matrix3d& a, const Matrix3d& b) {
  Nines x;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) x(3 * i + j, 3 * k + l) = a(i, k) * b(j, l);
  return x;
}

/// An invariant of C̄ with its derivatives by F.
struct Invariant {
  double value;
  Nine slope;
  Nines bend;
};

Invariant first_invariant(const Matrix3d& f, const Matrix3d& g, double j) {
  const double s = f.squaredNorm(), scale = std::pow(j, -2.0 / 3.0);
  const Nine a = flat(f), b = flat(g);
  return {scale * s, scale * (2.0 * a - 2.0 / 3.0 * s * b),
          scale * (2.0 * Nines::Identity() - 4.0 / 3.0 * both(a, b) +
                   4.0 / 9.0 * s * b * b.transpose() + 2.0 / 3.0 * s * crossed(g))};
}

Invariant second_invariant(const Matrix3d& f, const Matrix3d& g, double j) {
  const Matrix3d c = f.transpose() * f, left = f * f.transpose(), one = Matrix3d::Identity();
  const double s = f.squaredNorm(), i2 = 0.5 * (s * s - c.squaredNorm());
  const double scale = std::pow(j, -4.0 / 3.0);
  const Nine a = flat(f), b = flat(g), h = flat(2.0 * (s * f - f * c));
  const Nines inner = 4.0 * a * a.transpose() + 2.0 * s * Nines::Identity() -
                      2.0 * (paired(one, c) + crossed(f) + paired(left, one));
  return {scale * i2, scale * (h - 4.0 / 3.0 * i2 * b),
          scale * (inner - 4.0 / 3.0 * both(h, b) + 16.0 / 9.0 * i2 * b * b.transpose() +
                   4.0 / 3.0 * i2 * crossed(g))};
}

/// Neo-Hooke, Mooney-Rivlin and Yeoh.
IsochoricState polynomial(const Rubber& r, const Matrix3d& f) {
  const double j = f.determinant();
  const Matrix3d g = f.inverse().transpose();
  const Invariant first = first_invariant(f, g, j);
  const double x = first.value - 3.0;
  const double slope = r.c10 + x * (2.0 * r.c20 + x * 3.0 * r.c30),
               bend = 2.0 * r.c20 + 6.0 * r.c30 * x;
  IsochoricState out{x * (r.c10 + x * (r.c20 + x * r.c30)), slope * first.slope,
                     slope * first.bend + bend * first.slope * first.slope.transpose()};
  if (r.c01 == 0.0) return out;
  const Invariant second = second_invariant(f, g, j);
  out.energy += r.c01 * (second.value - 3.0);
  out.stress += r.c01 * second.slope;
  out.modulus += r.c01 * second.bend;
  return out;
}

/// Ogden's law in its principal axes. With e_i = ln λ_i: t_i = ∂W/∂e_i, S_i = t_i/λ_i².
IsochoricState ogden(const Rubber& r, const Matrix3d& f) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(f.transpose() * f);
  const Eigen::Vector3d squares = axes.eigenvalues();
  const Matrix3d& n = axes.eigenvectors();
  const double mean = std::log(squares.prod()) / 6.0;  // of the three e_i
  IsochoricState out;
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
  Matrix3d by = Matrix3d::Zero();  // ∂t_i/∂e_j
  for (const OgdenTerm& term : r.terms) {
    Eigen::Vector3d power;
    for (int i = 0; i < 3; ++i)
      power[i] = std::exp(term.exponent * (0.5 * std::log(squares[i]) - mean));
    const double third = power.sum() / 3.0;
    out.energy += term.modulus / term.exponent * (power.sum() - 3.0);
    t += term.modulus * (power.array() - third).matrix();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        by(i, j) += term.modulus * term.exponent *
                    ((i == j ? power[i] : 0.0) - (power[i] + power[j] - third) / 3.0);
  }
  const Eigen::Vector3d s = t.cwiseQuotient(squares);
  const Matrix3d fn = f * n;
  out.stress.setZero();  // P = Σ S_i F N_i ⊗ N_i
  out.modulus = paired(Matrix3d::Identity(), n * s.asDiagonal() * n.transpose());
  std::array<std::array<Nine, 3>, 3> dyad;  // F N_i ⊗ N_j
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) dyad[at(i)][at(j)] = flat(fn.col(i) * n.col(j).transpose());
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Nine &ii = dyad[at(i)][at(i)], &jj = dyad[at(j)][at(j)];
      if (i == j) out.stress += s[i] * ii;
      const double along = (by(i, j) - (i == j ? 2.0 * t[i] : 0.0)) / (squares[i] * squares[j]);
      out.modulus += along * ii * jj.transpose();
      if (i == j) continue;
      // (S_i - S_j)/(λ_i² - λ_j²); where both are equal, its limit.
      const double apart = squares[i] - squares[j];
      const double limit = 0.5 * (by(i, i) - by(i, j) - 2.0 * t[i]) / (squares[i] * squares[i]);
      const double slope =
          std::abs(apart) > 1e-6 * (squares[i] + squares[j]) ? (s[i] - s[j]) / apart : limit;
      const Nine &ij = dyad[at(i)][at(j)], &ji = dyad[at(j)][at(i)];
      out.modulus += slope * ij * (ij + ji).transpose();
    }
  return out;
}

}  // namespace

IsochoricState isochoric_state(const Rubber& rubber, const Matrix3d& f) {
  RONDO_DEMAND(f.determinant() > 0.0, f.determinant());
  return rubber.law == RubberLaw::ogden ? ogden(rubber, f) : polynomial(rubber, f);
}

VolumeState volume_state(const Matrix3d& f) {
  const double j = f.determinant();
  const Matrix3d g = f.inverse().transpose();
  const Nine b = flat(g);
  return {j, j * b, j * (b * b.transpose() - crossed(g))};
}

}  // namespace rondo::fem::finite
