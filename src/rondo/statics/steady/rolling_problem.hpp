// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of a steadily rolling body as dense linear algebra (docs/theory.md, 11.2, and
/// docs/wheel3d.md): the gaps, the ways along the ground and the places of all pairs are linear in
/// the forces on all pairs. D = 2 is the plane, where a pair has the numbers (n, t1); D = 3 is
/// space, where it has (n, t1, t2). In the plane forces are per metre of width.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/statics/steady/node_vector.hpp"

namespace rondo::statics {

/// A candidate at a sample; at sample 0 its sector is where it is in the reference.
struct RollingPair {
  std::size_t candidate = 0;
  int sample = 0;
};

template <int D>
struct RollingProblem {
  std::vector<RollingPair> pairs;
  double time = 0.0;  ///< of a sample                                                         [s]
  double pass = 1.0;  ///< P, of a sector: forces are sums over the pairs divided by it
  int back = -1;      ///< by this much a sample differs from the one before: -1 or 1
  Complex lean{1.0, 0.0};  ///< e^{iγ} of the camber γ; 1 in the plane
  /// (D pairs) gap and ways without forces, the center at height 0 and at rest: gap + h and way +
  /// V time (cos α, sin α) are those of a moving one [m]
  Eigen::VectorXd base;
  Eigen::MatrixXd matrix;      ///< (D pairs, D pairs) what forces add to them               [m/N]
  Eigen::VectorXd base_place;  ///< ((D - 1) pairs) along t1, t2 from the center, without forces [m]
  Eigen::MatrixXd matrix_place;  ///< ((D - 1) pairs, D pairs) what forces add to them       [m/N]
  double base_weight = 0.0;  ///< torque of the weight about the axle without forces         [N m]
  Eigen::VectorXd weight;    ///< (D pairs) what forces add to it                              [m]
  /// Empty where rolling is steady; else (rolling_transient.hpp) what forces of the step before
  /// moved the points of all pairs by, along t1 and t2, at the samples that these had then; 0 along
  /// n. (D pairs, D pairs) [m/N]
  Eigen::MatrixXd upstream{};
  Eigen::VectorXd before{};  ///< (D pairs) those forces, which are counted in the base        [N]

  [[nodiscard]] Eigen::Index size() const noexcept { return base.size(); }
  [[nodiscard]] Eigen::Index n_pairs() const noexcept { return base.size() / D; }
};

/// How the center goes along the ground. All 0 in the plane.
struct RollingPath {
  double slip_angle = 0.0;  ///< α: along cos α t1 + sin α t2                             [rad]
  double turn_slip = 0.0;   ///< φ: the body turns by φ V about n; > 0 to the left, to -t2 [1/m]
};

struct RollingFriction;  // rolling_friction.hpp

/// How much friction a pair has, beside the μ of all.
struct PairFriction {
  double factor = 1.0;  ///< the coefficient of the pair over μ, >= 0                          [-]
  /// By how much the bound of its shear grows, beside factor μ, with its normal force and with the
  /// length of its way, because the coefficient depends on pressure and slip speed: of a
  /// linearised law; else 0.
  double by_normal = 0.0;  ///< [-]
  double by_way = 0.0;     ///< [N/m]

  bool operator==(const PairFriction&) const noexcept = default;
};

/// The coefficients of all pairs. @param pairs must outlive it; those beyond its end have factor 1
class PairCoefficients {
 public:
  PairCoefficients(double all) noexcept : all_(all) {}  // NOLINT(*-explicit-*): a constant is one
  PairCoefficients(double all, std::span<const PairFriction> pairs) noexcept
      : all_(all), pairs_(pairs) {}

  [[nodiscard]] double operator[](std::size_t pair) const noexcept {
    return pair < pairs_.size() ? all_ * pairs_[pair].factor : all_;
  }

