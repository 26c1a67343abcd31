// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/ground/friction_rise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rondo/analysis/build/physical.hpp"
#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

/// κ from which even a contact node that no element holds alternates (4.3e).
constexpr double certain = 2.0;
/// Factor of the slip 0, over the largest one, below which nodes cannot stick.
constexpr double vanishing = 0.1;

/// The warning where contact nodes have no mass, and alternate at any step.
constexpr char no_step[] =
    "ground.friction.slip_speed is less than a tenth of its largest value at rest: contact nodes "
    "without mass slide and stick in turn at any step, and friction is too small: take "
    "solver.contact_mass = \"lumped\"";

/// Largest length or area of a contact node over its mass                    [m²/kg]
double largest_share(const dynamics::Model& model) {
  double share = 0.0;
  for (std::size_t k = 0; k < model.contact->nodes.size(); ++k)
    share = std::max(share, model.contact->tributary[k] / model.mass[at(model.contact->nodes[k])]);
  return share;
}

bool vanishes_at_rest(const contact::FrictionTable& table) {
  double most = 0.0;
  for (const auto& point : table.slip) most = std::max(most, point[1]);
  return table.slip.front()[1] < vanishing * most;
}

/// The pressure at which the slope of the table is largest                    [Pa]
double steepest_pressure(const contact::FrictionTable& table) {
  return table.pressure_reference * (table.pressure_exponent < 0.0 ? 0.1 : 10.0);
}

}  // namespace

dynamics::ElementLimit elements_of(const Setup& s) noexcept {
  const bool lagged = s.model.scheme == Scheme::as_printed || s.model.rim;
  return {s.critical.omega, s.model.stiffness_damping, lagged ? s.model.mass_damping : 0.0};
}

double friction_step_of(const Setup& s, double rate) noexcept {
  const double step = dynamics::friction_step(elements_of(s), rate);
  const double unit = std::pow(10.0, std::floor(std::log10(step)) - 1.0);
  return unit * std::floor(step / unit);
}

void tell_friction_rise(const Case& c, Setup& s) {
  const contact::FrictionTable& table = c.ground->friction;
  const double rise = contact::steepest_rise(table, steepest_pressure(table));
  if (!(rise > 0.0)) return;
  if (has_massless_contact(s.model)) {
    if (vanishes_at_rest(table)) s.warnings.emplace_back(no_step);
    return;
  }
  const double share = largest_share(s.model), dt = s.model.dt;
  s.figures.emplace_back(
      "friction",
      fmt::format("rises with the slip by up to {:.3g} s/m: the step follows that to a "
                  "contact pressure of {:.2g} Pa at least",
                  rise, dynamics::friction_limit(elements_of(s), dt) / (rise * share * dt)));
  const std::optional<double> pressure = estimated_pressure(c, s);
  if (!pressure || !vanishes_at_rest(table)) return;
  const double rate = contact::steepest_rise(table, *pressure) * *pressure * share;
  if (!(rate * dt > certain)) return;
  s.warnings.push_back(fmt::format(
      "ground.friction.slip_speed rises so steeply from less than a tenth of its largest value at "
      "rest that at a contact pressure of about {:.2g} Pa contact nodes slide and stick in turn "
      "from step to step, and friction is too small: a time.step of {:.2g} s is short enough up to "
      "twice that pressure",
      *pressure, friction_step_of(s, 2.0 * rate)));
}

}  // namespace rondo::study
