// SPDX-License-Identifier: BSD-3-Clause
/// @file  A body in two parts that share interface nodes, each part with its own time step: the
/// scheme "hati" (docs/theory.md, section 12).
#pragma once
#include <span>
#include <vector>

#include "rondo/fem/assembly.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::dynamics {

/// One part, consisting of its own cells alone.
struct Subdomain {
  std::vector<int> free;     ///< its nodes that are not clamped, ascending
  std::vector<double> mass;  ///< (n) lumped; 0 at nodes without a cell of it        [kg/m]
  fem::BlockCsr stiffness;   ///< K on the free nodes                                [N/m²]
};

struct Subdomains {
  Subdomain fine;              ///< A: explicit, m steps per coarse step
  Subdomain coarse;            ///< B: integrated by the trapezoidal rule
  std::vector<int> interface;  ///< free nodes that belong to both parts, ascending
  int ratio = 1;               ///< m >= 1
};

/// @param is_fine (e) @throws std::bad_alloc @pre both parts have a cell
[[nodiscard]] Subdomains make_subdomains(const mesh::Mesh& mesh,
                                         std::span<const fem::Material> materials,
                                         std::span<const Vec2> prestress,
                                         std::span<const char> is_fine, int ratio);

/// (n) Number of steps that a force on the interface takes to reach a node of A: the number of
/// elements in between, as coupled by the stiffness; -1: not a node of A, or not connected.
[[nodiscard]] std::vector<int> distance_to_interface(const Subdomains& parts);

}  // namespace rondo::dynamics
