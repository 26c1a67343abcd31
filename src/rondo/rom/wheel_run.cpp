// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel_run.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/rom/wheel/base/ring_candidates.hpp"

namespace rondo::rom {
namespace {

constexpr double law_residual = 1e-9;  ///< the bound of all runs in the plane

WheelSettings settings_of(const dynamics::Model& model, const Ring& ring) {
  return {{.dt = model.dt,
           .mass_damping = model.mass_damping,
           .stiffness_damping = model.stiffness_damping},
          model.contact->law.friction,
          SlipRule::anchored,
          tributaries_of(ring, *model.contact)};
}

}  // namespace

WheelRun::WheelRun(const dynamics::Model& model, const Ring& ring, const WheelModel& wheel,
                   WheelFigures& figures, const dynamics::State& at_start)
    : ReducedRun(model, wheel, law_residual, candidates_of(ring, *model.contact), figures),
      wheel_(ring, wheel, model.contact->ground, settings_of(model, ring)) {
  WheelMotion start = motion_at_start();
  start.center -= model.motion.advance(0.0, model.dt).plane();
  wheel_.start(start, at_start.u, at_start.v);
  frame_ = dynamics::frame_step(model.motion, 0, model.dt);
  if (rim_) {
    rim_->start(wheel_.sums(), wheel_.force_at_start());
    frame_ = rim_->frame();
  }
  begin_ledger(wheel_.energy_at_start(!rim_));
}

const WheelOutcome& WheelRun::make_step(dynamics::Works& works) {
  report_ = rim_ ? wheel_.step(n_, *rim_, works) : wheel_.step(motion_of(n_));
  if (rim_) frame_ = rim_->frame();
  return report_;
}

void WheelRun::report_forces(dynamics::ContactReport& report) {
  report.impulse = model_.dt * report_.mean_force;
  for (const WheelContact& c : report_.contacts) {
    dynamics::ActiveContact& a = list_contact(c.node);
    a.normal = c.normal;
    a.gap = c.gap;
    a.impulse = model_.dt * to_frame(c.normal, c.force);
    a.status = c.status;
  }
}

std::size_t WheelRun::n_numbers(const dynamics::Model& model, const Ring& ring,
                                const WheelModel& wheel) noexcept {
  return RingWheel::n_numbers(ring, wheel, model.contact->law.friction) + n_beside(model, wheel, 0);
}

bool WheelRun::is_saved(const dynamics::Model& model, const Ring& ring, const WheelModel& wheel,
                        std::span<const double> numbers) noexcept {
  const contact::Friction& friction = model.contact->law.friction;
  return numbers.size() == n_numbers(model, ring, wheel) &&
         RingWheel::is_saved(ring, wheel, friction,
                             numbers.first(RingWheel::n_numbers(ring, wheel, friction))) &&
         std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

}  // namespace rondo::rom
