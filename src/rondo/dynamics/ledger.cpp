// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/dynamics/ledger.hpp"

#include <algorithm>
#include <cmath>

namespace rondo::dynamics {

void Ledger::compare(double kinetic, double strain) noexcept {
  Balance& b = balance_;
  b.kinetic = kinetic;
  b.strain = strain;
  if (!started_) start_ = b.kinetic + b.strain;
  started_ = true;
  b.works = {.frame = frame_.value(),
             .contact = contact_.value(),
             .dissipation_friction = friction_.value(),
             .loss_impact = impact_.value(),
             .load = load_.value(),
             .rim = rim_.value(),
             .dissipation_mass = mass_.value(),
             .dissipation_stiffness = stiffness_.value(),
             .scheme = scheme_.value()};
  const Works& w = b.works;
  CompensatedSum rest;
  for (const double term : {b.kinetic, b.strain, -start_, -w.frame, -w.contact, -w.load,
                            w.dissipation_mass, w.dissipation_stiffness, -w.scheme})
    rest.add(term);
  b.residual = rest.value();
  const double works = std::abs(w.frame) + std::abs(w.contact) + std::abs(w.load) +
                       std::abs(w.dissipation_mass) + std::abs(w.dissipation_stiffness);
  b.exchanged = std::max(b.exchanged, std::abs(b.kinetic + b.strain) + works + std::abs(w.scheme));
  b.otherwise = std::max(b.otherwise, std::abs(start_) + works);
  if (b.residual != 0.0) b.relative = std::max(b.relative, std::abs(b.residual) / b.exchanged);
}

void Ledger::add(const StepEnergy& step) noexcept {
  compare(step.kinetic, step.strain);
  const Works& w = step.works;
  frame_.add(w.frame);
  contact_.add(w.contact);
  friction_.add(w.dissipation_friction);
  impact_.add(w.loss_impact);
  load_.add(w.load);
  rim_.add(w.rim);
  mass_.add(w.dissipation_mass);
  stiffness_.add(w.dissipation_stiffness);
  scheme_.add(w.scheme);
}

}  // namespace rondo::dynamics
