// SPDX-License-Identifier: BSD-3-Clause
/// @file  A measured road: heights over a grid along a reference line, as a curved regular grid of
/// ASAM OpenCRG describes it (docs/roads.md). u is the length along the reference line, v the
/// distance from it to the left. Source: ASAM OpenCRG 1.2.0, sections 6.1 and 6.4.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace rondo::road {

/// What the height is beyond an end (along u) or an edge (along v) of the grid. The numbers are
/// those of BORDER_MODE_U and BORDER_MODE_V.
enum class Border : int {
  none = 0,     ///< no road: the height is not a number
  zero = 1,     ///< the offset of the border
  keep = 2,     ///< the height at the border, and the offset
  repeat = 3,   ///< the grid once more
  reflect = 4,  ///< the grid mirrored
};

/// The rules beyond the grid, in both directions.
struct Edges {
  Border u = Border::keep;
  Border v = Border::keep;
  double offset_u = 0.0;  ///< added beyond the ends where the border is zero or keep   [m]
  double offset_v = 0.0;  ///< added beyond the edges where the border is zero or keep  [m]
};

/// What stands for missing heights between the last valid one and the edge. The numbers are those
/// of GRID_NAN_MODE.
enum class Missing : int {
  keep = 0,  ///< nothing: they are outside of the road, where the border along v rules
  zero = 1,  ///< the offset
  last = 2,  ///< the last valid height of the row, and the offset
};

/// The height above (u, v) is the one of the grid, plus that of the reference line, plus banking
/// times v.
struct Road {
  std::string file;                 ///< the file that holds the heights
  std::string format;               ///< LRFI, LDFI, KRBI or KDBI
  double u_first = 0.0;             ///< u of the first row                             [m]
  double u_step = 0.0;              ///< distance of two rows, > 0                      [m]
  std::vector<double> v;            ///< (n_v >= 2) ascending                           [m]
  std::vector<double> heights;      ///< (n_u >= 2, n_v) row by row, NaN where missing  [m]
  std::vector<double> line_height;  ///< (n_u) of the reference line, by its slope      [m]
  std::vector<double> slope;        ///< (n_u) of the stretch before each row, the first unused;
                                    ///<   (1) one for all                              [-]
  std::vector<double> banking;      ///< (n_u) or (1) one for all                       [-]
  std::vector<double> heading;      ///< (n_u) or (1), as in the file: not felt         [rad]
  Missing missing = Missing::last;
  double missing_offset = 0.0;     ///< [m]
  Edges edges;                     ///< as the options of the file ask for them
  std::vector<std::string> notes;  ///< whole sentences: what the reader left out or mended

  [[nodiscard]] std::size_t n_u() const noexcept {
    return v.empty() ? 0 : heights.size() / v.size();
  }
  [[nodiscard]] std::size_t n_v() const noexcept { return v.size(); }
  [[nodiscard]] double u_last() const noexcept {
    return u_first + static_cast<double>(n_u() - 1) * u_step;
  }
};

}  // namespace rondo::road
