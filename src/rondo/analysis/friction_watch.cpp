// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/friction_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rondo/analysis/build/ground/friction_rise.hpp"
#include "rondo/core/ground_frame.hpp"
#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

/// A slope is taken over this at least: that of closer slips is of their round-off         [m/s]
constexpr double least_difference = 1e-6;

/// Place of a node in the axes of the ground, as its law of friction sees it               [m]
Vec3 place_of(const dynamics::Model& model, const dynamics::State& state, std::size_t node) {
  if (!model.solid) return Vec3(position(model, state, node));
  const Vec3 arm = Vec3(model.reference[node], model.solid->axial[node]) + state.u.space()[node];
  const GroundFrame ground(model.motion.camber);
  return state.frame.center + ground.from_wheel(state.frame.rotation * arm);
}

/// How the coefficient of a contact differs between the slips before and after the step.
struct Difference {
  double most = 0.0;   ///< the larger μ                                                [-]
  double slope = 0.0;  ///< of μ over the slip, between both                            [s/m]
  double rise = 0.0;   ///< μ at the faster slip less μ at the slower one               [-]
};

Difference difference_of(const contact::Friction& friction, const dynamics::ActiveContact& c,
                         Vec3 place, double pressure) {
  const double before = std::hypot(c.before.y, c.before.z);
  const double after = std::hypot(c.after.y, c.after.z);
  const double slow = std::min(before, after), apart = std::max(before, after) - slow;
  const double over = std::max(apart, least_difference);
  const double low = friction.coefficient({place, slow, pressure});
  const double high = friction.coefficient({place, slow + over, pressure});
  const double slope = (high - low) / over;
  return {std::max(low, high), slope, slope * apart};
}

}  // namespace

double alternating_share(const ContactStatistics& found) noexcept {
  return found.friction_alternating > 0.0 ? found.friction_alternating / found.friction_bearable
                                          : 0.0;
}

FrictionWatch::FrictionWatch(const Setup& setup)
    : setup_(setup),
      watches_(setup.model.contact && !setup.model.contact->law.friction.is_constant() &&
               setup.reduced.empty()),
      has_mass_(!has_massless_contact(setup.model)),
      limit_(has_mass_ ? dynamics::friction_limit(elements_of(setup), setup.model.dt) : 0.0) {}

std::optional<double> FrictionWatch::limit() const noexcept {
  return watches_ && has_mass_ ? std::optional(limit_) : std::nullopt;
}

void FrictionWatch::look(const dynamics::State& state, ContactStatistics& found) const noexcept {
  if (!watches_) return;
  const dynamics::Model& model = setup_.model;
  for (const dynamics::ActiveContact& c : state.active) {
    const double impulse = c.impulse.x;
    if (!c.on_ground || impulse <= 0.0) continue;
    const std::size_t node = at(model.contact->nodes[c.candidate]);
    const double tributary = model.contact->tributary[c.candidate];
    const double pressure = tributary > 0.0 ? impulse / (model.dt * tributary) : 0.0;
    const Difference d =
        difference_of(model.contact->law.friction, c, place_of(model, state, node), pressure);
    found.friction_bearable += impulse * d.most;
    if (!(d.slope > 0.0)) continue;
    const double steepness = has_mass_ ? d.slope * impulse / model.mass[node] : 0.0;
    found.friction_steepness = std::max(found.friction_steepness, steepness);
    if (has_mass_ && steepness <= limit_) continue;
    found.friction_alternating += impulse * d.rise;
  }
}

std::string FrictionWatch::warning(const ContactStatistics& found) const {
  const double share = alternating_share(found);
  if (share <= alternating_bound) return {};
  const std::string told = fmt::format(
      "ground.friction: {:.3g} % of the friction alternates from step to step: it is too small for "
      "the slip (under a given torque the slip is too large), by up to this share. Friction rises "
      "so steeply with the slip that contact nodes slide and stick in turn, because a step takes "
      "the coefficient by the slip of the step before: ",
      100.0 * share);
  if (!has_mass_)
    return told +
           "contact nodes without mass do so at any step: take solver.contact_mass = \"lumped\", "
           "and a time.step for which this warning is not given";
  const double rate = found.friction_steepness / setup_.model.dt;
  const double step = friction_step_of(setup_, rate);
  return told +
         fmt::format("take a time.step of {:.2g} s; it is short enough where this warning is gone",
                     step);
}

}  // namespace rondo::study
