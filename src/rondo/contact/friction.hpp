// SPDX-License-Identifier: BSD-3-Clause
/// @file  The coefficient of friction μ of a contact: a constant, or a law of the place on the
/// ground, the slip speed and the pressure. A solver asks for it once per contact and solution;
/// within a solution μ is a number, so that the law of contact stays the one of docs/theory.md, 4.
#pragma once
#include <functional>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/vec3.hpp"

namespace rondo::contact {

/// State of one contact, as the step before has left it: a friction law may depend on it.
struct SlidingState {
  Vec3 place;         ///< place of the contact at t_{n+1}, in the axes of the ground     [m]
  double slip = 0.0;  ///< |w_t⁻|, the slip speed of the step before                      [m/s]
  double pressure = 0.0;  ///< r_n/(Δt ℓ) of the step before; 0 where it was open, or ℓ is 0  [Pa]
};

/// μ >= 0 of one contact; must not throw.                                                      [-]
using FrictionFunction = std::function<double(const SlidingState&)>;

/// The rows of all such functions, by name: friction_laws.hpp.
class Friction {
 public:
  Friction(double constant = 0.0) noexcept : constant_(constant) {}  // NOLINT(*-explicit-*)
  explicit Friction(FrictionFunction law) : law_(std::move(law)) {}

  [[nodiscard]] bool is_constant() const noexcept { return !law_; }
  /// μ of every contact, for solvers that take no other. @pre is_constant()
  [[nodiscard]] double constant() const noexcept {
    RONDO_DEMAND(is_constant());
    return constant_;
  }
  /// μ of one contact.
  [[nodiscard]] double coefficient(const SlidingState& of) const noexcept {
    return law_ ? law_(of) : constant_;
  }

 private:
  double constant_ = 0.0;
  FrictionFunction law_;  ///< none: μ is the constant
};

}  // namespace rondo::contact
