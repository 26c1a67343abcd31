// SPDX-License-Identifier: BSD-3-Clause
/// @file  The numbers of a node in steady rolling, D = 2 in the plane and 3 in space. Forces, gaps
/// and slips of contact are along the axes of the ground: n, its normal; t1, the heading; in space
/// t2 as well, across the heading. All else is along the axes of the wheel.
#pragma once
#include <Eigen/Core>

#include "rondo/core/vec3.hpp"

namespace rondo::statics {

template <int D>
using NodeVector = Eigen::Matrix<double, D, 1>;
template <int D>
using NodeMatrix = Eigen::Matrix<double, D, D>;

inline NodeVector<2> node_vector(Vec2 a) noexcept {
  return {a.x, a.y};
}
inline NodeVector<3> node_vector(Vec3 a) noexcept {
  return {a.x, a.y, a.z};
}
inline Vec2 vec_of(const NodeVector<2>& a) noexcept {
  return {a[0], a[1]};
}
inline Vec3 vec_of(const NodeVector<3>& a) noexcept {
  return {a[0], a[1], a[2]};
}

/// J a: a quarter of a turn about the axle.
template <int D>
NodeVector<D> quarter_turned(const NodeVector<D>& a) noexcept {
  NodeVector<D> b = NodeVector<D>::Zero();
  b[0] = -a[1];
  b[1] = a[0];
  return b;
}

}  // namespace rondo::statics
