// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/elements/subdomains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "rondo/analysis/elements/parts.hpp"

namespace rondo::study {
namespace {

constexpr const char* fine_key = "solver.hati.fine";
/// The matrix that joins the parts is dense.
constexpr std::size_t most_interface_nodes = 2000;

void check_interface(const Case& c, const dynamics::Subdomains& parts) {
  if (parts.interface.empty())
    throw case_error(c, fine_key, "these elements share no free node with other elements",
                     "a part of a body, beside the rest of it");
  if (parts.interface.size() > most_interface_nodes)
    throw case_error(
        c, fine_key,
        fmt::format("the parts meet at {} nodes, too many for the matrix that joins them",
                    parts.interface.size()),
        fmt::format("at most {} nodes", most_interface_nodes));
}

/// The effect of the multiplier in a coarse step must not reach a contact in it: 12.3.
void check_contacts(const Case& c, const Setup& s, const dynamics::Subdomains& parts) {
  if (!s.model.contact) return;
  const std::vector<int> distance = distance_to_interface(parts);
  for (const int node : s.model.contact->nodes) {
    const auto k = static_cast<std::size_t>(node);
    const std::string place =
        fmt::format("node {} at ({:.6g}, {:.6g}) m, which may touch the ground,", node,
                    s.mesh.coordinates[k].x, s.mesh.coordinates[k].y);
    if (parts.fine.mass[k] == 0.0)
      throw case_error(c, fine_key, place + " belongs to no fine element",
                       "all elements along the contact boundary, and those below them");
    if (distance[k] >= 0 && distance[k] < parts.ratio)
      throw case_error(
          c, "solver.hati.ratio",
          fmt::format(
              "{} is {} elements away from those that are not fine: in the {} fine steps of "
              "a coarse one it would feel how the parts are joined",
              place, distance[k], parts.ratio),
          fmt::format("at most {}, or at least {} fine elements below the contact boundary",
                      std::max(distance[k], 1), parts.ratio));
  }
}

/// Mean dilatations at nodes reach from one part into the other.
void check_dilatation(const Case& c, const Setup& s, const std::vector<int>& interface) {
  const fem::NodalDilatation dilatation(s.mesh, s.materials);
  for (std::size_t e = 0; e < s.mesh.cells.size(); ++e)
    if (dilatation.holds(e) && std::ranges::any_of(s.mesh.cells[e], [&](int node) {
          return std::ranges::binary_search(interface, node);
        }))
      throw case_error(
          c, fine_key,
          fmt::format("cell {}, where the parts meet, is a triangle by \"b-bar\", whose "
                      "dilatation is a mean that reaches into the other part",
                      e),
          "quadrilaterals there, or material.integration = \"full\"");
}

}  // namespace

void add_subdomains(const Case& c, Setup& s) {
  if (!c.hati) return;
  const std::vector<char> is_fine = chosen_cells(c, s, c.hati->fine, fine_key);
  if (std::ranges::find(is_fine, 0) == is_fine.end())
    throw case_error(c, fine_key, "chooses all elements: none is left for coarse steps",
                     "a part of the body, or time.scheme = \"symplectic\"");
  dynamics::Subdomains parts =
      dynamics::make_subdomains(s.mesh, s.materials, s.prestress, is_fine, c.hati->ratio);
  check_interface(c, parts);
  check_dilatation(c, s, parts.interface);
  check_contacts(c, s, parts);
  s.implicit_cells.resize(is_fine.size());
  std::ranges::transform(is_fine, s.implicit_cells.begin(), [](char fine) { return !fine; });
  s.model.subdomains = std::move(parts);
}

dynamics::CriticalStep fine_part_step(const Setup& s, dynamics::LaggedDamping damping) {
  const dynamics::Subdomain& fine = s.model.subdomains->fine;
  std::vector<char> is_fine(s.implicit_cells.size());
  std::ranges::transform(s.implicit_cells, is_fine.begin(), [](char coarse) { return !coarse; });
  const mesh::Mesh mesh = mesh_of_cells(s.mesh, is_fine);
  return dynamics::critical_step(fine.stiffness, fine.mass, fine.free, damping,
                                 fem::element_eigenvalue_bound(mesh, s.materials, s.prestress),
                                 s.model.threads);
}

}  // namespace rondo::study
