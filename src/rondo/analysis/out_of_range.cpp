// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/out_of_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "rondo/analysis/build/bodies.hpp"
#include "rondo/model/loaded_rim.hpp"
#include "rondo/output/run_options.hpp"

namespace rondo::study {
namespace {

/// Below the largest number of single precision, 3.4e38, by what sums of a few may add.
constexpr double largest_written = 1e37;

struct Largest {
  double value = 0.0;
  std::size_t node = 0;

  /// NaN stays.
  void add(double magnitude, std::size_t of_node) {
    if (magnitude <= value || std::isnan(value)) return;
    value = magnitude;
    node = of_node;
  }
};

/// By squares, which cost a fraction of norms, as long as they hold the numbers.
template <class Vec>
Largest largest_of(std::span<const Vec> field) {
  constexpr double largest_square = 1e300;
  double square = 0.0;
  std::size_t node = 0;
  bool held = true;  // false of what is not a number, too
  for (std::size_t k = 0; k < field.size(); ++k) {
    const double of_node = dot(field[k], field[k]);
    held = held && of_node <= largest_square;
    if (of_node <= square) continue;
    square = of_node;
    node = k;
  }
  if (held) return {field.empty() ? 0.0 : norm(field[node]), node};
  Largest largest;
  for (std::size_t k = 0; k < field.size(); ++k) largest.add(norm(field[k]), k);
  return largest;
}

Largest largest_of(const Field& field) {
  return field.components() == 3 ? largest_of(field.space()) : largest_of(field.plane());
}

std::string too_large(const char* name, const Largest& largest, const char* unit) {
  if (largest.value <= largest_written) return {};
  return fmt::format("the {} of node {}, {:.3g} {}, is out of the range of the result files", name,
                     largest.node, largest.value, unit);
}

double stiffest(std::span<const fem::Material> materials) {
  double modulus = 0.0;
  for (const fem::Material& m : materials) modulus = std::max(modulus, fem::hooke(m).d11);
  return modulus;
}

/// No stress is above the modulus times the largest difference of displacements over the shortest
/// edge. Rigid motion counts as well, which matters to astronomical figures only.
std::string stress_too_large(const mesh::Mesh& mesh, std::span<const fem::Material> materials,
                             const Largest& displacement) {
  const double modulus = stiffest(materials), change = 4.0 * displacement.value;
  if (modulus * change < 1e25) return {};  // edges are not that short
  const std::vector<double> size = element_sizes(mesh);
  const double shortest = *std::min_element(size.begin(), size.end());
  return too_large("stress near that", {modulus * change / shortest, displacement.node}, "Pa");
}

}  // namespace

double largest_strain_energy(const Setup& setup) {
  if (fem::has_rubber(setup.materials)) return std::numeric_limits<double>::infinity();
  constexpr double strain = 1.0;
  double speed = 0.0;
  for (const fem::Material& m : setup.materials)
    speed = std::max(speed, fem::wave_speeds(m).pressure);
  const auto& mass = setup.model.mass;
  return 0.5 * strain * strain * speed * speed * std::accumulate(mass.begin(), mass.end(), 0.0);
}

std::string beyond_files(const Setup& setup, const dynamics::State& state) {
  const Largest displacement = largest_of(state.u);
  std::string found = too_large("displacement", displacement, "m");
  if (found.empty()) found = too_large("velocity", largest_of(state.v), "m/s");
  if (found.empty() && !(norm(state.frame.center) <= largest_written))
    found = fmt::format("the center, {:.3g} m away, is out of the range of the result files",
                        norm(state.frame.center));
  if (found.empty()) found = stress_too_large(setup.mesh, setup.materials, displacement);
  Largest force;
  for (const dynamics::ActiveContact& a : state.active)
    force.add(norm(a.impulse) / setup.model.dt,
              static_cast<std::size_t>(setup.mesh.boundary[a.candidate]));
  const char* const unit = setup.model.solid ? "N" : "N/m";
  return found.empty() ? too_large("contact force", force, unit) : found;
}

std::string beyond_files(const CrushSetup& setup, const statics::CrushState& state) {
  const Largest displacement = largest_of(std::span<const Vec2>(state.u));
  std::string found = too_large("displacement", displacement, "m");
  if (found.empty()) found = stress_too_large(setup.mesh, setup.materials, displacement);
  Largest force;
  for (std::size_t k = 0; k < state.force.size(); ++k)
    force.add(norm(state.force[k]), static_cast<std::size_t>(setup.mesh.boundary[k]));
  return found.empty() ? too_large("contact force", force, "N/m") : found;
}

std::string beyond_files(const mesh::Mesh& mesh, std::span<const fem::Material> materials,
                         std::span<const Vec3> u) {
  const Largest displacement = largest_of(u);
  const std::string found = too_large("displacement", displacement, "m");
  return found.empty() ? stress_too_large(mesh, materials, displacement) : found;
}

std::string not_finite(const dynamics::State& state, const std::string& otherwise) {
  const auto first = [](FieldView field, const char* name) -> std::string {
    for (std::size_t i = 0; i < field.size(); ++i)
      if (!std::ranges::all_of(field[i], [](double x) { return std::isfinite(x); }))
        return fmt::format("the {} of node {} is not finite", name, i);
    return {};
  };
  std::string found = first(state.v_next, "velocity");
  if (found.empty()) found = first(state.u, "displacement");
  return found.empty() ? otherwise : found;
}

double energy_residual_bound(const Setup& setup) noexcept {
  const bool closes = setup.model.free_bodies.empty() || fem::has_rubber(setup.materials);
  return closes ? residual_bound : free_residual_bound;
}

std::string contact_not_found(const dynamics::ContactReport& step) {
  if (step.unseen > 0.0)
    return fmt::format(
        "a node has moved {:.3g} m in the last steps, farther than sharp corners of the ground "
        "were searched for: a contact may be missed; a smaller time.step, or ground.fillet > 0",
        step.unseen);
  if (step.two_facets)
    return "a contact node without mass is held by two facets of the ground at a concave corner, "
           "which is not supported; solver.contact_mass = \"lumped\", or a ground.profile whose "
           "concave corners the body does not reach";
  if (step.late > 0.0)
    return fmt::format(
        "a contact begins {:.3g} m deep at ({:.6g}, {:.6g}) m: it was inside the body a step "
        "before, without a contact. A smaller time.step, a finer mesh there, a larger "
        "ground.fillet; or a mesh.contact that includes all of the boundary that may touch there",
        step.late, step.late_at.x, step.late_at.y);
  return {};
}

std::string felt_joint() {
  return "impulses of contact changed when the force that joins the two parts was corrected: "
         "contact "
         "is nearer to the coarse part than solver.hati.ratio elements; a smaller ratio, or more "
         "fine elements";
}

std::string turned_too_far(double turn, double dt) {
  if (std::abs(turn) <= dynamics::most_turn) return {};
  return fmt::format(
      "the rim turns by {:.3g} rad in a step of {:.3g} s, more than {:.3g}: differences of "
      "positions no longer show its spin; smaller steps (time.step; --reduced-step of a reduced "
      "wheel), or loads and a torque that spin it up less",
      turn, dt, dynamics::most_turn);
}

double impact_gain(const dynamics::Balance& b) noexcept {
  return b.works.loss_impact < 0.0 ? -b.works.loss_impact / b.exchanged : 0.0;
}

std::string impact_cure(const dynamics::Model& model) {
  if (has_massless_contact(model)) return "a smaller step, or solver.contact_mass = \"lumped\"";
  const auto is_moreau = [](const auto& contact) {
    return contact && contact->law.impact == contact::Impact::moreau;
  };
  std::string keys;
  if (is_moreau(model.contact)) keys = "ground.impact = \"energy-safe\"";
  if (is_moreau(model.surfaces))
    keys += fmt::format("{}contact.impact = \"energy-safe\"", keys.empty() ? "" : ", ");
  return keys.empty() ? "a smaller step" : keys + ", or a smaller time.safety";
}

std::string created_by_impacts(const dynamics::Balance& b, double bound, const Bounds& of) {
  return fmt::format(
      "impacts have created energy: loss_impact = {:.6g} {}, {:.3g} % of the energy exchanged "
      "({:.6g} {}), bound {:.2g} %; {}",
      b.works.loss_impact, of.energy_unit, -100.0 * impact_gain(b), b.exchanged, of.energy_unit,
      -100.0 * bound, of.impact_cure);
}

OutOfBound find_out_of_bound(const dynamics::Balance& b, const ContactStatistics& contact,
                             const Bounds& bounds) {
  if (!std::isfinite(b.kinetic + b.strain) || !std::isfinite(b.residual))
    return {fmt::format("the energy is out of range (kinetic {:.3g}, strain {:.3g})", b.kinetic,
                        b.strain),
            true, true};
  if (std::abs(b.works.scheme) > 10.0 * b.otherwise)
    return {fmt::format("work_scheme = {:.6g} J/m, more than ten times the energy exchanged "
                        "otherwise ({:.6g} J/m): the scheme as printed has blown up",
                        b.works.scheme, b.otherwise),
            true};
  if (std::abs(b.strain) > bounds.strain_energy)
    return {fmt::format("the strain energy, {:.3g} {}, is that of strains above 1: the law for "
                        "small strains is no longer valid",
                        b.strain, bounds.energy_unit),
            true};
  if (b.relative > bounds.ledger)
    return {fmt::format("the energy balance does not close: relative residual {:.3g}, bound {:.0e}",
                        b.relative, bounds.ledger),
            true};
  if (bounds.guards_impacts && impact_gain(b) > impact_gain_bound)
    return {created_by_impacts(b, impact_gain_bound, bounds), true};
  if (!(contact.residual <= bounds.contact))
    return {fmt::format("contact residual {:.3g}, bound {:.0e}{}", contact.residual, bounds.contact,
                        bounds.contact_cure),
            false};
  return {};
}

}  // namespace rondo::study
