// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of half-spaces: Hertz's ellipse, and Kalker's linear creep coefficients (Kalker,
/// Three-Dimensional Elastic Bodies in Rolling Contact, 1990, table E.3, whose numbers CONTACT
/// stores in m_hertz.f90; eve70a/CONTACT d431cdb, Apache-2.0).
#pragma once
#include <cmath>
#include <numbers>

namespace rondo::test {

struct Ellipse {
  double rolling = 0.0, across = 0.0;  ///< half axes [m]
  double pressure = 0.0;               ///< largest [Pa]
};

/// Complete elliptic integrals of the parameter m = e² by the arithmetic-geometric mean.
struct Elliptic {
  double k = 0.0, e = 0.0;
};
inline Elliptic elliptic(double m) {
  double a = 1.0, b = std::sqrt(1.0 - m), sum = 0.5 * m, weight = 0.5;
  for (int n = 0; n < 40; ++n) {
    const double next = 0.5 * (a + b), c = 0.5 * (a - b);
    b = std::sqrt(a * b);
    a = next;
    weight *= 2.0;
    sum += weight * c * c;
  }
  const double k = std::numbers::pi / (2.0 * a);
  return {k, k * (1.0 - sum)};
}

/// Johnson, Contact Mechanics (1985), 4.2. @param modulus E/(1 - ν²) of the body on rigid ground
inline Ellipse hertz(double force, double modulus, double radius, double crown) {
  const double flat = 0.5 / std::max(radius, crown), steep = 0.5 / std::min(radius, crown);
  double low = 1e-3, high = 1.0 - 1e-9, ratio = 1.0;
  for (int n = 0; n < 100 && steep > flat * (1.0 + 1e-6); ++n) {
    ratio = 0.5 * (low + high);
    const Elliptic of = elliptic(1.0 - ratio * ratio);
    const bool too_thin = (of.e / (ratio * ratio) - of.k) / (of.k - of.e) > steep / flat;
    (too_thin ? low : high) = ratio;
  }
  double shape = std::numbers::pi / 4.0;  // (K - E)/e²
  if (ratio < 1.0) {
    const double m = 1.0 - ratio * ratio;
    shape = (elliptic(m).k - elliptic(m).e) / m;
  }
  const double major = std::cbrt(3.0 * force * shape / (2.0 * std::numbers::pi * modulus * flat));
  const double minor = ratio * major;
  const bool along = radius > crown;
  return {along ? major : minor, along ? minor : major,
          1.5 * force / (std::numbers::pi * major * minor)};
}

/// Interpolates the table's values at ν = 0, 1/4 and 1/2.
inline double at_poisson(double nu, double none, double quarter, double half) {
  return none * 8.0 * (nu - 0.25) * (nu - 0.5) - quarter * 16.0 * nu * (nu - 0.5) +
         half * 8.0 * nu * (nu - 0.25);
}

}  // namespace rondo::test
