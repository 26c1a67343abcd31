// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "rondo/core/complex.hpp"
#include "rondo/core/contract.hpp"

namespace rondo::contact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double straight = 1e-12;  ///< turns below this angle are no corners [rad]

Vec2 direction(const std::vector<Vec2>& p, std::size_t i) {
  const Vec2 d = p[i + 1] - p[i];
  return d / norm(d);
}

/// Angle by which the profile turns at its interior point i: > 0 to the left, a concave corner.
double turn_at(const std::vector<Vec2>& p, std::size_t i) {
  const Vec2 a = direction(p, i - 1), b = direction(p, i);
  return std::atan2(cross(a, b), dot(a, b));
}

constexpr double farthest = 1e100;  ///< limit of points and radii: their products are in range [m]
constexpr double closest = 1e-100;  ///< points nearer than this have no direction between them [m]

/// Length that the fillet at point i takes from each of the segments beside it.
double fillet_reach(const GroundShape& shape, std::size_t i) {
  if (i == 0 || i + 1 == shape.profile.size()) return 0.0;
  const double turn = turn_at(shape.profile, i);
  return turn < -straight ? shape.radius_at(i) * std::tan(-0.5 * turn) : 0.0;
}

std::vector<ShapeFault> point_faults(const std::vector<Vec2>& p) {
  std::vector<ShapeFault> faults;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!(std::abs(p[i].x) <= farthest && std::abs(p[i].y) <= farthest))
      faults.push_back({static_cast<int>(i), false,
                        fmt::format("lies farther than {:.0e} m from the origin", farthest)});
  if (!faults.empty()) return faults;
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    const int point = static_cast<int>(i) + 1;
    if (norm(p[i + 1] - p[i]) < closest)
      faults.push_back({point, false, "coincides with the point before it"});
    else if (p[i + 1].x < p[i].x)
      faults.push_back({point, false,
                        "the profile goes back to the left; it is walked from left to right with "
                        "the solid on its right-hand side"});
  }
  if (!faults.empty()) return faults;
  for (std::size_t i = 1; i + 1 < p.size(); ++i)
    if (std::abs(turn_at(p, i)) > 3.1)
      faults.push_back({static_cast<int>(i), false, "the profile turns back on itself here"});
  return faults;
}

std::vector<ShapeFault> fillet_faults(const GroundShape& shape) {
  std::vector<ShapeFault> faults;
  const auto& p = shape.profile;
  RONDO_DEMAND(shape.radii.empty() || shape.radii.size() == p.size(), shape.radii.size(), p.size());
  if (!(shape.fillet >= 0.0)) return {{-1, true, "must be >= 0"}};
  if (!(shape.fillet <= farthest))
    return {{-1, true, fmt::format("must be at most {:.0e} m", farthest)}};
  // The end segments go on for ever, so a fillet always fits beside its outer end.
  for (std::size_t i = 1; i + 2 < p.size(); ++i) {
    const double length = norm(p[i + 1] - p[i]);
    const double needed = fillet_reach(shape, i) + fillet_reach(shape, i + 1);
    if (needed > length * (1.0 + 1e-12))
      faults.push_back({static_cast<int>(i), true,
                        fmt::format("the fillet does not fit: it needs {:.6g} m of the {:.6g} m "
                                    "between points {} and {} of the profile",
                                    needed, length, i, i + 1)});
  }
  return faults;
}

}  // namespace

std::vector<ShapeFault> shape_faults(const GroundShape& shape) {
  if (shape.profile.size() < 2) return {{-1, false, "needs at least two points"}};
  std::vector<ShapeFault> faults = point_faults(shape.profile);
  return faults.empty() ? fillet_faults(shape) : faults;
}

Vec2 first_met(const Corner& bend, Vec2 inward) noexcept {
  if (bend.radius == 0.0) return bend.position;
  const auto [first, last] = bend.normals;
  Vec2 normal = inward;
  if (cross(first, inward) > 0.0) normal = first;  // the side meets an end of the arc
  if (cross(last, inward) < 0.0) normal = last;
  return bend.center + bend.radius * normal;
}

