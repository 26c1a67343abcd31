// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/road/limited_slope.hpp"
#include "rondo/road/whole_heights.hpp"

namespace rondo::road {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Weights of the two ends of a stretch of length 1, with their derivatives: the height is
/// z_0 + rise (z_1 - z_0) + h (ease_0 d_0 + ease_1 d_1) with the slopes d.
struct Weights {
  double rise, ease_0, ease_1;
  double rise_1st, ease_0_1st, ease_1_1st;
  double rise_2nd, ease_0_2nd, ease_1_2nd;
};

Weights weights(double t) noexcept {
  const double r = 1.0 - t;
  return {t * t * (3.0 - 2.0 * t), t * r * r,      -t * t * r,    6.0 * t * r,  r * (1.0 - 3.0 * t),
          t * (3.0 * t - 2.0),     6.0 - 12.0 * t, 6.0 * t - 4.0, 6.0 * t - 2.0};
}

/// A function of t with two derivatives.
struct Jet {
  double value, first, second;
};

Jet hermite(const Weights& w, double from, double to, double slope_from, double slope_to) noexcept {
  const double d = to - from;
  return {from + w.rise * d + w.ease_0 * slope_from + w.ease_1 * slope_to,
          w.rise_1st * d + w.ease_0_1st * slope_from + w.ease_1_1st * slope_to,
          w.rise_2nd * d + w.ease_0_2nd * slope_from + w.ease_1_2nd * slope_to};
}

/// Without slopes at the ends.
Jet blend(const Weights& w, double from, double to) noexcept {
  const double d = to - from;
  return {from + w.rise * d, w.rise_1st * d, w.rise_2nd * d};
}

/// A stretch between two neighbouring points of a line.
struct Stretch {
  double secant, length;  ///< [-], [m]
};

/// The two stretches at each end of a line.
struct LineEnds {
  Stretch first, second, before_last, last;
};

struct EndSlopes {
  double first, last;
};

/// Slopes at the ends of a line: over the seam where the grid repeats, 0 where it is mirrored.
EndSlopes end_slopes(Border border, const LineEnds& ends) noexcept {
  if (border == Border::reflect) return {0.0, 0.0};
  if (border == Border::repeat) {
    const double slope =
        limited_slope(ends.last.secant, ends.last.length, ends.first.secant, ends.first.length);
    return {slope, slope};
  }
  const auto end_slope = [](const Stretch& last, const Stretch& next) {
    return limited_end_slope(last.secant, last.length, next.secant, next.length);
  };
  return {end_slope(ends.first, ends.second), end_slope(ends.last, ends.before_last)};
}

}  // namespace

Surface::Surface(const Road& road, const Edges& edges)
    : u_(road.u_first, road.u_step, road.n_u(), edges.u, edges.offset_u),
      v_(road.v, edges.v, edges.offset_v),
      edges_(edges),
      points_(road.heights.size()) {
  const std::vector<double> whole = whole_heights(road, edges);
  for (std::size_t k = 0; k < whole.size(); ++k) points_[k] = {whole[k], 0.0F, 0.0F};
  for (std::size_t i = 0; i < u_.size(); ++i) find_slopes_v(i);
  find_slopes_u();
}

void Surface::find_slopes_v(std::size_t i) {
  Point* const row = points_.data() + i * v_.size();
  const std::size_t last = v_.size() - 1;
  const auto stretch = [&](std::size_t j) {
    const double length = v_.position(j + 1) - v_.position(j);
    return Stretch{(row[j + 1].height - row[j].height) / length, length};
  };
  const EndSlopes ends = end_slopes(
      v_.border(),
      {stretch(0), stretch(last > 1 ? 1 : 0), stretch(last > 1 ? last - 2 : 0), stretch(last - 1)});
  row[0].slope_v = toward_zero(ends.first);
  row[last].slope_v = toward_zero(ends.last);
  for (std::size_t j = 1; j < last; ++j) {
    const Stretch before = stretch(j - 1), after = stretch(j);
    row[j].slope_v =
        toward_zero(limited_slope(before.secant, before.length, after.secant, after.length));
  }
}

