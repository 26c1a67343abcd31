// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/finite/cord_face.hpp"

#include <cmath>
#include <cstddef>

#include "rondo/fem/finite/face_points.hpp"

namespace rondo::fem::finite {

std::array<CordPoint, 4> cord_points(const FaceCorners& x, const std::array<double, 4>& angle,
                                     const std::array<double, 4>& spacing) noexcept {
  std::array<CordPoint, 4> points;
  for (std::size_t q = 0; q < 4; ++q) {
    const FacePoint p = face_point(x, q);
    const Vec3 around = p.across / norm(p.across);
    const Vec3 rest = p.along - dot(p.along, around) * around;
    const double reach = norm(rest);
    // d = cos(angle) around + sin(angle) rest/|rest| = a along + b across
    const double a = std::sin(angle[q]) / reach;
    const double b = (std::cos(angle[q]) - a * dot(p.along, around)) / norm(p.across);
    for (std::size_t c = 0; c < 4; ++c)
      points[q].slope[c] = a * p.slope_along[c] + b * p.slope_across[c];
    points[q].length = norm(cross(p.along, p.across)) / spacing[q];
  }
  return points;
}

CordState cord_state(const CordPoint& point, const FaceCorners& x, const CordLaw& law) noexcept {
  Vec3 y;
  for (std::size_t c = 0; c < 4; ++c) y += point.slope[c] * x[c];
  CordState s;
  s.stretch = norm(y);
  s.along = y / s.stretch;
  const double strain = s.stretch - 1.0 + law.prestrain;
  s.force = law.stiffness * (strain < 0.0 ? law.compression : 1.0) * strain;
  return s;
}

FaceForce cord_force(std::span<const CordPoint, 4> points, const FaceCorners& x,
                     const CordLaw& law) noexcept {
  FaceForce out;
  for (const CordPoint& p : points) {
    const CordState s = cord_state(p, x, law);
    out.energy += 0.5 * p.length * s.force * (s.stretch - 1.0 + law.prestrain);
    for (std::size_t a = 0; a < 4; ++a) out.force[a] += p.length * s.force * p.slope[a] * s.along;
  }
  return out;
}

Energy<4> cord_face(std::span<const CordPoint, 4> points, const FaceCorners& x,
                    const CordLaw& law) noexcept {
  const FaceForce first = cord_force(points, x, law);
  Energy<4> out;
  out.value = first.energy;
  for (std::size_t a = 0; a < 4; ++a)
    out.force.segment<3>(static_cast<Eigen::Index>(3 * a)) << first.force[a].x, first.force[a].y,
        first.force[a].z;
  for (const CordPoint& p : points) {
    const CordState s = cord_state(p, x, law);
    const double stiffness = law.stiffness * (s.force < 0.0 ? law.compression : 1.0);
    const Eigen::Vector3d n(s.along.x, s.along.y, s.along.z);
    const double turns = s.force / s.stretch;  // what a force resists turning by
    const Eigen::Matrix3d k =
        p.length * ((stiffness - turns) * n * n.transpose() + turns * Eigen::Matrix3d::Identity());
    for (Eigen::Index a = 0; a < 4; ++a)
      for (Eigen::Index b = 0; b < 4; ++b)
        out.stiffness.block<3, 3>(3 * a, 3 * b) +=
            p.slope[static_cast<std::size_t>(a)] * p.slope[static_cast<std::size_t>(b)] * k;
  }
  return out;
}

}  // namespace rondo::fem::finite
