// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/pair.hpp"

#include <algorithm>

#include "rondo/contact/residual.hpp"

namespace rondo::contact {

std::array<Vec2, 2> pair_velocities(const PairProblem& p, const std::array<Vec2, 2>& r) noexcept {
  return {p.free[0] + p.delassus * (r[0] + p.turn * r[1]),
          p.free[1] + p.delassus * (r[1] + conj(p.turn) * r[0])};
}

PairSolution solve_pair(const PairProblem& p, double friction, const std::array<Vec2, 2>& start,
                        double tolerance, int limit) noexcept {
  const double mass = 1.0 / norm(p.delassus);
  const double scale = mass * std::max(norm(p.free[0]), norm(p.free[1]));
  PairSolution out;
  std::array<Vec2, 2> r = start;
  while (out.iterations < limit) {
    ++out.iterations;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec2 others = pair_velocities(p, r)[i] - p.delassus * r[i];
      out.contact[i] = solve_local({others, p.delassus, p.bounce[i]}, friction);
      r[i] = out.contact[i].impulse;
    }
    const std::array<Vec2, 2> w = pair_velocities(p, r);
    double worst = 0.0;
    for (std::size_t i = 0; i < 2; ++i)
      worst = std::max(worst, law_residual(r[i], w[i], p.bounce[i], friction, mass));
    out.residual = scale > 0.0 ? worst / scale : worst;
    out.converged = out.residual <= tolerance;
    if (out.converged) break;
  }
  return out;
}

}  // namespace rondo::contact
