// SPDX-License-Identifier: BSD-3-Clause
/// @file  A contact of any kind in one step (docs/theory.md, 4.7 and 4.8): rows on the velocities
/// that its nodes have in the fixed frame over a step, w = Σ H_i V_i.
#pragma once
#include <cstdint>

#include "rondo/contact/coupled/rows.hpp"
#include "rondo/contact/law.hpp"

namespace rondo::dynamics {

enum class ContactKind : std::uint8_t {
  facet,    ///< a node on a facet of the ground: r acts on the node
  corner,   ///< a sharp corner of the ground on a segment of a body: r acts on the ground
  segment,  ///< a node on a segment of a body: r acts on the node, the first of three
};

/// In a row's key the edge of the body has this many bits; before them are kind and corner or node.
inline constexpr unsigned key_bits_of_edge = 31;
static_assert(sizeof(std::uint64_t) * 8 == 2 + 2 * key_bits_of_edge);  // two for the kind

struct ContactRow {
  ContactKind kind = ContactKind::facet;
  contact::ContactRows rows;
  std::uint64_t key = 0;   ///< name of the contact, the same in the next step
  Vec2 normal;             ///< fixed frame; what r acts on is pushed along it
  Vec2 point;              ///< point that touches the facet or the segment, fixed frame [m]
  double turning = 0.0;    ///< by which the gap opens faster than w_n, as the segment turns during
                           ///< the step (4.8c); joins w_n in the law               [m/s]
  double gap = 0.0;        ///< <= 0                                                [m]
  double tributary = 0.0;  ///< boundary that it stands for                         [m]
  const contact::Law* law = nullptr;  ///< law of the ground, or between bodies
  Vec2 before, free, after;  ///< w⁻, w without impulses, w⁺                          [m/s]
  double bounce = 0.0;       ///< ε of the law (4.3)                                  [m/s]
  double friction = 0.0;     ///< μ of the law                                        [-]
  Vec2 impulse;              ///< r                                                   [N·s/m]
  contact::Status status = contact::Status::open;
};

}  // namespace rondo::dynamics
