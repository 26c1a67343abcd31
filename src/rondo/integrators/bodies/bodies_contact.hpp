// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contacts of a step whose fields are not in the order of the nodes: the places of the
/// boundary and the velocities of what touches come and go by node.
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "rondo/integrators/general/general_contact.hpp"

namespace rondo::dynamics {

/// A node in contact, vectors in its frame.
struct TouchingNode {
  int node = 0;
  Vec2 before;  ///< v_{n+1/2}                                                            [m/s]
  Vec2 free;    ///< v_{n+3/2} without impulses                                           [m/s]
  Vec2 after;   ///< v_{n+3/2}                                                            [m/s]
};

class BodiesContact {
 public:
  /// The model must outlive it.
  explicit BodiesContact(const Model& model);

  /// Nodes whose places the search looks at now, as ContactFinder::boundary_after().
  [[nodiscard]] std::span<const int> boundary_after(double travelled) noexcept {
    return contact_.finder().boundary_after(travelled);
  }
  /// Displacements; those of these nodes are to be set to u_{n+1} before find()            [m]
  [[nodiscard]] std::span<Vec2> displacement() noexcept { return state_.u; }
  /// The nodes of what touches, ascending: `before` and `free` are to be set before solve().
  std::span<TouchingNode> find(const FrameStep& frame);
  /// Sets `after`. @param center about which the ground's angular impulse is taken         [m]
  ContactReport solve(const BodyFrames& frames, Vec2 center);

  /// Contacts of the last step.
  [[nodiscard]] const std::vector<ActiveContact>& active() const noexcept { return state_.active; }
  /// See GeneralContact::coupled().
  [[nodiscard]] const contact::CoupledContacts& coupled() const noexcept {
    return contact_.coupled();
  }
  [[nodiscard]] contact::CoupledContacts& coupled() noexcept { return contact_.coupled(); }
  /// Goes on from these, wherever the boundary is.
  void restore(contact::KeptImpulses impulses) noexcept {
    contact_.coupled().kept = std::move(impulses);
    contact_.finder().forget();
  }

 private:
  const Model& model_;
  GeneralContact contact_;
  State state_;  ///< u of the boundary, v and v_next of what touches
  std::vector<TouchingNode> touching_;
};

}  // namespace rondo::dynamics
