// SPDX-License-Identifier: BSD-3-Clause
/// @file  Curves of a section as chains of nodes.
#pragma once
#include <string>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::study {

/// The edges of a curve of the section, one after the other. @throws InputError at `key`: there is
/// none of this name
const std::vector<mesh::Edge>& section_curve(const Case& c, const mesh::Mesh& section,
                                             const std::string& key, const std::string& name);

/// Edges with the direction in which cords have their angle: each chain goes from its end of
/// smaller z to that of larger, and at equal z outwards. @throws InputError at `key`: a node of the
/// curve has more than two edges; a chain is closed
std::vector<mesh::Edge> directed_curve(const Case& c, const mesh::Mesh& section,
                                       const std::string& key, const std::string& name);

/// "r = 0.3, z = 0.05 m"
std::string place_text(const mesh::Mesh& section, int node);

/// Nodes with an odd number of edges of the curve: one, where it has no branches.
std::vector<int> ends_of(const std::vector<mesh::Edge>& edges);

}  // namespace rondo::study
