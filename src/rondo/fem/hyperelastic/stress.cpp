// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/hyperelastic/stress.hpp"

#include <limits>

#include "rondo/fem/hyperelastic/quadrilateral.hpp"

namespace rondo::fem::hyperelastic {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

Corners<double> corners_of(const std::array<Vec2, 4>& v) noexcept {
  Corners<double> corners;
  for (std::size_t a = 0; a < corners.size(); ++a) corners[a] = {v[a].x, v[a].y};
  return corners;
}

/// J⁻¹ P Fᵀ = a/J F Fᵀ + b. An isochoric stress has no trace, which gives the out-of-plane stress.
Stress isochoric(const Rubber& rubber, const PointState<double>& at) noexcept {
  const double j = 1.0 + at.j_less_1;
  if (!(j > 0.0)) return {none, none, none, none};
  const PlaneStress<double> law = isochoric_stress(rubber, at.s, j);
  const Gradient<double>& f = at.f;
  const double a = law.a / j;
  const double xx = a * (f.x.x * f.x.x + f.y.x * f.y.x) + law.b;
  const double yy = a * (f.x.y * f.x.y + f.y.y * f.y.y) + law.b;
  return {xx, yy, -(xx + yy), a * (f.x.x * f.x.y + f.y.x * f.y.y)};
}

void add_pressure(double pressure, Stress& stress) noexcept {
  for (std::size_t k = 0; k < 3; ++k) stress[k] += pressure;
}

std::array<Stress, 4> of_one_point(const Rubber& rubber, const Center& center,
                                   const std::array<double, 4>& pressure) noexcept {
  const double s = dot(center.f.x, center.f.x) + dot(center.f.y, center.f.y);
  std::array<Stress, 4> stress{};
  stress.fill(isochoric(rubber, {center.f, center.j_less_1, s}));
  for (std::size_t a = 0; a < 4; ++a) add_pressure(pressure[a], stress[a]);
  return stress;
}

std::array<Stress, 4> of_four_points(const Rubber& rubber, const DeformedCell& cell) noexcept {
  const Bilinear<double> x = bilinear(corners_of(cell.x)), u = bilinear(corners_of(cell.u));
  std::array<Stress, 4> at_points;
  double area = 0.0, change = 0.0;
  for (std::size_t q = 0; q < 4; ++q) {
    const auto& [xi, eta] = points[q];
    const Gradient<double> g = local_gradient(x, xi, eta);
    const double weight = cross(g.x, g.y);
    const PointState<double> at = point_state(g, local_gradient(u, xi, eta), 1.0 / weight);
    at_points[q] = isochoric(rubber, at);
    area += weight;
    change += weight * at.j_less_1;
  }
  for (Stress& stress : at_points) add_pressure(pressure_of(rubber, change / area), stress);
  return extrapolated(at_points);
}

}  // namespace

double pressure_of(const Rubber& rubber, double j_less_1) noexcept {
  return j_less_1 > -1.0 ? volumetric(rubber.bulk_modulus, j_less_1).pressure : none;
}

std::array<Stress, 4> corner_stress(const Rubber& rubber, const DeformedCell& cell,
                                    const std::array<double, 4>& pressure) noexcept {
  if (cell.n_corners == 4 && !rubber.one_point) return of_four_points(rubber, cell);
  const Center center = center_of(cell);
  if (cell.n_corners == 3) return of_one_point(rubber, center, pressure);
  const double mean = pressure_of(rubber, center.j_less_1);
  return of_one_point(rubber, center, {mean, mean, mean, mean});
}

}  // namespace rondo::fem::hyperelastic
