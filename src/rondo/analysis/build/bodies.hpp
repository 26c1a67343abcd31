// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a case to its bodies: mesh, materials, where free ones are at t = 0 and how they
/// move.
#pragma once
#include <string>
#include <vector>

#include "rondo/case/setup.hpp"

namespace rondo::study {

/// The mesh generated or read. Of a free disk nothing is clamped.
/// @param warnings of the reader, added for the user; may be null
/// @throws InputError: layers that coincide in round-off; a file that is none, is no good or has
/// not the groups that the case names; a generated one that does not fit into memory. FileError: it
/// cannot be read.
mesh::Mesh build_mesh(const Case& c, std::vector<std::string>* warnings = nullptr);

/// The Gmsh file of a [mesh] or a [section]. @pre the body comes from one. @throws as build_mesh()
mesh::Mesh read_mesh_file(const Case& c, std::vector<std::string>* warnings);

/// One for each region of the mesh (fem::material_of). @throws InputError: a surface without cells
std::vector<fem::Material> materials_of(const Case& c, const mesh::Mesh& mesh);

/// Length of the mesh's box, the larger side halved: of a disk about its radius [m].
double extent_of(const mesh::Mesh& mesh);

/// Shortest edge of the cells or hexahedra around each node [m].
std::vector<double> element_sizes(const mesh::Mesh& mesh);

/// Turns and moves free bodies, in mesh and model, as [initial] says.
/// @throws InputError: it says so, and all bodies are held. @pre the free bodies are found
void place_free_bodies(const Case& c, mesh::Mesh& mesh, dynamics::Model& model);

/// Motion of a free body at t = 0.
struct RigidMotion {
  Vec2 velocity;                  ///< velocity of the center of mass    [m/s]
  double angular_velocity = 0.0;  ///< about it, > 0 clockwise            [rad/s]
};

/// (free_bodies) @throws InputError: a surface of held bodies, or two motions of one body
std::vector<RigidMotion> motions_of(const Case& c, const mesh::Mesh& mesh,
                                    const dynamics::Model& model);

/// Edges of a curve of the mesh. @throws InputError at `key`: there is none of that name
const std::vector<mesh::Edge>& curve_of(const Case& c, const mesh::Mesh& mesh,
                                        const std::string& key, const std::string& name);

/// In the mesh as it is generated or read. @throws InputError: a probe that is in no cell
std::vector<ProbeSite> find_probes(const Case& c, const mesh::Mesh& mesh);

}  // namespace rondo::study
