// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/solid/solid_strain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "rondo/core/vec3.hpp"
#include "rondo/fem/solid/hexahedron.hpp"

namespace rondo::fem {
namespace {

using Edges = std::array<Vec3, 3>;  ///< along the three directions of an element

double volume(const Edges& e) noexcept {
  return dot(e[0], cross(e[1], e[2]));
}

/// Edges from corner k to its neighbours; right-handed at the corners of a valid element.
Edges edges_at(const HexahedronCorners& x, std::size_t k) noexcept {
  const std::size_t face = k < 4 ? 0 : 4, c = k - face;
  const Vec3 next = x[face + (c + 1) % 4] - x[k], last = x[face + (c + 3) % 4] - x[k];
  const Vec3 across = x[(k + 4) % 8] - x[k];
  return face == 0 ? Edges{next, last, across} : Edges{last, next, across};
}

/// Means of the four edges along each direction: the gradient at the center maps their changes.
Edges mean_edges(const HexahedronCorners& x) noexcept {
  Edges e;
  for (const std::size_t f : {std::size_t{0}, std::size_t{4}}) {
    e[0] += 0.25 * ((x[f + 1] - x[f]) + (x[f + 2] - x[f + 3]));
    e[1] += 0.25 * ((x[f + 3] - x[f]) + (x[f + 2] - x[f + 1]));
  }
  for (std::size_t k = 0; k < 4; ++k) e[2] += 0.25 * (x[k + 4] - x[k]);
  return e;
}

/// The parts of a symmetric strain that are needed.
struct SolidStrain {
  double xx, yy, zz, xy, yz, zx;
};

/// Symmetric part of G = Σ du_k ⊗ g_k, g the vectors dual to the edges.
SolidStrain strain_of(const Edges& e, const Edges& du) noexcept {
  const double scale = 1.0 / volume(e);
  const Edges dual{scale * cross(e[1], e[2]), scale * cross(e[2], e[0]), scale * cross(e[0], e[1])};
  SolidStrain s{};
  for (std::size_t k = 0; k < 3; ++k) {
    s.xx += du[k].x * dual[k].x;
    s.yy += du[k].y * dual[k].y;
    s.zz += du[k].z * dual[k].z;
    s.xy += 0.5 * (du[k].x * dual[k].y + du[k].y * dual[k].x);
    s.yz += 0.5 * (du[k].y * dual[k].z + du[k].z * dual[k].y);
    s.zx += 0.5 * (du[k].z * dual[k].x + du[k].x * dual[k].z);
  }
  return s;
}

/// Largest |eigenvalue|, from the angle whose cosine is ½ the determinant of the scaled deviator.
double largest_principal(const SolidStrain& s) noexcept {
  const double mean = (s.xx + s.yy + s.zz) / 3.0;
  const double x = s.xx - mean, y = s.yy - mean, z = s.zz - mean;
  const double off = s.xy * s.xy + s.yz * s.yz + s.zx * s.zx;
  const double size = std::sqrt((x * x + y * y + z * z + 2.0 * off) / 6.0);
  if (!(size > 1e-100)) return std::abs(mean);
  const double determinant =
      x * (y * z - s.yz * s.yz) - s.xy * (s.xy * z - s.yz * s.zx) + s.zx * (s.xy * s.yz - y * s.zx);
  const double half = 0.5 * (determinant / size / size / size);
  const double angle = std::acos(std::clamp(half, -1.0, 1.0)) / 3.0;
  constexpr double third = 2.0 * std::numbers::pi / 3.0;
  return std::max(std::abs(mean + 2.0 * size * std::cos(angle)),
                  std::abs(mean + 2.0 * size * std::cos(angle + third)));
}

}  // namespace

Deformation solid_deformation(const mesh::Mesh& mesh, std::span<const Vec3> u) noexcept {
  Deformation d;
  for (std::size_t e = 0; e < mesh.hexahedra.size(); ++e) {
    HexahedronCorners x, change, now;
    for (std::size_t k = 0; k < 8; ++k) {
      const auto i = static_cast<std::size_t>(mesh.hexahedra[e][k]);
      x[k] = {mesh.coordinates[i], mesh.axial[i]};
      change[k] = u[i];
      now[k] = x[k] + change[k];
    }
    const double strain = largest_principal(strain_of(mean_edges(x), mean_edges(change)));
    if (strain > d.strain) {
      d.strain = d.linear_strain = strain;
      d.strain_cell = d.linear_cell = e;
    }
    for (std::size_t k = 0; k < 8; ++k) {
      const double jacobian = volume(edges_at(now, k)) / volume(edges_at(x, k));
      if (!(jacobian < d.jacobian)) continue;
      d.jacobian = jacobian;
      d.jacobian_cell = e;
    }
  }
  return d;
}

}  // namespace rondo::fem
