// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/base/strain_watch.hpp"

#include <fmt/format.h>

#include <cmath>

#include "rondo/fem/solid/solid_strain.hpp"
#include "rondo/mesh/locate.hpp"
#include "rondo/model/corotated.hpp"

namespace rondo::study {
namespace {

struct Strained {
  const fem::LargestDeformation& largest;
  std::vector<double> strain_place, jacobian_place;
};
constexpr JsonMember<Strained> strain_rows[] = {
    {"strain_max", "number", "",
     "Largest |principal strain| of the small-strain law, at the centers of the elements, in the "
     "frame of the body. Evaluated every 250 steps, at snapshots at least 100 steps apart (with "
     "--reduced every 25 steps and at all snapshots), at the start and at the end "
     "([theory.md](theory.md), 2.9), and at each increment of a crush. For "
     "[rubber](rubber.md): of the symmetric part of ∂u/∂X",
     [](const Strained& s) -> Json { return s.largest.found.strain; }},
    {"strain_max_cell", "integer", "",
     "Cell of the largest strain, a row of `/mesh/cells` (`/mesh/hexahedra` of a 3D wheel)",
     [](const Strained& s) -> Json { return s.largest.found.strain_cell; }},
    {"strain_max_place", "array of number", "m",
     "Middle of the undeformed cell of the largest strain",
     [](const Strained& s) -> Json { return s.strain_place; }},
    {"strain_max_time", "number", "s",
     "Time of the largest strain; in a crush the fraction of the depth, with tables that of the "
     "increments",
     [](const Strained& s) -> Json { return s.largest.strain_time; }},
    {"jacobian_min", "number", "",
     "Smallest J = det(I + ∂u/∂X) at the corners of the elements, evaluated at the same times; 0 "
     "or less: an element is inverted, at least at a corner",
     [](const Strained& s) -> Json { return s.largest.found.jacobian; }},
    {"jacobian_min_cell", "integer", "", "Cell of the smallest J, as for the strain",
     [](const Strained& s) -> Json { return s.largest.found.jacobian_cell; }},
    {"jacobian_min_place", "array of number", "m",
     "Middle of the undeformed cell of the smallest J",
     [](const Strained& s) -> Json { return s.jacobian_place; }},
    {"jacobian_min_time", "number", "s", "Time of the smallest J, as for the strain",
     [](const Strained& s) -> Json { return s.largest.jacobian_time; }},
};

}  // namespace

std::vector<MemberText> strain_members() {
  return texts_of(strain_rows);
}

bool is_look(const Looks& looks, long long step, bool snapshot, long long before) noexcept {
  if (step % looks.steps == 0) return true;
  const long long every = looks.snapshots;
  return snapshot && (before < 0 || step / every != before / every);
}

StrainWatch::StrainWatch(const mesh::Mesh& mesh, std::span<const fem::Material> materials,
                         const dynamics::Model* model)
    : mesh_(mesh), model_(model && !model->free_bodies.empty() ? model : nullptr) {
  if (model_) elastic_.resize(mesh.n_nodes());
  if (!fem::has_rubber(materials)) return;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
    rubber_.push_back(fem::material_of(mesh, materials, e).rubber ? 1 : 0);
}

/// In the plane or in space.
std::vector<double> StrainWatch::middle_of(std::size_t cell) const {
  if (!mesh_.is_solid()) {
    const Vec2 at = mesh::middle_of(mesh_.coordinates, mesh_.cells[cell]);
    return {at.x, at.y};
  }
  std::vector<double> at(3, 0.0);
  for (const int node : mesh_.hexahedra[cell]) {
    const auto k = static_cast<std::size_t>(node);
    at[0] += 0.125 * mesh_.coordinates[k].x;
    at[1] += 0.125 * mesh_.coordinates[k].y;
    at[2] += 0.125 * mesh_.axial[k];
  }
  return at;
}

std::string StrainWatch::cell_text(std::size_t cell) const {
  if (mesh_.is_solid()) {
    const std::vector<double> at = middle_of(cell);
    return fmt::format("hexahedron {} of /mesh/hexahedra near ({:.4g}, {:.4g}, {:.4g})", cell,
                       at[0], at[1], at[2]);
  }
  const Vec2 at = mesh::middle_of(mesh_.coordinates, mesh_.cells[cell]);
  return fmt::format("cell {} of /mesh/cells near ({:.4g}, {:.4g})", cell, at.x, at.y);
}

fem::Deformation StrainWatch::deformation(const Field& u, std::span<const dynamics::Pose> poses) {
  if (mesh_.is_solid()) return fem::solid_deformation(mesh_, u);
  if (!model_) return fem::deformation(mesh_, u, rubber_);
  dynamics::elastic_displacements(*model_, u, poses, elastic_);
  return fem::deformation(mesh_, elastic_, rubber_);
}

std::string StrainWatch::look(const Field& u, std::span<const dynamics::Pose> poses, double time) {
  const fem::Deformation now = deformation(u, poses);
  largest_.add(now, time);
  if (now.jacobian > 0.0) return {};
  return fmt::format(
      "{} of the undeformed mesh is inverted: J = {:.3g}, least of its corners. The body "
      "has left what its mesh{}; a smaller load, or a stiffer material",
      cell_text(now.jacobian_cell), now.jacobian,
      rubber_.empty() || !rubber_[now.jacobian_cell] ? " and small strains mean" : " means");
}

std::string StrainWatch::small_strain_warning(const TimeWords& words) const {
  return fmt::format(
      "the largest strain{} is {:.3g} ({}, {}{:.4g}{}): the law of the material is for small "
      "strains: above {:.0f} % results are rough",
      rubber_.empty() ? "" : " of linear elements", largest_.found.linear_strain,
      cell_text(largest_.found.linear_cell), words.before, largest_.linear_time, words.after,
      100.0 * small_strain);
}

void StrainWatch::summarise(const TimeWords& words, Json& j, RunReport& r) const {
  const fem::Deformation& found = largest_.found;
  if (!std::isfinite(found.jacobian)) return;  // the run had no look
  add_members(strain_rows, {largest_, middle_of(found.strain_cell), middle_of(found.jacobian_cell)},
              j);
  r.strain_max = found.strain;
  r.jacobian_min = found.jacobian;
  if (large_ || found.linear_strain <= small_strain) return;
  const std::string warning = small_strain_warning(words);
  j["warnings"].push_back(warning);
  r.warnings.push_back(warning);
}

}  // namespace rondo::study
