// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/intrusion.hpp"

#include <algorithm>

namespace rondo::contact {

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

}  // namespace rondo::contact
