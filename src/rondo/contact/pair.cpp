// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/pair.hpp"

#include <algorithm>
#include <limits>

#include "rondo/contact/residual.hpp"

namespace rondo::contact {
namespace {

using Solutions = std::array<LocalSolution, 2>;

/// The larger residual of the two rows over m max|free|.
double residual_of(const PairProblem& p, const Solutions& s) noexcept {
  const double mass = 1.0 / norm(p.delassus);
  const std::array<Vec2, 2> w = pair_velocities(p, {s[0].impulse, s[1].impulse});
  double worst = 0.0;
  for (std::size_t i = 0; i < 2; ++i)
    worst = std::max(worst, law_residual(s[i].impulse, w[i], p.bounce[i], p.friction[i], mass));
  const double scale = mass * std::max(norm(p.free[0]), norm(p.free[1]));
  return scale > 0.0 ? worst / scale : worst;
}

/// Keeps the best case so far; true once one is accepted.
struct Choice {
  const PairProblem& problem;
  double tolerance;
  PairSolution best{{}, std::numeric_limits<double>::infinity(), false};

  bool accepts(const Solutions& s) noexcept {
    const double residual = residual_of(problem, s);
    if (residual < best.residual) best = {s, residual, residual <= tolerance};
    return best.converged;
  }
};

/// Shares `total` (frame 0) among directions a of contact 0 and b of contact 1, each in its own
/// frame.
Solutions share(const PairProblem& p, Vec2 total, Vec2 a, Vec2 b, Status status) noexcept {
  const Vec2 turned = p.turn * b;
  const double det = cross(a, turned);
  const double x = cross(total, turned) / det, y = cross(a, total) / det;
  return {LocalSolution{std::max(x, 0.0) * a, status}, LocalSolution{std::max(y, 0.0) * b, status}};
}

double sign(double x) noexcept {
  return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0;
}

void both_press(const PairProblem& p, Choice& choice) noexcept {
  // n_0·w = -bounce_0 and n_1·w = -bounce_1 give w, in frame 0.
  const double wt = (p.turn.re * p.bounce[0] - p.bounce[1]) / p.turn.im;
  const Vec2 w0 = {-p.bounce[0], wt};
  const Vec2 total = (w0 - p.free[0]) / p.delassus;
  if (p.bounce[0] != 0.0 || p.bounce[1] != 0.0) {  // w_t ≠ 0: both slip
    const Vec2 w1 = conj(p.turn) * w0;
    choice.accepts(share(p, total, {1.0, -p.friction[0] * sign(w0.y)},
                         {1.0, -p.friction[1] * sign(w1.y)}, Status::slip));
    return;
  }
  // w = 0: any share within the two cones will do. Between the normals there is one without
  // friction; beyond them the total lies in one cone, and that contact alone has been tried.
  choice.accepts(share(p, total, {1.0, 0.0}, {1.0, 0.0}, Status::stick));
}

}  // namespace

std::array<Vec2, 2> pair_velocities(const PairProblem& p, const std::array<Vec2, 2>& r) noexcept {
  return {p.free[0] + p.delassus * (r[0] + p.turn * r[1]),
          p.free[1] + p.delassus * (r[1] + conj(p.turn) * r[0])};
}

PairSolution solve_pair(const PairProblem& p, double tolerance) noexcept {
  Choice choice{p, tolerance};
  if (choice.accepts({})) return choice.best;
  for (std::size_t i = 0; i < 2; ++i) {
    Solutions alone{};
    alone[i] = solve_local({p.free[i], p.delassus, p.bounce[i]}, p.friction[i]);
    if (choice.accepts(alone)) return choice.best;
  }
  both_press(p, choice);
  return choice.best;
}

}  // namespace rondo::contact
