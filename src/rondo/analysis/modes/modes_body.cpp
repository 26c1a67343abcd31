// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/modes/modes_body.hpp"

#include <fmt/format.h>

#include <cmath>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/build/overlap.hpp"
#include "rondo/analysis/build/physical.hpp"
#include "rondo/analysis/build/plausible/number_range.hpp"
#include "rondo/analysis/build/tyre/wheel_at_rest.hpp"
#include "rondo/modal/modes.hpp"

namespace rondo::study {
namespace {

/// @return an upper bound of ω² [1/s²]
double complete_plane(const Case& c, ModesBody& b) {
  refuse_overlaps(c, {b.mesh, b.mesh.coordinates, c.body_contact.between != BodyContact::none},
                  b.warnings);
  if (has_rubber(c))
    b.warnings.emplace_back(
        "the modes of rubber are those of small strain about the undeformed body, by its moduli "
        "for slow strains");
  b.mass = fem::lumped_mass(b.mesh, b.materials);
  b.wide_rows = has_wide_rows(c, b.mesh);
  b.free = static_cast<int>(modal::free_bodies(b.mesh).size());
  return b.cyclic() ? fem::sector_eigenvalue_bound(b.mesh, b.materials)
                    : fem::element_eigenvalue_bound(b.mesh, b.materials);
}

double complete_solid(const Case& c, ModesBody& b) {
  if (b.mesh.clamped.empty())
    throw case_error(c, c.section ? "section.clamped" : "disk.rim",
                     "nothing holds the wheel: the modes of a wheel in three dimensions are "
                     "computed with its rim held",
                     c.section ? "the curve that the rim holds" : "\"bonded\"");
  WheelAtRest rest = wheel_at_rest(c, b.mesh, b.materials, fem::ViscousBy::branches);
  b.mass = std::move(rest.mass);
  b.sector = std::move(rest.sector);
  b.viscous = std::move(rest.viscous);
  b.inflation = std::move(rest.inflation);
  return rest.frequencies_below;
}

}  // namespace

ModesBody make_modes_body(const Case& c) {
  ModesBody b;
  b.warnings = c.warnings;
  if (c.rim && (c.rim->free_x || c.rim->free_y || c.rim->free_spin))
    b.warnings.emplace_back(
        "[rim] has no effect on modes: they are those of the body with its rim held");
  b.mesh = build_mesh(c, &b.warnings);
  b.materials = materials_of(c, b.mesh);
  warn_of_units(c, b.mesh, b.materials, b.warnings);
  b.largest_frequency = std::sqrt(is_solid(c) ? complete_solid(c, b) : complete_plane(c, b));
  if (!(b.largest_frequency > 0.0) || !std::isfinite(b.largest_frequency))
    throw case_error(c, furthest_key(c),
                     fmt::format("with this number and mesh the largest frequency is {} rad/s, out "
                                 "of the range of floating-point numbers",
                                 b.largest_frequency),
                     "a modulus and a density in SI units");
  demand_harmonic_range(c, b.materials, b.mass, b.largest_frequency);
  return b;
}

}  // namespace rondo::study
