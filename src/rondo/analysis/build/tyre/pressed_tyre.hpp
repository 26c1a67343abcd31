// SPDX-License-Identifier: BSD-3-Clause
/// @file  How hard a tyre is pressed on the ground, for `rondo check`: load and deflection, one
/// estimated from the other by the air alone, and warnings if tyres do not bear that.
#pragma once
#include <string>

#include "rondo/analysis/build/physical.hpp"
#include "rondo/case/inflation_figures.hpp"

namespace rondo::study {

// Bounds beyond which there is a warning.
inline constexpr double least_air_share = 3e-3;  ///< load over air_force()
inline constexpr double most_air_share = 1.0;    ///< tyres of bicycles to aircraft bear .05 to .7
inline constexpr double deep_tyre_share = 0.35;  ///< deflection over the wall

/// A wheel about its inflated state. @pre the wall is that of this state
struct PressedTyre {
  const InflationFigures& state;
  Wall wall;
};

/// Pressure times width times outer radius: a measure of what the air can bear [N].
[[nodiscard]] double air_force(const InflationFigures& state);
/// Load over deflection, estimated by the air alone [N/m].
[[nodiscard]] double air_stiffness(const InflationFigures& state);

/// Lines and warnings for a load that is given. @param key that says how large it is
/// @param load > 0 [N] @pre the pressure is not 0
[[nodiscard]] PhysicalFigures under_load(const std::string& key, double load,
                                         const PressedTyre& tyre);
/// Lines and warnings for a deflection that is given. @param deflection > 0 [m]
[[nodiscard]] PhysicalFigures pressed_in(const std::string& key, double deflection,
                                         const PressedTyre& tyre);

/// The tyre stays clear of the ground; empty: it does not, a lean may still make it touch, or
/// stays_above_ground() tells it. @param gap below the tyre if it is upright [m] @param lean [rad]
[[nodiscard]] std::string stays_clear(const std::string& key, double gap, double lean,
                                      const PressedTyre& tyre);

}  // namespace rondo::study
