// SPDX-License-Identifier: BSD-3-Clause
/// @file  The mesh of a wheel in three dimensions, generated or from a section in a file.
#pragma once
#include <string>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::study {

/// @param warnings of the reader, added for the user; may be null
/// @throws InputError: what build_mesh() refuses; a section with triangles, with nodes at the axle
/// or beyond, or with a part that nothing holds
mesh::Mesh build_wheel(const Case& c, std::vector<std::string>* warnings);

/// The section alone, a plane mesh in r and z, with the nodes that the wheel has in each sector, in
/// the same order. @throws as build_wheel()
mesh::Mesh build_section(const Case& c, std::vector<std::string>* warnings);

}  // namespace rondo::study
