// SPDX-License-Identifier: BSD-3-Clause
/// @file  The stretch at which the law of an incompressible rubber becomes unstable: its nominal
/// stress falls while the stretch grows (Drucker's condition in the three tests used to fit laws).
#pragma once
#include <optional>
#include <string_view>

#include "rondo/fem/rubber.hpp"

namespace rondo::study {

/// Range of stretches of a test within which a law must be stable [-].
inline constexpr double least_stretch = 0.5, largest_stretch = 2.0;

struct Unstable {
  std::string_view test;  ///< "uniaxial", "equibiaxial" or "planar"
  double stretch = 0.0;   ///< nearest to 1 at which the stress does not rise [-]
};

/// None if the stress rises with the stretch in all three tests. @pre no exponent is 0
[[nodiscard]] std::optional<Unstable> find_unstable(const fem::Rubber& rubber);

/// d²W/dλ² of an incompressible test: slope of the nominal stress,
/// or the sum of two equal ones [Pa]. @param powers exponents of
/// the three principal stretches as powers of λ; their sum is 0
[[nodiscard]] double stress_slope(const fem::Rubber& rubber, const double (&powers)[3],
                                  double stretch) noexcept;

}  // namespace rondo::study
