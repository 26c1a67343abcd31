// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/cone.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::contact {
namespace {

/// Turns of the direction of sliding, at the most; a dozen are many.
constexpr int most_turns = 200;

/// The blocks of W, whose first row is the normal's.
struct Blocks {
  double nn;
  Vec2 nt, tn;  ///< W_nt, W_tn
  Vec2 t1, t2;  ///< rows of W_tt
};

Blocks blocks_of(const std::array<Vec3, 3>& w) noexcept {
  return {w[0].x, {w[0].y, w[0].z}, {w[1].x, w[2].x}, {w[1].y, w[1].z}, {w[2].y, w[2].z}};
}

/// r = r_n (1, -μτ) with w_n = 0 and w_t along τ: where the direction τ stands still under
/// (σ + μ k r_n) τ = b_t + r_n [W_tn - μ (W_tt - k) τ], the law holds exactly, whatever k.
SpatialSolution sliding(const Blocks& w, Vec3 b, double friction, Vec2 tau) noexcept {
  const double k = 0.5 * (w.t1.x + w.t2.y);
  const Vec2 bt{b.y, b.z};
  SpatialSolution s;
  s.status = Status::slip;
  s.converged = false;
  double rn = 0.0;
  for (; s.turns < most_turns && !s.converged; ++s.turns) {
    rn = -b.x / (w.nn - friction * dot(w.nt, tau));
    const Vec2 rest{dot(w.t1, tau) - k * tau.x, dot(w.t2, tau) - k * tau.y};
    const Vec2 next = direction(bt + rn * (w.tn - friction * rest));
    s.converged = norm(next - tau) <= 1e-15;
    tau = next;
  }
  rn = -b.x / (w.nn - friction * dot(w.nt, tau));
  s.impulse = {rn, -friction * rn * tau.x, -friction * rn * tau.y};
  return s;
}

}  // namespace

Vec3 stopping_impulse(const std::array<Vec3, 3>& w, Vec3 b) noexcept {
  const Vec3 x = cross(w[1], w[2]), y = cross(w[2], w[0]), z = cross(w[0], w[1]);
  const double determinant = dot(w[0], x);
  return -((b.x * x + b.y * y + b.z * z) / determinant);
}

SpatialSolution solve_spatial(const SpatialProblem& problem, double friction) noexcept {
  const Blocks w = blocks_of(problem.delassus);
  RONDO_ASSERT(w.nn > friction * norm(w.nt), w.nn, w.nt.x, w.nt.y, friction);
  const Vec3 b{problem.free.x + problem.bounce, problem.free.y, problem.free.z};
  if (b.x >= 0.0) return {};
  const Vec3 stick = stopping_impulse(problem.delassus, b);
  const Vec2 pull{stick.y, stick.z};
  if (norm(pull) <= friction * stick.x) return {stick, Status::stick};
  return sliding(w, b, friction, -direction(pull));
}

Vec3 project_on_cone(Vec3 r, double friction) noexcept {
  const double along = std::hypot(r.y, r.z);
  if (r.x >= 0.0 && along <= friction * r.x) return r;
  if (friction * along <= -r.x) return {};
  const double x = (r.x + friction * along) / (1.0 + friction * friction);
  const double scale = along > 0.0 ? friction * x / along : 0.0;
  return {x, scale * r.y, scale * r.z};
}

double law_residual(Vec3 r, Vec3 w, double bounce, double friction, double mass) noexcept {
  const Vec3 shifted = {w.x + bounce + friction * std::hypot(w.y, w.z), w.y, w.z};
  return norm(r - project_on_cone(r - mass * shifted, friction));
}

}  // namespace rondo::contact
