// SPDX-License-Identifier: BSD-3-Clause
/// @file  The 2×2 points of a bilinear face in space, whose weights are 1.
#pragma once
#include <array>
#include <cstddef>

#include "rondo/core/vec3.hpp"

namespace rondo::fem::finite {

/// Place and tangents at a point. Corners are at (ξ, η) = (-1, -1), (1, -1), (1, 1), (-1, 1).
struct FacePoint {
  Vec3 place, along, across;  ///< x, ∂x/∂ξ, ∂x/∂η [m]
  std::array<double, 4> shape{}, slope_along{}, slope_across{};
};

inline FacePoint face_point(const std::array<Vec3, 4>& x, std::size_t q) noexcept {
  constexpr double gauss = 0.57735026918962576451;  // 1/√3
  constexpr std::array<double, 4> xi{-1.0, 1.0, 1.0, -1.0}, eta{-1.0, -1.0, 1.0, 1.0};
  FacePoint p;
  for (std::size_t a = 0; a < 4; ++a) {
    const double u = 1.0 + gauss * xi[q] * xi[a], v = 1.0 + gauss * eta[q] * eta[a];
    p.shape[a] = 0.25 * u * v;
    p.slope_along[a] = 0.25 * xi[a] * v;
    p.slope_across[a] = 0.25 * eta[a] * u;
    p.place += p.shape[a] * x[a];
    p.along += p.slope_along[a] * x[a];
    p.across += p.slope_across[a] * x[a];
  }
  return p;
}

}  // namespace rondo::fem::finite
