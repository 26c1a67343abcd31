// SPDX-License-Identifier: BSD-3-Clause
/// @file  The capabilities of the time steps as one table: the features that a
/// model may have, the time steps, and which step cannot do which features, with
/// the reason as a sentence. The choice of the step, the refusals of combinations,
/// `rondo check` and docs/cases.md ("What goes with what") read it. To let a step
/// do more, remove a row; to add a feature, add its bit and its name.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rondo::dynamics {

struct Model;

/// A set of features, one bit each.
using Features = std::uint32_t;

namespace has {
enum Feature : Features {
  three_dimensions = 1U << 0,
  camber = 1U << 1,  ///< or a slip angle, for a wheel in three dimensions
  loaded_rim = 1U << 2,
  free_bodies = 1U << 3,
  body_contact = 1U << 4,
  mesh_file = 1U << 5,  ///< of a case: it is not known whether its sectors are equal
  assembled = 1U << 6,  ///< K is that of the whole body, not of one sector
  pressure = 1U << 7,
  sharp_corners = 1U << 8,  ///< like has_sharp_corners()
  rubber = 1U << 9,
  own_material = 1U << 10,  ///< InternalForce without a RubberPart
  implicit = 1U << 11,
  massless = 1U << 12,
  restitution = 1U << 13,
  energy_safe = 1U << 14,
  stiffness_damping = 1U << 15,
  stress_stiffening = 1U << 16,  ///< of a case
  plane_stress = 1U << 17,       ///< of a case
  other_scheme = 1U << 18,       ///< any other than "symplectic"
  hati = 1U << 19,               ///< sets other_scheme as well
  reduced = 1U << 20,            ///< a run of a reduced wheel
  friction_law = 1U << 21,       ///< friction that is no constant
  nonlinear_cords = 1U << 22,    ///< SolidBody::swept
  nonlinear_ogden = 1U << 23,    ///< SweptPart::rubber, by that law
  viscosity = 1U << 24,          ///< branches of small strain: Model::viscous, SolidBody::viscous
  friction_work = 1U << 25,      ///< of a case: by node and place, in results.h5
};
}  // namespace has

/// A feature, or a combination with a name of its own, in the user's words.
struct FeatureName {
  Features of;
  std::string_view name;
};
/// Each single feature is listed before the combinations that contain it.
[[nodiscard]] std::span<const FeatureName> feature_names() noexcept;
/// Name of the first entry that has all of these; empty: they have no name.
[[nodiscard]] std::string_view name_of(Features of) noexcept;

/// The time steps; among those with the same capabilities, the faster one comes first.
enum class StepKind {
  cyclic,         ///< integrators/fused
  sparse,         ///< integrators/fused
  bodies,         ///< integrators/bodies
  wheel,          ///< integrators/general, on a loaded rim
  general,        ///< integrators/general
  hati,           ///< integrators/hati
  solid_cyclic,   ///< integrators/fused/solid
  solid,          ///< integrators/solid: the reference, which no model needs
  solid_wheel,    ///< integrators/solid, on a loaded rim
  reduced,        ///< rom/wheel
  solid_reduced,  ///< rom/solid
};

struct StepRow {
  StepKind kind;
  std::string_view name;
  Features needs;  ///< the step is made for models with all of these features
};
/// The time steps in the order of StepKind.
[[nodiscard]] std::span<const StepRow> step_rows() noexcept;
[[nodiscard]] const StepRow& row_of(StepKind kind) noexcept;

/// A combination of features that some steps cannot do.
struct Limit {
  Features at;           ///< the feature that is refused
  Features with;         ///< only in combination with these; 0: always
  std::uint32_t not_by;  ///< steps that cannot do it; bit k: the StepKind k
  std::string_view why;  ///< a sentence about these features

  [[nodiscard]] constexpr bool holds_for(Features all) const noexcept {
    return (all & (at | with)) == (at | with);
  }
  [[nodiscard]] constexpr bool excludes(StepKind kind) const noexcept {
    return ((not_by >> static_cast<unsigned>(kind)) & 1U) != 0;
  }
  /// Whether no step can do this.
  [[nodiscard]] constexpr bool is_refusal() const noexcept { return not_by == ~0U; }
};
[[nodiscard]] std::span<const Limit> step_limits() noexcept;

/// First reason why the step cannot do all of these or is made for others; null: it can.
[[nodiscard]] const Limit* why_not(StepKind kind, Features all) noexcept;
/// Whether the step can do all of these and is made for them.
[[nodiscard]] bool can(StepKind kind, Features all) noexcept;
/// The fastest step that can do all of them; null: none can, and a Limit that applies is a refusal.
[[nodiscard]] const StepRow* choose_step(Features all) noexcept;

/// The features of the model: camber, pressures, ...
[[nodiscard]] Features features_of(const Model& model) noexcept;
/// The step that make_integrator() uses. @pre some step can do the model
[[nodiscard]] StepKind step_of(const Model& model);

/// "general (not fused cyclic, fused sparse: contact between bodies)": the step, and the reasons
/// why the faster ones are not used. @pre some step can do all of these
[[nodiscard]] std::string step_text(Features all);

}  // namespace rondo::dynamics
