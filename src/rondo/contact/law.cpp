// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/law.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::contact {

double restitution_shift(const Law& law, double before, double neutral) noexcept {
  const double moreau = law.restitution * before;
  return law.impact == Impact::energy_safe ? std::max(moreau, neutral) : moreau;
}

LocalSolution solve_local(const LocalProblem& problem, double friction) noexcept {
  RONDO_ASSERT(problem.delassus.re > friction * std::abs(problem.delassus.im), problem.delassus.re,
               problem.delassus.im, friction);
  const Vec2 w = {problem.free.x + problem.bounce, problem.free.y};
  if (w.x >= 0.0) return {};
  const Vec2 stick = -(w / problem.delassus);  // w + W r = 0
  if (std::abs(stick.y) <= friction * stick.x) return {stick, Status::stick};
  // Slip: r = r_n (1, side μ), the side being the one in which sticking would have pulled.
  const double side = stick.y > 0.0 ? 1.0 : -1.0;
  const double normal = problem.delassus.re - side * friction * problem.delassus.im;
  const double rn = -w.x / normal;
  return {{rn, side * friction * rn}, Status::slip};
}

}  // namespace rondo::contact
