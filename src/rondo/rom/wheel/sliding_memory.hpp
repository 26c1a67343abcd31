// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the friction of the contact nodes of a reduced wheel depends on (docs/reduced.md):
/// the way of each node in the step before, and the force that pressed it.
#pragma once
#include <span>
#include <vector>

#include "rondo/contact/friction.hpp"
#include "rondo/core/vec2.hpp"

namespace rondo::rom {

/// μ with its derivatives.
struct SlidingFriction {
  double coefficient = 0.0;  ///< [-]
  double by_slip = 0.0;      ///< [1/m]
  double by_normal = 0.0;    ///< [m/N]
};

class SlidingMemory {
 public:
  /// @param lengths of the boundary that belongs to a contact node of a sector, (C)           [m]
  /// @param n_nodes a multiple of C
  SlidingMemory(contact::Friction friction, std::vector<double> lengths, std::size_t n_nodes,
                double dt);

  /// μ by the way and the force of the step before.
  /// @param place of the node at the start of the step [m]
  /// @param tangent unit vector of the ground there
  [[nodiscard]] double before(int node, Vec2 place, Vec2 tangent) const noexcept;
  /// μ by the way and the force of a step. @param place as above
  /// @param slip >= 0 of the node in the step [m]
  /// @param normal force [N/m]
  [[nodiscard]] SlidingFriction within(int node, Vec2 place, double slip,
                                       double normal) const noexcept;

  void clear() noexcept;
  /// @param way of the node in the step that ends, and the force of the ground along its normal
  void keep(int node, Vec2 way, double normal) noexcept;
  void press(int node, double normal) noexcept;
  void move(int node, Vec2 way) noexcept;

  static constexpr std::size_t numbers_of_node = 3;
  /// Appends numbers_of_node numbers for each node.
  void save(std::vector<double>& numbers) const;
  /// @pre as many numbers as save() appends
  void restore(std::span<const double> numbers);

 private:
  struct Kept {
    Vec2 way;             ///< [m]
    double normal = 0.0;  ///< [N/m]
  };
  [[nodiscard]] double length(int node) const noexcept;

  const contact::Friction friction_;
  const std::vector<double> lengths_;
  const double dt_;
  std::vector<Kept> kept_;
};

}  // namespace rondo::rom
