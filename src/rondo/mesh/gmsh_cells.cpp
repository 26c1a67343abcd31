// SPDX-License-Identifier: BSD-3-Clause
/// Nodes and cells of a Gmsh file, and the faults that they may have.
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "rondo/mesh/gmsh_draft.hpp"
#include "rondo/mesh/locate.hpp"
#include "rondo/mesh/mesh_check.hpp"
#include "rondo/mesh/physical_group.hpp"

namespace rondo::mesh {
namespace {

constexpr int triangle = 2, quadrilateral = 3;  // Gmsh's numbers of types

struct RawCell {
  std::uint64_t tag = 0;
  std::size_t entity = 0;
  Cell nodes{-1, -1, -1, -1};  ///< indices in RawMesh::node_tags
};

/// Elements of surfaces in the order surface, type, tag, the same for every form of a file. An
/// element of a surface in several groups appears once (MSH 2.2 repeats it per group).
std::vector<RawCell> gather_cells(const RawMesh& raw, const TagIndex& index, Findings& findings) {
  std::vector<RawCell> cells;
  std::vector<std::uint64_t> lost;
  for (const RawBlock& block : raw.blocks) {
    const RawType& type = raw.types[block.type];
    if (type.type != triangle && type.type != quadrilateral) continue;
    const auto n = static_cast<std::size_t>(type.type == triangle ? 3 : 4);
    for (std::size_t k = 0; k < block.tags.size(); ++k) {
      RawCell cell{.tag = block.tags[k], .entity = block.entity};
      for (std::size_t a = 0; a < n; ++a) cell.nodes[a] = index.find(block.nodes[n * k + a]);
      if (std::any_of(cell.nodes.begin(), cell.nodes.begin() + static_cast<std::ptrdiff_t>(n),
                      [](int node) { return node < 0; }))
        lost.push_back(cell.tag);
      else
        cells.push_back(cell);
    }
  }
  if (!lost.empty())
    findings.add(
        fmt::format(
            "{} cells have nodes that the file does not have: element {}", lost.size(),
            examples(lost.size(), [&](std::size_t k) { return fmt::format("{}", lost[k]); })),
        "a mesh as Gmsh writes it");
  const auto key = [](const RawCell& c) { return std::tuple(c.entity, n_corners(c.nodes), c.tag); };
  if (!std::ranges::is_sorted(cells, {}, key)) std::ranges::stable_sort(cells, {}, key);
  return cells;
}

void drop_repeats(const RawMesh& raw, std::vector<RawCell>& cells) {
  const auto several = [&](const RawCell& c) { return raw.entities[c.entity].groups.size() > 1; };
  if (std::ranges::none_of(cells, several)) return;
  std::vector<std::pair<std::size_t, Cell>> seen;
  for (const RawCell& cell : cells)
    if (several(cell)) seen.emplace_back(cell.entity, cell.nodes);
  std::ranges::sort(seen);
  std::vector<char> taken(seen.size(), 0);
  std::erase_if(cells, [&](const RawCell& cell) {
    if (!several(cell)) return false;
    const auto at = std::ranges::lower_bound(seen, std::pair{cell.entity, cell.nodes});
    char& was = taken[static_cast<std::size_t>(at - seen.begin())];
    return std::exchange(was, 1) == 1;
  });
}

/// Collects the nodes of cells, numbered in the order of their tags.
void number_nodes(const RawMesh& raw, const std::vector<RawCell>& cells, Draft& draft) {
  std::vector<char> used(raw.node_tags.size(), 0);
  for (const RawCell& cell : cells)
    for (int a = 0; a < n_corners(cell.nodes); ++a)
      used[static_cast<std::size_t>(cell.nodes[static_cast<std::size_t>(a)])] = 1;
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < used.size(); ++k)
    if (used[k]) places.push_back(k);
  const auto tag = [&](std::size_t k) { return raw.node_tags[k]; };
  if (!std::ranges::is_sorted(places, {}, tag)) std::ranges::stable_sort(places, {}, tag);
  draft.node_of.assign(raw.node_tags.size(), -1);
  for (const std::size_t k : places) {
    draft.node_of[k] = static_cast<int>(draft.node_tag.size());
    draft.node_tag.push_back(raw.node_tags[k]);
    draft.mesh.coordinates.push_back(
        {draft.scale * raw.places[3 * k], draft.scale * raw.places[3 * k + 1]});
  }
}

/// A limit for coordinates, so far from overflow that areas and moments of inertia are finite.
constexpr double farthest = 1e12;  // m

void check_coordinates(const Draft& draft, Findings& findings) {
  std::vector<int> wild;
  for (std::size_t k = 0; k < draft.mesh.n_nodes(); ++k) {
    const Vec2 x = draft.mesh.coordinates[k];
    if (!(std::abs(x.x) <= farthest && std::abs(x.y) <= farthest))
      wild.push_back(static_cast<int>(k));
  }
  if (wild.empty()) return;
  findings.add(
      fmt::format("{} nodes are nowhere: {}", wild.size(),
                  examples(wild.size(), [&](std::size_t k) { return draft.node_text(wild[k]); })),
      fmt::format("coordinates of up to {:g} m", farthest));
}

void check_plane(const RawMesh& raw, const Draft& draft, Findings& findings) {
  double size = 0.0, z = 0.0;
  std::size_t first = raw.node_tags.size();
  for (std::size_t k = 0; k < raw.node_tags.size(); ++k) {
    if (draft.node_of[k] < 0) continue;
    if (first == raw.node_tags.size()) {
      first = k;
      z = raw.places[3 * k + 2];
    }
    for (std::size_t i = 0; i < 2; ++i)
      size = std::max(size, std::abs(raw.places[3 * k + i] - raw.places[3 * first + i]));
  }
  std::vector<std::size_t> out;
  constexpr double rounding = 1e-9;  // relative to the size: text files may have ten digits
  for (std::size_t k = first; k < raw.node_tags.size(); ++k)
    if (draft.node_of[k] >= 0 && !(std::abs(raw.places[3 * k + 2] - z) <= rounding * size))
      out.push_back(k);
  if (out.empty()) return;
  findings.add(fmt::format("the mesh is not plane: {} nodes are off z = {:g}: {}", out.size(), z,
                           examples(out.size(),
                                    [&](std::size_t k) {
                                      return fmt::format("{} with z = {:g}",
                                                         draft.node_text(draft.node_of[out[k]]),
                                                         raw.places[3 * out[k] + 2]);
                                    })),
               "one z for all nodes");
}

void warn_of_dropped(const RawMesh& raw, const Draft& draft, Findings& findings) {
  const std::uint64_t in_file = std::max<std::uint64_t>(raw.nodes_in_file, raw.node_tags.size());
  const std::uint64_t dropped = in_file - draft.node_tag.size();
  if (dropped > 0)
    findings.warnings.push_back(
        fmt::format("{} of {} nodes are in no cell and are left out", dropped, in_file));
}

}  // namespace

