// SPDX-License-Identifier: BSD-3-Clause
/// @file  Parts of a body: layers of a generated disk, physical surfaces of a mesh, and elements
/// that a case chooses by them.
#pragma once
#include <string>
#include <vector>

#include "rondo/case/setup.hpp"

namespace rondo::study {

struct Parts {
  std::vector<int> of_cell;        ///< (e) number of each cell's
  std::vector<std::string> names;  ///< what each is called
  std::string kind;                ///< what each is
};

/// Layers of a generated disk, by the radii of their nodes, 0 at the rim.
Parts layers_of(const mesh::Mesh& mesh, Vec2 center);
/// Layers of a disk, surfaces of a mesh; the whole body of a mesh without surfaces.
Parts parts_of(const Case& c, const Setup& s);

/// Region of each of so many layers of a generated body, as `material.region[].layers` say, 0 the
/// rest; names the regions. @throws InputError: a layer that there is not, or that two of them have
std::vector<int> regions_of_layers(const Case& c, int layers, mesh::Mesh& mesh);

/// Regions of a generated disk as `material.region[].layers` say: 0 is the rest.
/// @throws InputError: a layer that the disk does not have, or that two of them have
void set_disk_regions(const Case& c, mesh::Mesh& mesh);

/// (e) 1 where a cell is chosen. @param table of the case that chooses, e.g. "solver.implicit[0]"
/// @throws InputError: a layer or surface that is not there, or no element at all
std::vector<char> chosen_cells(const Case& c, const Setup& s, const ElementChoice& choice,
                               const std::string& table);

}  // namespace rondo::study
