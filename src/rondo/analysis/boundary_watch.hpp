// SPDX-License-Identifier: BSD-3-Clause
/// @file  Nodes of a body's boundary that mesh.contact leaves out go through the ground unseen by
/// the contact: looked for now and then, and told once.
#pragma once
#include <string>
#include <vector>

#include "rondo/case/setup.hpp"

namespace rondo::study {

class BoundaryWatch {
 public:
  /// Watches nothing for a generated disk, without ground, and where the whole boundary may touch.
  BoundaryWatch(const Case& c, const Setup& setup);

  /// The trouble in this state, with node, place and time, the first time; else empty.
  [[nodiscard]] std::string look(const dynamics::State& state);

 private:
  [[nodiscard]] std::string curves_of(int node) const;

  const Case& case_;
  const Setup& setup_;
  std::vector<int> nodes_;  ///< nodes of the boundary, neither held nor candidates
  double depth_ = 0.0;      ///< from which a node counts as inside                     [m]
};

}  // namespace rondo::study
