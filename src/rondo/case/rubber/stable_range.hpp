// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where the law of an incompressible rubber stops being stable: its nominal stress falls
/// while the stretch grows (Drucker's condition along the three tests that laws are fitted to).
#pragma once
#include <optional>
#include <string_view>

#include "rondo/fem/rubber.hpp"

namespace rondo::study {

/// Stretches of a test in which a law must be stable [-].
inline constexpr double least_stretch = 0.5, largest_stretch = 2.0;

struct Unstable {
  std::string_view test;  ///< "uniaxial", "equibiaxial" or "planar"
  double stretch = 0.0;   ///< nearest to 1 where the stress does not rise with it [-]
};

/// None where the stress rises with the stretch in all three tests. @pre no exponent is 0
[[nodiscard]] std::optional<Unstable> find_unstable(const fem::Rubber& rubber);

/// d²W/dλ² of an incompressible test: slope of the nominal stress, of two equal ones their sum
/// [Pa].
/// @param powers of the stretch that the three principal stretches are; their sum is 0
[[nodiscard]] double stress_slope(const fem::Rubber& rubber, const double (&powers)[3],
                                  double stretch) noexcept;

}  // namespace rondo::study
