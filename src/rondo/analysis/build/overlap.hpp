// SPDX-License-Identifier: BSD-3-Clause
/// @file  Bodies of a mesh that lie in each other, or side by side with nothing that joins them.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::study {

/// Places of the bodies of a mesh at the start.
struct PlacedBodies {
  const mesh::Mesh& mesh;
  std::span<const Vec2> x;       ///< (n) fixed frame [m]
  bool contact_between = false;  ///< candidates of one touch those of another
};

/// Bodies are the parts that no cell joins. A node, the middle of a cell or an edge of one must not
/// be in another: by no more than round-off where they know no contact; where they do, by up to
/// half an element, which is warned of. Sides that coincide are allowed between candidates of a
/// contact.
/// @throws InputError: the two bodies, a place, and what Gmsh makes one body of them
void refuse_overlaps(const Case& c, const PlacedBodies& bodies, std::vector<std::string>& warnings);

}  // namespace rondo::study
