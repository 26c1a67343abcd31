// SPDX-License-Identifier: BSD-3-Clause
/// Reports what the checks of a mesh find, with the words and numbers of the Gmsh file.
#include <algorithm>
#include <array>

#include "rondo/core/index.hpp"
#include "rondo/mesh/gmsh_draft.hpp"
#include "rondo/mesh/mesh_check.hpp"

namespace rondo::mesh {
namespace {

constexpr std::array<int, 4> readable{1, 2, 3, 15};  // line, triangle, quadrilateral, point

std::string first_place(const RawMesh& raw, const TagIndex& index, const RawBlock& block) {
  const int node = block.nodes.empty() ? -1 : index.find(block.nodes.front());
  if (node < 0) return {};
  const auto k = static_cast<std::size_t>(node);
  return fmt::format(" at ({:.6g}, {:.6g})", raw.places[3 * k], raw.places[3 * k + 1]);
}

void name_cells(const char* what, const char* allowed, const std::vector<int>& cells,
                const Draft& draft, Findings& findings) {
  if (cells.empty()) return;
  findings.add(
      fmt::format("{} {}: {}", cells.size(), what,
                  examples(cells.size(), [&](std::size_t k) { return draft.cell_text(cells[k]); })),
      allowed);
}

/// Names surfaces whose cells are all clockwise: a common mistake that is easy to correct.
std::string reversed_surfaces(const RawMesh& raw, const std::vector<int>& clockwise,
                              const Draft& draft) {
  std::vector<std::size_t> all(raw.entities.size(), 0), wrong(raw.entities.size(), 0);
  for (const std::size_t k : draft.cell_entity) ++all[k];
  for (const int cell : clockwise) ++wrong[draft.cell_entity[at(cell)]];
  std::vector<std::string> tags;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (wrong[k] > 0 && wrong[k] == all[k]) tags.push_back(fmt::format("{}", raw.entities[k].tag));
  if (tags.empty()) return "cells counter-clockwise, all in one sense";
  return fmt::format(
      "cells in one sense; those of {} surface(s) are all clockwise: ReverseMesh Surface{{{}}}; "
      "in the .geo file turns them",
      tags.size(), examples(tags.size(), [&](std::size_t k) { return tags[k]; }));
}

void name_clockwise(const RawMesh& raw, const std::vector<int>& cells, const Draft& draft,
                    Findings& findings) {
  if (cells.empty()) return;
  name_cells("cells are inverted (their corners run clockwise)", "", cells, draft, findings);
  findings.faults.back().allowed = reversed_surfaces(raw, cells, draft);
}

void name_duplicates(const std::vector<std::array<int, 2>>& pairs, const Draft& draft,
                     Findings& findings) {
  if (pairs.empty()) return;
  findings.add(fmt::format("{} cells are there twice: {}", pairs.size(),
                           examples(pairs.size(),
                                    [&](std::size_t k) {
                                      return fmt::format("{} has the corners of element {}",
                                                         draft.cell_text(pairs[k][0]),
                                                         draft.cell_tag[at(pairs[k][1])]);
                                    })),
               "each once: gmsh.model.mesh.removeDuplicateElements, or one surface less");
}

void name_crowded(const std::vector<BadEdge>& edges, const Draft& draft, Findings& findings) {
  if (edges.empty()) return;
  const auto text_of = [&](std::size_t k) {
    const BadEdge& edge = edges[k];
    const auto tag = [&](std::size_t c) {
      return fmt::format("{}", draft.cell_tag[at(edge.cells[c])]);
    };
    const auto node = [&](std::size_t a) { return draft.mesh.coordinates[at(edge.nodes[a])]; };
    return fmt::format("the one at {} of elements {}", draft.place_text(0.5 * (node(0) + node(1))),
                       examples(edge.cells.size(), tag));
  };
  findings.add(fmt::format("{} edges have more than one cell on one side (the mesh overlaps or is "
                           "folded): {}",
                           edges.size(), examples(edges.size(), text_of)),
               "at most one cell on each side of an edge");
}

/// Two coincident nodes are correct where two bodies or the sides of a cut touch, and wrong where
/// the parts should be connected. A node inside a body must never coincide with another.
void name_coincident(const Draft& draft, const EdgeTable& table, Findings& findings) {
  const std::vector<char> on_boundary = boundary_flags(table, draft.mesh.n_nodes());
  std::vector<std::array<int, 2>> touching, inside;
  for (const auto& pair : coincident_nodes(draft.mesh)) {
    const auto outer = [&](std::size_t k) { return on_boundary[at(pair[k])] != 0; };
    (outer(0) && outer(1) ? touching : inside).push_back(pair);
  }
  const auto list = [&](const std::vector<std::array<int, 2>>& pairs) {
    return examples(pairs.size(), [&](std::size_t k) {
      return fmt::format("node {} and {}", draft.node_tag[at(pairs[k][1])],
                         draft.node_text(pairs[k][0]));
    });
  };
  constexpr const char* cure =
      "Coherence Mesh; in the .geo file (gmsh.model.mesh.removeDuplicateNodes) makes one of two";
  if (!inside.empty())
    findings.add(fmt::format("{} nodes inside the mesh lie where another node is: {}",
                             inside.size(), list(inside)),
                 cure);
  if (!touching.empty())
    findings.warnings.push_back(
        fmt::format("{} nodes of the boundary lie where another node is: {}. Nothing joins the "
                    "cells there; where they should be one body: {}",
                    touching.size(), list(touching), cure));
}

}  // namespace

void check_types(const RawMesh& raw, const TagIndex& index, Findings& findings) {
  for (std::size_t t = 0; t < raw.types.size(); ++t) {
    const RawType& type = raw.types[t];
    if (std::ranges::find(readable, type.type) != readable.end()) continue;
    std::size_t count = 0;
    const RawBlock* first = nullptr;
    for (const RawBlock& block : raw.blocks) {
      if (block.type != t || block.tags.empty()) continue;
      if (first == nullptr) first = &block;
      count += block.tags.size();
    }
    if (first == nullptr) continue;
    const std::string found =
        fmt::format("{} elements of type \"{}\" (number {}), the first: element {}{}", count,
                    type.name, type.type, first->tags.front(), first_place(raw, index, *first));
    if (type.dimension == 3)
      findings.add("volume elements cannot be used: " + found,
                   "a plane mesh: gmsh -2, and no physical volume");
    else if (type.order > 1)
      findings.add("elements of higher order cannot be used: " + found,
                   "first order: Mesh.ElementOrder = 1; in the .geo file, or gmsh -order 1");
    else
      findings.add("elements of this type cannot be used: " + found,
                   "triangles, quadrilaterals, lines and points of first order");
  }
}

void check_shapes(const RawMesh& raw, Draft& draft, Findings& findings) {
  BadCells bad = check_cells(draft.mesh);
  if (!draft.mesh.cells.empty() && bad.clockwise.size() == draft.mesh.cells.size()) {
    for (Cell& cell : draft.mesh.cells) cell = reversed(cell);
    findings.warnings.emplace_back(
        "the corners of all cells run clockwise in the file: taken the other way round");
    bad = check_cells(draft.mesh);
  }
  name_cells("cells have one node at two corners", "three or four different nodes", bad.repeated,
             draft, findings);
  name_cells("cells have no area", "cells with an area", bad.flat, draft, findings);
  name_clockwise(raw, bad.clockwise, draft, findings);
  name_cells("cells are not convex (a corner of 180 degrees or more, or crossed edges)",
             "every corner below 180 degrees", bad.concave, draft, findings);
}

void check_joints(const Draft& draft, const EdgeTable& table, Findings& findings) {
  const auto duplicates = duplicate_cells(draft.mesh);
  name_duplicates(duplicates, draft, findings);
  if (duplicates.empty()) name_crowded(crowded_edges(table), draft, findings);
  name_coincident(draft, table, findings);
}

}  // namespace rondo::mesh
