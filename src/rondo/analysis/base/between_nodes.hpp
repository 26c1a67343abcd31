// SPDX-License-Identifier: BSD-3-Clause
/// @file  How deep the ground stands in a body between its contact nodes, where arcs and blunt
/// corners meet no segment (docs/theory.md, 4.1).
#pragma once
#include "rondo/model/model.hpp"

namespace rondo::study {

class BetweenNodes {
 public:
  /// @param model must outlive the object
  explicit BetweenNodes(const dynamics::Model& model);

  /// Bends of the ground are so near that they may be in the body within as many steps from here,
  /// deeper than contact::least_hidden. Where they are not, depth() need not be looked at.
  /// @param frame null: not known
  [[nodiscard]] bool may_be_deep(const dynamics::FrameStep* frame, long long steps) const noexcept;

  /// Largest depth of a bend behind an edge between candidates, in the plane of a profile, no
  /// deeper than the edge is long [m]
  [[nodiscard]] double depth(const dynamics::State& state) const noexcept;

 private:
  [[nodiscard]] Vec2 place(const dynamics::State& state, std::size_t set, int node) const noexcept;

  const dynamics::Model& model_;
  GroundFrame ground_;
  bool watches_ = false;  ///< some bend hides more than the least that counts
  double radius_ = 0.0;   ///< 1.5 times that of the candidates around the center         [m]
};

}  // namespace rondo::study
