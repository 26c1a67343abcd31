// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/tyre/wheel_at_rest.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondo/analysis/build/solid/wheel_mesh.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/finite/tangent_sector.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/mesh/solid/wheel.hpp"

namespace rondo::study {
namespace {

/// Largest sum of the entries of a row of M⁻¹K: no eigenvalue is above it.
double row_bound(const fem::SolidSector& k, std::span<const double> mass) {
  double largest = 0.0;
  for (std::size_t a = 0; a < k.n_local(); ++a) {
    std::array<double, 3> sum{};
    for (const fem::SolidSector::Entry& e : k.row(a))
      for (std::size_t i = 0; i < 9; ++i) sum[i % 3] += std::abs(e.block[i]);
    largest = std::max(largest, std::ranges::max(sum) / mass[k.node(a, 0)]);
  }
  return largest;
}

/// (n_local) -s² m P x in the frame of the sector.
std::vector<Vec3> pull_of(const mesh::Mesh& mesh, const WheelAtRest& rest, double spin_squared) {
  std::vector<Vec3> load;
  for (std::size_t a = 0; spin_squared != 0.0 && a < rest.sector.n_local(); ++a) {
    const std::size_t node = rest.sector.node(a, 0);
    load.emplace_back(-spin_squared * rest.mass[node] * mesh.coordinates[node], 0.0);
  }
  return load;
}

/// Cords and air apart from the rubber, whose tangent stays.
dynamics::SweptPart swept_part(const InflationCase& c, const InflatedWheel& wheel,
                               const statics::Inflation& found, const mesh::Mesh& mesh) {
  fem::finite::SweptSection rubber = wheel.energy().section();
  rubber.cords.clear();
  rubber.liner.clear();
  rubber.caps.clear();
  const fem::finite::SectorEnergy alone(std::move(rubber));
  dynamics::SweptPart part{wheel.energy().faces(wheel.loads().sector.pressure),
                           fem::finite::tangent_sector(mesh, alone.state(found.u, {}))};
  if (c.nonlinear == TyreMotion::cords) return part;
  part.rubber = wheel.energy().rubber(found.u);
  part.window.half = c.nonlinear == TyreMotion::all ? 2.0 * std::numbers::pi : c.window;
  return part;
}

/// K about the state with all cords as stiff as in tension; none: they are, or stay as they are.
std::optional<fem::SolidSector> stiffest(const Case& c, const InflatedWheel& wheel,
                                         const statics::Inflation& found, const mesh::Mesh& mesh) {
  const auto softer = [](const fem::finite::Cords& cords) { return cords.law.compression < 1.0; };
  if (c.inflation->nonlinear == TyreMotion::linear ||
      std::ranges::none_of(wheel.energy().section().cords, softer))
    return std::nullopt;
  fem::finite::SweptSection section = wheel.energy().section();
  for (fem::finite::Cords& cords : section.cords) cords.law.compression = 1.0;
  const fem::finite::SectorEnergy taut(std::move(section));
  return fem::finite::tangent_sector(mesh, taut.state(found.u, wheel.loads().sector));
}

WheelAtRest inflated(const Case& c, mesh::Mesh& mesh, std::vector<fem::Material>& materials,
                     fem::ViscousBy by) {
  const InflatedWheel wheel(c, build_section(c, nullptr), materials);
  const statics::Inflation found = equilibrium_of(c, wheel);
  WheelAtRest rest;
  for (int j = 0; j < mesh.n_sectors; ++j)
    rest.mass.insert(rest.mass.end(), wheel.energy().mass().begin(), wheel.energy().mass().end());
  rest.sector = fem::finite::tangent_sector(mesh, found.state);
  rest.stiffest = stiffest(c, wheel, found, mesh);
  if (c.inflation->nonlinear != TyreMotion::linear)
    rest.swept = swept_part(*c.inflation, wheel, found, mesh);
  mesh::move_nodes(mesh, in_all_sectors(mesh, found.u),
                   c.section ? c.section->mesh.contact : "tread");
  rest.load = pull_of(mesh, rest, wheel.loads().sector.spin_squared);
  rest.inflation = figures_of(wheel, found);
  rest.viscous = fem::viscous_parts<fem::SolidSector>(mesh, materials, by);
  if (!rest.viscous.empty())
    rest.stiffest =
        fem::with_branches<3>(rest.stiffest ? *rest.stiffest : rest.sector, rest.viscous);
  rest.frequencies_below = row_bound(rest.stiffest ? *rest.stiffest : rest.sector, rest.mass);
  for (fem::Material& m : materials) m.rubber.reset();
  return rest;
}

}  // namespace

WheelAtRest wheel_at_rest(const Case& c, mesh::Mesh& mesh, std::vector<fem::Material>& materials,
                          fem::ViscousBy by) {
  RONDO_DEMAND(mesh.is_solid(), mesh.n_nodes());
  if (c.inflation) return inflated(c, mesh, materials, by);
  WheelAtRest rest;
  rest.mass = fem::solid_mass(mesh, materials);
  rest.sector = fem::assemble_solid_sector(mesh, materials);
  const std::vector<fem::Material> at_once = fem::instantaneous(materials);
  rest.frequencies_below = fem::solid_eigenvalue_bound(mesh, at_once);
  if (fem::has_branches(materials)) rest.stiffest = fem::assemble_solid_sector(mesh, at_once);
  rest.viscous = fem::viscous_parts<fem::SolidSector>(mesh, materials, by);
  return rest;
}

}  // namespace rondo::study
