// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the contact nodes of a viscous disk remember of their forces
/// (creep/creep_memory.hpp), node by node: a step costs one product of the tables with the
/// forces of the nodes in contact.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "rondo/core/index.hpp"
#include "rondo/core/vec2.hpp"
#include "rondo/rom/wheel/creep/creep_memory.hpp"
#include "rondo/rom/wheel/ring_harmonics.hpp"

namespace rondo::rom {

/// A force on a contact node, in the frame of its sector [N/m].
struct NodeForce {
  int node = 0;
  Vec2 force;
};

class CreepField {
 public:
  /// @param at_once, later tables of CreepResidual, one for each spin; they must outlive it
  /// @param n number of contact nodes of the wheel, those of a sector one after the other
  /// @param stiffness_damping β that the terms contain [s] @param dt [s]
  CreepField(std::span<const CreepTerm> terms, std::span<const RingResidual> at_once,
             std::span<const RingResidual> later, std::size_t n, double stiffness_damping,
             double dt);

  /// Its shares of new forces and of those that have always been there, its energies, its numbers.
  [[nodiscard]] const CreepMemory& memory() const noexcept { return memory_; }
  /// Forgets all forces.
  void clear() noexcept { start({}); }
  /// Starts from forces that have always been there.
  void start(std::span<const NodeForce> forces) noexcept;
  /// Moves on by a step, at whose end these are the forces. Allocates nothing.
  void step(std::span<const NodeForce> forces) noexcept;

  /// Displacement of a node, and what will be left of it after a step without new forces [m].
  [[nodiscard]] Vec2 now(int node, const TableShares& shares) const noexcept;
  [[nodiscard]] Vec2 left(int node, const TableShares& shares) const noexcept;

  /// Lagging forces on a node by their shares, of the first term and of all others [N/m].
  struct Lagging {
    Vec2 at_once, later;
  };
  [[nodiscard]] Lagging lagging(int node) const noexcept;
  /// At the start of the last step.
  [[nodiscard]] Lagging lagging_before(int node) const noexcept;

  void restore(std::span<const double> numbers) noexcept { memory_.restore(numbers); }
  /// @param n number of contact nodes
  [[nodiscard]] static std::size_t n_saved(std::size_t terms, std::size_t tables,
                                           std::size_t n) noexcept {
    return CreepMemory::n_saved(terms, tables, 2 * n);
  }

 private:
  void push(std::span<const NodeForce> forces) noexcept;
  static void add_product(const RingResidual& table, const NodeForce& from,
                          CreepMemory::Numbers& out) noexcept;

  std::array<std::span<const RingResidual>, 2> tables_;  ///< at once, later
  CreepMemory memory_;                                   ///< a group is a node
};

}  // namespace rondo::rom
