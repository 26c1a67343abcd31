// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/elasticity.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::fem {

const Material& material_of(const mesh::Mesh& mesh, std::span<const Material> materials,
                            std::size_t cell) {
  const std::size_t place = mesh.region.empty() ? 0 : static_cast<std::size_t>(mesh.region[cell]);
  RONDO_DEMAND(place < materials.size(), place, materials.size());
  return materials[place];
}

bool has_rubber(std::span<const Material> materials) noexcept {
  return std::ranges::any_of(materials, [](const Material& m) { return m.rubber.has_value(); });
}

bool has_branches(std::span<const Material> materials) noexcept {
  return std::ranges::any_of(materials, [](const Material& m) {
    return !(m.rubber ? m.rubber->branches : m.branches).empty();
  });
}

std::vector<Material> instantaneous(std::span<const Material> materials) {
  std::vector<Material> at_once(materials.begin(), materials.end());
  for (Material& m : at_once) {
    if (!m.rubber) {
      double sum = 1.0;
      for (const ViscousBranch& branch : m.branches) sum += branch.relative_modulus;
      m.youngs_modulus *= sum;
      m.branches.clear();
      continue;
    }
    const double kappa = m.rubber->bulk_modulus;
    const double mu = m.rubber->shear_modulus() * m.rubber->instantaneous();
    if (!m.rubber->branches.empty()) {  // else the same bits
      m.poissons_ratio = (3.0 * kappa - 2.0 * mu) / (2.0 * (3.0 * kappa + mu));
      m.youngs_modulus = 2.0 * mu * (1.0 + m.poissons_ratio);
    }
    m.rubber.reset();
  }
  return at_once;
}

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

ElementLaw element_law(const Material& m) noexcept {
  const Hooke d = hooke(m);
  if (m.integration == Integration::full || m.plane == Plane::stress) return {d, 0.0};
  const double shear = d.d33;
  return {{4.0 / 3.0 * shear, -2.0 / 3.0 * shear, shear, -1.0},
          m.only_shear ? 0.0 : d.d11 - 4.0 / 3.0 * shear};
}

WaveSpeeds wave_speeds(const Material& m) noexcept {
  const Hooke d = hooke(m);
  return {std::sqrt(d.d11 / m.density), std::sqrt(d.d33 / m.density)};
}

}  // namespace rondo::fem
