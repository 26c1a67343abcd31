// SPDX-License-Identifier: BSD-3-Clause
/// @file  The rigid body on which a reduced wheel is mounted (docs/reduced.md): its center and its
/// spin are free under loads, supports and a brake, or follow tables. Balances of momentum are
/// those of rim and body together. Components are x, y and the angle, counter-clockwise, per metre
/// of width.
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "rondo/core/sum.hpp"
#include "rondo/model/integrator.hpp"
#include "rondo/model/model.hpp"

namespace rondo::rom {

/// (ċ_x, ċ_y, s), or the forces and the torque on them.
using RimVector = Eigen::Vector3d;

/// The rim over a step from t_n to t_{n+1}.
struct WheelMotion {
  double angle = 0.0, angle_next = 0.0;  ///< θ, counter-clockwise                      [rad]
  double spin_next = 0.0;                ///< s at t_{n+1}                            [rad/s]
  double spin_rate = 0.0;                ///< (s_{n+1} - s_n)/Δt                     [rad/s²]
  Vec2 center, center_next;              ///< [m]
  Vec2 pull;                             ///< mean of c̈ - g, fixed frame               [m/s²]
  /// A rim that moves says for which spin the step takes its matrices: it keeps them while its own
  /// spin is close [rad/s].
  std::optional<double> kept_spin;
};

/// What the deformation holds of the momentum of the whole, and of its energy.
struct WheelSums {
  Vec2 momentum;         ///< Σ m R w, w the velocity in the co-rotating frame         [kg/s]
  Vec2 moment;           ///< Y: Σ m R u, fixed frame                                      [kg]
  double swirl = 0.0;    ///< Σ m (X + u) × w                                       [kg·m/s]
  double stretch = 0.0;  ///< D: Σ m X·u                                              [kg·m]
  double square = 0.0;   ///< Q: Σ m u·u                                              [kg·m]

  /// Momentum of the deformation beyond that of the rigid body at a spin.
  [[nodiscard]] RimVector of(double spin) const noexcept {
    return {momentum.x - spin * moment.y, momentum.y + spin * moment.x,
            swirl + spin * (2.0 * stretch + square)};
  }
};

/// How the momentum of the deformation at the end of a step depends on what is not known yet.
struct WheelAnswer {
  WheelSums free;           ///< without new forces, and with the accelerations of WheelRim::begin
  Eigen::Matrix3d by_rate;  ///< change by unit accelerations of the rim, through the modes [kg·s]
};

class WheelRim {
 public:
  /// The rim at t = 0. The model must outlive it. @param theta share of the new force in a step
  /// @param largest_spin of the run, about: matrices are kept within a small share of it [rad/s]
  /// @pre model.rim; model.mass with the masses of contact nodes at their neighbours
  WheelRim(const dynamics::Model& model, double theta, double largest_spin);

  /// Call before begin(): in this and all later steps, prescribed components have these velocities
  /// at the end of the step and approach them linearly, whatever the tables say; their positions
  /// are the integral.
  void lead(const RimVector& end) noexcept { led_ = end; }

  /// Call before begin(): of a wheel that is leaned, the tangent of its camber times its
  /// acceleration along t2, which WheelSums::moment feels as a torque [m/s²].
  void lean(double aside) noexcept { aside_ = aside; }

  /// The rim at t = 0 as a step that ends there.
  [[nodiscard]] WheelMotion at_start() const;
  /// @param sums of the deformation at t = 0
  /// @param force of the ground then, and its torque about the center [N/m], [N]
  void start(const WheelSums& sums, const RimVector& force);
  /// Step n + 1: its motion as far as it is known before its forces.
  [[nodiscard]] WheelMotion begin(long long n);
  /// The balances of momentum of the step.
  void set_lines(const WheelAnswer& answer);
  /// Accelerations beyond those of begin(), of a try without new forces [m/s²], [rad/s²].
  [[nodiscard]] RimVector hold();
  /// What forces do: accelerations are those of hold() + answer() · their push, where the push is
  /// the momentum that they give the rim [N·s/m], [N·s].
  [[nodiscard]] const Eigen::Matrix3d& answer() const noexcept { return answer_; }
  /// False if the brake would reverse the wheel or does not hold it: hold() and try again then.
  [[nodiscard]] bool settled(const RimVector& push);
  /// After settled(): in no try the brake could hold.
  [[nodiscard]] bool gave_up() const noexcept { return gave_up_; }
  /// Accelerations beyond those of begin(), with the forces of settled().
  [[nodiscard]] const RimVector& change() const noexcept { return change_; }
  /// The motion of the step with these.
  [[nodiscard]] WheelMotion moved() const;

