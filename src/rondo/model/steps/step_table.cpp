// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/steps/step_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {
namespace {

constexpr std::array names{
    FeatureName{has::three_dimensions, "wheel in three dimensions"},
    FeatureName{has::three_dimensions | has::camber, "camber or slip angle"},
    FeatureName{has::loaded_rim, "rim that forces move"},
    FeatureName{has::free_bodies, "free bodies"},
    FeatureName{has::body_contact, "contact between bodies"},
    FeatureName{has::mesh_file, "plane mesh from a file"},
    FeatureName{has::assembled, "assembled stiffness"},
    FeatureName{has::pressure, "pressure"},
    FeatureName{has::pressure | has::loaded_rim, "pressure on a rim that forces move"},
    FeatureName{has::sharp_corners, "sharp corners of the ground"},
    FeatureName{has::rubber, "rubber at finite strain"},
    FeatureName{has::rubber | has::pressure | has::sharp_corners,
                "pressure on rubber with sharp corners of the ground"},
    FeatureName{has::three_dimensions | has::nonlinear_cords, "nonlinear cords and air of a tyre"},
    FeatureName{has::three_dimensions | has::nonlinear_ogden,
                "nonlinear rubber of a tyre by Ogden's law"},
    FeatureName{has::viscosity, "viscous branches at small strain"},
    FeatureName{has::own_material, "rubber in triangles, or a material of your own"},
    FeatureName{has::implicit, "implicit elements"},
    FeatureName{has::massless, "contact nodes without mass"},
    FeatureName{has::restitution, "restitution"},
    FeatureName{has::energy_safe, "energy-safe impacts"},
    FeatureName{has::friction_law, "friction that is not constant"},
    FeatureName{has::friction_law | has::sharp_corners,
                "friction that is not constant, with sharp corners of the ground"},
    FeatureName{has::friction_law | has::implicit,
                "friction that is not constant, with implicit elements"},
    FeatureName{has::friction_law | has::massless,
                "friction that is not constant, with contact nodes without mass"},
    FeatureName{has::friction_work, "friction work in the results"},
    FeatureName{has::stiffness_damping, "stiffness damping"},
    FeatureName{has::stress_stiffening, "stress stiffening"},
    FeatureName{has::plane_stress, "plane stress"},
    FeatureName{has::other_scheme, "scheme other than \"symplectic\""},
    FeatureName{has::hati | has::other_scheme, "scheme \"hati\""},
    FeatureName{has::reduced, "reduced wheel"},
    FeatureName{has::reduced | has::loaded_rim, "reduced wheel on a rim that forces move"},
    FeatureName{has::reduced | has::viscosity, "reduced wheel of a viscous material"},
    FeatureName{has::reduced | has::pressure, "reduced wheel with pressures"},
    FeatureName{has::reduced | has::nonlinear_cords, "reduced wheel with nonlinear cords and air"},
};

constexpr std::array steps{
    StepRow{StepKind::cyclic, "fused cyclic", 0},
    StepRow{StepKind::sparse, "fused sparse", 0},
    StepRow{StepKind::bodies, "fused bodies", 0},
    StepRow{StepKind::wheel, "general on a loaded rim", has::loaded_rim},
    StepRow{StepKind::general, "general", 0},
    StepRow{StepKind::hati, "hati", has::hati | has::other_scheme},
    StepRow{StepKind::solid_cyclic, "fused 3-D cyclic", has::three_dimensions},
    StepRow{StepKind::solid, "general 3-D", has::three_dimensions},
    StepRow{StepKind::solid_wheel, "general 3-D on a loaded rim",
            has::three_dimensions | has::loaded_rim},
    StepRow{StepKind::reduced, "reduced", has::reduced},
    StepRow{StepKind::solid_reduced, "reduced 3-D", has::three_dimensions | has::reduced},
};

constexpr std::uint32_t bit(StepKind kind) {
  return 1U << static_cast<unsigned>(kind);
}
constexpr std::uint32_t cyclic = bit(StepKind::cyclic), sparse = bit(StepKind::sparse),
                        bodies = bit(StepKind::bodies), general = bit(StepKind::general),
                        wheel = bit(StepKind::wheel), own_hati = bit(StepKind::hati),
                        disk_reduced = bit(StepKind::reduced),
                        solid_reduced = bit(StepKind::solid_reduced),
                        fused = cyclic | sparse | bodies, plane = fused | general | wheel,
                        any = ~0U;

constexpr std::array limits{
    // What some steps do not support -------------------------------------------------------------
    Limit{has::three_dimensions, 0, plane | own_hati | disk_reduced,
          "the step is for plane bodies"},
    Limit{has::mesh_file, 0, cyclic, "a mesh from a file is not known to have equal sectors"},
    Limit{has::assembled, 0, cyclic, "the stiffness is assembled, not that of one sector"},
    Limit{has::loaded_rim, 0, bodies | general | bit(StepKind::solid),
          "the rim of this step follows its tables"},
    Limit{has::free_bodies, 0, cyclic | sparse,
          "a free body does not stay in the co-rotating frame of its sectors"},
    Limit{has::body_contact, 0, cyclic | sparse,
          "there is a [contact] of bodies, which couples nodes that the step updates one by one"},
    Limit{has::pressure, has::loaded_rim, cyclic | sparse,
          "with a [rim] pressures act on the deformed edges, which needs the general step"},
    Limit{has::rubber, 0, cyclic | bodies,
          "the forces of rubber at finite strain are no product with a stiffness"},
    Limit{has::rubber, has::pressure | has::sharp_corners, sparse,
          "with sharp corners the step does not support pressures that follow the edges of rubber"},
    Limit{has::nonlinear_ogden, 0, bit(StepKind::solid_cyclic),
          "the step has rubber of polynomial laws, not of Ogden's, whose powers are slow"},
    Limit{has::viscosity, 0, fused | bit(StepKind::solid_cyclic) | own_hati,
          "viscous branches at small strain have displacements of their own, which the step does "
          "not carry"},
    Limit{has::own_material, 0, fused,
          "the forces of the material are no product with a stiffness"},
    Limit{has::implicit, 0, bodies, "the step has no implicit elements"},
    Limit{has::massless, 0, bodies, "the step needs nodes with mass"},
    Limit{has::friction_law, has::sharp_corners, cyclic | sparse | bit(StepKind::solid_cyclic),
          "with sharp corners the step does not know the pressure that a node had before a corner "
          "held it"},
    Limit{has::friction_law, has::implicit, cyclic | sparse,
          "with implicit elements the step takes one coefficient of friction for all contacts"},
    Limit{has::friction_law, has::massless, cyclic | sparse,
          "with contact nodes without mass the step takes one coefficient of friction for all "
          "contacts"},
    Limit{has::hati, 0, plane, "the scheme \"hati\" has a step of its own"},
    Limit{has::other_scheme, 0, fused, "a scheme other than \"symplectic\" needs the general step"},
    Limit{has::reduced, 0, ~(disk_reduced | solid_reduced),
          "a reduced wheel has a step of its own"},
    Limit{has::pressure, has::reduced, disk_reduced,
          "a reduced disk is one that its rim holds, on the ground, without pressures"},
    Limit{has::nonlinear_cords, has::reduced, solid_reduced,
          "a reduced wheel is linear about its inflated state"},
    // What no step supports ----------------------------------------------------------------------
    Limit{has::free_bodies, has::three_dimensions, any,
          "a wheel in three dimensions is held by its rim"},
    Limit{has::body_contact, has::three_dimensions, any,
          "a wheel in three dimensions touches nothing but the ground"},
    Limit{has::mesh_file, has::three_dimensions, any,
          "a wheel in three dimensions is made from a [disk] with a width, or from a [section]"},
    Limit{has::assembled, has::three_dimensions, any,
          "the stiffness of a wheel in three dimensions is applied sector by sector"},
    Limit{has::rubber, has::three_dimensions, any,
          "a wheel in three dimensions needs linear materials, with b-bar integration near "
          "poissons_ratio = 0.5"},
    Limit{has::own_material, has::three_dimensions, any,
          "a wheel in three dimensions needs linear materials"},
    Limit{has::implicit, has::three_dimensions, any,
          "implicit elements are for plane bodies, not for a wheel in three dimensions, which "
          "needs a "
          "smaller step, or elements of more even size"},
    Limit{has::massless, has::three_dimensions, any,
          "contact nodes without mass are for plane bodies, not for a wheel in three dimensions"},
    Limit{has::stress_stiffening, has::three_dimensions, any,
          "stress stiffening is for plane bodies, not for a wheel in three dimensions"},
    Limit{has::plane_stress, has::three_dimensions, any,
          "a wheel in three dimensions is in neither plane strain nor plane stress: its sides are "
          "free, "
          "so that a narrow wheel is close to plane stress"},
    Limit{has::other_scheme, has::three_dimensions, any,
          "a wheel in three dimensions needs the scheme \"symplectic\""},
    Limit{has::free_bodies, has::loaded_rim, any,
          "a body is free: a [rim] moves bodies that it holds"},
    Limit{has::massless, has::loaded_rim, any,
          "there is a [rim], whose step needs contact nodes with mass"},
    Limit{has::implicit, has::loaded_rim, any,
          "implicit elements do not support a [rim], whose step needs the forces of an explicit "
          "body"},
    Limit{has::other_scheme, has::loaded_rim, any,
          "the scheme does not support a rim that forces move"},
    Limit{has::massless, has::free_bodies, any,
          "a body is free: contact nodes without mass need the co-rotating frame of a rim"},
    Limit{has::implicit, has::free_bodies, any,
          "implicit elements do not support free bodies, because their stiffness turns with them"},
    Limit{has::other_scheme, has::free_bodies, any,
          "schemes other than \"symplectic\" do not support free bodies, which are not turned by a "
          "rim"},
    Limit{has::massless, has::body_contact, any,
          "there is a [contact] of bodies, whose nodes have mass"},
    Limit{has::body_contact, has::hati, any,
          "the scheme \"hati\" supports contact with the ground only"},
    Limit{has::friction_law, has::hati, any,
          "the scheme \"hati\" has one coefficient of friction for all contacts"},
    Limit{has::friction_work, has::hati, any,
          "the scheme \"hati\" repeats its fine steps until both parts agree, and does not keep "
          "where the nodes of each were"},
    Limit{has::pressure, has::hati, any, "the scheme \"hati\" supports no load except the ground"},
    Limit{has::massless, has::sharp_corners, any,
          "the ground has sharp convex corners, which touch between two nodes"},
    Limit{has::massless, has::restitution, any,
          "the contact law of nodes without mass is one of gaps, without restitution"},
    Limit{has::massless, has::energy_safe, any,
          "ground.impact = \"energy-safe\" is a law of velocities, and that of nodes without mass "
          "is one "
          "of gaps"},
    Limit{has::massless, has::rubber, any,
          "the positions of contact nodes without mass follow from the stiffness of small strain, "
          "which rubber does not have"},
    Limit{has::massless, has::own_material, any,
          "the positions of contact nodes without mass follow from the stiffness of small strain, "
          "which the material does not have"},
    Limit{has::massless, has::other_scheme, any,
          "contact nodes without mass need the scheme \"symplectic\""},
    Limit{has::implicit, has::rubber, any,
          "implicit elements need a body of linear elements only, and there is rubber"},
    Limit{has::viscosity, has::free_bodies, any,
          "a body is free: viscous branches at small strain need the co-rotating frame of a rim"},
    Limit{has::viscosity, has::massless, any,
          "the positions of contact nodes without mass follow from the stiffness of slow strains "
          "alone"},
    Limit{has::viscosity, has::implicit, any, "implicit elements have no viscous branches"},
    Limit{has::viscosity, has::other_scheme, any,
          "viscous branches at small strain need the scheme \"symplectic\""},
    Limit{has::implicit, has::own_material, any,
          "implicit elements need a body of linear elements only"},
    Limit{has::implicit, has::hati, any,
          "in the scheme \"hati\" all elements that are not fine are implicit"},
    Limit{has::implicit, has::other_scheme, any,
          "implicit elements need the scheme \"symplectic\""},
    Limit{has::plane_stress, has::rubber, any, "rubber is supported in plane strain only"},
    Limit{has::stress_stiffening, has::rubber, any, "rubber at finite strain includes it"},
    Limit{has::other_scheme, has::rubber, any, "rubber needs the scheme \"symplectic\""},
    Limit{has::hati, has::own_material, any, "the scheme \"hati\" needs linear materials"},
    // What a reduced wheel does not support -----------------------------------------------------
    Limit{has::free_bodies, has::reduced, any,
          "a reduced run is for one wheel that its rim holds, on the ground, without free bodies"},
    Limit{has::body_contact, has::reduced, any,
          "a reduced run is for one wheel that its rim holds, on the ground, without contact of "
          "bodies"},
    Limit{has::mesh_file, has::reduced | has::loaded_rim, any,
          "a reduced wheel on a rim that forces move needs equal sectors, which a mesh from a file "
          "is not known to have"},
    Limit{has::sharp_corners, has::reduced, any,
          "a reduced run has contact at nodes only, not at sharp corners"},
    Limit{has::rubber, has::reduced, any,
          "a reduced run is computed at small strain, rubber at finite strain"},
    Limit{has::own_material, has::reduced, any, "a reduced run needs linear materials"},
    Limit{has::implicit, has::reduced, any, "a reduced run has modes instead of elements"},
    Limit{has::massless, has::reduced, any,
          "a reduced run itself decides whether contact nodes have mass"},
    Limit{has::other_scheme, has::reduced, any, "a reduced run has a scheme of its own"},
    Limit{has::restitution, has::reduced, any,
          "contact nodes of a reduced wheel have no mass, hence no restitution"},
    Limit{has::energy_safe, has::reduced, any,
          "ground.impact = \"energy-safe\" is a law of velocities, and that of a reduced wheel is "
          "one of gaps"},
    Limit{has::friction_work, has::reduced, any,
          "the contacts of a reduced wheel have forces and gaps, but no slip of their own"},
    Limit{has::stress_stiffening, has::reduced | has::viscosity, any,
          "in a reduced wheel of a viscous material all of the stiffness creeps, and that of the "
          "stress does not"},
};

bool has_ogden(const SweptPart& part) noexcept {
  return part.rubber && std::ranges::any_of(part.rubber->rubbers, [](const fem::Rubber& r) {
           return r.law == fem::RubberLaw::ogden;
         });
}

}  // namespace

