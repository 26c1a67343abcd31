// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/features/case_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "rondo/case/rubber/material.hpp"
#include "rondo/core/contract.hpp"

namespace rondo::study {
namespace {

namespace has = dynamics::has;

/// Sharp convex corners may touch the body between two nodes.
bool has_sharp_corners(const Case& c) {
  if (has_obstacles_of_own_axes(c))
    return std::ranges::any_of(c.ground->obstacles,
                               [](const contact::Obstacle& o) { return o.fillet == 0.0; });
  return c.ground && contact::shape_faults(c.ground->shape).empty() &&
         !contact::Ground(c.ground->shape).corners().empty();
}

bool has_slip_or_camber(const Case& c) {
  return is_solid(c) && (c.motion.camber != 0.0 || c.motion.slip_angle.largest() != 0.0);
}

bool has_nonlinear_ogden(const Case& c) {
  if (!c.inflation ||
      (c.inflation->nonlinear != TyreMotion::window && c.inflation->nonlinear != TyreMotion::all))
    return false;
  return c.law.model == MaterialModel::ogden ||
         std::ranges::any_of(c.regions, [](const MaterialRegion& region) {
           return region.law.model == MaterialModel::ogden;
         });
}

/// Patches make the friction of the ground no constant, and its tables do not.
bool has_patches_alone(const Case& c) {
  if (!c.ground || c.ground->friction.is_constant()) return false;
  contact::FrictionTable rest = c.ground->friction;
  rest.patches.clear();
  return rest.is_constant();
}

/// If a feature has two rows, the last one also applies to a feature known only from the model.
constexpr std::array rows{
    CaseFeature{has::three_dimensions, "section", "a [disk] without disk.width",
                [](const Case& c) { return c.section.has_value(); }},
    CaseFeature{has::three_dimensions, "disk.width", "no disk.width: a plane body",
                [](const Case& c) { return c.wheel.width.has_value(); }},
    CaseFeature{has::camber, "motion.camber", "motion.camber = 0 and motion.slip_angle = 0",
                has_slip_or_camber},
    CaseFeature{has::loaded_rim, "rim", "no [rim]: a rim that follows [motion]",
                [](const Case& c) { return c.rim.has_value(); }},
    CaseFeature{has::free_bodies, "disk.rim", "disk.rim = \"bonded\"",
                [](const Case& c) { return !c.mesh && c.free_rim; }},
    CaseFeature{has::free_bodies, "mesh.clamped", "mesh.clamped that holds every body",
                [](const Case& c) { return c.mesh && c.mesh->clamped.empty(); }},
    CaseFeature{has::body_contact, "contact.between", "contact.between = \"none\"",
                [](const Case& c) { return c.body_contact.between != BodyContact::none; }},
    CaseFeature{has::mesh_file, "mesh.file", "a [disk]",
                [](const Case& c) { return c.mesh.has_value(); }},
    CaseFeature{has::assembled, "solver.operator", "solver.operator = \"auto\" or \"cyclic\"",
                [](const Case& c) { return c.solver_operator == "sparse"; }},
    CaseFeature{has::pressure, "load.pressure[0]", "no [[load.pressure]]",
                [](const Case& c) { return !c.pressures.empty(); }},
    CaseFeature{has::sharp_corners, "ground.fillet",
                "ground.fillet > 0 and that of each obstacle, about the size of an element",
                has_sharp_corners},
    CaseFeature{has::rubber, "material.model",
                "material.model = \"linear\" for the whole of the body",
                [](const Case& c) { return has_rubber(c); }},
    CaseFeature{
        has::nonlinear_cords, "inflation.nonlinear", "inflation.nonlinear = \"none\"",
        [](const Case& c) { return c.inflation && c.inflation->nonlinear != TyreMotion::linear; }},
    CaseFeature{has::nonlinear_ogden, "inflation.nonlinear", "inflation.nonlinear = \"cords\"",
                has_nonlinear_ogden},
    CaseFeature{has::viscosity, "material.viscosity[0]", "no viscosity; damping.stiffness",
                [](const Case& c) { return !has_rubber(c) && !c.law.viscosity.empty(); }},
    CaseFeature{has::viscosity, "material.loss_factor", "no loss_factor; damping.stiffness",
                [](const Case& c) { return !has_rubber(c) && c.law.loss_factor > 0.0; }},
    CaseFeature{has::viscosity, "material.region[0]",
                "no viscosity and no loss_factor of a region; damping.stiffness",
                [](const Case& c) { return !has_rubber(c) && has_viscosity(c); }},
    CaseFeature{has::own_material, "material.model", "material.model = \"linear\"",
                [](const Case&) { return false; }},
    CaseFeature{has::implicit, "solver.implicit[0]", "no [[solver.implicit]]",
                [](const Case& c) { return !c.implicit.empty(); }},
    CaseFeature{has::massless, "solver.contact_mass", "solver.contact_mass = \"lumped\"",
                [](const Case& c) { return c.contact_mass != ContactMass::lumped; }},
    CaseFeature{has::restitution, "ground.restitution", "ground.restitution = 0",
                [](const Case& c) { return c.ground && c.ground->restitution > 0.0; }},
    CaseFeature{
        has::energy_safe, "ground.impact", "no ground.impact",
        [](const Case& c) { return c.ground && c.ground->impact == contact::Impact::energy_safe; }},
    CaseFeature{has::friction_law, "ground.patch[0]", "no [[ground.patch]]", has_patches_alone},
    CaseFeature{has::friction_law, "ground.friction", "a number ground.friction, and no patches",
                [](const Case& c) { return c.ground && !c.ground->friction.is_constant(); }},
    CaseFeature{has::friction_work, "output.friction_work", "output.friction_work = false",
                [](const Case& c) { return c.output.friction_work; }},
    CaseFeature{has::stiffness_damping, "damping.stiffness", "damping.stiffness = 0",
                [](const Case& c) { return c.damping.stiffness > 0.0; }},
    CaseFeature{has::stress_stiffening, "material.stress_stiffening",
                "material.stress_stiffening = \"none\"",
                [](const Case& c) { return c.stress_stiffening != StressStiffening::none; }},
    CaseFeature{has::plane_stress, "material.plane", "material.plane = \"strain\"",
                [](const Case& c) { return c.material.plane == fem::Plane::stress; }},
    CaseFeature{has::other_scheme, "time.scheme", "time.scheme = \"symplectic\"",
                [](const Case& c) { return c.time.scheme != Scheme::symplectic; }},
    CaseFeature{has::hati, "time.scheme", "time.scheme = \"symplectic\"",
                [](const Case& c) { return c.time.scheme == Scheme::hati; }},
    CaseFeature{has::reduced, "analysis.kind", "the full run, without --reduced",
                [](const Case&) { return false; }},
};

}  // namespace

dynamics::Features features_of(const Case& c) {
  dynamics::Features all = 0;
  for (const CaseFeature& row : rows)
    if (row.is_in(c)) all |= row.of;
  return all;
}

const CaseFeature& row_of(const Case& c, dynamics::Features feature) {
  const dynamics::Features first = feature & (~feature + 1);
  const auto is_it = [&](const CaseFeature& row) { return row.of == first; };
  const auto* const in_case = std::ranges::find_if(
      rows, [&](const CaseFeature& row) { return is_it(row) && row.is_in(c); });
  if (in_case != rows.end()) return *in_case;
  const auto last = std::find_if(rows.rbegin(), rows.rend(), is_it);
  RONDO_DEMAND(last != rows.rend(), feature);
  return *last;
}

std::string instead_of(const Case& c, const dynamics::Limit& refusal) {
  return fmt::format("{}; or {}", row_of(c, refusal.at).without, row_of(c, refusal.with).without);
}

std::string_view why_not_cyclic(const Case& c) {
  const dynamics::Limit* const why = why_not(dynamics::StepKind::cyclic, features_of(c));
  return why ? why->why : std::string_view{};
}

}  // namespace rondo::study