  /// What the modes tell when the step is made.
  struct End {
    RimVector force;      ///< of the ground at t_{n+1}, and its torque about the center  [N/m], [N]
    WheelSums sums;       ///< at t_{n+1}
    double rim_work = 0;  ///< of the ground on the rim as WheelEnergy::rim                  [J/m]
    Vec2 middle;          ///< Σ m R w of the mean velocity                              [kg/s]
    double swirl = 0.0;   ///< Σ m u × w of mean velocity and the u that the step used [kg·m/s]
    double aside = 0.0;  ///< torque that WheelSums::moment takes by an acceleration along t2 [N·m]
  };
  /// Finishes the step: adds its works, all but those of contact and of internal forces.
  void finish(const End& end, dynamics::Works& works);
  /// Adds what rim and rigid motion of the body hold to energies in the co-rotating frame.
  void add_energy(dynamics::StepEnergy& energy) const;

  [[nodiscard]] const dynamics::FrameStep& frame() const noexcept { return frame_; }
  [[nodiscard]] const dynamics::RimReport& report() const noexcept { return report_; }
  /// Largest |s| so far [rad/s]
  [[nodiscard]] double most_spin() const noexcept { return most_spin_; }

  /// Mass and inertia of rim and body, undeformed                            [kg/m], [kg·m]
  [[nodiscard]] double whole_mass() const noexcept { return mass_; }
  [[nodiscard]] double whole_inertia() const noexcept { return inertia_; }

  static constexpr std::size_t n_numbers = 33;
  /// The numbers from which another rim of this model resumes bit for bit.
  [[nodiscard]] std::vector<double> save() const;
  /// @param n number of steps made @pre n_numbers
  void restore(long long n, std::span<const double> numbers);

 private:
  enum class Brake { off, slips, locks };

  [[nodiscard]] bool is_free(Eigen::Index k) const noexcept;
  [[nodiscard]] bool moves(Eigen::Index k) const noexcept;
  [[nodiscard]] RimVector given(double t) const;
  [[nodiscard]] RimVector momentum_of(const RimVector& v, const WheelSums& sums) const;
  [[nodiscard]] RimVector outside(const RimVector& v, Vec2 place) const;
  void set_frame(double turn, Vec2 way);
  void add_works(const RimVector& v, const RimVector& held, dynamics::Works& works) const;
  [[nodiscard]] double scheme_work(const End& end, const RimVector& missed) const;

  const dynamics::Model& model_;
  const dynamics::RimBody& rim_;
  const double theta_, closeness_;
  double body_mass_ = 0.0, mass_ = 0.0;        ///< of the body, and with the rim          [kg/m]
  double body_inertia_ = 0.0, inertia_ = 0.0;  ///< about the center                     [kg·m]
  long long step_ = 0;
  CompensatedSum x_, y_, angle_;
  Vec2 center_;
  RimVector now_, end_;           ///< velocities at both ends of the step
  std::optional<RimVector> led_;  ///< argument of lead()
  double aside_ = 0.0;            ///< argument of lean()
  double kept_spin_ = 0.0;
  double most_spin_ = 0.0;
  double rate_ = 0.0;   ///< θ̈ of the last step                                      [rad/s²]
  RimVector force_;     ///< of the ground at t_n, and its torque
  RimVector momentum_;  ///< that the balances have given so far; where held, that of the state
  RimVector actual_;    ///< of the state at t_n
  RimVector error_;     ///< of set_lines() in the last step, which is expected in the next
  WheelSums sums_;      ///< at t_n

  // The members below are made anew by each step.
  WheelMotion motion_;
  Vec2 gravity_;
  RimVector load_;     ///< F, T
  RimVector begun_;    ///< accelerations of begin()
  RimVector known_;    ///< right sides without new forces and without the brake
  RimVector right_;    ///< and with it
  RimVector at_rest_;  ///< accelerations beyond begun_ without new forces
  RimVector change_;   ///< and with them
  Eigen::Matrix3d lines_, answer_;
  double braking_ = 0.0;  ///< largest torque of the brake                                  [N]
  Brake brake_ = Brake::off;
  double direction_ = 0.0;  ///< sign of the spin while the brake slips
  int tries_ = 0;
  bool gave_up_ = false;
  dynamics::FrameStep frame_;
  dynamics::RimReport report_;
};

}  // namespace rondo::rom
