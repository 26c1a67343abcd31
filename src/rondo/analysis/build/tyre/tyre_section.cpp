// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/tyre/tyre_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rondo/analysis/build/tyre/curves.hpp"
#include "rondo/case/case_keys.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

using fem::finite::Cords;
using fem::finite::SweptSection;

double area_of(const mesh::Mesh& section, std::size_t cell) {
  const mesh::Cell& q = section.cells[cell];
  const auto x = [&](std::size_t i) { return section.coordinates[at(q[i])]; };
  return 0.5 * std::abs(cross(x(2) - x(0), x(3) - x(1)));
}

/// Cells with both nodes of an edge.
std::vector<std::size_t> cells_beside(const mesh::Mesh& section, const mesh::Edge& edge) {
  std::vector<std::size_t> found;
  for (std::size_t e = 0; e < section.cells.size(); ++e) {
    const mesh::Cell& cell = section.cells[e];
    if (std::ranges::find(cell, edge[0]) != cell.end() &&
        std::ranges::find(cell, edge[1]) != cell.end())
      found.push_back(e);
  }
  return found;
}

/// (lines) Mass of a metre of cord less that of the rubber of mean density in its place.
std::vector<double> excess_mass(const CordsCase& cords, const mesh::Mesh& section,
                                const SweptSection& swept, const std::vector<mesh::Edge>& lines) {
  if (cords.excess_mass) return std::vector<double>(lines.size(), *cords.excess_mass);
  if (!cords.density) return {};
  std::vector<double> excess;
  for (const mesh::Edge& line : lines) {
    const std::vector<std::size_t> beside = cells_beside(section, line);
    RONDO_DEMAND(!beside.empty(), line[0], line[1]);
    double rubber = 0.0;
    for (const std::size_t e : beside)
      rubber += swept.densities[at(swept.quads[e].rubber)] / static_cast<double>(beside.size());
    excess.push_back(*cords.area * (*cords.density - rubber));
  }
  return excess;
}

/// Refuses cords that take more room than there is in the elements on both sides.
void refuse_thick(const Case& c, const mesh::Mesh& section, const std::string& table,
                  const CordsCase& cords, const std::vector<mesh::Edge>& lines) {
  if (!cords.area) return;
  for (const mesh::Edge& line : lines) {
    double room = 0.0;
    for (const std::size_t e : cells_beside(section, line)) room += area_of(section, e);
    const Vec2 a = section.coordinates[at(line[0])], b = section.coordinates[at(line[1])];
    const double thick = *cords.area / cords.spacing, height = room / norm(b - a);
    if (thick > height)
      throw case_error(c, table + ".area",
                       fmt::format("the cords fill a layer of {:.4g} m, and the elements on both "
                                   "sides of the curve are {:.4g} m high together at {}",
                                   thick, height, place_text(section, line[0])),
                       "a smaller area or a larger spacing");
  }
}

/// Refuses cords of a drum that would not reach a node of their curve.
void refuse_short(const Case& c, const mesh::Mesh& section, const std::string& table,
                  const Cords& cords) {
  if (!cords.lift) return;
  for (const auto& line : cords.lines)
    for (const int node : line) {
      const double r = section.coordinates[at(node)].x;
      if (const double cosine = cords.lift->cosine(cords.angle, r); cosine < 1.0) continue;
      throw case_error(c, table + ".green_radius",
                       fmt::format("lifted from the drum, cords at {:.4g} rad would lie around the "
                                   "wheel before they reach {}",
                                   cords.angle, place_text(section, node)),
                       "a larger angle, drum or green_extension");
    }
}

template <class Edges>
bool all_held(const mesh::Mesh& section, const Edges& edges) {
  const std::vector<char> held = mesh::clamped_flags(section);
  return std::ranges::all_of(
      edges, [&](const auto& edge) { return held[at(edge[0])] && held[at(edge[1])]; });
}

