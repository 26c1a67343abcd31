// SPDX-License-Identifier: BSD-3-Clause
/// @file  Masses of a body whose contact nodes have none (docs/theory.md, 3.10).
#pragma once
#include <span>
#include <vector>

#include "rondo/mesh/mesh.hpp"

namespace rondo::fem {

struct MovedMass {
  std::vector<double> mass;    ///< (n) 0 at the nodes of `contact`                     [kg/m]
  int without_neighbour = -1;  ///< a contact node beside which no free node has mass, -1: none
};

/// The mass of each contact node goes to the free nodes with mass beside it, in equal shares: to
/// those that an edge of a cell joins to it, else to those of its cells. On layers of
/// quadrilaterals that is the node below. Σm stays.
/// @param contact none clamped
MovedMass move_contact_mass(const mesh::Mesh& mesh, std::span<const double> mass,
                            std::span<const int> contact);

/// Multiplies masses by 1 + a + b·X + d|X|², as little as that can be, so that their sum, center
/// and polar moment are those of `like`. False, and nothing is changed, where that cannot be
/// without a mass that is not positive. @param nodes whose masses count and, where not zero, change
bool keep_moments(const mesh::Mesh& mesh, std::span<const double> like, std::span<const int> nodes,
                  std::vector<double>& mass);

}  // namespace rondo::fem