 private:
  double all_;
  std::span<const PairFriction> pairs_{};
};

/// One of height and load is given, and one of speed, traction and torque.
struct RollingDrive {
  double height = 0.0;      ///< h, of the center above the ground; without a load             [m]
  double speed = 0.0;       ///< V; without traction and torque; else where to start         [m/s]
  double slip_angle = 0.0;  ///< α: the center goes along cos α t1 + sin α t2; 0 in the plane [rad]
  double turn_slip = 0.0;  ///< φ: yaw rate over V, > 0 to the left; 0 in the plane           [1/m]
  double friction = 0.0;   ///< μ >= 0
  std::optional<double> load{};      ///< force of the ground on the body along n, > 0           [N]
  std::optional<double> traction{};  ///< force of the ground on the body along t1               [N]
  std::optional<double> torque{};    ///< of ground and weight, counter-clockwise              [N m]
  /// Null: the coefficients are those of `pairs`. Else they follow from slip speed and pressure, μ
  /// times the factors of the law, and `pairs` is not used. It must outlive the drive.
  const RollingFriction* law = nullptr;
  std::vector<PairFriction> pairs{};  ///< of the first pairs; those beyond have factor 1

  [[nodiscard]] PairCoefficients coefficients() const noexcept { return {friction, pairs}; }
  /// The friction of one pair, over μ.
  [[nodiscard]] PairFriction of_pair(std::size_t pair) const noexcept {
    return pair < pairs.size() ? pairs[pair] : PairFriction{};
  }
  /// Height and speed are given.
  [[nodiscard]] bool is_fixed() const noexcept { return !load && !traction && !torque; }
  [[nodiscard]] RollingPath path() const noexcept { return {slip_angle, turn_slip}; }
};

/// Forces on all pairs, height and speed of the center.
struct RollingPoint {
  Eigen::VectorXd force{};  ///< (D pairs)                                                     [N]
  double height = 0.0, speed = 0.0;
};

/// What the ground does to the body: means over a sector's pass. In the plane those that are of
/// space alone are 0.
struct RollingForces {
  double normal = 0.0, heading = 0.0, lateral = 0.0;  ///< along n, t1, t2                     [N]
  double torque = 0.0;    ///< about the axle, counter-clockwise, with that of the weight    [N m]
  double aligning = 0.0;  ///< about n                                                       [N m]
  double overturning = 0.0;  ///< about t1, through the center's projection on the ground    [N m]
};

/// The axes n, t1, t2 = t1 × n of the ground under a wheel of camber γ, as columns, in those of the
/// wheel. @param lean e^{iγ}; 1 in the plane
template <int D>
[[nodiscard]] NodeMatrix<D> ground_axes(Complex lean) noexcept;

/// Gaps and ways of all pairs, (D pairs) [m]. With a turn slip the ways are those of the displaced
/// places x, φ V time n × x more: bilinear in speed and forces.
template <int D>
[[nodiscard]] Eigen::VectorXd gaps_and_ways(const RollingProblem<D>& problem,
                                            const RollingPoint& point, const RollingPath& path);
/// n × x of places x: 0, and along t1 and t2 what a turn of 1 to the left moves them by. In the
/// plane 0. @param places ((D - 1) pairs, columns). @return (D pairs, columns)
template <int D>
[[nodiscard]] Eigen::MatrixXd yawed(const Eigen::MatrixXd& places);
/// What forces add to gaps and ways of a body that turns by so much about n in a sample's time.
/// @param turn φ V time [rad]. @return (D pairs, D pairs) [m/N]
template <int D>
[[nodiscard]] Eigen::MatrixXd yawing_matrix(const RollingProblem<D>& problem, double turn);
/// Places of all pairs along t1 and t2 from the center, ((D - 1) pairs) [m].
template <int D>
[[nodiscard]] Eigen::VectorXd places(const RollingProblem<D>& problem,
                                     const Eigen::VectorXd& force);
template <int D>
[[nodiscard]] RollingForces forces_of(const RollingProblem<D>& problem, const RollingPoint& point);

/// Adds what a force at a place of the ground does, times a share.
/// @param place along t1 and t2 from the center [m]
template <int D>
void add_force(const NodeVector<D>& force, const NodeVector<D - 1>& place, double height,
               Complex lean, double share, RollingForces& sum) noexcept;

/// How the torque changes at a point: P dT = row·dr + by_height dh.
struct TorqueChange {
  Eigen::VectorXd row;  ///< (D pairs) [m]
  double by_height = 0.0;
};
template <int D>
[[nodiscard]] TorqueChange torque_change(const RollingProblem<D>& problem,
                                         const RollingPoint& point);

/// How the forces change with a change of the point, whose speed does not matter.
/// @param torque that of the point
template <int D>
[[nodiscard]] RollingForces forces_change(const RollingProblem<D>& problem,
                                          const RollingPoint& point, const TorqueChange& torque,
                                          const RollingPoint& change);

}  // namespace rondo::statics
