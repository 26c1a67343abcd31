// SPDX-License-Identifier: BSD-3-Clause
/// @file  A wheel that stands and is pressed onto flat ground by increments of depth or load, and
/// drawn along it (docs/tyre.md, section 6): an equilibrium after each, under Signorini's law on
/// gaps and Coulomb's on the ways of nodes along the ground since the increment before
/// (docs/theory.md, 6.4). The law of an increment is that of a pair of steady rolling, whose solver
/// is used with one sample a sector, no spin and no inertia. The coefficient of friction of a pair
/// is that of its pressure and its place at the end of the increment before; slip speeds count as
/// 0. A node that touches for the first time within an increment has its way from where it was
/// before it: an error that vanishes with the increments.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "rondo/core/sum.hpp"
#include "rondo/core/vec3.hpp"
#include "rondo/statics/crush.hpp"
#include "rondo/statics/steady/finite_rolling.hpp"

namespace rondo::statics {

/// Where an increment ends.
struct StandingTarget {
  double depth = 0.0;            ///< of the center below first touch, >= 0; without a load  [m]
  std::optional<double> load{};  ///< force of the ground along its normal, > 0              [N]
  double slide = 0.0;            ///< of the center along t1 since first touch               [m]
};

/// After an increment.
struct StandingState {
  double depth = 0.0, slide = 0.0;  ///< of the center, reached                              [m]
  /// Forces, gaps and ways of the window's pairs. Its end is no_contact where nothing touches.
  RollingSolution solution{.end = RollingEnd::no_contact};
  FiniteEffort effort;       ///< of forces that are not linear
  Eigen::MatrixXd u;         ///< (3 n_local, N) in the frames of the sectors                [m]
  std::vector<Vec3> nodes;   ///< (n) displacement in the axes of the wheel                  [m]
  std::vector<Vec3> inner;   ///< (n) force that the body resists it with                    [N]
  double residual = 0.0;     ///< of the law, from the whole field (6.4d)                    [-]
  double equilibrium = 0.0;  ///< largest row that is out of balance, over the largest force [-]
  double penetration = 0.0;  ///< largest -gap of all candidates, >= 0                       [m]
  CrushWorks works;          ///< since first touch                                          [J]
  std::array<CompensatedSum, 4> sums;  ///< of rim, friction, impact, internal
};

class StandingWheel {
 public:
  /// Both must outlive it. @param harmonics of no spin, one sample a sector; they keep their
  /// factors if there is a remainder @param camber γ [rad] @param friction no function of the slip
  /// speed: a crush has no time @param remainder null: the forces of the body are linear
  /// @param extent (candidates) area of the undeformed boundary that belongs to each, which its
  /// pressure is over [m²]; empty: friction is constant
  StandingWheel(const RollingHarmonics<3>& harmonics, double camber, contact::Friction friction,
                RollingRemainder* remainder, std::vector<double> extent = {});

  /// Height of the center above the ground at first touch [m].
  [[nodiscard]] double touch_height() const noexcept { return touch_height_; }
  [[nodiscard]] const RollingWindow<3>& window() const noexcept { return window_; }
  [[nodiscard]] const StandingState& state() const noexcept { return state_; }

  /// From the state to the next. @return its end; unless that is solved, or nothing touches at
  /// depth 0, the state stays as it was
  [[nodiscard]] RollingEnd press(const StandingTarget& target);
  /// What the increment that was not solved left.
  [[nodiscard]] const StandingState& left() const noexcept { return trial_; }

 private:
  [[nodiscard]] bool solve(const StandingTarget& target, StandingState& next);
  void solve_contact(const StandingTarget& target, const RollingDrive& drive, StandingState& next);
  void find_friction();
  [[nodiscard]] double coefficient(std::size_t pair) const;
  /// μ where friction is constant; else what the factors of the pairs are of.
  [[nodiscard]] double friction_of_all() const;
  [[nodiscard]] FiniteRolling solve_finite(const RollingDrive& drive, const StandingTarget& target);
  void take(FiniteRolling found, StandingState& next);
  void lift_off(StandingState& next) const;
  void find_inner(const Eigen::MatrixXd& remainder, StandingState& next) const;
  /// (3 pairs) gap and way of each pair by the fields alone [m].
  [[nodiscard]] Eigen::VectorXd moved(const StandingState& next) const;
  void judge(StandingState& next) const;
  void add_works(StandingState& next) const;

  const RollingHarmonics<3>& harmonics_;
  RollingRemainder* remainder_;
  RollingWindow<3> window_;
  contact::Friction friction_;
  std::vector<double> extent_;
  double touch_height_;
  std::vector<PairFriction> pairs_;  ///< of the increment that is solved; empty: μ is constant
  StandingState state_, trial_;
  std::optional<FiniteRolling> finite_;  ///< of the state; none: of no state yet, or linear
};

}  // namespace rondo::statics
