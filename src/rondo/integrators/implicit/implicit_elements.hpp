// SPDX-License-Identifier: BSD-3-Clause
/// @file  Elements that are implicit in the explicit step (docs/theory.md, 3.9): their stiffness
/// acts at the mean of both half steps, so that they do not bound the step. What the explicit step
/// makes of their nodes' velocities is put right after it.
#pragma once
#include <memory>
#include <optional>

#include "rondo/integrators/implicit/implicit_contact.hpp"
#include "rondo/integrators/implicit/implicit_operator.hpp"

namespace rondo::dynamics {

/// The terms that implicit elements add to the ledger of a step [J/m].
struct ImplicitEnergy {
  double strain = 0.0;                 ///< Δt²/8 v⁻ᵀ K_I v⁻
  double dissipation_stiffness = 0.0;  ///< Δt β/2 v̄ᵀ K_I (v⁺ - v⁻)
};

class ImplicitElements {
 public:
  /// @param implicit of these nodes, A at spin `factored` [rad/s]. @pre model.implicit; the model
  /// outlives it
  ImplicitElements(const Model& model, NodeSet nodes, std::unique_ptr<ImplicitOperator> implicit,
                   double factored);

  [[nodiscard]] const NodeSet& nodes() const noexcept { return nodes_; }
  /// u_{n+1} and v_{n+1/2}, to be filled before the step.
  [[nodiscard]] PlaneField& u() noexcept { return u_; }
  [[nodiscard]] PlaneField& before() noexcept { return before_; }

  /// From the velocities that the explicit step came to, those of the implicit one.
  /// @param v in: explicit v_{n+3/2}, without contact; out: v_{n+3/2}
  /// @param step of the contacts, null: no ground. @param report of them, added to
  ImplicitEnergy solve(double spin, const ContactStep* step, PlaneField& v, ContactReport& report);

  /// Null: none of the nodes may touch anything.
  [[nodiscard]] ImplicitContact* contact() noexcept { return contact_ ? &*contact_ : nullptr; }
  [[nodiscard]] const ImplicitContact* contact() const noexcept {
    return contact_ ? &*contact_ : nullptr;
  }

 private:
  void find_right_side(double spin, const PlaneField& v) noexcept;
  [[nodiscard]] double iterate(double off, bool touching, const ContactStep* step);
  [[nodiscard]] ImplicitEnergy energy() noexcept;

  const Model& model_;
  const NodeSet nodes_;
  const std::unique_ptr<ImplicitOperator> implicit_;
  const double factored_;
  std::optional<ImplicitContact> contact_;
  PlaneField u_, before_;
  PlaneField right_;   ///< impulses of the explicit step                              [N·s/m]
  PlaneField change_;  ///< v⁺ - v⁻                                                     [m/s]
  PlaneField next_, free_, product_;
};

}  // namespace rondo::dynamics
