// SPDX-License-Identifier: BSD-3-Clause
/// @file  The surface of a road: bilinear between the points of the grid, as OpenCRG defines
/// heights, and for contact a surface with continuous slopes through the same points
/// (docs/roads.md). Bicubic Hermite patches without mixed derivatives at the points; slopes by
/// limited_slope.hpp, so that a patch stays between its four corners. A bilinear patch is met but
/// for 1 % of its twist z_00 - z_01 - z_10 + z_11.
#pragma once
#include <vector>

#include "rondo/road/axis.hpp"
#include "rondo/road/road.hpp"

namespace rondo::road {

/// Height of the smooth surface with its derivatives by u and v.
struct SurfacePoint {
  double height = 0.0;                                 ///< [m]
  double slope_u = 0.0, slope_v = 0.0;                 ///< [-]
  double bend_uu = 0.0, bend_uv = 0.0, bend_vv = 0.0;  ///< second derivatives          [1/m]
};

/// Beyond the grid the edges rule. Slopes are continuous within the grid, at mirrored borders, and
/// at repeated ones if the grid ends with the heights it begins with. Kept heights leave the grid
/// with a kink along the direction that leaves it, and zero with a step. Memory: 16 bytes for each
/// point of the grid (heights double, slopes in single precision, which is less than 4e-8 of a
/// slope times the width of a cell).
class Surface {
 public:
  /// @throws std::bad_alloc
  Surface(const Road& road, const Edges& edges);
  /// With the edges that the file asks for.
  explicit Surface(const Road& road) : Surface(road, road.edges) {}

  /// Height [m] by bilinear interpolation; not a number where the road has no height.
  [[nodiscard]] double bilinear(double u, double v) const noexcept;
  /// The smooth surface. Not a number: as bilinear().
  [[nodiscard]] SurfacePoint at(double u, double v) const noexcept;
  /// The highest corner of the patch at a place, above which the smooth surface does not rise there
  /// [m]; not a number: as bilinear().
  [[nodiscard]] double bound(double u, double v) const noexcept;

  [[nodiscard]] const Axis& u_axis() const noexcept { return u_; }
  [[nodiscard]] const Axis& v_axis() const noexcept { return v_; }
  [[nodiscard]] const Edges& edges() const noexcept { return edges_; }
  /// Height at a point of the grid [m].
  [[nodiscard]] double height_at(std::size_t i, std::size_t j) const noexcept {
    return points_[i * v_.size() + j].height;
  }
  /// Slopes along u and v at a point of the grid [-].
  struct GridSlopes {
    double u, v;
  };
  [[nodiscard]] GridSlopes slopes_at(std::size_t i, std::size_t j) const noexcept {
    const Point& p = points_[i * v_.size() + j];
    return {static_cast<double>(p.slope_u), static_cast<double>(p.slope_v)};
  }

 private:
  struct Point {
    double height;           ///< [m]
    float slope_u, slope_v;  ///< [-]
  };
  void find_slopes_v(std::size_t i);
  void find_slopes_u();
  [[nodiscard]] double outside_height(const AxisPlace& u, const AxisPlace& v) const noexcept;

  Axis u_, v_;
  Edges edges_;
  std::vector<Point> points_;  ///< (n_u, n_v)
};

}  // namespace rondo::road
