// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/intrusion.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "rondo/core/contract.hpp"

namespace rondo::contact {
namespace {

/// A place on a line: on the piece from point `piece` to the next.
struct BoundaryPlace {
  Vec2 x;
  std::size_t piece = 0;
};

/// Straight lines of one length from place to place of the surface.
class Chords {
 public:
  Chords(const Ground& ground, double spacing)
      : line_(ground.outline(step * spacing, spacing)), spacing_(spacing) {}

  [[nodiscard]] Hidden look() {
    double passed = 0.0;  // of the piece, to where the next one begins
    for (std::size_t i = 0; i + 1 < line_.size(); ++i) {
      const Vec2 piece = line_[i + 1] - line_[i];
      // A chord that begins before the last spacing of a piece also ends on that piece.
      double left = std::min(norm(piece) - passed, spacing_);
      for (; left > 0.0; left -= step * spacing_)
        look_from({line_[i + 1] - left / norm(piece) * piece, i});
      passed = -left;
    }
    return hidden_;
  }

 private:
  static constexpr double step = 1.0 / 16.0;

  /// The surface never goes back to the left: no end is farther to the right than the spacing.
  void look_from(const BoundaryPlace& from) {
    Vec2 a = from.x;
    for (std::size_t j = from.piece; j + 1 < line_.size(); ++j) {
      const Vec2 b = line_[j + 1];
      if (norm(a - from.x) < spacing_ && norm(b - from.x) >= spacing_)
        look_at(from, {on_circle(from.x, a, b), j});
      if (b.x > from.x.x + spacing_) return;
      a = b;
    }
  }

  /// The point where the way from a, which is inside, to b leaves the circle.
  [[nodiscard]] Vec2 on_circle(Vec2 center, Vec2 a, Vec2 b) const {
    const Vec2 d = b - a, o = a - center;
    const double p = dot(d, o) / dot(d, d), q = (dot(o, o) - spacing_ * spacing_) / dot(d, d);
    return a + (std::sqrt(std::max(0.0, p * p - q)) - p) * d;
  }

  void look_at(const BoundaryPlace& from, const BoundaryPlace& to) {
    const Vec2 chord = (to.x - from.x) / spacing_;
    Intrusion found;
    for (std::size_t k = from.piece + 1; k <= to.piece; ++k) {
      const double depth = cross(chord, line_[k] - from.x);
      if (depth > found.depth) found = {depth, line_[k]};
    }
    if (found.depth > hidden_.deepest.depth) hidden_.deepest = found;
    // How far the surface is below the line's ends half a spacing before it, and after it.
    const double before = cross(chord, along(from.piece)), after = -cross(chord, along(to.piece));
    const bool is_whole = 0.5 * spacing_ * std::max(before, after) < 0.1 * found.depth;
    if (is_whole && found.depth > hidden_.whole.depth) hidden_.whole = found;
  }

  [[nodiscard]] Vec2 along(std::size_t piece) const {
    const Vec2 d = line_[piece + 1] - line_[piece];
    return d / norm(d);
  }

  std::vector<Vec2> line_;
  double spacing_;  ///< [m]
  Hidden hidden_;
};

}  // namespace

Intrusion deepest_inside(const Ground& ground, Vec2 a, Vec2 b, double deepest) noexcept {
  const Vec2 along = b - a;
  const double length = norm(along);
  if (!(length > 0.0)) return {};
  const Vec2 inward = turn90(along / length);
  const Vec2 c = a + deepest * inward, d = b + deepest * inward;
  const double left = std::min({a.x, b.x, c.x, d.x}) - ground.bend_reach();
  const double right = std::max({a.x, b.x, c.x, d.x}) + ground.bend_reach();
  const auto bends = ground.bends();
  auto bend = std::partition_point(bends.begin(), bends.end(),
                                   [&](const Corner& k) { return k.position.x < left; });
  Intrusion out;
  for (; bend != bends.end() && bend->position.x <= right; ++bend) {
    if (dot(bend->normals[0] + bend->normals[1], inward) <= 0.0) continue;
    const Vec2 point = first_met(*bend, inward);
    const double depth = dot(inward, point - a), foot = dot(along, point - a) / length;
    if (foot < 0.0 || foot > length || depth > deepest || depth <= out.depth) continue;
    out = {depth, point};
  }
  return out;
}

Hidden hidden_between_nodes(const Ground& ground, double spacing) {
  RONDO_DEMAND(spacing > 0.0, spacing);
  return Chords(ground, spacing).look();
}

}  // namespace rondo::contact
