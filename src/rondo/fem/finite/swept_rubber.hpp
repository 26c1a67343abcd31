// SPDX-License-Identifier: BSD-3-Clause
/// @file  Rubber of a wheel of equal sectors about a state at finite strain, and the window of its
/// columns in which it is not linear about that state (docs/tyre.md).
#pragma once
#include <array>
#include <span>
#include <vector>

#include "rondo/core/vec3.hpp"
#include "rondo/fem/rubber.hpp"
#include "rondo/fem/solid/hexahedron.hpp"

namespace rondo::fem::finite {

/// Rubber of one sector in a state, in the frame of the sector: outwards, around, along the axle.
struct SweptRubber {
  std::vector<std::array<int, 4>> corner;  ///< nodes of the section at an element's first side
  std::vector<HexahedronPoints> points;    ///< of its undeformed shape
  std::vector<int> rubber;                 ///< of each element
  std::vector<Rubber> rubbers;
  std::vector<Vec3> u;  ///< (n of the section) from the undeformed shape to the state [m]
};

/// How much of its remainder the rubber of each column of elements has. Column j is between the
/// sectors j and j + 1.
struct ColumnWindow {
  double half = 0.0;  ///< to each side of the lowest point [rad]; more than π: all columns have 1
  /// 1 up to `half`, and smoothly down to 0 over so much more [rad].
  static constexpr double fade = 0.1;

  [[nodiscard]] bool is_whole() const noexcept;
  /// @param angle by which the wheel has turned [rad]. @param weight (columns)
  void find(double angle, std::span<double> weight) const noexcept;
};

}  // namespace rondo::fem::finite
