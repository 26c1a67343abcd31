// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/finite/enclosed_volume.hpp"

#include <cstddef>

#include "rondo/fem/finite/face_points.hpp"

namespace rondo::fem::finite {
namespace {

Eigen::Vector3d vector_of(Vec3 v) {
  return {v.x, v.y, v.z};
}

/// v ↦ a × v
Eigen::Matrix3d cross_by(Vec3 a) {
  Eigen::Matrix3d m;
  m << 0.0, -a.z, a.y, a.z, 0.0, -a.x, -a.y, a.x, 0.0;
  return m;
}

}  // namespace

Energy<4> cone_volume(const std::array<Vec3, 4>& x) noexcept {
  Energy<4> out;
  for (std::size_t q = 0; q < 4; ++q) {
    const FacePoint p = face_point(x, q);
    // det(x, x₁, x₂): its derivatives by the three are cross products.
    const Vec3 by_place = cross(p.along, p.across), by_along = cross(p.across, p.place),
               by_across = cross(p.place, p.along);
    out.value += dot(p.place, by_place) / 3.0;
    const Eigen::Matrix3d place = cross_by(p.place), along = cross_by(p.along),
                          across = cross_by(p.across);
    for (std::size_t a = 0; a < 4; ++a) {
      const auto row = static_cast<Eigen::Index>(3 * a);
      out.force.segment<3>(row) += vector_of(p.shape[a] * by_place + p.slope_along[a] * by_along +
                                             p.slope_across[a] * by_across) /
                                   3.0;
      for (std::size_t b = 0; b < 4; ++b) {
        // ∂(x₁ × x₂) = x₁ × ∂x₂ - x₂ × ∂x₁, and so on.
        const double pa = p.shape[a] * p.slope_across[b] - p.slope_across[a] * p.shape[b],
                     pl = p.slope_along[a] * p.shape[b] - p.shape[a] * p.slope_along[b],
                     ac = p.slope_across[a] * p.slope_along[b] -
                          p.slope_along[a] * p.slope_across[b];
        out.stiffness.block<3, 3>(row, static_cast<Eigen::Index>(3 * b)) +=
            (pa * along + pl * across + ac * place) / 3.0;
      }
    }
  }
  return out;
}

/// With x = m + a ξ + c η + d ξη the volume is 4/3 m·(a × c): d drops out of the integral.
FaceForce cone_force(const std::array<Vec3, 4>& x) noexcept {
  const Vec3 middle = 0.25 * (x[0] + x[1] + x[2] + x[3]),
             along = 0.25 * (x[1] + x[2] - x[0] - x[3]),
             across = 0.25 * (x[2] + x[3] - x[0] - x[1]);
  const Vec3 by_middle = cross(along, across), by_along = cross(across, middle),
             by_across = cross(middle, along);
  constexpr std::array<double, 4> xi{-1.0, 1.0, 1.0, -1.0}, eta{-1.0, -1.0, 1.0, 1.0};
  FaceForce out;
  out.energy = 4.0 / 3.0 * dot(middle, by_middle);
  for (std::size_t a = 0; a < 4; ++a)
    out.force[a] = (by_middle + xi[a] * by_along + eta[a] * by_across) / 3.0;
  return out;
}

Energy<2> cap_volume(Vec3 here, Vec3 next, double outward) noexcept {
  // (z + z')(x y' - y x')/12, the mean height times the triangle's area over 3
  const double factor = outward / 12.0, height = here.z + next.z,
               area = here.x * next.y - here.y * next.x;
  Eigen::Vector<double, 6> by_height, by_area;
  by_height << 0.0, 0.0, 1.0, 0.0, 0.0, 1.0;
  by_area << next.y, -next.x, 0.0, -here.y, here.x, 0.0;
  Energy<2> out;
  out.value = factor * height * area;
  out.force = factor * (area * by_height + height * by_area);
  Eigen::Matrix<double, 6, 6> bend = Eigen::Matrix<double, 6, 6>::Zero();
  bend(0, 4) = bend(4, 0) = 1.0;
  bend(1, 3) = bend(3, 1) = -1.0;
  out.stiffness =
      factor * (by_height * by_area.transpose() + by_area * by_height.transpose() + height * bend);
  return out;
}

}  // namespace rondo::fem::finite
