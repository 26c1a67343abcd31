// SPDX-License-Identifier: BSD-3-Clause
/// @file  How the tangents of a whole wheel are handed on, block by block.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <functional>

#include "rondo/core/complex.hpp"

namespace rondo::fem::finite {

/// Takes what a node's displacement adds to the force on another, in the axes of the wheel [N/m].
using TakeBlock = std::function<void(std::size_t force, std::size_t move, const Eigen::Matrix3d&)>;

/// From axes that are turned about the axle to those of the wheel.
inline Eigen::Matrix3d about_axle(Complex turn) {
  Eigen::Matrix3d m;
  m << turn.re, -turn.im, 0.0, turn.im, turn.re, 0.0, 0.0, 0.0, 1.0;
  return m;
}

}  // namespace rondo::fem::finite
