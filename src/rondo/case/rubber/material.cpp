// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/rubber/material.hpp"

#include <algorithm>

#include "rondo/fem/viscosity.hpp"

namespace rondo::study {
namespace {

/// The coefficients of its model; all others are 0.
fem::Rubber law_of(const MaterialLaw& law) {
  fem::Rubber r;
  const MaterialModel model = law.model;
  using enum MaterialModel;
  r.law = model == mooney_rivlin ? fem::RubberLaw::mooney_rivlin
          : model == yeoh        ? fem::RubberLaw::yeoh
          : model == ogden       ? fem::RubberLaw::ogden
                                 : fem::RubberLaw::neo_hooke;
  if (model == neo_hooke) r.c10 = 0.5 * law.shear_modulus;
  if (model == mooney_rivlin || model == yeoh) r.c10 = law.c10;
  if (model == mooney_rivlin) r.c01 = law.c01;
  if (model == yeoh) r.c20 = law.c20;
  if (model == yeoh) r.c30 = law.c30;
  if (model == ogden)
    for (const auto& [modulus, exponent] : law.terms) r.terms.push_back({modulus, exponent});
  return r;
}

std::vector<fem::ViscousBranch> branches_of(const MaterialLaw& law) {
  if (law.loss_factor > 0.0 && !has_band(law)) return {};  // check_materials() has told
  if (law.loss_factor > 0.0)
    return fem::branches_of(law.loss_factor, {law.loss_band.x, law.loss_band.y});
  std::vector<fem::ViscousBranch> branches;
  for (const auto& [modulus, time] : law.viscosity) branches.push_back({modulus, time});
  return branches;
}

}  // namespace

bool has_band(const MaterialLaw& law) noexcept {
  const auto [low, high] = law.loss_band;
  return low >= slowest_band && low < high && high <= fastest_band && high <= widest_band * low;
}

bool has_viscosity(const Case& c) noexcept {
  const auto has = [](const MaterialLaw& law) {
    return law.loss_factor > 0.0 || !law.viscosity.empty();
  };
  return has(c.law) || std::ranges::any_of(c.regions, has, &MaterialRegion::law);
}

bool has_rubber_law(const Case& c) noexcept {
  return c.law.is_rubber() || std::ranges::any_of(c.regions, [](const MaterialRegion& region) {
           return region.law.is_rubber();
         });
}

double shear_modulus_of(const MaterialLaw& law) noexcept {
  return law_of(law).shear_modulus();
}

void fill_material(const MaterialLaw& law, fem::Material& m) {
  m.rubber.reset();
  m.branches.clear();
  m.integration =
      law.integration == Quadrature::full ? fem::Integration::full : fem::Integration::b_bar;
  if (!law.is_rubber()) {
    m.branches = branches_of(law);
    return;
  }
  fem::Rubber r = law_of(law);
  const double mu = r.shear_modulus();
  if (law.bulk_modulus) {
    r.bulk_modulus = *law.bulk_modulus;
    m.poissons_ratio = (3.0 * r.bulk_modulus - 2.0 * mu) / (2.0 * (3.0 * r.bulk_modulus + mu));
  } else {
    r.bulk_modulus = 2.0 * mu * (1.0 + m.poissons_ratio) / (3.0 * (1.0 - 2.0 * m.poissons_ratio));
  }
  m.youngs_modulus = 2.0 * mu * (1.0 + m.poissons_ratio);
  r.branches = branches_of(law);
  r.one_point = law.integration == Quadrature::one_point;
  m.rubber = std::move(r);
}

}  // namespace rondo::study