std::span<const FeatureName> feature_names() noexcept {
  return names;
}

std::string_view name_of(Features of) noexcept {
  const auto* const found =
      std::ranges::find_if(names, [&](const FeatureName& name) { return (name.of & of) == of; });
  return found == names.end() ? std::string_view{} : found->name;
}

std::span<const StepRow> step_rows() noexcept {
  return steps;
}

const StepRow& row_of(StepKind kind) noexcept {
  return steps[static_cast<std::size_t>(kind)];
}

std::span<const Limit> step_limits() noexcept {
  return limits;
}

const Limit* why_not(StepKind kind, Features all) noexcept {
  const auto* const found = std::ranges::find_if(
      limits, [&](const Limit& limit) { return limit.excludes(kind) && limit.holds_for(all); });
  return found == limits.end() ? nullptr : found;
}

bool can(StepKind kind, Features all) noexcept {
  const Features needs = row_of(kind).needs;
  return (all & needs) == needs && why_not(kind, all) == nullptr;
}

const StepRow* choose_step(Features all) noexcept {
  const auto* const found =
      std::ranges::find_if(steps, [&](const StepRow& step) { return can(step.kind, all); });
  return found == steps.end() ? nullptr : found;
}

Features features_of(const Model& m) noexcept {
  Features all = 0;
  const auto add = [&](bool is_there, Features feature) {
    if (is_there) all |= feature;
  };
  add(m.solid.has_value(), has::three_dimensions);
  add(m.solid && (m.motion.camber != 0.0 || m.motion.slip_angle.largest() != 0.0), has::camber);
  add(m.rim.has_value(), has::loaded_rim);
  add(!m.free_bodies.empty(), has::free_bodies);
  add(m.surfaces.has_value(), has::body_contact);
  add(!m.solid && m.stiffness_operator == StiffnessOperator::sparse, has::assembled);
  add(!m.pressures.empty() || (m.solid && !m.solid->pressures.empty()), has::pressure);
  add(has_sharp_corners(m), has::sharp_corners);
  add(m.rubber.has_value(), has::rubber);
  add(m.internal_force && !m.rubber, has::own_material);
  add(m.solid && m.solid->swept, has::nonlinear_cords);
  add(m.solid && m.solid->swept && has_ogden(*m.solid->swept), has::nonlinear_ogden);
  add(!m.viscous.empty() || (m.solid && !m.solid->viscous.empty()), has::viscosity);
  add(m.implicit.has_value(), has::implicit);
  add(has_massless_contact(m), has::massless);
  add(m.contact && m.contact->law.restitution > 0.0, has::restitution);
  add(m.contact && m.contact->law.impact == contact::Impact::energy_safe, has::energy_safe);
  add(has_friction_law(m), has::friction_law);
  add(m.friction_work != nullptr, has::friction_work);
  add(m.stiffness_damping > 0.0, has::stiffness_damping);
  add(m.scheme != Scheme::symplectic, has::other_scheme);
  add(m.subdomains.has_value(), has::hati);
  return all;
}

StepKind step_of(const Model& model) {
  const StepRow* const step = choose_step(features_of(model));
  RONDO_DEMAND(step != nullptr, features_of(model));
  return step->kind;
}

std::string step_text(Features all) {
  const StepRow* const chosen = choose_step(all);
  RONDO_DEMAND(chosen != nullptr, all);
  std::vector<std::pair<const Limit*, std::string>> reasons;  // with the steps that have them
  for (const StepRow* step = steps.data(); step != chosen; ++step) {
    const Limit* const why = why_not(step->kind, all);
    if (why == nullptr || why->at == has::three_dimensions) continue;  // made for other models
    if (reasons.empty() || reasons.back().first != why) reasons.emplace_back(why, "not ");
    std::string& not_by = reasons.back().second;
    not_by += fmt::format("{}{}", not_by == "not " ? "" : ", ", step->name);
  }
  std::string text;
  for (const auto& [why, not_by] : reasons)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", not_by, name_of(why->at | why->with));
  return text.empty() ? std::string(chosen->name) : fmt::format("{} ({})", chosen->name, text);
}

}  // namespace rondo::dynamics
