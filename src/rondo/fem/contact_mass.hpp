// SPDX-License-Identifier: BSD-3-Clause
/// @file  Masses of a body whose contact nodes are massless (docs/theory.md, 3.10).
#pragma once
#include <span>
#include <vector>

#include "rondo/mesh/mesh.hpp"

namespace rondo::fem {

struct MovedMass {
  std::vector<double> mass;    ///< (n) 0 at the nodes of `contact`                     [kg/m]
  int without_neighbour = -1;  ///< a contact node without a free neighbour that has mass, -1: none
};

/// Moves the mass of each contact node in equal shares to its free neighbours with mass: the nodes
/// joined to it by an edge of a cell, or, without such nodes, those of its cells. On layers of
/// quadrilaterals that is the node below. Σm is unchanged.
/// @param contact none clamped
MovedMass move_contact_mass(const mesh::Mesh& mesh, std::span<const double> mass,
                            std::span<const int> contact);

/// Multiplies masses by 1 + a + b·X + d|X|², with the smallest change that gives them the sum,
/// center and polar moment of `like`. Returns false and changes nothing if a mass would not remain
/// positive. @param nodes whose masses count and, unless zero, are changed
bool keep_moments(const mesh::Mesh& mesh, std::span<const double> like, std::span<const int> nodes,
                  std::vector<double>& mass);

}  // namespace rondo::fem
