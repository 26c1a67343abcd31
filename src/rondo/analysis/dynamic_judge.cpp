// SPDX-License-Identifier: BSD-3-Clause
/// @file  What ends a motion in time, or is warned of: by the numbers of each step, and by looks at
/// the state now and then.
#include <fmt/format.h>

#include "rondo/analysis/dynamic.hpp"
#include "rondo/analysis/rubber_watch.hpp"

namespace rondo::study {

/// The message names the step that made the trouble: what a half step shows came from the step
/// before.
void DynamicAnalysis::judge(const dynamics::StepReport& step) {
  warn_of_impacts(step);
  OutOfBound found{contact_not_found(step.contact), false};
  if (found.what.empty()) found = find_out_of_bound(step.balance, contact_, bounds_);
  if (found.what.empty() && setup_.model.rim) found = {look_at_rim(step), false};
  if (step.material.least_volume <= 0.0) {
    dynamics::State now(setup_.model);  // after the steps of this call
    integrator_->fields(now);
    found = {inverted_rubber(setup_.mesh, now.u, step.material.least_volume), false};
  }
  if (found.what.empty() && step.contact_felt_joint) found = {felt_joint(), false};
  if (found.what.empty()) return;
  if (found.not_finite) {
    dynamics::State now(setup_.model);  // after the steps of this call
    integrator_->fields(now);
    found.what = not_finite(now, found.what);
  }
  const bool before = found.at_half_step && !setup_.model.subdomains;
  const double half = before ? 0.5 * setup_.model.dt : 0.0;
  trouble_ = fmt::format("step {} of {}, t = {:.9g} s: {}", step.step - (before ? 1 : 0),
                         setup_.n_steps, step.frame.time - half, found.what);
}

/// The trouble with a loaded rim; empty: none.
std::string DynamicAnalysis::look_at_rim(const dynamics::StepReport& step) {
  const std::string turned = turned_too_far(step.frame.turn, setup_.model.dt);
  if (!turned.empty()) return turned;
  const HubWatch::Seen hub = hub_->look(step.frame.center, step.frame.time);
  if (!hub.warning.empty()) warn(hub.warning);
  return hub.trouble;
}

/// Once a run: what follows is the same.
void DynamicAnalysis::warn_of_impacts(const dynamics::StepReport& step) {
  const double gain = impact_gain(step.balance);
  if (impacts_told_ || !bounds_.guards_impacts || gain <= impact_gain_spoken_of ||
      gain > impact_gain_bound)
    return;
  impacts_told_ = true;
  warn(fmt::format("t = {:.9g} s: {}", step.frame.time - 0.5 * setup_.model.dt,
                   created_by_impacts(step.balance, impact_gain_bound, bounds_)));
}

void DynamicAnalysis::warn(std::string warning) {
  give_warnings({warning}, options_);
  warnings_.push_back(std::move(warning));
}

Looks DynamicAnalysis::looks() const noexcept {
  return setup_.reduced.empty() ? Looks{} : looks_of_reduced_runs;
}

bool DynamicAnalysis::is_looked_at() const noexcept {
  const long long before = next_ > 0 ? schedule_.steps[next_ - 1] : -1;
  return is_look(looks(), state_.step, state_.step == next_snapshot(), before);
}

void DynamicAnalysis::look() {
  if (trouble_) return;
  std::string passing = watch_->look(state_);
  if (!passing.empty()) warn(std::move(passing));
  std::string wrong = strain_->look(state_.u, state_.poses, state_.frame.time);
  if (wrong.empty() && setup_.rubber && integrator_ &&
      rubber_step_.is_due(state_.step, strain_->largest().found.strain))
    wrong = RubberStepWatch::look(setup_, integrator_->resumable()->save());
  if (!wrong.empty())
    trouble_ = fmt::format("step {} of {}, t = {:.9g} s: {}", state_.step, setup_.n_steps,
                           state_.frame.time, wrong);
}

}  // namespace rondo::study
