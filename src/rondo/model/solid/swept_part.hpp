// SPDX-License-Identifier: BSD-3-Clause
/// @file  Forces of a wheel that are not linear about its state: cords, air, and rubber in a window
/// of columns (docs/tyre.md).
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "rondo/fem/finite/rubber_remainder.hpp"
#include "rondo/fem/finite/swept_forces.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// All forces of a wheel at a displacement from its state.
class SweptWheel {
 public:
  /// The part must outlive it. @param x (n) places of the nodes in the state, sector by sector [m]
  SweptWheel(const SweptPart& part, std::vector<Vec3> x);

  /// Finds f(x + u) - f(x), on clamped nodes as well.
  /// @param angle by which the wheel has turned [rad]
  /// @return E(x + u) - E(x) - f(x)·u [J]
  double find(std::span<const Vec3> u, double angle, std::span<Vec3> force) noexcept;
  /// Hands on the stiffness at u.
  void tangent(std::span<const Vec3> u, double angle, const fem::finite::TakeBlock& take) const;
  /// What the window's motion between the last two places gave to the rubber of columns that
  /// entered, less what it took from those that left [J].
  [[nodiscard]] double window_work() const noexcept { return window_work_; }

  /// Appends weight and energy of each column at the last place, which window_work() needs.
  void save(std::vector<double>& numbers) const;
  /// @param numbers (2 n_sectors)
  void restore(std::span<const double> numbers);

 private:
  double find_rubber(std::span<const Vec3> u, double angle, std::span<Vec3> force) noexcept;

  const SweptPart& part_;
  fem::finite::SweptForces faces_;
  std::optional<fem::finite::RubberRemainder> rubber_;
  std::vector<double> weight_, weight_before_, energy_, energy_before_;  ///< (n_sectors)
  double window_work_ = 0.0;
};

/// @pre model.solid->swept
[[nodiscard]] SweptWheel swept_wheel(const Model& model);

/// What is stored at u more than in the state, in rubber, cords and air [J].
/// @param angle by which the wheel has turned [rad]
[[nodiscard]] double stored_energy(const Model& model, std::span<const Vec3> u, double angle);

/// Whether columns enter and leave a window, which does work on the rubber.
[[nodiscard]] bool has_window(const Model& model) noexcept;
/// Size of SavedState::window.
[[nodiscard]] std::size_t window_numbers(const Model& model) noexcept;

}  // namespace rondo::dynamics
