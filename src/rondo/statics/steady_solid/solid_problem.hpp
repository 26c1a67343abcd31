// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of a steadily rolling wheel in three dimensions as dense linear algebra
/// (docs/wheel3d.md): gaps, ways along the ground and places of pairs are linear in the forces of
/// all. A pair has three numbers of each: along n (gap, normal force), t1 and t2.
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <vector>

#include "rondo/contact/law.hpp"
#include "rondo/core/vec3.hpp"
#include "rondo/statics/steady/rolling_problem.hpp"

namespace rondo::statics {

/// Axes of the ground under a wheel of camber γ, in those of the wheel: t2 = t1 × n.
struct GroundFrame {
  GroundFrame() = default;
  explicit GroundFrame(double camber) noexcept
      : normal(0.0, std::cos(camber), std::sin(camber)),
        lateral(0.0, -std::sin(camber), std::cos(camber)) {}

  Vec3 normal{0.0, 1.0, 0.0}, heading{1.0, 0.0, 0.0}, lateral{0.0, 0.0, 1.0};

  [[nodiscard]] Vec3 to_wheel(Vec3 a) const noexcept {
    return a.x * normal + a.y * heading + a.z * lateral;
  }
  /// Along n, t1 and t2.
  [[nodiscard]] Vec3 to_ground(Vec3 a) const noexcept {
    return {dot(a, normal), dot(a, heading), dot(a, lateral)};
  }
};

struct SolidRollingProblem {
  std::vector<RollingPair> pairs;
  GroundFrame ground;
  double time = 0.0;  ///< of a sample                                                         [s]
  double pass = 1.0;  ///< P, of a sector: forces are sums over the pairs by it
  /// (3 pairs) gap and ways without forces, the center at height 0 and at rest: gap + h and way +
  /// V time (cos α, sin α) are those of a moving one [m]
  Eigen::VectorXd base;
  Eigen::MatrixXd matrix;  ///< (3 pairs, 3 pairs) of them by the forces                     [m/N]
  Eigen::VectorXd base_place;    ///< (2 pairs) along t1 and t2 from the center, without forces [m]
  Eigen::MatrixXd matrix_place;  ///< (2 pairs, 3 pairs) and by them                         [m/N]
  /// Torque of the weight about the axle without forces [N m], and by those of all pairs [m].
  double base_weight = 0.0;
  Eigen::VectorXd weight;  ///< (3 pairs)

  [[nodiscard]] Eigen::Index size() const noexcept { return base.size(); }
};

/// Forces on all pairs, height and speed of the center.
struct SolidRollingPoint {
  Eigen::VectorXd force;  ///< (3 pairs) along n, t1, t2                                       [N]
  double height = 0.0, speed = 0.0;
};

/// Of each of two pairs one is given: height or load, speed or traction or torque.
struct SolidRollingDrive {
  double height = 0.0;      ///< h, of the center above the ground; without a load             [m]
  double speed = 0.0;       ///< V; without traction and torque; else where to start         [m/s]
  double slip_angle = 0.0;  ///< α: the center goes along cos α t1 + sin α t2                [rad]
  double friction = 0.0;    ///< μ >= 0
  std::optional<double> load{};      ///< F_n of the ground on the body, > 0                     [N]
  std::optional<double> traction{};  ///< F_t1 of the ground on the body                         [N]
  std::optional<double> torque{};    ///< of ground and weight, counter-clockwise              [N m]
};

/// Of the ground on the body, means over a sector's pass.
struct SolidRollingForces {
  double normal = 0.0, heading = 0.0, lateral = 0.0;  ///< along n, t1, t2                     [N]
  double torque = 0.0;    ///< about the axle, counter-clockwise, with that of the weight    [N m]
  double aligning = 0.0;  ///< about n                                                       [N m]
  double overturning = 0.0;  ///< about t1, through the center's projection on the ground    [N m]
};

/// Gaps and ways of all pairs, (3 pairs).
[[nodiscard]] Eigen::VectorXd gaps_and_ways(const SolidRollingProblem& problem, double slip_angle,
                                            const SolidRollingPoint& point);
/// Places of all pairs along t1 and t2 from the center, (2 pairs).
[[nodiscard]] Eigen::VectorXd places(const SolidRollingProblem& problem,
                                     const Eigen::VectorXd& force);
[[nodiscard]] SolidRollingForces forces_of(const SolidRollingProblem& problem,
                                           const SolidRollingPoint& point);
/// dT P = row·dr of the torque about the axle.
[[nodiscard]] Eigen::VectorXd torque_row(const SolidRollingProblem& problem,
                                         const SolidRollingPoint& point);

}  // namespace rondo::statics
