// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/residual.hpp"

#include <cmath>

namespace rondo::contact {

Vec2 project_on_cone(Vec2 r, double friction) noexcept {
  if (r.x >= 0.0 && std::abs(r.y) <= friction * r.x) return r;  // without friction 0 <= -0
  if (friction * std::abs(r.y) <= -r.x) return {};              // in the polar cone
  const double side = r.y > 0.0 ? 1.0 : -1.0;
  const double x = (r.x + friction * std::abs(r.y)) / (1.0 + friction * friction);
  return {x, side * friction * x};
}

double law_residual(Vec2 r, Vec2 w, double bounce, double friction, double mass) noexcept {
  const Vec2 shifted = {w.x + bounce + friction * std::abs(w.y), w.y};
  return norm(r - project_on_cone(r - mass * shifted, friction));
}

}  // namespace rondo::contact
