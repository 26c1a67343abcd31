// SPDX-License-Identifier: BSD-3-Clause
/// @file  A body in two parts that meet at nodes, each with a step of its own: the scheme "hati"
/// (docs/theory.md, section 12).
#pragma once
#include <span>
#include <vector>

#include "rondo/fem/assembly.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::dynamics {

/// One of them, of its own cells alone.
struct Subdomain {
  std::vector<int> free;     ///< its nodes that move, ascending
  std::vector<double> mass;  ///< (n) lumped; 0 where it has no cell                 [kg/m]
  fem::BlockCsr stiffness;   ///< K on the free nodes                                [N/m²]
};

struct Subdomains {
  Subdomain fine;              ///< A: explicit, m steps in one of the other
  Subdomain coarse;            ///< B: by the trapezoidal rule
  std::vector<int> interface;  ///< free nodes of both, ascending
  int ratio = 1;               ///< m >= 1
};

/// @param is_fine (e) @throws std::bad_alloc @pre both have a cell
[[nodiscard]] Subdomains make_subdomains(const mesh::Mesh& mesh,
                                         std::span<const fem::Material> materials,
                                         std::span<const Vec2> prestress,
                                         std::span<const char> is_fine, int ratio);

/// (n) How many steps a force on the interface takes to reach a node of A: elements in between,
/// as the stiffness joins them; -1: it is not one of A, or nothing leads there.
[[nodiscard]] std::vector<int> distance_to_interface(const Subdomains& parts);

}  // namespace rondo::dynamics