double Ground::length_so_far() const noexcept {
  return facets_.empty() ? 0.0 : facets_.back().start_length + facets_.back().to;
}

/// Between the points i and i + 1 of the profile, without what the fillets take of it.
void Ground::add_segment(const GroundShape& shape, std::size_t i) {
  const auto& p = shape.profile;
  const Vec2 t = direction(p, i);
  const double lead = fillet_reach(shape, i), trail = fillet_reach(shape, i + 1);
  const bool is_last = i + 2 == p.size();
  Facet segment{.begin = p[i] + lead * t, .tangent = t, .normal = turn90(t), .center = {}};
  segment.from = i == 0 ? -infinity : 0.0;
  segment.to = is_last ? infinity : norm(p[i + 1] - p[i]) - lead - trail;
  segment.start_length = length_so_far();
  segment.concave_end = !is_last && turn_at(p, i + 1) > blunt_turn;
  segment.sharp_end = !is_last && trail == 0.0 && turn_at(p, i + 1) < -straight;
  facets_.push_back(segment);
}

/// After the segment that ends at point i of the profile, a convex one.
void Ground::add_bend(const GroundShape& shape, std::size_t i) {
  const auto& p = shape.profile;
  const Facet& before = facets_.back();
  const std::array<Vec2, 2> normals{before.normal, turn90(direction(p, i))};
  const double reach = fillet_reach(shape, i);
  if (reach == 0.0) return bends_.push_back({p[i], normals});
  Facet arc{.begin = p[i] - reach * before.tangent,
            .tangent = before.tangent,
            .normal = before.normal,
            .center = {}};
  arc.radius = shape.radius_at(i);
  arc.center = arc.begin - arc.radius * arc.normal;
  arc.to = -turn_at(p, i) * arc.radius;
  arc.start_length = length_so_far();
  facets_.push_back(arc);
  const Vec2 middle = rotation(0.5 * turn_at(p, i)) * arc.normal;
  bends_.push_back({arc.center + arc.radius * middle, normals, arc.center, arc.radius});
  bend_reach_ = std::max(bend_reach_, 0.5 * arc.to);
}

/// Nodes meet an arc that is as wide as they are apart, and what turns no more than a blunt corner
/// within that length: `least` has the turns before the points of the last spacing that a later
/// point may have turned most from, since the last corner.
void Ground::choose_corners(const std::vector<Turn>& turns) {
  std::deque<Turn> least;
  std::size_t bend = 0;
  double turned = 0.0;
  for (const auto& [angle, length] : turns) {
    while (!least.empty() && length - least.front().length > spacing_) least.pop_front();
    while (!least.empty() && least.back().angle >= turned) least.pop_back();
    least.push_back({turned, length});
    turned += angle;
    if (!(angle > straight)) continue;
    const Corner& here = bends_[bend++];
    if (here.radius > 0.0 && here.radius >= spacing_) continue;
    if (turned - least.front().angle < blunt_turn) continue;
    corners_.push_back(here);
    least.clear();
  }
}

Ground::Ground(const GroundShape& shape, double spacing) : spacing_(spacing) {
  RONDO_DEMAND(shape_faults(shape).empty(), shape.profile.size(), shape.fillet);
  RONDO_DEMAND(spacing >= 0.0, spacing);
  const auto& p = shape.profile;
  const std::size_t n = p.size() - 1;
  std::vector<Turn> turns;
  add_segment(shape, 0);
  for (std::size_t i = 1; i < n; ++i) {
    const double angle = -turn_at(p, i), before = length_so_far();
    if (angle > straight) add_bend(shape, i);
    turns.push_back({angle, 0.5 * (before + length_so_far())});
    add_segment(shape, i);
  }
  choose_corners(turns);
  add_boxes();
  if (direction(p, 0).y >= 0.0 && direction(p, n - 1).y <= 0.0)
    top_ = std::max_element(p.begin(), p.end(), [](Vec2 a, Vec2 b) { return a.y < b.y; })->y;
}

