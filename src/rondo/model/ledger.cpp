// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/ledger.hpp"

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
  add_works(step.works);
}

void Ledger::add_works(const Works& w) noexcept {
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

std::array<double, Ledger::n_numbers> Ledger::save() const noexcept {
  std::array<double, n_numbers> numbers{};
  std::size_t i = 0;
  for (const CompensatedSum* sum :
       {&frame_, &contact_, &load_, &friction_, &impact_, &rim_, &mass_, &stiffness_, &scheme_})
    for (const double part : {sum->sum(), sum->correction()}) numbers[i++] = part;
  for (const double number :
       {started_ ? 1.0 : 0.0, start_, balance_.exchanged, balance_.otherwise, balance_.relative})
    numbers[i++] = number;
  return numbers;
}

void Ledger::restore(std::span<const double, n_numbers> numbers) noexcept {
  std::size_t i = 0;
  for (CompensatedSum* sum :
       {&frame_, &contact_, &load_, &friction_, &impact_, &rim_, &mass_, &stiffness_, &scheme_}) {
    *sum = {numbers[i], numbers[i + 1]};
    i += 2;
  }
  started_ = numbers[i++] != 0.0;
  for (double* number : {&start_, &balance_.exchanged, &balance_.otherwise, &balance_.relative})
    *number = numbers[i++];
}

}  // namespace rondo::dynamics
