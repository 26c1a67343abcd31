// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/residual.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/contact/coupled/coupled.hpp"
#include "rondo/core/keep_larger.hpp"

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

double coupled_residual(const CoupledProblem& p, std::span<const Vec2> impulse) noexcept {
  double worst = 0.0, scale = 0.0;
  for (std::size_t j = 0; j < p.size(); ++j) {
    Vec2 w = p.free[j];
    for (auto k = static_cast<std::size_t>(p.row_start[j]);
         k < static_cast<std::size_t>(p.row_start[j + 1]); ++k)
      w += apply(p.blocks[k], impulse[static_cast<std::size_t>(p.column[k])]);
    const double found = law_residual(impulse[j], w, p.bounce[j], p.friction[j], p.mass[j]);
    worst = keep_larger(worst, found);
    scale = std::max(scale, p.mass[j] * norm(p.free[j]));
  }
  return scale > 0.0 ? worst / scale : worst;
}

}  // namespace rondo::contact