TagIndex::TagIndex(const std::vector<std::uint64_t>& tags) {
  sorted_.reserve(tags.size());
  for (std::size_t k = 0; k < tags.size(); ++k) sorted_.emplace_back(tags[k], static_cast<int>(k));
  if (!std::ranges::is_sorted(sorted_)) std::ranges::sort(sorted_);
  for (std::size_t k = 1; k < sorted_.size(); ++k)
    if (sorted_[k].first == sorted_[k - 1].first) repeated_.push_back(sorted_[k].first);
  if (sorted_.empty() || sorted_.back().first > 4 * tags.size() + 1000) return;
  dense_.assign(static_cast<std::size_t>(sorted_.back().first) + 1, -1);
  for (const auto& [tag, place] : sorted_) dense_[static_cast<std::size_t>(tag)] = place;
}

int TagIndex::find(std::uint64_t tag) const {
  if (!dense_.empty()) return tag < dense_.size() ? dense_[static_cast<std::size_t>(tag)] : -1;
  const auto at = std::ranges::lower_bound(sorted_, std::pair{tag, 0});
  return at != sorted_.end() && at->first == tag ? at->second : -1;
}

std::string Draft::place_text(Vec2 x) const {
  return fmt::format("({:.6g}, {:.6g})", x.x / scale, x.y / scale);
}

std::string Draft::node_text(int node) const {
  const auto k = static_cast<std::size_t>(node);
  return fmt::format("node {} at {}", node_tag[k], place_text(mesh.coordinates[k]));
}

std::string Draft::cell_text(int cell) const {
  const auto e = static_cast<std::size_t>(cell);
  return fmt::format("element {} at {}", cell_tag[e],
                     place_text(middle_of(mesh.coordinates, mesh.cells[e])));
}

Draft draft_mesh(const RawMesh& raw, const TagIndex& index, const MeshRequest& request,
                 Findings& findings) {
  if (!index.repeated().empty())
    findings.add(
        fmt::format(
            "{} nodes have a tag that another node has: {}", index.repeated().size(),
            examples(index.repeated().size(),
                     [&](std::size_t k) { return fmt::format("{}", index.repeated()[k]); })),
        "a tag of its own for each node");
  std::vector<RawCell> cells = gather_cells(raw, index, findings);
  drop_repeats(raw, cells);
  Draft draft;
  draft.scale = request.scale;
  number_nodes(raw, cells, draft);
  draft.mesh.cells.reserve(cells.size());
  for (const RawCell& cell : cells) {
    Cell nodes{-1, -1, -1, -1};
    for (int a = 0; a < n_corners(cell.nodes); ++a) {
      const auto corner = static_cast<std::size_t>(a);
      nodes[corner] = draft.node_of[static_cast<std::size_t>(cell.nodes[corner])];
    }
    draft.mesh.cells.push_back(nodes);
    draft.cell_tag.push_back(cell.tag);
    draft.cell_entity.push_back(cell.entity);
  }
  const bool has_other = std::ranges::any_of(raw.blocks, [&](const RawBlock& block) {
    return !block.tags.empty() && raw.types[block.type].dimension >= 2;
  });
  if (cells.empty() && !has_other)
    findings.add(
        "there are no triangles and no quadrilaterals in it",
        "a surface mesh (gmsh -2). Where there are physical groups, Gmsh saves only what is "
        "in one of them, so every surface of the body must be in a physical surface: " +
            physical_group_line("Surface", "body"));
  check_coordinates(draft, findings);
  check_plane(raw, draft, findings);
  warn_of_dropped(raw, draft, findings);
  return draft;
}

}  // namespace rondo::mesh
