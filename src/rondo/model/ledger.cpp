// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/ledger.hpp"

#include <algorithm>
#include <cmath>

namespace rondo::dynamics {
namespace {

/// A work and its sign in the balance: +1 done on the body, -1 lost; 0: part of another one.
struct Term {
  double Works::*work;
  double sign;
};

/// That of the scheme comes last; the works before it are what a run exchanges by itself.
constexpr std::array<Term, Ledger::n_works> terms{{{&Works::frame, 1.0},
                                                   {&Works::contact, 1.0},
                                                   {&Works::load, 1.0},
                                                   {&Works::dissipation_mass, -1.0},
                                                   {&Works::dissipation_stiffness, -1.0},
                                                   {&Works::gravity, 1.0},
                                                   {&Works::rim_load, 1.0},
                                                   {&Works::torque, 1.0},
                                                   {&Works::held, 1.0},
                                                   {&Works::dissipation_brake, -1.0},
                                                   {&Works::dissipation_support, -1.0},
                                                   {&Works::dissipation_friction, 0.0},
                                                   {&Works::loss_impact, 0.0},
                                                   {&Works::rim, 0.0},
                                                   {&Works::interface, 0.0},
                                                   {&Works::scheme, 1.0}}};

}  // namespace

void Ledger::compare(const StepEnergy& energy, double to_come) noexcept {
  Balance& b = balance_;
  b.kinetic = energy.kinetic;
  b.strain = energy.strain;
  b.kinetic_rim = energy.kinetic_rim;
  b.support = energy.support;
  const double whole = b.kinetic + b.strain + b.kinetic_rim + b.support;
  if (!started_) start_ = whole;
  started_ = true;
  CompensatedSum rest;
  for (const double part : {b.kinetic, b.strain, b.kinetic_rim, b.support, -start_}) rest.add(part);
  double works = 0.0;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const auto [work, sign] = terms[i];
    const double value = b.works.*work = works_[i].value();
    if (sign != 0.0) rest.add(-sign * value);
    if (sign != 0.0 && work != &Works::scheme) works += std::abs(value);
  }
  b.residual = rest.value();
  b.exchanged = std::max(b.exchanged, std::abs(whole) + works + std::abs(b.works.scheme));
  b.otherwise = std::max(b.otherwise, std::abs(start_) + works);
  if (b.residual != 0.0)
    b.relative = std::max(b.relative, std::abs(b.residual) / (b.exchanged + to_come));
}

void Ledger::add(const StepEnergy& step) noexcept {
  double to_come = 0.0;
  for (const auto [work, sign] : terms)
    if (sign != 0.0) to_come += std::abs(step.works.*work);
  compare(step, to_come);
  add_works(step.works);
}

void Ledger::add_works(const Works& w) noexcept {
  for (std::size_t i = 0; i < terms.size(); ++i) works_[i].add(w.*terms[i].work);
}

std::array<double, Ledger::n_numbers> Ledger::save() const noexcept {
  std::array<double, n_numbers> numbers{};
  std::size_t i = 0;
  for (const CompensatedSum& sum : works_)
    for (const double part : {sum.sum(), sum.correction()}) numbers[i++] = part;
  for (const double number :
       {started_ ? 1.0 : 0.0, start_, balance_.exchanged, balance_.otherwise, balance_.relative})
    numbers[i++] = number;
  return numbers;
}

void Ledger::restore(std::span<const double, n_numbers> numbers) noexcept {
  std::size_t i = 0;
  for (CompensatedSum& sum : works_) {
    sum = {numbers[i], numbers[i + 1]};
    i += 2;
  }
  started_ = numbers[i++] != 0.0;
  for (double* number : {&start_, &balance_.exchanged, &balance_.otherwise, &balance_.relative})
    *number = numbers[i++];
}

}  // namespace rondo::dynamics
