// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the elements of a wheel at finite strain give: an energy and its derivatives.
#pragma once
#include <Eigen/Core>

namespace rondo::fem::finite {

/// Component c of corner i is number 3i + c.
template <int Corners>
struct Energy {
  static constexpr int size = 3 * Corners;
  double value = 0.0;                                                       ///< [J]
  Eigen::Vector<double, size> force = Eigen::Vector<double, size>::Zero();  ///< its gradient [N]
  Eigen::Matrix<double, size, size> stiffness =
      Eigen::Matrix<double, size, size>::Zero();  ///< and its second derivatives [N/m]
};

}  // namespace rondo::fem::finite
