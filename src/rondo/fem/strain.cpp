// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/strain.hpp"

#include <array>
#include <cmath>

namespace rondo::fem {
namespace {

void keep_larger(double strain, std::size_t cell, bool is_linear, Deformation& d) noexcept {
  if (strain > d.strain) {
    d.strain = strain;
    d.strain_cell = cell;
  }
  if (!is_linear || !(strain > d.linear_strain)) return;
  d.linear_strain = strain;
  d.linear_cell = cell;
}

void keep_smaller(double jacobian, std::size_t cell, Deformation& d) noexcept {
  if (!(jacobian < d.jacobian)) return;
  d.jacobian = jacobian;
  d.jacobian_cell = cell;
}

/// Twice the areas at the corners i, j, k, l of a quadrilateral, from its diagonals a = ik, b = jl
/// and the edge ij. The areas at both ends of a diagonal add up to the whole.
std::array<double, 4> corner_areas(Vec2 a, Vec2 b, Vec2 edge) noexcept {
  const double whole = cross(a, b), at_i = cross(edge, b), at_j = cross(edge, a);
  return {at_i, at_j, whole - at_i, whole - at_j};
}

}  // namespace

/// The gradient at the center of a bilinear cell maps its diagonals, that of a triangle two edges:
/// [a b] and their changes give ∂u/∂X = [δa δb] [a b]⁻¹.
Deformation deformation(const mesh::Mesh& mesh, std::span<const Vec2> u,
                        std::span<const char> rubber) noexcept {
  Deformation d;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const mesh::Cell& cell = mesh.cells[e];
    const bool triangle = cell[3] < 0;
    const auto i = static_cast<std::size_t>(cell[0]), j = static_cast<std::size_t>(cell[1]),
               k = static_cast<std::size_t>(cell[2]),
               l = static_cast<std::size_t>(triangle ? cell[0] : cell[3]);
    const Vec2 a = mesh.coordinates[k] - mesh.coordinates[i];
    const Vec2 b = mesh.coordinates[l] - mesh.coordinates[j];
    const Vec2 da = u[k] - u[i], db = u[l] - u[j];
    const double scale = 1.0 / cross(a, b);
    const double xx = scale * (da.x * b.y - db.x * a.y), xy = scale * (db.x * a.x - da.x * b.x);
    const double yx = scale * (da.y * b.y - db.y * a.y), yy = scale * (db.y * a.x - da.y * b.x);
    const double deviation = std::sqrt((xx - yy) * (xx - yy) + (xy + yx) * (xy + yx));
    keep_larger(0.5 * (std::abs(xx + yy) + deviation), e, rubber.empty() || !rubber[e], d);
    if (triangle) {
      keep_smaller((1.0 + xx) * (1.0 + yy) - xy * yx, e, d);
      continue;
    }
    const Vec2 edge = mesh.coordinates[j] - mesh.coordinates[i];
    const std::array<double, 4> undeformed = corner_areas(a, b, edge),
                                now = corner_areas(a + da, b + db, edge + (u[j] - u[i]));
    for (std::size_t c = 0; c < 4; ++c)  // divides only to replace the smallest so far
      if (now[c] < d.jacobian * undeformed[c]) keep_smaller(now[c] / undeformed[c], e, d);
  }
  return d;
}

void LargestDeformation::add(const Deformation& now, double time) noexcept {
  if (now.strain > found.strain) {
    found.strain = now.strain;
    found.strain_cell = now.strain_cell;
    strain_time = time;
  }
  if (now.linear_strain > found.linear_strain) {
    found.linear_strain = now.linear_strain;
    found.linear_cell = now.linear_cell;
    linear_time = time;
  }
  if (now.jacobian < found.jacobian) {
    found.jacobian = now.jacobian;
    found.jacobian_cell = now.jacobian_cell;
    jacobian_time = time;
  }
}

}  // namespace rondo::fem
