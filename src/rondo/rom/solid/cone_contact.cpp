// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid/cone_contact.hpp"

#include <algorithm>
#include <cmath>

namespace rondo::rom {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

constexpr int most_directions = 30;    ///< of sliding
constexpr int most_coefficients = 40;  ///< of friction that follows the slip
constexpr double settled = 1e-10;      ///< error of such a coefficient
constexpr double least_turn = 1e-5;    ///< what is left then is its square

/// The direction in which a contact begins to slide.
Vector2d first_direction(const ConeLocal& c, const Vector3d& free) noexcept {
  Vector2d e = c.force.tail<2>();
  if (e.isZero(0.0)) e = -free.tail<2>();
  const double length = e.norm();
  return length > 0.0 ? Vector2d(e / length) : Vector2d(1.0, 0.0);
}

/// r = r_n (1, μ e) with e against the slip.
Vector3d slide(const Matrix3d& a, double mu, const Vector3d& free, Vector2d e) noexcept {
  for (int turn = 0; turn < most_directions; ++turn) {
    const double stiff = a(0, 0) + mu * (a(0, 1) * e[0] + a(0, 2) * e[1]);
    const double softness = 1.0 / stiff, normal = -free[0] * softness;
    const Vector2d reached = a.block<2, 1>(1, 0) + mu * (a.block<2, 2>(1, 1) * e);
    const Vector2d slip = free.tail<2>() + normal * reached;
    const Vector2d across(-e[1], e[0]);
    const double off = e[0] * slip[1] - e[1] * slip[0];  // 0: along e
    const double by_normal = -normal * mu * (a(0, 1) * across[0] + a(0, 2) * across[1]) * softness;
    const Vector2d slip_by = by_normal * reached + normal * mu * (a.block<2, 2>(1, 1) * across);
    const double slope =
        across[0] * slip[1] - across[1] * slip[0] + e[0] * slip_by[1] - e[1] * slip_by[0];
    if (e.dot(slip) > 0.0 && slope <= 0.0) {
      e = -slip.normalized();
      continue;
    }
    if (slope == 0.0) break;
    const double step = std::clamp(-off / slope, -1.0, 1.0);
    e = (e + step * across).normalized();
    if (std::abs(step) <= least_turn) break;
  }
  const double normal = -free[0] / (a(0, 0) + mu * (a(0, 1) * e[0] + a(0, 2) * e[1]));
  return {normal, mu * normal * e[0], mu * normal * e[1]};
}

}  // namespace

Vector3d solve_alone(const ConeLocal& c, double friction, const Vector3d& free) noexcept {
  if (free[0] >= 0.0) return Vector3d::Zero();
  if (friction == 0.0) return {-free[0] / c.own(0, 0), 0.0, 0.0};
  const Vector3d stuck = -(c.inverse * free);
  if (stuck[0] > 0.0 && stuck.tail<2>().squaredNorm() <= friction * friction * stuck[0] * stuck[0])
    return stuck;
  return slide(c.own, friction, free, first_direction(c, free));
}

/// μ less that of its own force and slip is below 0 at 0 and above 0 far out; regula falsi finds
/// where it vanishes.
Vector3d solve_following(const ConeFriction& friction, std::size_t number, ConeLocal& c,
                         const Vector3d& free) {
  if (free[0] >= 0.0) return Vector3d::Zero();
  Vector3d force;
  const auto beyond = [&](double mu) {
    force = solve_alone(c, mu, free);
    return mu - friction(number, (free + c.own * force).tail<2>().norm(), force[0]);
  };
  double low = c.friction, at_low = beyond(low), high = low, at_high = at_low;
  if (std::abs(at_low) <= settled) return force;
  for (int turn = 0; turn < most_coefficients && at_high < 0.0; ++turn) {
    low = high, at_low = at_high;
    high -= 2.0 * at_high;
    at_high = beyond(high);
  }
  if (at_low > 0.0) low = 0.0, at_low = beyond(0.0);
  double mu = high, missed = at_high;
  for (int turn = 0; turn < most_coefficients && std::abs(missed) > settled; ++turn) {
    mu = (low * at_high - high * at_low) / (at_high - at_low);
    missed = beyond(mu);
    if (missed < 0.0) {
      low = mu, at_low = missed, at_high *= 0.5;
    } else {
      high = mu, at_high = missed, at_low *= 0.5;
    }
  }
  c.friction = mu;
  return force;
}

}  // namespace rondo::rom