void Ground::add_boxes() {
  std::vector<BoxTree::Box> boxes;
  for (const Facet& f : facets_) {
    begins_.push_back(f.begin.x);
    const auto end = [&](double along) {  // 0 * infinity is no number
      return f.begin + Vec2{f.tangent.x == 0.0 ? 0.0 : along * f.tangent.x,
                            f.tangent.y == 0.0 ? 0.0 : along * f.tangent.y};
    };
    // No point of an arc is farther from its beginning than it is long.
    const Vec2 a = f.radius > 0.0 ? f.begin - Vec2{f.to, f.to} : end(f.from);
    const Vec2 b = f.radius > 0.0 ? f.begin + Vec2{f.to, f.to} : end(f.to);
    boxes.push_back(
        {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}});
  }
  boxes_ = BoxTree(boxes);
}

std::vector<Vec2> Ground::outline(double step, double beyond) const {
  RONDO_DEMAND(step > 0.0, step);
  std::vector<Vec2> line{facets_.front().begin - beyond * facets_.front().tangent};
  for (const Facet& f : facets_) {
    if (f.begin != line.back()) line.push_back(f.begin);
    constexpr double most = 4096.0;  // for an arc of any size
    const double pieces = f.radius > 0.0 ? std::min(most, std::ceil(f.to / step)) : 1.0;
    for (double i = 1.0; i < pieces; ++i)
      line.push_back(f.center + f.radius * (rotation(-i / pieces * f.to / f.radius) * f.normal));
  }
  line.push_back(facets_.back().begin + beyond * facets_.back().tangent);
  return line;
}

Ground::Projection Ground::project(const Facet& f, Vec2 x) noexcept {
  Projection out;
  if (f.radius > 0.0) {
    const Vec2 offset = x - f.center;
    const double r = norm(offset);
    const double angle = std::atan2(-cross(f.normal, offset), dot(f.normal, offset));  // clockwise
    out.along = std::clamp(f.radius * angle, f.from, f.to);
    out.gap = r - f.radius;
    out.normal = r >= std::numeric_limits<double>::min() ? offset / r : f.normal;
    out.distance = norm(x - (f.center + f.radius * (rotation(-out.along / f.radius) * f.normal)));
    return out;
  }
  const Vec2 offset = x - f.begin;
  out.along = std::clamp(dot(f.tangent, offset), f.from, f.to);
  out.gap = dot(f.normal, offset);
  out.normal = f.normal;
  out.distance = norm(offset - out.along * f.tangent);
  return out;
}

/// Facets go from left to right: one that is farther along x than the facet under the point is from
/// it cannot be nearer. What is left out is farther by more than round-off.
std::pair<std::size_t, std::size_t> Ground::around(Vec2 x) const noexcept {
  constexpr std::size_t few = 8;  // are sooner looked at than searched
  if (facets_.size() <= few) return {0, facets_.size()};
  const auto after = [&](double place) {
    return static_cast<std::size_t>(std::ranges::upper_bound(begins_, place) - begins_.begin());
  };
  const std::size_t under = std::max<std::size_t>(after(x.x), 1) - 1;
  const double reach = project(facets_[under], x).distance;
  const double wide = reach + 1e-6 * (reach + std::abs(x.x));
  const std::size_t first =
      static_cast<std::size_t>(std::ranges::lower_bound(begins_, x.x - wide) - begins_.begin());
  return {std::max<std::size_t>(first, 1) - 1, std::max<std::size_t>(after(x.x + wide), 1)};
}

