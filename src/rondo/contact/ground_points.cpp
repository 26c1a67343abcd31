// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "rondo/contact/ground.hpp"
#include "rondo/core/complex.hpp"
#include "rondo/core/contract.hpp"

namespace rondo::contact {

Vec2 Ground::point_of(const Facet& f, double along) noexcept {
  if (f.radius == 0.0) return f.begin + along * f.tangent;
  return f.center + f.radius * (rotation(-along / f.radius) * f.normal);
}

std::pair<double, double> Ground::within(const Facet& f, Vec2 low, Vec2 high) {
  double from = f.from, to = f.to;
  if (f.radius > 0.0) {  // an arc of half a circle at most is no longer than π/2 times its chord
    const double size = norm(high - low);
    const Projection middle = project(f, 0.5 * (low + high));
    if (middle.distance > 0.5 * size) return {0.0, -1.0};
    return {std::max(from, middle.along - 1.6 * size), std::min(to, middle.along + 1.6 * size)};
  }
  const auto clip = [&](double begin, double rate, double least, double most) {
    if (rate == 0.0) {
      if (begin < least || begin > most) to = -std::numeric_limits<double>::infinity();
      return;
    }
    const auto [first, last] = std::minmax({(least - begin) / rate, (most - begin) / rate});
    from = std::max(from, first);
    to = std::min(to, last);
  };
  clip(f.begin.x, f.tangent.x, low.x, high.x);
  clip(f.begin.y, f.tangent.y, low.y, high.y);
  return {from, to};
}

std::vector<Vec2> Ground::surface_points(Vec2 low, Vec2 high, double spacing) const {
  RONDO_DEMAND(spacing > 0.0, spacing);
  std::vector<Vec2> points;
  const auto first = std::ranges::lower_bound(begins_, low.x);
  for (auto k =
           static_cast<std::size_t>(first - begins_.begin()) - (first == begins_.begin() ? 0 : 1);
       k < facets_.size() && begins_[k] <= high.x; ++k) {
    const auto [from, to] = within(facets_[k], low, high);
    if (!(from <= to)) continue;
    const auto n = static_cast<std::size_t>(std::ceil((to - from) / spacing));
    for (std::size_t i = 0; i <= n; ++i) {
      const double share = n == 0 ? 0.0 : static_cast<double>(i) / static_cast<double>(n);
      const Vec2 p = point_of(facets_[k], from + share * (to - from));
      const bool arc = facets_[k].radius > 0.0;
      if (!arc || (p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y))
        points.push_back(p);
    }
  }
  return points;
}

}  // namespace rondo::contact
