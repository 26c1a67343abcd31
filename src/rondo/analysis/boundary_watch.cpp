// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/boundary_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rondo/analysis/build/bodies.hpp"
#include "rondo/core/index.hpp"
#include "rondo/mesh/edges.hpp"

namespace rondo::study {
namespace {

/// Share of the smallest element: neighbours of contact nodes go less deep where boundaries bend.
constexpr double depth_share = 0.25;

std::vector<int> unguarded_nodes(const mesh::Mesh& mesh) {
  std::vector<char> guarded = mesh::clamped_flags(mesh);
  for (const int node : mesh.boundary) guarded[at(node)] = 1;
  std::vector<int> nodes;
  for (const mesh::Edge& edge : mesh::boundary_edges(mesh::EdgeTable(mesh)))
    for (const int node : edge)
      if (!guarded[at(node)]) nodes.push_back(node);
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

BoundaryWatch::BoundaryWatch(const Case& c, const Setup& setup) : case_(c), setup_(setup) {
  if (!c.mesh || !setup.model.contact) return;
  nodes_ = unguarded_nodes(setup.mesh);
  if (nodes_.empty()) return;
  depth_ = depth_share * std::ranges::min(element_sizes(setup.mesh));
}

std::string BoundaryWatch::curves_of(int node) const {
  std::string names;
  for (const mesh::Curve& curve : setup_.mesh.curves)
    if (std::ranges::any_of(curve.edges, [&](const mesh::Edge& edge) {
          return edge[0] == node || edge[1] == node;
        }))
      names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", curve.name);
  return names;
}

std::string BoundaryWatch::look(const dynamics::State& state) {
  const contact::Ground* const ground = nodes_.empty() ? nullptr : &setup_.model.contact->ground;
  for (const int node : nodes_) {
    const Vec2 x = position(setup_.model, state, static_cast<std::size_t>(node));
    const double inside = -ground->distance(x);
    if (inside <= depth_) continue;
    nodes_.clear();
    const std::string curves = curves_of(node);
    return fmt::format(
        "t = {:.9g} s: node {} of the boundary, at ({:.6g}, {:.6g}) m, is {:.3g} m deep in the "
        "ground and nothing stops it: mesh.contact = \"{}\" leaves it out, as all of the boundary "
        "that may not touch. mesh.contact should name a physical curve that also has the lines "
        "{} (in Gmsh, a line may be in several physical curves)",
        state.frame.time, node, x.x, x.y, inside, case_.mesh->contact,
        curves.empty() ? "at this node" : "of " + curves);
  }
  return {};
}

}  // namespace rondo::study
