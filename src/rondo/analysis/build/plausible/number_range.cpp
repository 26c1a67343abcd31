// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/plausible/number_range.hpp"

#include <fmt/format.h>

#include <cmath>

#include "rondo/case/case_keys.hpp"
#include "rondo/core/contract.hpp"

namespace rondo::study {
namespace {

/// A product of four of such numbers, as a pivot's square is, has still a range to spare.
constexpr double least = 1e-60, most = 1e60;

struct Used {
  std::string key;
  double value, usual;  ///< in SI units
};

std::vector<Used> used_by(const Case& c) {
  std::vector<Used> all{{"material.youngs_modulus", c.material.youngs_modulus, 1e7},
                        {"material.density", c.material.density, 1e3},
                        {"damping.mass", c.damping.mass, 1e2},
                        {"damping.stiffness", c.damping.stiffness, 1e-5},
                        {"motion.angular_velocity", c.motion.angular_velocity.largest(), 30.0},
                        {"motion.gravity", c.motion.gravity.largest(), 10.0}};
  if (!mesh_file_of(c)) all.push_back({"disk.outer_radius", c.disk.outer_radius, 0.3});
  if (c.wheel.width) all.push_back({"disk.width", *c.wheel.width, 0.1});
  for (std::size_t k = 0; k < c.pressures.size(); ++k)
    all.push_back({item_of("load.pressure", k) + ".value", c.pressures[k].pressure.largest(), 1e5});
  for (std::size_t k = 0; k < c.regions.size(); ++k) {
    const std::string table = item_of("material.region", k) + ".";
    all.push_back({table + "youngs_modulus", c.regions[k].material.youngs_modulus, 1e7});
    all.push_back({table + "density", c.regions[k].material.density, 1e3});
  }
  return all;
}

bool is_within(double value) {
  return value >= least && value <= most;
}

}  // namespace

std::string furthest_key(const Case& c) {
  std::string key = "material.youngs_modulus";
  double furthest = 0.0;
  for (const Used& used : used_by(c)) {
    const double orders =
        used.value != 0.0 ? std::abs(std::log10(std::abs(used.value) / used.usual)) : 0.0;
    if (orders > furthest) furthest = orders, key = used.key;
  }
  return key;
}

void demand_harmonic_range(const Case& c, const std::vector<fem::Material>& materials,
                           std::span<const double> mass, double rate) {
  RONDO_DEMAND(!materials.empty() && !mass.empty(), materials.size(), mass.size());
  bool fits = rate == 0.0 || is_within(rate * rate);
  fits &= c.damping.mass * rate <= most && c.damping.stiffness * rate <= most;
  for (const fem::Material& m : materials)
    fits &= is_within(m.youngs_modulus) && is_within(m.density);
  for (const double m : mass) fits &= m == 0.0 || is_within(m);
  if (!fits)
    throw case_error(
        c, furthest_key(c),
        "with this number the equations of the body exceed the range of floating-point numbers",
        fmt::format("SI units: moduli, masses of nodes, squares of frequencies and "
                    "damping times frequency from {:.0e} to {:.0e}",
                    least, most));
}

}  // namespace rondo::study
