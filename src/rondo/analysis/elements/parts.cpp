// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/elements/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "rondo/case/case_keys.hpp"
#include "rondo/core/index.hpp"
#include "rondo/mesh/physical_group.hpp"

namespace rondo::study {
namespace {

void demand_layers(const Case& c, const std::string& table, const std::vector<int>& layers,
                   int there) {
  if (layers.back() <= there) return;
  throw case_error(c, table + ".layers", fmt::format("the disk has no layer {}", layers.back()),
                   fmt::format("1, at the rim, to {}", there));
}

void choose_region(const Case& c, const mesh::Mesh& mesh, const ElementChoice& choice,
                   const std::string& table, std::vector<char>& chosen) {
  const auto& names = mesh.region_names;
  const auto found = std::find(names.begin(), names.end(), choice.region);
  if (found == names.end())
    throw case_error(c, table + ".region",
                     "no cell of the mesh is in a physical surface of this name",
                     fmt::format("{}{}{}", fmt::join(names, ", "), names.empty() ? "" : "; or ",
                                 mesh::physical_group_line("Surface", choice.region)));
  const auto place = static_cast<int>(found - names.begin());
  for (std::size_t e = 0; e < chosen.size(); ++e) chosen[e] = mesh.region[e] == place ? 1 : 0;
}

void choose_layers(const Case& c, const mesh::Mesh& mesh, Vec2 center, const ElementChoice& choice,
                   const std::string& table, std::vector<char>& chosen) {
  const Parts layers = layers_of(mesh, center);
  demand_layers(c, table, choice.layers, static_cast<int>(layers.names.size()));
  for (std::size_t e = 0; e < chosen.size(); ++e)
    chosen[e] = std::ranges::binary_search(choice.layers, layers.of_cell[e] + 1) ? 1 : 0;
}

/// Elements that differ by round-off alone are chosen together.
void choose_in_all_sectors(const mesh::Mesh& mesh, std::vector<char>& chosen) {
  const auto place = [&](std::size_t e) {
    mesh::Cell nodes = mesh.cells[e];
    for (int& node : nodes) node = node < 0 ? -1 : mesh.sector_node[at(node)];
    std::ranges::sort(nodes);
    return nodes;
  };
  std::set<mesh::Cell> places;
  for (std::size_t e = 0; e < chosen.size(); ++e)
    if (chosen[e]) places.insert(place(e));
  for (std::size_t e = 0; e < chosen.size(); ++e) chosen[e] = places.contains(place(e)) ? 1 : 0;
}

/// An element alone has the critical step of its largest frequency, 3.8 with the damping.
void choose_slow(const Case& c, const Setup& s, double slower_than, std::vector<char>& chosen) {
  const std::vector<double> values =
      fem::element_eigenvalues(s.mesh, s.materials, s.prestress, false);
  for (std::size_t e = 0; e < chosen.size(); ++e) {
    const double omega = std::sqrt(std::max(values[e], 0.0));
    chosen[e] =
        omega > 0.0 && dynamics::critical_step_of(omega, {c.damping.stiffness, 0.0}) < slower_than
            ? 1
            : 0;
  }
  if (s.mesh.n_sectors > 0) choose_in_all_sectors(s.mesh, chosen);
}

}  // namespace

Parts layers_of(const mesh::Mesh& mesh, Vec2 center) {
  std::vector<double> radii;
  for (const Vec2 x : mesh.coordinates) radii.push_back(norm(x - center));
  std::sort(radii.begin(), radii.end());
  const double same = 1e-9 * radii.back();
  radii.erase(
      std::unique(radii.begin(), radii.end(), [&](double a, double b) { return b - a < same; }),
      radii.end());
  Parts parts{{}, {}, "layer"};
  for (std::size_t k = 1; k < radii.size(); ++k)
    parts.names.push_back(fmt::format("layer {} of {} from the rim, r = {:.6g} to {:.6g} m", k,
                                      radii.size() - 1, radii[k - 1], radii[k]));
  for (const mesh::Cell& cell : mesh.cells) {
    double inner = radii.back();  // of its corners: the middle of a wide cell is further in
    for (const int node : cell) inner = std::min(inner, norm(mesh.coordinates[at(node)] - center));
    const auto outer = std::upper_bound(radii.begin(), radii.end(), inner + same);
    parts.of_cell.push_back(static_cast<int>(outer - radii.begin()) - 1);
  }
  return parts;
}

Parts parts_of(const Case& c, const Setup& s) {
  if (!c.mesh)
    return layers_of(s.mesh,
                     s.model.free_bodies.empty() ? Vec2{} : s.model.free_bodies.front().center);
  if (s.mesh.region.empty())
    return {std::vector<int>(s.mesh.cells.size(), 0), {"the body"}, "body"};
  Parts parts{s.mesh.region, {}, "surface"};
  for (const std::string& name : s.mesh.region_names)
    parts.names.push_back(name.empty() ? "no physical surface"
                                       : fmt::format("surface \"{}\"", name));
  return parts;
}

std::vector<int> regions_of_layers(const Case& c, int layers, mesh::Mesh& mesh) {
  std::vector<int> of_layer(at(layers), 0);
  mesh.region_names.assign(1, "");
  for (std::size_t k = 0; k < c.regions.size(); ++k) {
    const std::string table = item_of("material.region", k);
    demand_layers(c, table, c.regions[k].layers, layers);
    for (const int layer : c.regions[k].layers) {
      int& region = of_layer[at(layer - 1)];
      if (region != 0)
        throw case_error(c, table + ".layers",
                         fmt::format("layer {} has a material already, that of {}", layer,
                                     item_of("material.region", at(region - 1))),
                         "each layer once");
      region = static_cast<int>(k) + 1;
    }
    mesh.region_names.push_back(fmt::format("layers {}", fmt::join(c.regions[k].layers, ", ")));
  }
  return of_layer;
}

void set_disk_regions(const Case& c, mesh::Mesh& mesh) {
  if (c.regions.empty()) return;
  const Parts layers = layers_of(mesh, {});
  const std::vector<int> of_layer =
      regions_of_layers(c, static_cast<int>(layers.names.size()), mesh);
  for (const int layer : layers.of_cell) mesh.region.push_back(of_layer[at(layer)]);
}

std::vector<char> chosen_cells(const Case& c, const Setup& s, const ElementChoice& choice,
                               const std::string& table) {
  std::vector<char> chosen(s.mesh.cells.size(), 0);
  const Vec2 center = s.model.free_bodies.empty() ? Vec2{} : s.model.free_bodies.front().center;
  if (choice.slower_than)
    choose_slow(c, s, *choice.slower_than, chosen);
  else if (!choice.layers.empty())
    choose_layers(c, s.mesh, center, choice, table, chosen);
  else
    choose_region(c, s.mesh, choice, table, chosen);
  if (std::ranges::find(chosen, 1) != chosen.end()) return chosen;
  throw case_error(c, table, "chooses no element",
                   "a longer slower_than; `rondo check` tells the critical step and what sets it");
}

}  // namespace rondo::study
