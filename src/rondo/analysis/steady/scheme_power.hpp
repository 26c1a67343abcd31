// SPDX-License-Identifier: BSD-3-Clause
/// @file  Judges the power of the discretisation in a steady state (docs/steady.md, The power of
/// the discretisation): the balance of powers closes with it, so that the balance does not tell.
#pragma once
#include <string>

#include "rondo/case/case.hpp"
#include "rondo/statics/steady/rolling_power.hpp"

namespace rondo::study {

inline constexpr double scheme_share_told = 0.05;   ///< above it the run warns
inline constexpr double scheme_share_bound = 0.25;  ///< above it the state is no result
/// A bound of scheme_over_load: up to it a state stays a result, for its forces and its rolling
/// resistance are exact to a hundredth of what a tyre has.
inline constexpr double scheme_over_load_bound = 1e-4;

/// What is wrong, and what to do; empty: nothing, or the case accepts it.
[[nodiscard]] std::string scheme_trouble(const Case& c, const statics::RollingPower& power);

/// For the user; empty: it is small.
[[nodiscard]] std::string scheme_warning(const Case& c, const statics::RollingPower& power);

}  // namespace rondo::study
