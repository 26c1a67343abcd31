// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/cone_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rondo::contact {
namespace {

using SpatialSolutions = std::array<SpatialSolution, 2>;

/// The larger residual of the two over m |free|.
double spatial_residual(const SpatialPair& p, double friction, const SpatialSolutions& s) noexcept {
  const double mass = 1.0 / p.delassus[0].x;
  const Vec3 total = s[0].impulse + p.turn * s[1].impulse;
  const Vec3 w = p.free + Vec3{dot(p.delassus[0], total), dot(p.delassus[1], total),
                               dot(p.delassus[2], total)};
  const double worst =
      std::max(law_residual(s[0].impulse, w, p.bounce[0], friction, mass),
               law_residual(s[1].impulse, conj(p.turn) * w, p.bounce[1], friction, mass));
  const double scale = mass * norm(p.free);
  return scale > 0.0 ? worst / scale : worst;
}

/// Keeps the best case so far; true once one is accepted.
struct SpatialChoice {
  const SpatialPair& problem;
  double friction, tolerance;
  SpatialPairSolution best{{}, std::numeric_limits<double>::infinity(), false};

  bool accepts(const SpatialSolutions& s) noexcept {
    const double residual = spatial_residual(problem, friction, s);
    if (residual < best.residual) best = {s, residual, residual <= tolerance};
    return best.converged;
  }
};

SpatialSolutions one_alone(const SpatialPair& p, double friction, std::size_t i) noexcept {
  SpatialProblem own{p.free, p.delassus, p.bounce[i]};
  if (i == 1) {  // Qᵀ W Q: by the columns of Q, then by its rows
    own.free = conj(p.turn) * p.free;
    std::array<Vec3, 3> rows;
    for (std::size_t k = 0; k < 3; ++k) rows[k] = conj(p.turn) * p.delassus[k];
    const auto& [a, b] = p.turn;
    own.delassus = {a * rows[0] + b * rows[1], a * rows[1] - b * rows[0], rows[2]};
  }
  SpatialSolutions alone{};
  alone[i] = solve_spatial(own, friction);
  return alone;
}

/// Shares of directions a of contact 0 and b of contact 1, each in its own frame, in what is
/// `total` in frame 0; none where they are parallel.
Vec2 shares(const SpatialPair& p, Vec2 total, Vec2 a, Vec2 b) noexcept {
  constexpr double parallel = 1e-12;
  const Vec2 turned = p.turn * b;
  const double det = cross(a, turned);
  if (std::abs(det) <= parallel) return {};
  return {cross(total, turned) / det, cross(a, total) / det};
}

/// w = 0: any share within the two cones will do. The impulse along the corner is shared as those
/// along the normals are.
bool sticks(const SpatialPair& p, SpatialChoice& choice) noexcept {
  const Vec3 total = stopping_impulse(p.delassus, p.free);
  const Vec2 part = shares(p, total.plane(), {1.0, 0.0}, {1.0, 0.0});
  const double both = part.x + part.y;
  if (!(both > 0.0)) return false;
  const auto one = [&](double share) {
    return SpatialSolution{{std::max(share, 0.0), 0.0, total.z * (share / both)}, Status::stick};
  };
  return choice.accepts({one(part.x), one(part.y)});
}

/// Both slide, at `along` the corner.
struct Sliding {
  SpatialSolutions contact;
  double left;  ///< impulse along the corner that friction does not give
};

/// @param w the velocity across the corner, frame 0
Sliding sliding(const SpatialPair& p, double friction, Vec2 w, double along) noexcept {
  const Vec3 total = stopping_impulse(p.delassus, p.free - Vec3(w, along));
  const Vec2 a = -friction * direction({w.y, along});
  const Vec2 b = -friction * direction({(conj(p.turn) * w).y, along});
  const Vec2 part = shares(p, total.plane(), {1.0, a.x}, {1.0, b.x});
  return {{SpatialSolution{std::max(part.x, 0.0) * Vec3{1.0, a.x, a.y}, Status::slip},
           SpatialSolution{std::max(part.y, 0.0) * Vec3{1.0, b.x, b.y}, Status::slip}},
          total.z - part.x * a.y - part.y * b.y};
}

/// Sliding::left rises with the velocity along the corner, beyond all bounds.
void slides(const SpatialPair& p, SpatialChoice& choice) noexcept {
  constexpr int most_doublings = 60, most_halvings = 200;
  const Vec2 w{-p.bounce[0], (p.turn.re * p.bounce[0] - p.bounce[1]) / p.turn.im};
  const auto left = [&](double along) { return sliding(p, choice.friction, w, along).left; };
  double high = norm(p.free) + norm(w), low = -high;
  for (int k = 0; k < most_doublings && !(left(low) <= 0.0 && left(high) >= 0.0); ++k)
    low *= 2.0, high *= 2.0;
  for (int k = 0; k < most_halvings; ++k) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (left(middle) > 0.0 ? high : low) = middle;
  }
  if (choice.accepts(sliding(p, choice.friction, w, high).contact)) return;
  choice.accepts(sliding(p, choice.friction, w, low).contact);
}

}  // namespace

SpatialPairSolution solve_spatial_pair(const SpatialPair& p, double friction,
                                       double tolerance) noexcept {
  SpatialChoice choice{p, friction, tolerance};
  if (choice.accepts({})) return choice.best;
  for (std::size_t i = 0; i < 2; ++i)
    if (choice.accepts(one_alone(p, friction, i))) return choice.best;
  if (p.bounce[0] == 0.0 && p.bounce[1] == 0.0 && sticks(p, choice)) return choice.best;
  slides(p, choice);
  return choice.best;
}

}  // namespace rondo::contact