Cords cords_of(const Case& c, const mesh::Mesh& section, const SweptSection& swept, std::size_t k) {
  const CordsCase& given = c.cords[k];
  const std::string table = item_of("cords", k);
  Cords cords;
  cords.name = given.curve;
  cords.law = {given.stiffness ? *given.stiffness : *given.youngs_modulus * *given.area,
               given.prestrain, given.compression};
  cords.angle = given.angle;
  cords.spacing = given.spacing;
  cords.spacing_radius = given.spacing_radius;
  if (given.green_radius) cords.lift = {*given.green_radius, given.green_extension};
  cords.lines = directed_curve(c, section, table + ".curve", given.curve);
  if (all_held(section, cords.lines))
    throw case_error(c, table + ".curve", "every node of the curve is held: its cords do nothing",
                     "a curve inside the wheel");
  refuse_short(c, section, table, cords);
  refuse_thick(c, section, table, given, cords.lines);
  cords.excess_mass = excess_mass(given, section, swept, cords.lines);
  return cords;
}

void add_liner(const Case& c, const mesh::Mesh& section, SweptSection& swept) {
  constexpr const char* key = "inflation.curve";
  if (c.inflation->curve.empty()) return;
  swept.liner = section_curve(c, section, key, c.inflation->curve);
  const std::vector<char> held = mesh::clamped_flags(section);
  for (const int end : ends_of(swept.liner)) {
    if (held[at(end)]) continue;
    throw case_error(c, key,
                     fmt::format("the curve ends at {}, which is not held: the air would leak "
                                 "there, and its force would be wrong",
                                 place_text(section, end)),
                     "a curve from bead to bead, its ends on section.clamped");
  }
  if (all_held(section, swept.liner))
    throw case_error(c, key, "every node of the curve is held: a pressure there has no effect",
                     "the wall of the cavity; of a generated disk none is inside");
}

}  // namespace

SweptSection tyre_section(const Case& c, const mesh::Mesh& section,
                          const std::vector<fem::Material>& materials) {
  RONDO_DEMAND(c.inflation && section.coordinates.size() == section.n_nodes(), section.n_nodes());
  SweptSection swept;
  swept.n_sectors = c.section ? c.section->sectors : c.disk.circumferential;
  swept.place = section.coordinates;
  for (const fem::Material& m : materials) {
    swept.rubbers.push_back(m.rubber.value());
    swept.densities.push_back(m.density);
  }
  for (std::size_t e = 0; e < section.cells.size(); ++e)
    swept.quads.push_back({section.cells[e], section.region.empty() ? 0 : section.region[e]});
  const std::vector<char> held = mesh::clamped_flags(section);
  for (const char is_held : held) swept.held.insert(swept.held.end(), 3, is_held);
  add_liner(c, section, swept);
  for (std::size_t k = 0; k < c.cords.size(); ++k)
    swept.cords.push_back(cords_of(c, section, swept, k));
  return swept;
}

statics::InflationLoads inflation_loads(const Case& c, const mesh::Mesh& section) {
  const InflationCase& air = c.inflation.value();
  const double spin = spin_at_rest(c);
  statics::InflationLoads loads{{air.pressure, spin * spin}, {}, air.steps};
  if (!air.mounting.empty()) loads.mounting.resize(section.n_nodes());
  const std::vector<char> held = mesh::clamped_flags(section);
  for (std::size_t k = 0; k < air.mounting.size(); ++k) {
    const std::string key = item_of("inflation.mounting", k) + ".curve";
    for (const auto& edge : section_curve(c, section, key, air.mounting[k].curve))
      for (const int node : edge) {
        if (!held[at(node)])
          throw case_error(c, key,
                           fmt::format("\"{}\" is not held: the rim moves what is bonded to it",
                                       air.mounting[k].curve),
                           "a curve of section.clamped");
        const Vec3 way{air.mounting[k].radial, 0.0, air.mounting[k].axial};
        Vec3& given = loads.mounting[at(node)];
        if (given != Vec3{} && given != way)
          throw case_error(c, key, "shares a node with another curve that goes elsewhere",
                           "curves that do not meet, or ways that are the same");
        given = way;
      }
  }
  return loads;
}

}  // namespace rondo::study
