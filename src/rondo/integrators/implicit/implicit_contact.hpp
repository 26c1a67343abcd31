// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact with the ground of nodes on implicit elements (docs/theory.md, 4.9). An impulse
/// on one of them moves all at once, so that they are solved together.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "rondo/contact/coupled/coupled_contacts.hpp"
#include "rondo/integrators/implicit/implicit_operator.hpp"
#include "rondo/model/contact_node.hpp"

namespace rondo::dynamics {

class ImplicitContact {
 public:
  /// @pre model.contact. Both must outlive it.
  ImplicitContact(const Model& model, const NodeSet& nodes);

  [[nodiscard]] bool any_candidate() const noexcept { return !candidates_.empty(); }
  /// (nb) of ContactModel::nodes: 1 where it is one of these nodes.
  [[nodiscard]] const std::vector<char>& is_held() const noexcept { return is_held_; }

  /// Which of them touch at u_{n+1}, and what impulses on them do. @return any
  bool find(const ContactStep& step, const PlaneField& u, const PlaneField& before,
            ImplicitOperator& implicit);
  /// Adds to `impulse` what the ground does on nodes that would have these velocities: to the right
  /// side of the step. @param free v_{n+3/2} without it
  void solve(const ContactStep& step, const PlaneField& free, PlaneField& impulse);
  /// Reports the contacts of solve(), with the velocities `after`.
  void report(const ContactStep& step, const PlaneField& before, const PlaneField& after,
              ContactReport& report);
  /// Contacts of the last step, in the order of the candidates.
  [[nodiscard]] const std::vector<ActiveContact>& active() const noexcept { return active_; }
  /// Adds these contacts. @param step the one of report()
  void add_friction(const ContactStep& step, FrictionWork& work) const noexcept;

  /// The impulses from which the next step starts, and the difficult problems.
  [[nodiscard]] const contact::CoupledContacts& coupled() const noexcept { return coupled_; }
  [[nodiscard]] contact::CoupledContacts& coupled() noexcept { return coupled_; }
  /// Set in all keys: the fourth kind, beside the three of ContactKind.
  static constexpr std::uint64_t key_bits = std::uint64_t{3} << 62U;

 private:
  struct Candidate {
    std::size_t place;      ///< among the nodes
    std::size_t candidate;  ///< in ContactModel::nodes
  };
  struct Row {
    std::size_t of;  ///< place in candidates_
    std::uint64_t key;
    Vec2 arm;  ///< X + u_{n+1}, co-rotating frame                                     [m]
  };

  void fill_column(std::size_t of, ImplicitOperator& implicit);
  [[nodiscard]] contact::Block response(std::size_t to, std::size_t from) const noexcept;
  void build_problem(const ContactStep& step);
  [[nodiscard]] double friction_of(const ContactStep& step, const ActiveContact& contact,
                                   const Row& row) const noexcept;

  const Model& model_;
  const NodeSet& nodes_;
  std::vector<Candidate> candidates_;
  std::vector<char> is_held_;
  /// (candidates or, with sectors, rows) A⁻¹ of a unit impulse in x and in y, at the candidates, or
  /// at all nodes; empty: not looked for yet.
  std::vector<std::array<PlaneField, 2>> columns_;
  PlaneField unit_;
  std::vector<Row> rows_;
  std::vector<ActiveContact> active_;
  contact::CoupledContacts coupled_;
};

}  // namespace rondo::dynamics
