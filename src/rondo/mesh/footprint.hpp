// SPDX-License-Identifier: BSD-3-Clause
/// @file  The footprint of a wheel in three dimensions: the rectangle along its heading t1 and
/// across along t2 that holds places of its surface, gaps between them included.
#pragma once
#include <algorithm>
#include <limits>

#include "rondo/core/ground_frame.hpp"

namespace rondo::mesh {

class Footprint {
 public:
  /// @param ground its axes are those of the rectangle
  /// @param rotation from the frame in which places are given to the axes of the wheel
  Footprint(const GroundFrame& ground, Complex rotation) noexcept
      : ground_(ground), rotation_(rotation) {}

  /// Widens the rectangle. @param arm from the center [m]
  void include(Vec3 arm) noexcept {
    const Vec3 place = ground_.from_wheel(rotation_ * arm);
    along_.include(place.x);
    across_.include(place.z);
  }
  /// Along t1 [m]; 0: nothing is included.
  [[nodiscard]] double length() const noexcept { return along_.size(); }
  /// Along t2 [m]; 0: nothing is included.
  [[nodiscard]] double width() const noexcept { return across_.size(); }

 private:
  struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void include(double place) noexcept {
      low = std::min(low, place);
      high = std::max(high, place);
    }
    [[nodiscard]] double size() const noexcept { return std::max(0.0, high - low); }
  };

  GroundFrame ground_;
  Complex rotation_;
  Range along_, across_;
};

}  // namespace rondo::mesh
