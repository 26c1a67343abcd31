// SPDX-License-Identifier: BSD-3-Clause
/// Physical curves of a Gmsh file: edges of the mesh, clamped nodes, contact candidates.
#include <algorithm>
#include <optional>

#include "rondo/core/index.hpp"
#include "rondo/mesh/gmsh_draft.hpp"

namespace rondo::mesh {
namespace {

constexpr int line_type = 1;  // Gmsh's number

/// A line element of a curve.
struct CurveLine {
  Edge nodes{-1, -1};  ///< in the mesh; -1: the node is in no cell
  std::uint64_t tag = 0;
  std::uint64_t first = 0, second = 0;  ///< tags of its nodes in the file
};

Edge undirected_edge(const Edge& edge) {
  return {std::ranges::min(edge), std::ranges::max(edge)};
}

/// Line elements of each entity.
std::vector<std::vector<CurveLine>> lines_of_entities(const CurveInput& in, const Draft& draft) {
  const auto node = [&](std::uint64_t tag) {
    const int place = in.index.find(tag);
    return place < 0 ? -1 : draft.node_of[at(place)];
  };
  std::vector<std::vector<CurveLine>> lines(in.raw.entities.size());
  for (const RawBlock& block : in.raw.blocks) {
    if (in.raw.types[block.type].type != line_type) continue;
    for (std::size_t k = 0; k < block.tags.size(); ++k) {
      const std::uint64_t first = block.nodes[2 * k], second = block.nodes[2 * k + 1];
      lines[block.entity].push_back({{node(first), node(second)}, block.tags[k], first, second});
    }
  }
  return lines;
}

/// MSH 2.2 repeats the lines of a curve for each of its groups. If they are not repeated, the file
/// assigns lines to groups, but the Gmsh library does not report the assignment.
void check_groups_of_22(const CurveInput& in, std::vector<std::vector<CurveLine>>& lines,
                        Findings& findings) {
  std::vector<std::string> mixed;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const RawEntity& entity = in.raw.entities[k];
    if (entity.dimension != 1 || entity.groups.size() < 2) continue;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> ends;
    for (const CurveLine& line : lines[k]) ends.push_back(std::minmax(line.first, line.second));
    std::ranges::sort(ends);
    for (auto at = ends.begin(); at != ends.end();) {
      const auto next = std::upper_bound(at, ends.end(), *at);
      if (static_cast<std::size_t>(next - at) != entity.groups.size()) {
        mixed.push_back(fmt::format("curve {}", entity.tag));
        break;
      }
      at = next;
    }
  }
  if (mixed.empty()) return;
  findings.add(fmt::format("lines of different physical curves have the same elementary tag, so "
                           "that Gmsh cannot tell them apart: {}",
                           examples(mixed.size(), [&](std::size_t k) { return mixed[k]; })),
               "another elementary tag (the second tag of a line) in each physical curve, or the "
               "file as MSH 4.1");
}

/// The requirements on the edges of a group.
struct Demand {
  bool named = false;     ///< in the request: every line must be an edge of a cell
  bool boundary = false;  ///< it must have a cell on one side only
};

Demand demand_on(const NamedGroup& group, const CurveInput& in) {
  const auto is = [&](const std::string& name) {
    return !name.empty() && find_group(in.groups, 1, name) == &group;
  };
  Demand demand;
  demand.boundary = is(in.request.contact) || std::ranges::any_of(in.request.curves, is);
  demand.named = demand.boundary || std::ranges::any_of(in.request.clamped, is) ||
                 std::ranges::any_of(in.request.lines, is);
  return demand;
}

struct Sorted {
  std::vector<Edge> edges;
  std::vector<CurveLine> loose;   ///< not an edge of a cell
  std::vector<CurveLine> inside;  ///< with cells on both sides
};

/// Sorts the lines of a group into edges, each once, with the body on its left.
Sorted sort_lines(const NamedGroup& group, const std::vector<std::vector<CurveLine>>& lines,
                  const EdgeTable& table) {
  std::vector<CurveLine> all;
  for (const std::size_t k : group.entities)
    all.insert(all.end(), lines[k].begin(), lines[k].end());
  const auto key = [](const CurveLine& line) {
    return std::pair{std::min(line.first, line.second), std::max(line.first, line.second)};
  };
  std::ranges::stable_sort(all, {}, key);
  all.erase(std::unique(all.begin(), all.end(),
                        [&](const CurveLine& a, const CurveLine& b) { return key(a) == key(b); }),
            all.end());
  Sorted sorted;
  for (const CurveLine& line : all) {
    if (std::ranges::min(line.nodes) < 0 || table.find(line.nodes).empty()) {
      sorted.loose.push_back(line);
      continue;
    }
    const auto cells = table.find(line.nodes);
    const auto [low, high] = undirected_edge(line.nodes);
    if (cells.size() > 1) {
      sorted.inside.push_back(line);
      sorted.edges.push_back(line.nodes);
    } else {
      sorted.edges.push_back(cells.front().rising ? Edge{low, high} : Edge{high, low});
    }
  }
  sorted.edges = in_order(sorted.edges);
  return sorted;
}

std::string line_text(const CurveLine& line, const CurveInput& in) {
  const int place = in.index.find(line.first);
  if (place < 0) return fmt::format("line {}", line.tag);
  const auto k = static_cast<std::size_t>(place);
  return fmt::format("line {} from ({:.6g}, {:.6g})", line.tag, in.raw.places[3 * k],
                     in.raw.places[3 * k + 1]);
}

void name_lines(const NamedGroup& group, const Sorted& sorted, const CurveInput& in,
                Findings& findings) {
  const Demand demand = demand_on(group, in);
  const auto list = [&](const std::vector<CurveLine>& lines) {
    return examples(lines.size(), [&](std::size_t k) { return line_text(lines[k], in); });
  };
  const std::string said =
      fmt::format("{} lines of the physical curve \"{}\" are no edge of a cell: {}",
                  sorted.loose.size(), group.name, list(sorted.loose));
  if (!sorted.loose.empty() && demand.named)
    findings.add(
        said,
        "curves along the edges of cells: a curve inside a surface must be embedded in it, "
        "and a surface that is in no physical surface is not saved where there are "
        "physical groups");
  else if (!sorted.loose.empty())
    findings.warnings.push_back(said + "; they are left out");
  if (!sorted.inside.empty() && demand.boundary)
    findings.add(fmt::format("{} lines of the physical curve \"{}\" are not on the boundary, they "
                             "have cells on both sides: {}",
                             sorted.inside.size(), group.name, list(sorted.inside)),
                 "for contact and pressure, curves of the boundary");
}

/// Nullptr: no such curve is requested.
const Curve* curve_of(const std::string& name, const CurveInput& in, const Mesh& mesh) {
  const NamedGroup* const group = name.empty() ? nullptr : find_group(in.groups, 1, name);
  if (group == nullptr) return nullptr;
  const auto at = std::ranges::find(mesh.curves, group->name, &Curve::name);
  return at == mesh.curves.end() ? nullptr : &*at;
}

void add_candidates(const Curve& curve, Mesh& mesh) {
  const std::vector<char> clamped = clamped_flags(mesh);
  const auto is_clamped = [&](int node) { return clamped[at(node)] != 0; };
  std::vector<int> place(mesh.n_nodes(), -1);
  for (const Edge& edge : curve.edges) {
    const double half = 0.5 * norm(mesh.coordinates[at(edge[1])] - mesh.coordinates[at(edge[0])]);
    for (const int node : edge) {
      if (is_clamped(node)) continue;
      int& own = place[at(node)];
      if (own < 0) {
        own = static_cast<int>(mesh.boundary.size());
        mesh.boundary.push_back(node);
        mesh.tributary.push_back(0.0);
      }
      mesh.tributary[at(own)] += half;
    }
    if (!is_clamped(edge[0]) && !is_clamped(edge[1])) mesh.contact_edges.push_back(edge);
  }
}

/// The nodes of the curve that are clamped.
std::vector<int> clamped_nodes_of(const Curve& curve, const Mesh& mesh) {
  const std::vector<char> clamped = clamped_flags(mesh);
  std::vector<int> nodes;
  for (const Edge& edge : curve.edges)
    for (const int node : edge)
      if (clamped[at(node)]) nodes.push_back(node);
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

void add_curves(const CurveInput& in, Draft& draft, Findings& findings) {
  std::vector<std::vector<CurveLine>> lines = lines_of_entities(in, draft);
  if (in.version_22) check_groups_of_22(in, lines, findings);
  for (const NamedGroup& group : in.groups) {
    if (group.dimension != 1) continue;
    Sorted sorted = sort_lines(group, lines, in.table);
    name_lines(group, sorted, in, findings);
    if (!sorted.edges.empty()) draft.mesh.curves.push_back({group.name, std::move(sorted.edges)});
  }
}

void add_boundary(const CurveInput& in, Draft& draft, Findings& findings) {
  Mesh& mesh = draft.mesh;
  for (const std::string& name : in.request.clamped)
    if (const Curve* const curve = curve_of(name, in, mesh))
      for (const Edge& edge : curve->edges)
        mesh.clamped.insert(mesh.clamped.end(), edge.begin(), edge.end());
  std::ranges::sort(mesh.clamped);
  mesh.clamped.erase(std::unique(mesh.clamped.begin(), mesh.clamped.end()), mesh.clamped.end());
  const Curve* const contact = curve_of(in.request.contact, in, mesh);
  if (contact == nullptr) return;
  add_candidates(*contact, mesh);
  const std::vector<int> held = clamped_nodes_of(*contact, mesh);
  if (held.empty()) return;
  const std::string nodes =
      examples(held.size(), [&](std::size_t k) { return draft.node_text(held[k]); });
  if (mesh.boundary.empty())
    findings.add(fmt::format("all nodes of the contact curve \"{}\" are clamped: {}",
                             in.request.contact, nodes),
                 "a contact curve with free nodes");
  else
    findings.warnings.push_back(
        fmt::format("{} nodes of the contact curve \"{}\" are clamped and are no "
                    "contact nodes: {}",
                    held.size(), in.request.contact, nodes));
}

}  // namespace rondo::mesh
