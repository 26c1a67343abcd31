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

/// F with what the invariants of C̄ need of it.
struct Gradient {
  explicit Gradient(const Matrix3d& of)
      : f(of), j(of.determinant()), g(of.inverse().transpose()), squares(of.squaredNorm()) {}
  Matrix3d f;
  double j;
  Matrix3d g;  ///< F^-T
  double squares;
};

/// An invariant of C̄ with its derivative by F.
struct Invariant {
  double value;
  Matrix3d slope;
};

Invariant first_invariant(const Gradient& x) {
  const double scale = std::pow(x.j, -2.0 / 3.0);
  return {scale * x.squares, scale * (2.0 * x.f - 2.0 / 3.0 * x.squares * x.g)};
}

Nines bend_of_first(const Gradient& x) {
  const double s = x.squares;
  const Nine a = flat(x.f), b = flat(x.g);
  return std::pow(x.j, -2.0 / 3.0) *
         (2.0 * Nines::Identity() - 4.0 / 3.0 * both(a, b) + 4.0 / 9.0 * s * b * b.transpose() +
          2.0 / 3.0 * s * crossed(x.g));
}

/// ½ (s² - C:C), and its derivative.
Invariant second_of(const Gradient& x) {
  const Matrix3d c = x.f.transpose() * x.f;
  return {0.5 * (x.squares * x.squares - c.squaredNorm()), 2.0 * (x.squares * x.f - x.f * c)};
}

Invariant second_invariant(const Gradient& x) {
  const double scale = std::pow(x.j, -4.0 / 3.0);
  const Invariant of = second_of(x);
  return {scale * of.value, scale * (of.slope - 4.0 / 3.0 * of.value * x.g)};
}

Nines bend_of_second(const Gradient& x) {
  const Matrix3d c = x.f.transpose() * x.f, left = x.f * x.f.transpose(),
                 one = Matrix3d::Identity();
  const Invariant of = second_of(x);
  const Nine a = flat(x.f), b = flat(x.g), h = flat(of.slope);
  const Nines inner = 4.0 * a * a.transpose() + 2.0 * x.squares * Nines::Identity() -
                      2.0 * (paired(one, c) + crossed(x.f) + paired(left, one));
  return std::pow(x.j, -4.0 / 3.0) *
         (inner - 4.0 / 3.0 * both(h, b) + 16.0 / 9.0 * of.value * b * b.transpose() +
          4.0 / 3.0 * of.value * crossed(x.g));
}

/// Neo-Hooke, Mooney-Rivlin and Yeoh.
IsochoricStress polynomial_stress(const Rubber& r, const Gradient& x) {
  const Invariant first = first_invariant(x);
  const double more = first.value - 3.0;
  IsochoricStress out{more * (r.c10 + more * (r.c20 + more * r.c30)),
                      (r.c10 + more * (2.0 * r.c20 + more * 3.0 * r.c30)) * first.slope};
  if (r.c01 == 0.0) return out;
  const Invariant second = second_invariant(x);
  out.energy += r.c01 * (second.value - 3.0);
  out.stress += r.c01 * second.slope;
  return out;
}

IsochoricState polynomial(const Rubber& r, const Gradient& x) {
  const IsochoricStress stress = polynomial_stress(r, x);
  const Invariant first = first_invariant(x);
  const double more = first.value - 3.0, bend = 2.0 * r.c20 + 6.0 * r.c30 * more;
  const Nine slope = flat(first.slope);
  IsochoricState out{stress.energy, flat(stress.stress),
                     (r.c10 + more * (2.0 * r.c20 + more * 3.0 * r.c30)) * bend_of_first(x) +
                         bend * slope * slope.transpose()};
  if (r.c01 != 0.0) out.modulus += r.c01 * bend_of_second(x);
  return out;
}

/// Ogden's law in its principal axes. With e_i = ln λ_i: t_i = ∂W/∂e_i.
struct Principal {
  double energy = 0.0;
  Eigen::Vector3d squares, t = Eigen::Vector3d::Zero();  ///< λ_i²
  Matrix3d axes, by = Matrix3d::Zero();                  ///< ∂t_i/∂e_j
};

Principal principal(const Rubber& r, const Matrix3d& f) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(f.transpose() * f);
  Principal out;
  out.squares = axes.eigenvalues();
  out.axes = axes.eigenvectors();
  const double mean = std::log(out.squares.prod()) / 6.0;  // of the three e_i
  for (const OgdenTerm& term : r.terms) {
    Eigen::Vector3d power;
    for (int i = 0; i < 3; ++i)
      power[i] = std::exp(term.exponent * (0.5 * std::log(out.squares[i]) - mean));
    const double third = power.sum() / 3.0;
    out.energy += term.modulus / term.exponent * (power.sum() - 3.0);
    out.t += term.modulus * (power.array() - third).matrix();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        out.by(i, j) += term.modulus * term.exponent *
                        ((i == j ? power[i] : 0.0) - (power[i] + power[j] - third) / 3.0);
  }
  return out;
}

/// P = Σ S_i F N_i ⊗ N_i, S_i = t_i/λ_i²
IsochoricStress ogden_stress(const Principal& p, const Matrix3d& f) {
  return {p.energy, f * (p.axes * p.t.cwiseQuotient(p.squares).asDiagonal() * p.axes.transpose())};
}

IsochoricState ogden(const Rubber& r, const Matrix3d& f) {
  const Principal p = principal(r, f);
  const Matrix3d &n = p.axes, &by = p.by;
  const Eigen::Vector3d &squares = p.squares, &t = p.t, s = t.cwiseQuotient(squares);
  const Matrix3d fn = f * n;
  IsochoricState out{p.energy, flat(ogden_stress(p, f).stress),
                     paired(Matrix3d::Identity(), n * s.asDiagonal() * n.transpose())};
  std::array<std::array<Nine, 3>, 3> dyad;  // F N_i ⊗ N_j
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) dyad[at(i)][at(j)] = flat(fn.col(i) * n.col(j).transpose());
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Nine &ii = dyad[at(i)][at(i)], &jj = dyad[at(j)][at(j)];
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
  return rubber.law == RubberLaw::ogden ? ogden(rubber, f) : polynomial(rubber, Gradient(f));
}

IsochoricStress isochoric_stress(const Rubber& rubber, const Matrix3d& f) {
  return rubber.law == RubberLaw::ogden ? ogden_stress(principal(rubber, f), f)
                                        : polynomial_stress(rubber, Gradient(f));
}

VolumeState volume_state(const Matrix3d& f) {
  const double j = f.determinant();
  const Matrix3d g = f.inverse().transpose();
  const Nine b = flat(g);
  return {j, j * b, j * (b * b.transpose() - crossed(g))};
}

}  // namespace rondo::fem::finite
