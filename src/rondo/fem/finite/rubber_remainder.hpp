// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the forces of the rubber of a wheel of equal sectors have beyond those that are
/// linear about a state, f(x + u) - f(x) - K u, element by element: of all columns, or of those
/// near the ground alone (docs/tyre.md).
#pragma once
#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/fem/finite/swept_rubber.hpp"
#include "rondo/fem/finite/take_block.hpp"

namespace rondo::fem::finite {

class RubberRemainder {
 public:
  /// @param turn (n_sectors) from the axes of sector 0 to those of each: sector 0 is the lowest
  RubberRemainder(SweptRubber rubber, std::vector<Complex> turn);

  /// Adds the weighted remainders to `force`.
  /// @param u, force (n of the wheel), sector by sector
  /// @param weight (n_sectors) of the columns; what has none is left out
  /// @param energy (n_sectors) E(x + u) - E(x) - f(x)·u - ½ u·Ku of each column that has a weight,
  /// without that weight; else 0 [J]
  void add_to(std::span<const Vec3> u, std::span<const double> weight, std::span<Vec3> force,
              std::span<double> energy) const noexcept;
  /// Hands on the weighted derivative of the remainders at u. An element that is turned inside out
  /// has none.
  void tangent(std::span<const Vec3> u, std::span<const double> weight,
               const TakeBlock& take) const;

 private:
  /// An element in its column: nodes of its corners, and their displacements from the state and
  /// from the undeformed shape, in the frame of the sector.
  struct Placed {
    std::array<std::size_t, 8> node;
    HexahedronCorners more, all;
  };
  [[nodiscard]] Placed placed(std::size_t e, std::size_t column,
                              std::span<const Vec3> u) const noexcept;

  struct State {
    double energy = 0.0;
    Eigen::Vector<double, 24> force;
    Eigen::Matrix<double, 24, 24> stiffness;
    HexahedronCorners u;
  };
  double add_element(std::size_t e, std::size_t column, std::span<const Vec3> u, double weight,
                     std::span<Vec3> force) const noexcept;

  SweptRubber rubber_;
  std::vector<Complex> axes_;  ///< (n_sectors) from the frame of a sector to the wheel's axes
  std::vector<State> state_;   ///< (elements)
};

}  // namespace rondo::fem::finite
