// SPDX-License-Identifier: BSD-3-Clause
/// @file  Cords and air of a whole wheel of equal sectors about a state: the forces that a
/// displacement from there changes, without any linearisation, for steps in time (docs/tyre.md).
#pragma once
#include <array>
#include <span>
#include <vector>

#include "rondo/core/vec3.hpp"
#include "rondo/fem/finite/cord_face.hpp"
#include "rondo/fem/finite/swept_section.hpp"
#include "rondo/fem/finite/take_block.hpp"

namespace rondo::fem::finite {

/// A layer of cords: its lines, and the points of each.
struct SweptCords {
  CordLaw law;
  Curve lines;
  std::vector<std::array<CordPoint, 4>> points;
};

/// Those of one sector, by the nodes of the section.
struct SweptFaces {
  std::vector<SweptCords> cords;
  Curve liner;            ///< in the direction in which its faces look away from the air
  double pressure = 0.0;  ///< of the air [Pa]
};

class SweptForces {
 public:
  /// @param x (n of the wheel) places of the nodes in the state, sector by sector [m]
  SweptForces(SweptFaces faces, std::vector<Vec3> x, int n_sectors);

  /// Adds f(x + u) - f(x), the gradient of the energy, to `force`.
  /// @return E(x + u) - E(x) - f(x)·u, of cords and air [J]
  double add_to(std::span<const Vec3> u, std::span<Vec3> force) const noexcept;
  /// Hands on the stiffness at x + u.
  void tangent(std::span<const Vec3> u, const TakeBlock& take) const;

 private:
  /// The nodes of a line's face in a column.
  [[nodiscard]] std::array<std::size_t, 4> nodes(const std::array<int, 2>& line,
                                                 std::size_t column) const noexcept;
  /// @return the energy
  double find(std::span<const Vec3> u, std::span<Vec3> force) const noexcept;

  SweptFaces faces_;
  std::vector<Vec3> x_;
  std::size_t n_sectors_;
  std::vector<Vec3> of_state_;    ///< (n) f(x)                                             [N]
  double energy_of_state_ = 0.0;  ///< E(x)                                              [J]
};

}  // namespace rondo::fem::finite
