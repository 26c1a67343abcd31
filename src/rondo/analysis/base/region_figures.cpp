// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/base/region_figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rondo/fem/region_sizes.hpp"

namespace rondo::study {
namespace {

RegionFigures whole_of(std::span<const RegionFigures> regions) {
  RegionFigures whole;
  for (const RegionFigures& region : regions) {
    whole.elements += region.elements;
    whole.size += region.size;
    whole.mass += region.mass;
  }
  return whole;
}

std::string text_of(const RegionFigures& region, bool solid) {
  return fmt::format("{:.6g} {}, {} {:.6g} {}, {} elements", region.mass, solid ? "kg" : "kg/m",
                     solid ? "volume" : "area", region.size, solid ? "m3" : "m2", region.elements);
}

struct Sized {
  RegionFigures figures;
  bool solid;
};
constexpr JsonMember<Sized> whole_rows[] = {
    {"mass", "number", "kg/m",
     "Mass of the body; with [inflation] of its rubber, in the inflated shape",
     [](const Sized& s) -> Json { return s.figures.mass; }},
    {"area", "number", "m2", "Area of the undeformed body; not of a 3D wheel",
     [](const Sized& s) { return s.solid ? absent() : Json(s.figures.size); }},
    {"volume", "number", "m3", "Volume of an undeformed 3D wheel",
     [](const Sized& s) { return s.solid ? Json(s.figures.size) : absent(); }},
};
constexpr JsonMember<Sized> region_rows[] = {
    {"name", "string", "", "Name of the region; \"\": cells in none",
     [](const Sized& s) -> Json { return s.figures.name; }},
    {"elements", "integer", "", "Number of its elements",
     [](const Sized& s) -> Json { return s.figures.elements; }},
    {"area", "number", "m2", "Its undeformed area; not of a 3D wheel", whole_rows[1].value},
    {"volume", "number", "m3", "Its undeformed volume, of a 3D wheel", whole_rows[2].value},
    {"mass", "number", "kg/m", "Its mass", whole_rows[0].value},
};

constexpr JsonMember<std::vector<Sized>> list_rows[] = {
    {"regions", "array", "", "Mass and size of each physical surface or region of the case",
     [](const std::vector<Sized>& all) { return objects_of(region_rows, all); },
     [] { return texts_of(region_rows); }},
};

}  // namespace

std::vector<RegionFigures> region_figures(const mesh::Mesh& mesh,
                                          std::span<const fem::Material> materials) {
  const std::vector<double> sizes = fem::region_sizes(mesh, materials.size());
  std::vector<RegionFigures> regions(materials.size());
  for (std::size_t k = 0; k < regions.size(); ++k) {
    if (k < mesh.region_names.size()) regions[k].name = mesh.region_names[k];
    regions[k].elements =
        mesh.region.empty()
            ? mesh.n_elements()
            : static_cast<std::size_t>(std::ranges::count(mesh.region, static_cast<int>(k)));
    regions[k].size = sizes[k];
    regions[k].mass = materials[k].density * sizes[k];
  }
  return regions;
}

std::vector<Told> region_lines(const mesh::Mesh& mesh, std::span<const fem::Material> materials) {
  constexpr std::size_t most = 20;
  const std::vector<RegionFigures> regions = region_figures(mesh, materials);
  const bool solid = mesh.is_solid();
  std::vector<Told> lines{{"mass", text_of(whole_of(regions), solid)}};
  if (regions.size() == 1) return lines;
  for (std::size_t k = 0; k < std::min(most, regions.size()); ++k) {
    if (regions[k].elements == 0) continue;
    lines.emplace_back(
        regions[k].name.empty() ? "  of no region" : fmt::format("  of \"{}\"", regions[k].name),
        text_of(regions[k], solid));
  }
  if (regions.size() > most)
    lines.emplace_back("  of others", fmt::format("{} more regions", regions.size() - most));
  return lines;
}

void describe_regions(const mesh::Mesh& mesh, std::span<const fem::Material> materials,
                      Json& json) {
  const std::vector<RegionFigures> regions = region_figures(mesh, materials);
  std::vector<Sized> all;
  for (const RegionFigures& region : regions) all.push_back({region, mesh.is_solid()});
  add_members(whole_rows, {whole_of(regions), mesh.is_solid()}, json);
  add_members(list_rows, all, json);
}

std::vector<MemberText> region_members() {
  return joined({texts_of(whole_rows), texts_of(list_rows)});
}

}  // namespace rondo::study
