// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/solid/face.hpp"

#include <cmath>

namespace rondo::mesh {

std::array<Vec3, 4> face_shares(const std::array<Vec3, 4>& x) noexcept {
  constexpr std::array<Vec2, 4> corner{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const double gauss = 1.0 / std::sqrt(3.0);
  std::array<Vec3, 4> share{};
  for (const Vec2 point : corner) {
    const Vec2 xi = gauss * point;
    Vec3 along_xi, along_eta;
    for (std::size_t i = 0; i < 4; ++i) {
      along_xi += 0.25 * corner[i].x * (1 + corner[i].y * xi.y) * x[i];
      along_eta += 0.25 * corner[i].y * (1 + corner[i].x * xi.x) * x[i];
    }
    const Vec3 normal = cross(along_xi, along_eta);  // with unit weight at each of 2×2 points
    for (std::size_t i = 0; i < 4; ++i)
      share[i] += 0.25 * (1 + corner[i].x * xi.x) * (1 + corner[i].y * xi.y) * normal;
  }
  return share;
}

}  // namespace rondo::mesh
