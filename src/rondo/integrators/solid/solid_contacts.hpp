// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contacts of a step of a wheel in three dimensions: every candidate looks for the ground
/// by itself, but for those that sharp corners of the ground push (corner_solver.hpp).
#pragma once
#include <optional>
#include <vector>

#include "rondo/contact/coupled/coupled_contacts.hpp"
#include "rondo/integrators/solid/corner_solver.hpp"
#include "rondo/integrators/solid/solid_forces.hpp"
#include "rondo/model/solid/solid_contact.hpp"

namespace rondo::dynamics {

class SolidContacts {
 public:
  explicit SolidContacts(const Model& model);

  /// Solves what touches at u_{n+1}: v_next of `state`, without contact, becomes that with it, and
  /// `active` the contacts in the order of the candidates.
  ContactReport solve(const SolidContactStep& step, State& state) noexcept;

  /// Impulses by the keys of their contacts, for the next step: those that a friction law asks
  /// with, and those at corners. Ascending.
  [[nodiscard]] const contact::KeptImpulses& impulses() const noexcept { return kept_; }
  void set_impulses(const contact::KeptImpulses& impulses) { kept_ = impulses; }

 private:
  void find_at_corners(const SolidContactStep& step, const State& state);
  void solve_alone(const SolidContactStep& step, std::size_t candidate, State& state,
                   ContactReport& report);

  const Model& model_;
  contact::KeptImpulses kept_, before_;  ///< of the last step, and of that before
  std::optional<CornerSolver> corners_;
  std::vector<CornerFinder::Near> near_;
  std::vector<char> is_held_;  ///< (nodes) contacts of the node are solved with those at corners
};

}  // namespace rondo::dynamics
