// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/finite/enclosed_volume.hpp"

#include <array>
#include <cstddef>

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

/// The corners of FacePoint.
constexpr std::array<double, 4> xi{-1.0, 1.0, 1.0, -1.0}, eta{-1.0, -1.0, 1.0, 1.0};

/// The middle of a face, and ∂x/∂ξ, ∂x/∂η there.
struct Middle {
  explicit Middle(const std::array<Vec3, 4>& x) noexcept {
    for (std::size_t a = 0; a < 4; ++a) {
      place += 0.25 * x[a];
      along += 0.25 * xi[a] * x[a];
      across += 0.25 * eta[a] * x[a];
    }
  }
  Vec3 place, along, across;
};

}  // namespace

/// With x = m + a ξ + c η + d ξη the volume is 4/3 m·(a × c): d drops out of the integral.
FaceForce cone_force(const std::array<Vec3, 4>& x) noexcept {
  const Middle mid(x);
  const Vec3 by_middle = cross(mid.along, mid.across), by_along = cross(mid.across, mid.place),
             by_across = cross(mid.place, mid.along);
  FaceForce out;
  out.energy = 4.0 / 3.0 * dot(mid.place, by_middle);
  for (std::size_t a = 0; a < 4; ++a)
    out.force[a] = (by_middle + xi[a] * by_along + eta[a] * by_across) / 3.0;
  return out;
}

Energy<4> cone_volume(const std::array<Vec3, 4>& x) noexcept {
  const FaceForce first = cone_force(x);
  const Middle mid(x);
  const Eigen::Matrix3d place = cross_by(mid.place), along = cross_by(mid.along),
                        across = cross_by(mid.across);
  Energy<4> out;
  out.value = first.energy;
  for (std::size_t a = 0; a < 4; ++a) {
    const auto row = static_cast<Eigen::Index>(3 * a);
    out.force.segment<3>(row) = vector_of(first.force[a]);
    // ∂(a × c) = a × ∂c - c × ∂a, and so on.
    for (std::size_t b = 0; b < 4; ++b)
      out.stiffness.block<3, 3>(row, static_cast<Eigen::Index>(3 * b)) =
          ((eta[b] - eta[a]) * along + (xi[a] - xi[b]) * across +
           (eta[a] * xi[b] - xi[a] * eta[b]) * place) /
          12.0;
  }
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
