// SPDX-License-Identifier: BSD-3-Clause
/// @file  Motion of the rim: its angle and center, integrated exactly (docs/theory.md, section 1).
#pragma once
#include <array>
#include <cmath>
#include <vector>

#include "rondo/core/ground_frame.hpp"

namespace rondo::dynamics {

/// A piecewise-linear function of time; constant before its first and after its last point.
class Table {
 public:
  Table() = default;
  explicit Table(double constant) : points_{{{0.0, constant}}}, from_start_{0.0} {}
  /// @pre at least one point, times strictly increasing, all finite.
  explicit Table(std::vector<std::array<double, 2>> points);

  [[nodiscard]] double at(double t) const noexcept;
  /// Slope just after t; it is piecewise constant.
  [[nodiscard]] double slope(double t) const noexcept;
  /// Exact ∫ over [from, from + length], bitwise the same at every step while the table is
  /// constant. From t = 0 on, its cost does not grow with the number of points.
  [[nodiscard]] double integral(double from, double length) const noexcept;
  /// Change over [from, from + length], without cancellation of the value.
  [[nodiscard]] double change(double from, double length) const noexcept;
  /// Largest |value| at the points.
  [[nodiscard]] double largest() const noexcept;
  [[nodiscard]] const std::vector<std::array<double, 2>>& points() const noexcept {
    return points_;
  }

 private:
  [[nodiscard]] double piece(double begin, double length) const noexcept;
  [[nodiscard]] double integral_from_start(double end) const noexcept;

  std::vector<std::array<double, 2>> points_{{{0.0, 0.0}}};
  std::vector<double> from_start_{0.0};  ///< (points) ∫ from 0 to each point after t = 0
};

struct Motion {
  Table angular_velocity;  ///< ω > 0 rolls towards +x; counter-clockwise rate s = -ω  [rad/s]
  Table speed;             ///< V, of the center along x                               [m/s]
  Table height;            ///< h, of the center above y = 0                           [m]
  Table gravity;           ///< downwards, tilted by the slope                          [m/s2]
  double start_x = 0.0;    ///< x of the center at t = 0                               [m]
  double slope = 0.0;      ///< of the ground, by which gravity is tilted: > 0 descends to +x [rad]
  // The members below are of a wheel in three dimensions (docs/wheel3d.md). The axes of the ground
  // are t1 = e_x, its normal n = (0, cos γ, sin γ) and t2 = t1 × n; x, y above are along t1, n.
  Table slip_angle;     ///< α: the center moves along cos α t1 + sin α t2   [rad]
  double camber = 0.0;  ///< γ, > 0 leans the top of the wheel to -t2          [rad]

  /// g, fixed frame [m/s2]
  [[nodiscard]] Vec2 gravity_at(double t) const noexcept;
  [[nodiscard]] double angle(double t) const noexcept { return turn(0.0, t); }
  /// θ(from + length) - θ(from); for times before t = 0 see advance()                  [rad]
  [[nodiscard]] double turn(double from, double length) const noexcept;
  /// (t1, n, t2) of ground_frame.hpp; in the plane x, y, 0 [m]
  [[nodiscard]] Vec3 center(double t) const noexcept {
    const Vec3 way = advance(0.0, t);
    return {start_x + way.x, height.at(t), way.z};
  }
  /// Speed of the center along t1, which is its whole speed without a slip angle [m/s]
  [[nodiscard]] double ahead(double t) const noexcept {
    return speed.at(t) * std::cos(slip_angle.at(t));
  }
  /// c(from + length) - c(from), without cancellation of the position. Before t = 0 the center
  /// moves with its initial velocity and acceleration, so that the start causes no kink.
  [[nodiscard]] Vec3 advance(double from, double length) const noexcept;
};

/// (ω R - V) / max(|V|, |ω R|), from the speeds of rim and center; 0 if both vanish.
double slip_ratio(double rim_speed, double speed) noexcept;

/// All data of the frame that a step at t_{n+1} needs.
struct FrameStep {
  double time = 0.0;       ///< t_{n+1}                                               [s]
  double spin = 0.0;       ///< s = θ̇, counter-clockwise                              [rad/s]
  double spin_rate = 0.0;  ///< ṡ = (θ_{n+2} - 2θ_{n+1} + θ_n)/Δt²                     [rad/s2]
  double angle = 0.0;      ///< θ_{n+1}                                               [rad]
  double turn = 0.0;       ///< θ_{n+2} - θ_{n+1}                                     [rad]
  double turn_before = 0.0;  ///< θ_{n+1} - θ_n                                         [rad]
  Complex rotation;          ///< e^{iθ_{n+1}}
  double slip_angle = 0.0;   ///< α(t_{n+1}); 0 in the plane                            [rad]
  // Vectors in (t1, n, t2) of ground_frame.hpp; in the plane x, y, 0.
  Vec3 center;          ///< c_{n+1}                                                    [m]
  Vec3 advance;         ///< c_{n+2} - c_{n+1}                                          [m]
  Vec3 advance_before;  ///< c_{n+1} - c_n                                              [m]
  Vec3 pull;            ///< Rᵀ (c̈ - g) in the turning frame, and along the axle        [m/s2]
};

/// (ṡJ - s²)(X + u) + Rᵀ(c̈ - g): frame acceleration at a point (3.1). @param arm X + u [m]
constexpr Vec2 frame_acceleration(const FrameStep& f, Vec2 arm) noexcept {
  return Complex{-f.spin * f.spin, f.spin_rate} * arm + f.pull.plane();
}

/// The frame at t = n dt.
FrameStep frame_step(const Motion& motion, long long n, double dt) noexcept;
/// The frame at t = (n - 1/2) dt, in the middle of step n.
FrameStep middle_frame_step(const Motion& motion, long long n, double dt) noexcept;

}  // namespace rondo::dynamics
