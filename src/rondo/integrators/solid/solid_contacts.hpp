// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contacts of a step of a wheel in three dimensions: every candidate looks for the ground
/// by itself, because none shares a node with another.
#pragma once
#include <vector>

#include "rondo/contact/coupled/coupled_contacts.hpp"
#include "rondo/integrators/solid/solid_forces.hpp"
#include "rondo/model/solid/solid_contact.hpp"

namespace rondo::dynamics {

class SolidContacts {
 public:
  explicit SolidContacts(const Model& model);

  /// Solves what touches at u_{n+1}: v_next of `state`, without contact, becomes that with it, and
  /// `active` the contacts in the order of the candidates.
  ContactReport solve(const SolidContactStep& step, State& state) noexcept;

  /// What the next step asks a friction law with: empty where friction is a constant.
  [[nodiscard]] const contact::KeptImpulses& impulses() const noexcept { return kept_; }
  void set_impulses(const contact::KeptImpulses& impulses) { kept_ = impulses; }

 private:
  const Model& model_;
  contact::KeptImpulses kept_, before_;  ///< of the last step, and of that before
};

}  // namespace rondo::dynamics