void Surface::find_slopes_u() {
  const std::size_t last = u_.size() - 1, n_v = v_.size();
  const double h = u_.position(1) - u_.position(0);
  for (std::size_t j = 0; j < n_v; ++j) {
    const auto stretch = [&](std::size_t i) {
      return Stretch{(height_at(i + 1, j) - height_at(i, j)) / h, h};
    };
    const EndSlopes ends =
        end_slopes(u_.border(), {stretch(0), stretch(last > 1 ? 1 : 0),
                                 stretch(last > 1 ? last - 2 : 0), stretch(last - 1)});
    points_[j].slope_u = toward_zero(ends.first);
    points_[last * n_v + j].slope_u = toward_zero(ends.last);
  }
  for (std::size_t i = 1; i < last; ++i)
    for (std::size_t j = 0; j < n_v; ++j)
      points_[i * n_v + j].slope_u =
          toward_zero(limited_slope((height_at(i, j) - height_at(i - 1, j)) / h, h,
                                    (height_at(i + 1, j) - height_at(i, j)) / h, h));
}

/// Beyond a border that has no heights. The rule across the road is asked last, as in OpenCRG.
double Surface::outside_height(const AxisPlace& u, const AxisPlace& v) const noexcept {
  if ((u.outside && edges_.u != Border::zero) || (v.outside && edges_.v != Border::zero))
    return not_a_number;
  if (v.outside) return edges_.offset_v;
  return edges_.offset_u + v.offset;
}

double Surface::bilinear(double u, double v) const noexcept {
  const AxisPlace pu = u_.locate(u), pv = v_.locate(v);
  if (pu.outside || pv.outside) return outside_height(pu, pv);
  const Point* const here = points_.data() + pu.cell * v_.size() + pv.cell;
  const Point* const next = here + v_.size();
  const double s = pu.fraction, t = pv.fraction;
  // A corner without weight may be missing.
  const auto along = [](double from, double to, double x) {
    return x == 0.0 ? from : x == 1.0 ? to : from + x * (to - from);
  };
  return along(along(here[0].height, here[1].height, t), along(next[0].height, next[1].height, t),
               s) +
         pu.offset + pv.offset;
}

double Surface::bound(double u, double v) const noexcept {
  const AxisPlace pu = u_.locate(u), pv = v_.locate(v);
  if (pu.outside || pv.outside) return outside_height(pu, pv);
  const Point* const here = points_.data() + pu.cell * v_.size() + pv.cell;
  const Point* const next = here + v_.size();
  const double highest =
      std::max(std::max(here[0].height, here[1].height), std::max(next[0].height, next[1].height));
  return highest + pu.offset + pv.offset;
}

SurfacePoint Surface::at(double u, double v) const noexcept {
  const AxisPlace pu = u_.locate(u), pv = v_.locate(v);
  if (pu.outside || pv.outside) return {.height = outside_height(pu, pv)};
  const Point* const p = points_.data() + pu.cell * v_.size() + pv.cell;
  const Point* const q = p + v_.size();
  const double hu = pu.width, hv = pv.width;
  const Weights s = weights(pu.fraction), t = weights(pv.fraction);
  // The two sides of the patch along v, and the slopes along u on them.
  const Jet a = hermite(t, p[0].height, p[1].height, hv * static_cast<double>(p[0].slope_v),
                        hv * static_cast<double>(p[1].slope_v));
  const Jet b = hermite(t, q[0].height, q[1].height, hv * static_cast<double>(q[0].slope_v),
                        hv * static_cast<double>(q[1].slope_v));
  const Jet da =
      blend(t, hu * static_cast<double>(p[0].slope_u), hu * static_cast<double>(p[1].slope_u));
  const Jet db =
      blend(t, hu * static_cast<double>(q[0].slope_u), hu * static_cast<double>(q[1].slope_u));
  const Jet height = hermite(s, a.value, b.value, da.value, db.value);
  const Jet by_v = hermite(s, a.first, b.first, da.first, db.first);
  const double by_vv = hermite(s, a.second, b.second, da.second, db.second).value;
  const double per_u = pu.direction / hu, per_v = pv.direction / hv;
  return {.height = height.value + pu.offset + pv.offset,
          .slope_u = height.first * per_u,
          .slope_v = by_v.value * per_v,
          .bend_uu = height.second * per_u * per_u,
          .bend_uv = by_v.first * per_u * per_v,
          .bend_vv = by_vv * per_v * per_v};
}

}  // namespace rondo::road