std::size_t Ground::nearest(Vec2 x, Projection& projection) const noexcept {
  constexpr std::size_t many = 64;  // are sooner searched by their boxes than looked at
  const auto [first, last] = around(x);
  std::size_t best = first;
  projection = project(facets_[first], x);
  const auto look = [&](std::size_t k) {
    const Projection candidate = project(facets_[k], x);
    if (candidate.distance < projection.distance ||
        (candidate.distance == projection.distance && k < best)) {
      projection = candidate;
      best = k;
    }
    return projection.distance;
  };
  if (last - first > many)
    boxes_.each_near(x, look);
  else
    for (std::size_t k = first + 1; k < last; ++k) look(k);
  // If a corner itself is nearest, both facets are equally far, and the point may be on the
  // wrong side of the line of one: it is outside a convex corner if it is before either facet,
  // inside a concave one if it is behind either.
  const auto at_corner = [&](std::size_t other, bool convex) {
    const Projection candidate = project(facets_[other], x);
    if (convex ? candidate.gap <= projection.gap : candidate.gap >= projection.gap) return;
    projection = candidate;
    best = other;
  };
  const Facet& f = facets_[best];
  if ((f.sharp_end || f.concave_end) && projection.along == f.to) {
    at_corner(best + 1, f.sharp_end);
  } else if (best > 0 && projection.along == f.from) {
    const Facet& before = facets_[best - 1];
    if (before.sharp_end || before.concave_end) at_corner(best - 1, before.sharp_end);
  }
  return best;
}

Touches Ground::touches(Vec2 x) const noexcept {
  Touches out;
  if (x.y > top_) return out;
  Projection p;
  const std::size_t k = nearest(x, p);
  if (p.gap > 0.0) return out;
  out.at[0] = {p.gap, p.normal};
  out.count = 1;
  // Behind a concave corner the facet beside the nearest one holds the point back as well.
  const auto also = [&](const Facet& facet) {
    const Projection q = project(facet, x);
    if (q.gap > 0.0 || (out.count == 2 && q.gap > out.at[1].gap)) return;
    out.at[1] = {q.gap, q.normal};
    out.count = 2;
  };
  if (facets_[k].concave_end) also(facets_[k + 1]);
  if (k > 0 && facets_[k - 1].concave_end) also(facets_[k - 1]);
  if (out.count == 2 && out.at[1].gap < out.at[0].gap) std::swap(out.at[0], out.at[1]);
  return out;
}

Touch Ground::facet_near(Vec2 x) const noexcept {
  Projection p;
  static_cast<void>(nearest(x, p));
  return {p.gap, p.normal};
}

std::span<const Corner> Ground::corners(double low, double high) const noexcept {
  const auto from = std::ranges::lower_bound(corners_, low - bend_reach_, {},
                                             [](const Corner& c) { return c.position.x; });
  const auto to = std::upper_bound(from, corners_.end(), high + bend_reach_,
                                   [](double x, const Corner& c) { return x < c.position.x; });
  return {from, to};
}

bool Ground::has_concave_corners() const noexcept {
  return std::ranges::any_of(facets_, [](const Facet& facet) { return facet.concave_end; });
}

double Ground::beside_concave_corner(Vec2 x) const noexcept {
  Projection p;
  const std::size_t k = nearest(x, p);
  double gap = infinity;
  if (facets_[k].concave_end) gap = project(facets_[k + 1], x).gap;
  if (k > 0 && facets_[k - 1].concave_end) gap = std::min(gap, project(facets_[k - 1], x).gap);
  return gap;
}

double Ground::distance(Vec2 x) const noexcept {
  Projection p;
  static_cast<void>(nearest(x, p));
  return p.gap > 0.0 ? p.distance : -p.distance;
}

SurfaceLine Ground::surface_at(double x) const noexcept {
  const auto after = std::ranges::upper_bound(begins_, x);
  const Facet& f =
      facets_[static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - begins_.begin() - 1, 0))];
  if (f.radius > 0.0) {
    const double along = x - f.center.x;
    const double up = std::sqrt(std::max(0.0, f.radius * f.radius - along * along));
    return {f.center.y + up, -along / up};
  }
  const double slope = f.tangent.y / f.tangent.x;
  return {f.begin.y + (f.tangent.y == 0.0 ? 0.0 : slope * (x - f.begin.x)), slope};
}

double Ground::abscissa(Vec2 x) const noexcept {
  Projection p;
  return facets_[nearest(x, p)].start_length + p.along;
}

}  // namespace rondo::contact
