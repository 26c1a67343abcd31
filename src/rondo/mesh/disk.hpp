// SPDX-License-Identifier: BSD-3-Clause
/// @file  Generated disks: rings of quadrilaterals between a rigid rim and a smooth or treaded top.
/// Radii of the layers: r_k = ri + (rb - ri) (1 - (1 - k/n)^p), docs/theory.md (2.1).
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

/// Tread pattern: equal pitches, each a land followed by a groove, counter-clockwise.
struct Tread {
  int pitches = 60;      ///< equal sectors of the disk, >= 3
  double depth = 0.012;  ///< height of the lands                      [m], 0 < depth < ro - ri
  int land_columns = 3;  ///< columns of quadrilaterals in a land, >= 1
  int groove_columns =
      1;           ///< columns of a groove, >= 1; all columns of a pitch have the same angle
  int layers = 2;  ///< layers of quadrilaterals over the depth, >= 1
};

struct Disk {
  double outer_radius = 0.30;  ///< radius of the top of the tread        [m]
  double inner_radius = 0.15;  ///< radius bonded to the rim              [m], 0 < ri < ro
  int radial = 12;             ///< layers between the radii (with a tread: below its grooves), >= 1
  int circumferential = 180;   ///< columns of a smooth disk, >= 3; unused with a tread
  double grading = 1.0;        ///< p >= 1: finer near the tread if p > 1
  std::optional<Tread> tread;
};

/// Column 0 (the first land) starts at -90°, straight down; the columns follow counter-clockwise.
/// Nodes are numbered sector after sector, from the rim outwards. @pre the bounds above hold
Mesh make_disk(const Disk& disk);

/// Radii of the layers of nodes, from the rim to the top of the tread [m].
std::vector<double> layer_radii(const Disk& disk);

/// Number of nodes that make_disk would make, computed without making them (64 bits: no overflow).
std::size_t n_disk_nodes(const Disk& disk) noexcept;

}  // namespace rondo::mesh
