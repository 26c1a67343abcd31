// SPDX-License-Identifier: BSD-3-Clause
/// @file  The coefficient of friction by tables: over the slip speed, by a power of the pressure,
/// and by patches of the ground (docs/roads.md). μ = μ_0 f(|w_t|) (p/p_ref)^k times the factors of
/// the patches at that place.
#pragma once
#include <array>
#include <vector>

#include "rondo/contact/friction.hpp"

namespace rondo::contact {

/// Where across the track a patch is, seen along t1: t2 points to the right.
enum class Side { both, left, right };

/// A stretch of the ground with another surface: from <= x < to.
struct FrictionPatch {
  double from = 0.0, to = 0.0;  ///< along t1                                             [m]
  /// left: t2 < 0, right: t2 > 0. One passes into the other from 1 mm before t2 = 0 to 1 mm behind
  /// it: for a node in the middle plane the factor counts by half
  Side side = Side::both;
  double factor = 1.0;  ///< >= 0, of the coefficient                             [-]
};

struct FrictionTable {
  double coefficient = 0.0;  ///< μ_0: at factor 1, and at the reference pressure  [-]
  /// Factor of the coefficient, >= 0, over the slip speed |w_t| >= 0: ascending speeds, linear
  /// between, the end values beyond. None: factor 1                                  [m/s, -]
  std::vector<std::array<double, 2>> slip;
  double pressure_exponent = 0.0;     ///< k                                                [-]
  double pressure_reference = 2.0e5;  ///< p_ref > 0; p counts from p_ref/10 to 10 p_ref    [Pa]
  std::vector<FrictionPatch> patches;

  /// Whether μ is the same at every place, slip speed and pressure.
  [[nodiscard]] bool is_constant() const noexcept;
};

/// μ with its derivatives by the slip speed and the pressure. At a corner of the tables they are
/// those of the piece above.
struct FrictionValue {
  double coefficient = 0.0;  ///< [-]
  double by_slip = 0.0;      ///< [s/m]
  double by_pressure = 0.0;  ///< [1/Pa]
};

/// Allocates nothing.
[[nodiscard]] FrictionValue friction_at(const FrictionTable& table,
                                        const SlidingState& of) noexcept;

/// The most that μ can be, at any place, slip speed and pressure; of a constant, the constant.
[[nodiscard]] double largest_friction(const FrictionTable& table) noexcept;

/// Whether the factor of some slip speed is below that of a smaller one.
[[nodiscard]] bool falls_with_slip(const FrictionTable& table) noexcept;

/// The most by which μ rises with the slip speed at a pressure, outside of all patches; 0: it does
/// not rise                                                                               [s/m]
[[nodiscard]] double steepest_rise(const FrictionTable& table, double pressure) noexcept;

/// The product of the factors of all patches at a place.
[[nodiscard]] double patch_factor(const FrictionTable& table, const Vec3& place) noexcept;

/// The law of a table; a constant where the table is one.
[[nodiscard]] Friction friction_of(FrictionTable table);

}  // namespace rondo::contact
