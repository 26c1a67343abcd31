// SPDX-License-Identifier: BSD-3-Clause
/// @file  Rubber for tests: materials, and disks made of it.
#pragma once
#include <memory>

#include "rondo/model/hyperelastic.hpp"
#include "support/models.hpp"

namespace rondo::test {

/// The material with the corresponding small-strain constants.
inline fem::Material rubber_material(const fem::Rubber& r, double density = 1100.0) {
  const double mu = r.shear_modulus(), k = r.bulk_modulus;
  fem::Material m;
  m.youngs_modulus = 9.0 * k * mu / (3.0 * k + mu);
  m.poissons_ratio = (3.0 * k - 2.0 * mu) / (2.0 * (3.0 * k + mu));
  m.density = density;
  m.integration = fem::Integration::b_bar;
  m.rubber = r;
  return m;
}

/// @param mu, bulk at small strain [Pa]
inline fem::Rubber neo_hooke(double mu, double bulk) {
  fem::Rubber r;
  r.c10 = 0.5 * mu;
  r.bulk_modulus = bulk;
  return r;
}

/// Sets the forces of rubber for the reference step and for the fused one.
inline void set_rubber(Built& b) {
  b.model.sector.reset();
  b.model.internal_force = dynamics::hyperelastic_maker(
      std::make_shared<const fem::Hyperelasticity>(b.mesh, b.materials));
  b.model.rubber = dynamics::rubber_part(b.mesh, b.materials);
}

}  // namespace rondo::test
