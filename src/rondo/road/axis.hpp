// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where a coordinate lies in the cells of a line of grid positions, and what it means
/// beyond their ends.
#pragma once
#include <cstdint>
#include <vector>

#include "rondo/road/road.hpp"

namespace rondo::road {

/// A place on an axis.
struct AxisPlace {
  std::size_t cell = 0;   ///< between the positions cell and cell + 1
  double fraction = 0.0;  ///< from 0 to 1 within the cell                              [-]
  double width = 1.0;     ///< of the cell                                              [m]
  double direction =
      1.0;  ///< slope of the place by the coordinate: 1; -1 where mirrored; 0 where kept
  double offset = 0.0;   ///< to be added to the height                                [m]
  bool outside = false;  ///< beyond an end where the border is zero or none
};

/// Positions with one distance are found by arithmetic, others by a table of equal steps. Both take
/// a few nanoseconds and allocate nothing.
class Axis {
 public:
  /// @param positions (n >= 2) ascending [m]
  Axis(const std::vector<double>& positions, Border border, double offset);
  /// n positions with one distance. @pre n >= 2, step > 0 [m]
  Axis(double first, double step, std::size_t n, Border border, double offset);

  [[nodiscard]] AxisPlace locate(double x) const noexcept;
  [[nodiscard]] double first() const noexcept { return first_; }
  [[nodiscard]] double last() const noexcept { return last_; }
  [[nodiscard]] Border border() const noexcept { return border_; }
  /// Position of a grid point. @pre i < size()
  [[nodiscard]] double position(std::size_t i) const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return cells_ + 1; }
  [[nodiscard]] bool even() const noexcept { return positions_.empty(); }

 private:
  [[nodiscard]] AxisPlace within(double x) const noexcept;
  [[nodiscard]] AxisPlace beyond(double x) const noexcept;
  void make_table();

  double first_, last_, step_;  ///< step_: of the positions, or of the table        [m]
  double per_step_;             ///< its inverse                                     [1/m]
  std::size_t cells_;
  Border border_;
  double offset_;                     ///< [m]
  std::vector<double> positions_;     ///< empty: they have one distance
  std::vector<std::uint32_t> table_;  ///< the cell at the beginning of each step
};

}  // namespace rondo::road
