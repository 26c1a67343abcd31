// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/disk.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::mesh {
namespace {

/// A line of nodes from the rim outwards; the lines are in counter-clockwise order.
struct Line {
  int first;  ///< node on the rim
  int top;    ///< top layer of the line: base layers, plus tread layers beside a land
};

struct Layout {
  int pitches, columns, land, base, layers;  ///< columns: per pitch, of land; layers: below, above
};

Layout layout_of(const Disk& d) {
  if (!d.tread) return {d.circumferential, 1, 1, d.radial, 0};
  return {d.tread->pitches, d.tread->land_columns + d.tread->groove_columns, d.tread->land_columns,
          d.radial, d.tread->layers};
}

/// A line carries tread nodes if it bounds a land: lines 0 … land of a pitch.
int top_layer(const Layout& l, int line_in_pitch) {
  return line_in_pitch <= l.land ? l.base + l.layers : l.base;
}

std::vector<Line> add_nodes(Mesh& mesh, const Layout& l, const std::vector<double>& radii) {
  std::vector<Line> lines;
  const int n_lines = l.pitches * l.columns;
  for (int line = 0; line < n_lines; ++line) {
    const int pitch = line / l.columns, in_pitch = line % l.columns;
    const double angle = 2.0 * std::numbers::pi * line / n_lines - 0.5 * std::numbers::pi;
    const Vec2 direction = direction_at(angle);
    const int first = static_cast<int>(mesh.n_nodes());
    const int in_sector = in_pitch == 0 ? 0 : mesh.sector_node.back() + 1;
    const int top = top_layer(l, in_pitch);
    for (int k = 0; k <= top; ++k) {
      mesh.coordinates.push_back(radii[at(k)] * direction);
      mesh.sector.push_back(pitch);
      mesh.sector_node.push_back(in_sector + k);
    }
    mesh.clamped.push_back(first);
    lines.push_back({first, top});
  }
  return lines;
}

void add_cells(Mesh& mesh, const Layout& l, const std::vector<Line>& lines) {
  for (std::size_t column = 0; column < lines.size(); ++column) {
    const Line a = lines[column], b = lines[(column + 1) % lines.size()];
    const bool land = static_cast<int>(column) % l.columns < l.land;
    const int top = land ? std::min(a.top, b.top) : l.base;
    for (int k = 0; k < top; ++k)
      mesh.cells.push_back({a.first + k, a.first + k + 1, b.first + k + 1, b.first + k});
  }
}

/// Candidates: tops of the lands, each with half of the adjacent chords on its own land.
void add_boundary(Mesh& mesh, const Layout& l, const std::vector<Line>& lines) {
  const int n = static_cast<int>(lines.size());
  const bool grooved = l.columns > l.land;
  const auto top_node = [&](int i) {
    const Line& line = lines[at((i + n) % n)];
    return line.first + line.top;
  };
  const auto chord = [&](int i) {
    return norm(mesh.coordinates[at(top_node(i + 1))] - mesh.coordinates[at(top_node(i))]);
  };
  for (int i = 0; i < n; ++i) {
    const int in_pitch = i % l.columns;
    if (in_pitch > l.land) continue;
    const bool land_before = !grooved || in_pitch > 0;
    const bool land_after = !grooved || in_pitch < l.land;
    mesh.boundary.push_back(top_node(i));
    mesh.tributary.push_back((land_before ? 0.5 * chord(i - 1) : 0.0) +
                             (land_after ? 0.5 * chord(i) : 0.0));
    if (land_after) mesh.contact_edges.push_back({top_node(i), top_node(i + 1)});
  }
}

/// "rim": the inner boundary, clockwise, so that the body is on its left. "tread": the tops.
void add_curves(Mesh& mesh, const std::vector<Line>& lines) {
  Curve rim{"rim", {}};
  for (std::size_t i = 0; i < lines.size(); ++i)
    rim.edges.push_back({lines[(i + 1) % lines.size()].first, lines[i].first});
  mesh.curves = {std::move(rim), {"tread", mesh.contact_edges}};
}

}  // namespace

std::vector<double> layer_radii(const Disk& d) {
  const Layout l = layout_of(d);
  const double base_radius = d.outer_radius - (d.tread ? d.tread->depth : 0.0);
  std::vector<double> r;
  for (int k = 0; k <= l.base; ++k) {
    const double fraction = 1.0 - std::pow(1.0 - static_cast<double>(k) / l.base, d.grading);
    r.push_back(k == l.base ? base_radius
                            : d.inner_radius + (base_radius - d.inner_radius) * fraction);
  }
  for (int k = 1; k <= l.layers; ++k)
    r.push_back(k == l.layers ? d.outer_radius
                              : base_radius + (d.outer_radius - base_radius) * k / l.layers);
  return r;
}

std::size_t n_disk_nodes(const Disk& disk) noexcept {
  const Layout l = layout_of(disk);
  const auto per_line = [](int layers) { return static_cast<std::size_t>(layers) + 1; };
  const std::size_t bare = static_cast<std::size_t>(l.columns) * per_line(l.base);
  const std::size_t tread_lines = static_cast<std::size_t>(std::min(l.land + 1, l.columns));
  const std::size_t tread = tread_lines * static_cast<std::size_t>(l.layers);
  return static_cast<std::size_t>(l.pitches) * (bare + tread);
}

Mesh make_disk(const Disk& disk) {
  const Layout l = layout_of(disk);
  RONDO_DEMAND(disk.inner_radius > 0 && disk.outer_radius > disk.inner_radius, disk.inner_radius,
               disk.outer_radius);
  RONDO_DEMAND(l.pitches >= 3 && l.land >= 1 && l.base >= 1 && disk.grading >= 1, l.pitches, l.land,
               l.base, disk.grading);
  RONDO_DEMAND(!disk.tread || (disk.tread->groove_columns >= 1 && l.layers >= 1), l.layers);
  Mesh mesh;
  mesh.n_sectors = l.pitches;
  const std::size_t n = n_disk_nodes(disk);
  mesh.coordinates.reserve(n);
  mesh.sector.reserve(n);
  mesh.sector_node.reserve(n);
  mesh.cells.reserve(n);  // there are no more cells than nodes
  const std::vector<Line> lines = add_nodes(mesh, l, layer_radii(disk));
  add_cells(mesh, l, lines);
  add_boundary(mesh, l, lines);
  add_curves(mesh, lines);
  return mesh;
}

}  // namespace rondo::mesh
