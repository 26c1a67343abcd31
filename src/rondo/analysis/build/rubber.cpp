// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/rubber.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "rondo/case/case_keys.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/fem/viscosity.hpp"
#include "rondo/model/hyperelastic.hpp"

namespace rondo::study {
namespace {

/// A step resolves a branch that relaxes in so many of them.
constexpr double resolved_steps = 4.0;

/// A table that describes a material.
struct Described {
  std::string table;  ///< "material", "material.region[1]"
  std::string name;   ///< name of the part; empty: [material]
  const MaterialLaw& law;
  const fem::Material& material;
};

std::vector<Described> materials_in(const Case& c) {
  std::vector<Described> found;
  found.push_back({"material", "", c.law, c.material});
  for (std::size_t k = 0; k < c.regions.size(); ++k) {
    const MaterialRegion& region = c.regions[k];
    const std::string name = !is_generated(c)
                                 ? region.surface
                                 : fmt::format("layers {}", fmt::join(region.layers, ", "));
    found.push_back({item_of("material.region", k), name, region.law, region.material});
  }
  return found;
}

std::vector<Described> rubbers_of(const Case& c) {
  std::vector<Described> found;
  for (const Described& d : materials_in(c))
    if (d.law.is_rubber()) found.push_back(d);
  RONDO_ASSERT(
      std::ranges::all_of(found, [](const Described& d) { return d.material.rubber.has_value(); }),
      found.size());
  return found;
}

/// The rotation of a body that nothing holds would be damped as if it were strain.
void refuse_damped_free_bodies(const Case& c, const Setup& s) {
  if (c.damping.stiffness == 0.0 || s.model.free_bodies.empty()) return;
  for (std::size_t e = 0; e < s.mesh.cells.size(); ++e) {
    const auto node = static_cast<std::size_t>(s.mesh.cells[e][0]);
    if (!in_fixed_frame(s.model, node) || !fem::material_of(s.mesh, s.materials, e).rubber)
      continue;
    throw case_error(c, "damping.stiffness",
                     "acts on the rate of the forces of rubber, which turn with a free body: its "
                     "rotation would be damped",
                     "0, and [[material.viscosity]], which depends on strain only");
  }
}

/// Small strains are taken in a frame that turns with a body; rubber has none.
void refuse_linear_free_bodies(const Case& c, const Setup& s) {
  if (s.model.free_bodies.empty()) return;
  for (std::size_t e = 0; e < s.mesh.cells.size(); ++e) {
    const auto node = static_cast<std::size_t>(s.mesh.cells[e][0]);
    if (!in_fixed_frame(s.model, node) || fem::material_of(s.mesh, s.materials, e).rubber) continue;
    throw case_error(
        c, "material.model",
        "a free body has linear elements, and another part is rubber: beside rubber only rubber "
        "may rotate freely, because linear elements would take a rotation for strain",
        "rubber for the whole of the body (a stiff one is \"neo-hooke\" with a large "
        "shear_modulus), or a body that is held");
  }
}

/// Their volume is that of nodes, which the general step alone knows.
bool has_triangles_of_rubber(const Setup& s) {
  for (std::size_t e = 0; e < s.mesh.cells.size(); ++e)
    if (mesh::n_corners(s.mesh.cells[e]) == 3 && fem::material_of(s.mesh, s.materials, e).rubber)
      return true;
  return false;
}

/// Its branches are those of [material], which come first.
bool inherits_branches(const Case& c, const Described& d) {
  return !d.name.empty() && d.law.model == c.law.model && d.law.viscosity == c.law.viscosity &&
         d.law.loss_factor == c.law.loss_factor;
}

/// The key of a branch's time in the case.
std::string time_key(const Described& d, std::size_t branch) {
  if (d.law.loss_factor > 0.0) return "material.loss_band";
  const bool listed = d.name.empty();
  return listed ? item_of("material.viscosity", branch) + ".time" : d.table + ".viscosity";
}

std::string_view model_name(const MaterialLaw& law) {
  const auto& names = find_case_key("material.model")->allowed.choices;
  const auto which = static_cast<std::size_t>(law.model);
  RONDO_DEMAND(which < names.size(), which, names.size());  // both lists in one order
  return names[which];
}

Told law_line(const Described& d) {
  const fem::Rubber& r = *d.material.rubber;
  const double mu = r.shear_modulus(), kappa = r.bulk_modulus;
  return {d.name.empty() ? "rubber" : "rubber of " + d.name,
          fmt::format("{}{}, shear modulus {:.4g} Pa, bulk modulus {:.4g} Pa ({:.4g} times), "
                      "Poisson's ratio {:.6g} at small strain",
                      model_name(d.law), r.one_point ? " by one point" : "", mu, kappa, kappa / mu,
                      d.material.poissons_ratio)};
}

Told branch_line(const Described& d, const fem::ViscousBranch& branch, double step) {
  std::string text = fmt::format("{:.4g} of the shear modulus, relaxing in {:.4g} s",
                                 branch.relative_modulus, branch.time);
  if (step > 0.0) text += fmt::format(", {:.4g} steps", branch.time / step);
  return {d.name.empty() ? "viscosity" : "viscosity of " + d.name, text};
}

/// Stiffness of sudden strains over that of slow ones.
double sudden_share(std::span<const fem::ViscousBranch> branches) {
  double share = 1.0;
  for (const fem::ViscousBranch& branch : branches) share += branch.relative_modulus;
  return share;
}

/// By how much the step is longer at most if material.loss_band ends at this frequency [Hz]: as the
/// root of the stiffness; with damping, whose bound the stiffness of sudden strains sets, up to the
/// stiffness itself.
double growth_of_step(const Case& c, double highest) {
  const double power = c.damping.stiffness > 0.0 ? 1.0 : 0.5;
  double most = 1.0;
  for (const Described& d : materials_in(c)) {
    if (d.law.loss_factor == 0.0) continue;
    const fem::Band band{std::min(d.law.loss_band.x, 0.1 * highest), highest};
    const double now = sudden_share(fem::branches_of(d.material));
    const double then = sudden_share(fem::branches_of(d.law.loss_factor, band));
    most = std::max(most, std::pow(now / then, power));
  }
  return most;
}

/// The end of the band [Hz] whose shortest branch relaxes in a step. A narrower band has less
/// stiffness at sudden strains, hence a longer step, which its own branches must resolve.
/// @param steps in which the shortest branch of the case relaxes
double highest_frequency(const Case& c, const Described& d, double steps) {
  constexpr int passes = 8;         // the growth depends on the logarithm of the frequency
  constexpr double rounded = 0.98;  // for its digits in the message, and what the passes miss
  double highest = d.law.loss_band.y;
  for (int pass = 0; pass < passes; ++pass)
    highest = d.law.loss_band.y * steps / growth_of_step(c, highest);
  return rounded * highest;
}

/// What a step resolves in place of a branch that relaxes in so many of them.
std::string slower_than(const Case& c, const Described& d, double steps, double step) {
  if (d.law.loss_factor > 0.0)
    return fmt::format(
        "a highest frequency of at most about {:.3g} Hz, below {:.3g} Hz to resolve it",
        highest_frequency(c, d, steps), highest_frequency(c, d, steps / resolved_steps));
  return fmt::format(
      ">= {0:.4g}, above {1:.4g} to resolve it; or no such branch: one so fast is practically "
      "always relaxed",
      step, resolved_steps * step);
}

}  // namespace

void add_rubber(const Case& c, Setup& s) {
  if (!has_rubber(c)) return;
  RONDO_DEMAND(s.model.mass.size() == s.model.n_nodes() &&
                   s.model.stiffness.row_start.size() == s.model.n_nodes() + 1,
               s.model.mass.size(), s.model.stiffness.row_start.size(), s.model.n_nodes());
  refuse_damped_free_bodies(c, s);
  refuse_linear_free_bodies(c, s);
  s.rubber = std::make_shared<const fem::Hyperelasticity>(s.mesh, s.materials);
  s.model.internal_force = dynamics::hyperelastic_maker(s.rubber);
  if (!has_triangles_of_rubber(s)) s.model.rubber = dynamics::rubber_part(s.mesh, s.materials);
}

void check_branches(const Case& c, Setup& s) {
  const double step = explicit_step(s.model);
  RONDO_DEMAND(step > 0.0, step);
  for (const Described& d : materials_in(c)) {
    if (inherits_branches(c, d)) continue;
    const std::vector<fem::ViscousBranch>& branches = fem::branches_of(d.material);
    for (std::size_t b = 0; b < branches.size(); ++b) {
      const double time = branches[b].time;
      if (time >= resolved_steps * step) continue;
      const std::string found =
          fmt::format("a branch that relaxes in {:.4g} s, {:.3g} of the step of {:.4g} s", time,
                      time / step, step);
      const std::string slower = slower_than(c, d, time / step, step);
      if (time < step)
        throw case_error(c, time_key(d, b), found + ": the step passes over it", slower);
      s.warnings.push_back(fmt::format("{}: {}: its losses are rough below {} steps: {}",
                                       time_key(d, b), found, resolved_steps, slower));
      if (d.law.loss_factor > 0.0) break;  // the shortest one is the first of its band
    }
  }
}

std::vector<Told> rubber_lines(const Case& c, double step) {
  std::vector<Told> lines;
  for (const Described& d : rubbers_of(c)) {
    lines.push_back(law_line(d));
    if (d.law.loss_factor > 0.0) continue;  // viscosity_lines() has them
    for (const fem::ViscousBranch& branch : d.material.rubber->branches)
      lines.push_back(branch_line(d, branch, step));
  }
  return lines;
}

}  // namespace rondo::study
