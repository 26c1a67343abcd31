// SPDX-License-Identifier: BSD-3-Clause
/// @file  A contact as rows on the velocities of its nodes, w = Σ H_k v_k, and the coupled problem
/// of contacts that share nodes (docs/theory.md, 4.7, 4.8).
#pragma once
#include <array>
#include <span>

#include "rondo/contact/coupled/coupled.hpp"

namespace rondo::contact {

/// At most three nodes: the node that touches, and the two of the segment that it touches. A node
/// on the ground is one; a corner of the ground on a segment is two.
struct ContactRows {
  int count = 0;
  std::array<int, 3> node{};
  std::array<Block, 3> block{};  ///< H_k: fixed-frame velocity to (normal, tangential); Hᵀ r is the
                                 ///< impulse on the node, transposed()
};

/// Rows of a node on rigid ground (w = n̄ v).
ContactRows ground_rows(int node, Vec2 normal) noexcept;

/// W_jl = Σ H_jk G_k H_lkᵀ over the nodes k that j and l share, into row_start, column, blocks and
/// mass of `problem`; G_k = response[k] is a complex number, velocity per impulse in the fixed
/// frame [m/kg]. free, bounce and friction are the caller's. O(contacts · contacts a node has);
/// memory only grows.
class DelassusBuilder {
 public:
  void build(std::span<const ContactRows> contacts, std::span<const Complex> response,
             CoupledProblem& problem);

 private:
  void list_contacts(std::span<const ContactRows> contacts);
  void find_sharing(const ContactRows& contact);

  /// Entry 3 j + a is node a of contact j; the contacts of a node are a linked list of entries.
  std::vector<int> head_, next_;
  std::vector<int> sharing_;  ///< contacts that share a node with the one at hand
};

}  // namespace rondo::contact
