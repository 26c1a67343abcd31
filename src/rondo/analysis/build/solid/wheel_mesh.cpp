// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/solid/wheel_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rondo/analysis/build/bodies.hpp"
#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/elements/parts.hpp"
#include "rondo/case/solid/wheel_of.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

/// The cells of a generated section are numbered layer after layer from the rim.
void set_regions(const Case& c, mesh::Mesh& section) {
  if (c.regions.empty()) return;
  const std::size_t across = at(c.wheel.axial), layers = section.cells.size() / across;
  RONDO_DEMAND(layers * across == section.cells.size() && section.region.empty(), across,
               section.cells.size(), section.region.size());
  const std::vector<int> of_layer = regions_of_layers(c, static_cast<int>(layers), section);
  for (std::size_t e = 0; e < section.cells.size(); ++e)
    section.region.push_back(of_layer[e / across]);
}

mesh::Mesh generate_section(const Case& c) {
  mesh::Mesh section = mesh::make_section(wheel_of(c));
  set_regions(c, section);
  return section;
}

mesh::Mesh generate(const Case& c) {
  demand_memory(c, n_generated_nodes(c), mesh_memory(n_generated_nodes(c)));
  const mesh::Mesh section = generate_section(c);
  return mesh::revolve(section, mesh::columns_of(wheel_of(c), section), "tread");
}

InputError section_error(const Case& c, const std::string& message, const std::string& allowed) {
  return case_error(c, "section.file", message, allowed);
}

void refuse_triangles(const Case& c, const mesh::Mesh& section) {
  const auto n = std::ranges::count_if(
      section.cells, [](const mesh::Cell& cell) { return mesh::n_corners(cell) == 3; });
  if (n == 0) return;
  throw section_error(c,
                      fmt::format("{} of {} cells are triangles, and a section is revolved into "
                                  "hexahedra",
                                  n, section.cells.size()),
                      "quadrilaterals alone: \"Recombine Surface {...};\" in Gmsh, or its option "
                      "Mesh.SubdivisionAlgorithm = 1");
}

/// Its x is a radius.
void refuse_axle(const Case& c, const mesh::Mesh& section) {
  const auto inner = std::ranges::min_element(section.coordinates, {}, &Vec2::x);
  if (inner->x > 0.0) return;
  throw section_error(
      c,
      fmt::format("a node is at x = {:.6g}, y = {:.6g} m: x is the distance from the axle",
                  inner->x, inner->y),
      "x > 0 for all nodes: r along x, z, along the axle, along y");
}

void refuse_loose_parts(const Case& c, const mesh::Mesh& section) {
  const mesh::Bodies bodies = mesh::find_bodies(section);
  std::vector<char> held(at(bodies.count), 0);
  for (const int node : section.clamped)
    if (bodies.of_node[at(node)] >= 0) held[at(bodies.of_node[at(node)])] = 1;
  const auto loose = std::ranges::count(held, 0);
  if (loose == 0) return;
  throw case_error(c, "section.clamped",
                   fmt::format("{} of {} parts of the section have no node of this curve: nothing "
                               "holds them",
                               loose, bodies.count),
                   "a section in one piece, its surfaces sharing their lines, or a physical curve "
                   "on each part");
}

mesh::Mesh read_section(const Case& c, std::vector<std::string>* warnings) {
  mesh::Mesh section = read_mesh_file(c, warnings);
  refuse_triangles(c, section);
  refuse_axle(c, section);
  refuse_loose_parts(c, section);
  return section;
}

mesh::Mesh revolve_file(const Case& c, std::vector<std::string>* warnings) {
  const mesh::Mesh section = read_section(c, warnings);
  const std::size_t nodes = section.n_nodes() * at(c.section->sectors);
  if (nodes >= std::size_t{1} << 31)
    throw case_error(c, "section.sectors", fmt::format("the mesh would have {} nodes", nodes),
                     fmt::format("at most {}", (std::size_t{1} << 31) / section.n_nodes()));
  demand_memory(c, nodes, mesh_memory(nodes));
  return mesh::revolve(section, {c.section->sectors, 1, {}}, c.section->mesh.contact);
}

}  // namespace

mesh::Mesh build_wheel(const Case& c, std::vector<std::string>* warnings) {
  RONDO_DEMAND(is_solid(c), c.file.string());
  return c.section ? revolve_file(c, warnings) : generate(c);
}

mesh::Mesh build_section(const Case& c, std::vector<std::string>* warnings) {
  RONDO_DEMAND(is_solid(c), c.file.string());
  return c.section ? read_section(c, warnings) : generate_section(c);
}

}  // namespace rondo::study
