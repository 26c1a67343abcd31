// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/modal/residual.hpp"

#include <cmath>
#include <vector>

namespace rondo::modal {
namespace {

using Field = std::vector<Vec2>;

Vec2 times(const std::array<double, 4>& b, Vec2 u) {
  return {b[0] * u.x + b[2] * u.y, b[1] * u.x + b[3] * u.y};
}

double squared(const Field& f) {
  double sum = 0.0;
  for (const Vec2 v : f) sum += dot(v, v);
  return sum;
}

/// The products with the matrices of a body: K u, and its block diagonal alone.
struct Products {
  Field k_real, k_imaginary, d_real, d_imaginary;
};

double residual_of(Products p, std::span<const double> mass, double spin, const Mode& mode) {
  const double scale = squared(p.d_real) + squared(p.d_imaginary);
  const Complex lambda{mode.growth, mode.omega}, square = lambda * lambda;
  Field rest_real = p.k_real, rest_imaginary = p.k_imaginary;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const double m = mass[i];
    const Vec2 r = mode.real[i], q = mode.imaginary[i];
    if (p.d_real[i] == Vec2{} && p.d_imaginary[i] == Vec2{}) continue;  // clamped
    p.k_real[i] -= spin * spin * m * r;
    p.k_imaginary[i] -= spin * spin * m * q;
    const double turn = 2.0 * spin;
    rest_real[i] = p.k_real[i] + m * (square.re * r - square.im * q) +
                   m * turn90(turn * lambda.re * r - turn * lambda.im * q);
    rest_imaginary[i] = p.k_imaginary[i] + m * (square.re * q + square.im * r) +
                        m * turn90(turn * lambda.re * q + turn * lambda.im * r);
  }
  const double rest = squared(rest_real) + squared(rest_imaginary);
  const double size = squared(p.k_real) + squared(p.k_imaginary);
  const bool still = mode.wave == Wave::rigid && lambda == Complex{};
  return std::sqrt(rest / (still ? scale : size));
}

}  // namespace

double residual(const CyclicBody& body, double spin, const Mode& mode) {
  const fem::SectorStiffness& k = body.stiffness;
  const std::size_t n = mode.real.size();
  Products p{Field(n), Field(n), Field(n), Field(n)};
  fem::apply(k, mode.real, p.k_real);
  fem::apply(k, mode.imaginary, p.k_imaginary);
  for (std::size_t j = 0; j < k.turn.size(); ++j)
    for (std::size_t a = 0; a < k.n_local(); ++a)
      for (const fem::SectorStiffness::Entry& e : k.row(a)) {
        if (e.shift != 0 || static_cast<std::size_t>(e.column) != a) continue;
        const std::size_t node = k.node(a, j);
        p.d_real[node] = k.turn[j] * times(e.block, conj(k.turn[j]) * mode.real[node]);
        p.d_imaginary[node] = k.turn[j] * times(e.block, conj(k.turn[j]) * mode.imaginary[node]);
      }
  return residual_of(std::move(p), body.mass, spin, mode);
}

double residual(const MeshBody& body, double spin, const Mode& mode) {
  const fem::BlockCsr& k = body.stiffness;
  const std::size_t n = mode.real.size();
  Products p{Field(n), Field(n), Field(n), Field(n)};
  for (std::size_t row = 0; row < n; ++row)
    for (auto b = static_cast<std::size_t>(k.row_start[row]);
         b < static_cast<std::size_t>(k.row_start[row + 1]); ++b) {
      const auto column = static_cast<std::size_t>(k.column[b]);
      const Vec2 real = times(k.values[b], mode.real[column]);
      const Vec2 imaginary = times(k.values[b], mode.imaginary[column]);
      p.k_real[row] += real;
      p.k_imaginary[row] += imaginary;
      if (column == row) p.d_real[row] = real, p.d_imaginary[row] = imaginary;
    }
  return residual_of(std::move(p), body.mass, spin, mode);
}

}  // namespace rondo::modal
