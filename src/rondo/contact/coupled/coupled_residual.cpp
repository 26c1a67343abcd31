// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/coupled_residual.hpp"

#include <algorithm>

#include "rondo/contact/residual.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/keep_larger.hpp"

namespace rondo::contact {

double coupled_residual(const CoupledProblem& p, std::span<const Vec2> impulse) noexcept {
  double worst = 0.0, scale = 0.0;
  for (std::size_t j = 0; j < p.size(); ++j) {
    Vec2 w = p.free[j];
    for (auto k = static_cast<std::size_t>(p.row_start[j]);
         k < static_cast<std::size_t>(p.row_start[j + 1]); ++k)
      w += apply(p.blocks[k], impulse[at(p.column[k])]);
    const double found = law_residual(impulse[j], w, p.bounce[j], p.friction[j], p.mass[j]);
    worst = keep_larger(worst, found);
    scale = std::max(scale, p.mass[j] * norm(p.free[j]));
  }
  return scale > 0.0 ? worst / scale : worst;
}

}  // namespace rondo::contact
