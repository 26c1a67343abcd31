// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/modal/residual.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "rondo/fem/solid/solid_sector.hpp"

namespace rondo::modal {
namespace {

template <int D>
using VecOf = std::conditional_t<D == 2, Vec2, Vec3>;
template <int D>
using Values = std::vector<VecOf<D>>;

Vec2 times(const std::array<double, 4>& b, Vec2 u) {
  return {b[0] * u.x + b[2] * u.y, b[1] * u.x + b[3] * u.y};
}
Vec3 times(const std::array<double, 9>& b, Vec3 u) {
  return {b[0] * u.x + b[3] * u.y + b[6] * u.z, b[1] * u.x + b[4] * u.y + b[7] * u.z,
          b[2] * u.x + b[5] * u.y + b[8] * u.z};
}

/// P u and J u.
Vec2 in_plane(Vec2 u) {
  return u;
}
Vec3 in_plane(Vec3 u) {
  return u.plane();
}
Vec2 quarter_turned(Vec2 u) {
  return turn90(u);
}
Vec3 quarter_turned(Vec3 u) {
  return turn90(u.plane());
}

template <class Vec>
double squared(const std::vector<Vec>& f) {
  double sum = 0.0;
  for (const Vec v : f) sum += dot(v, v);
  return sum;
}

/// The products with the matrices of a body: K u, and its block diagonal alone.
template <int D>
struct Products {
  explicit Products(std::size_t n) : k_real(n), k_imaginary(n), d_real(n), d_imaginary(n) {}
  Values<D> k_real, k_imaginary, d_real, d_imaginary;
};

template <int D>
double residual_of(Products<D> p, std::span<const double> mass, double spin, const Mode& mode) {
  using Vec = VecOf<D>;
  const std::span<const Vec> real = mode.real, imaginary = mode.imaginary;
  const double scale = squared(p.d_real) + squared(p.d_imaginary);
  const Complex lambda{mode.growth, mode.omega}, square = lambda * lambda;
  Values<D> rest_real = p.k_real, rest_imaginary = p.k_imaginary;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const double m = mass[i];
    const Vec r = real[i], q = imaginary[i];
    if (p.d_real[i] == Vec{} && p.d_imaginary[i] == Vec{}) continue;  // clamped
    p.k_real[i] -= spin * spin * m * in_plane(r);
    p.k_imaginary[i] -= spin * spin * m * in_plane(q);
    const double turn = 2.0 * spin;
    rest_real[i] = p.k_real[i] + m * (square.re * r - square.im * q) +
                   m * quarter_turned(turn * lambda.re * r - turn * lambda.im * q);
    rest_imaginary[i] = p.k_imaginary[i] + m * (square.re * q + square.im * r) +
                        m * quarter_turned(turn * lambda.re * q + turn * lambda.im * r);
  }
  const double rest = squared(rest_real) + squared(rest_imaginary);
  const double size = squared(p.k_real) + squared(p.k_imaginary);
  const bool still = mode.wave == Wave::rigid && lambda == Complex{};
  return std::sqrt(rest / (still ? scale : size));
}

template <int D>
ModeForms forms_in(std::span<const double> mass, double spin, const Mode& mode) {
  using Vec = VecOf<D>;
  const std::span<const Vec> real = mode.real, imaginary = mode.imaginary;
  ModeForms forms;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const Vec r = in_plane(real[i]), q = in_plane(imaginary[i]);
    forms.gyroscopic += 4.0 * spin * mass[i] * dot(r, quarter_turned(q));
    forms.softening += spin * spin * mass[i] * (dot(r, r) + dot(q, q));
  }
  const double w = mode.omega;
  forms.elastic = w * w + w * forms.gyroscopic + forms.softening;
  return forms;
}

}  // namespace

template <int D>
double residual(const CyclicBody<D>& body, double spin, const Mode& mode) {
  const fem::SectorBlocks<D>& k = body.stiffness;
  const std::span<const VecOf<D>> real = mode.real, imaginary = mode.imaginary;
  Products<D> p(real.size());
  fem::apply(k, real, p.k_real);
  fem::apply(k, imaginary, p.k_imaginary);
  for (std::size_t j = 0; j < k.turn.size(); ++j)
    for (std::size_t a = 0; a < k.n_local(); ++a)
      for (const auto& e : k.row(a)) {
        if (e.shift != 0 || static_cast<std::size_t>(e.column) != a) continue;
        const std::size_t node = k.node(a, j);
        p.d_real[node] = k.turn[j] * times(e.block, conj(k.turn[j]) * real[node]);
        p.d_imaginary[node] = k.turn[j] * times(e.block, conj(k.turn[j]) * imaginary[node]);
      }
  return residual_of<D>(std::move(p), body.mass, spin, mode);
}

double residual(const MeshBody& body, double spin, const Mode& mode) {
  const fem::BlockCsr& k = body.stiffness;
  const std::span<const Vec2> of_real = mode.real, of_imaginary = mode.imaginary;
  const std::size_t n = of_real.size();
  Products<2> p(n);
  for (std::size_t row = 0; row < n; ++row)
    for (auto b = static_cast<std::size_t>(k.row_start[row]);
         b < static_cast<std::size_t>(k.row_start[row + 1]); ++b) {
      const auto column = static_cast<std::size_t>(k.column[b]);
      const Vec2 real = times(k.values[b], of_real[column]);
      const Vec2 imaginary = times(k.values[b], of_imaginary[column]);
      p.k_real[row] += real;
      p.k_imaginary[row] += imaginary;
      if (column == row) p.d_real[row] = real, p.d_imaginary[row] = imaginary;
    }
  return residual_of<2>(std::move(p), body.mass, spin, mode);
}

ModeForms forms_of(std::span<const double> mass, double spin, const Mode& mode) {
  return mode.real.components() == 2 ? forms_in<2>(mass, spin, mode)
                                     : forms_in<3>(mass, spin, mode);
}

double damping_ratio(std::span<const double> mass, double spin, const Mode& mode, Damping damping) {
  if (mode.wave == Wave::rigid || !(mode.omega > 0.0))
    return std::numeric_limits<double>::quiet_NaN();
  const ModeForms forms = forms_of(mass, spin, mode);
  return (damping.mass + damping.stiffness * forms.elastic) / (2.0 * mode.omega + forms.gyroscopic);
}

template double residual(const CyclicBody<2>&, double, const Mode&);
template double residual(const CyclicBody<3>&, double, const Mode&);

}  // namespace rondo::modal
