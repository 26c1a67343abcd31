// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/rubber_watch.hpp"

#include <fmt/format.h>

#include <cmath>

#include "rondo/fem/strain.hpp"
#include "rondo/mesh/locate.hpp"

namespace rondo::study {
namespace {

constexpr JsonMember<double> rubber_rows[] = {
    {"integration_relative", "number", "",
     "Only with rubber at finite strain, nonlinear cords or viscous materials: magnitude of "
     "`integration` of "
     "`history.csv` at the last step; a warning above 0.01",
     [](const double& relative) -> Json { return relative; }},
};

}  // namespace

std::vector<MemberText> rubber_members() {
  return texts_of(rubber_rows);
}

std::string inverted_rubber(const mesh::Mesh& mesh, std::span<const Vec2> u, double least) {
  const std::size_t cell = fem::deformation(mesh, u).jacobian_cell;
  const Vec2 at = mesh::middle_of(mesh.coordinates, mesh.cells[cell]);
  return fmt::format(
      "cell {} of /mesh/cells near ({:.4g}, {:.4g}) m of the undeformed mesh is inverted: its "
      "smallest det F is {:.3g}, which no rubber reaches. Reduce the load or apply it more slowly, "
      "refine the mesh where it is strained most, or take a smaller time.safety",
      cell, at.x, at.y, least);
}

void summarise_rubber(const dynamics::MaterialReport& last, double exchanged, Json& j,
                      RunReport& r) {
  const double relative = std::abs(last.relative_integration(exchanged));
  add_members(rubber_rows, relative, j);
  r.notes.push_back(
      fmt::format("integration: work of the internal forces less energy stored and lost, {:.1e} "
                  "of the energy exchanged",
                  relative));
  if (relative <= integration_bound) return;
  const std::string warning = fmt::format(
      "work of the internal forces less energy stored and lost is {:.2g} of the energy exchanged, "
      "above {:.2g}: the steps are too coarse; half the step leaves a quarter of it",
      relative, integration_bound);
  j["warnings"].push_back(warning);
  r.warnings.push_back(warning);
}

}  // namespace rondo::study
