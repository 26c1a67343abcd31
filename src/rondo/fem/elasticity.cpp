// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/elasticity.hpp"

#include <cmath>

namespace rondo::fem {

Hooke hooke(const Material& m) noexcept {
  const double e = m.youngs_modulus, nu = m.poissons_ratio;
  const double shear = e / (2.0 * (1.0 + nu));
  if (m.plane == Plane::stress) {
    const double d11 = e / (1.0 - nu * nu);
    return {d11, nu * d11, shear, 0.0};
  }
  const double factor = e / ((1.0 + nu) * (1.0 - 2.0 * nu));
  return {factor * (1.0 - nu), factor * nu, shear, nu};
}

WaveSpeeds wave_speeds(const Material& m) noexcept {
  const Hooke d = hooke(m);
  return {std::sqrt(d.d11 / m.density), std::sqrt(d.d33 / m.density)};
}

}  // namespace rondo::fem
