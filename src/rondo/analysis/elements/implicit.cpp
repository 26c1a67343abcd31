// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/elements/implicit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "rondo/analysis/elements/corner_words.hpp"
#include "rondo/analysis/elements/parts.hpp"
#include "rondo/case/case_keys.hpp"
#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

constexpr const char* first_table = "solver.implicit[0]";

/// An element that is implicit feeds energy to nodes without mass that it touches.
void refuse_massless_nodes(const Case& c, const Setup& s) {
  if (!has_massless_contact(s.model)) return;
  std::vector<char> touches(s.mesh.n_nodes(), 0);
  for (const int node : s.mesh.boundary) touches[at(node)] = 1;
  for (std::size_t e = 0; e < s.implicit_cells.size(); ++e)
    for (int a = 0; s.implicit_cells[e] && a < mesh::n_corners(s.mesh.cells[e]); ++a) {
      const int node = s.mesh.cells[e][at(a)];
      if (touches[at(node)])
        throw case_error(
            c, first_table,
            fmt::format("element {} has contact node {}, which solver.contact_mass leaves without "
                        "mass: together they would create energy",
                        e, node),
            "elements without contact nodes, or solver.contact_mass = \"lumped\"");
    }
}

/// Contacts that would have to know what an impulse on one node does to the others.
void refuse_contacts(const Case& c, const Setup& s, const std::vector<int>& nodes) {
  if (!has_candidates(s.model)) return;
  std::vector<int> boundary = s.mesh.boundary;
  std::ranges::sort(boundary);
  const auto touched = std::ranges::find_if(
      nodes, [&](int node) { return std::ranges::binary_search(boundary, node); });
  if (touched == nodes.end()) return;
  const Vec2 x = s.mesh.coordinates[at(*touched)];
  const std::string where = fmt::format(
      "node {} at ({:.6g}, {:.6g}) m, on an implicit element, may touch", *touched, x.x, x.y);
  if (s.model.surfaces)
    throw case_error(c, first_table, where + " other bodies: only the ground is possible there",
                     "elements away from the contact boundary, or no [contact]");
  if (!has_sharp_corners(s.model)) return;
  const CornerWords words = corner_words(c, s.model);
  throw case_error(c, first_table, where + " " + words.corners,
                   "elements away from the contact boundary, or " + words.instead);
}

/// The effect of an impulse on one of these nodes on all others is kept; round a disk once for all
/// sectors.
void refuse_many_contacts(const Case& c, const Setup& s, const std::vector<int>& nodes) {
  if (!s.model.contact || s.model.stiffness_operator == dynamics::StiffnessOperator::cyclic) return;
  std::vector<int> boundary = s.mesh.boundary;
  std::ranges::sort(boundary);
  const auto n = std::ranges::count_if(
      nodes, [&](int node) { return std::ranges::binary_search(boundary, node); });
  constexpr long most = 5000;  // of which pairs take 0.8 GB
  if (n <= most) return;
  throw case_error(
      c, first_table,
      fmt::format("{} nodes on implicit elements may touch the ground: what each does "
                  "to all others would take {:.2g} GB",
                  n, 3.2e-8 * static_cast<double>(n) * static_cast<double>(n)),
      fmt::format("at most {} of them; or elements away from the contact boundary", most));
}

/// Mean dilatations at nodes reach beyond an element.
void refuse_mean_dilatation(const Case& c, const Setup& s, const std::vector<char>& chosen) {
  const fem::NodalDilatation dilatation(s.mesh, s.materials);
  for (std::size_t e = 0; e < chosen.size(); ++e)
    if (chosen[e] && dilatation.holds(e))
      throw case_error(c, first_table,
                       fmt::format("cell {} is a triangle by \"b-bar\", whose dilatation is a mean "
                                   "that reaches beyond it",
                                   e),
                       "quadrilaterals there, or material.integration = \"full\"");
}

std::vector<char> all_chosen(const Case& c, const Setup& s) {
  std::vector<char> chosen(s.mesh.cells.size(), 0);
  for (std::size_t k = 0; k < c.implicit.size(); ++k) {
    const auto more = chosen_cells(c, s, c.implicit[k], item_of("solver.implicit", k));
    for (std::size_t e = 0; e < chosen.size(); ++e) chosen[e] |= more[e];
  }
  return chosen;
}

/// Free nodes of these cells, ascending.
std::vector<int> free_nodes_of(const mesh::Mesh& mesh, const std::vector<char>& cells) {
  const std::vector<char> clamped = mesh::clamped_flags(mesh);
  std::vector<char> is_of(mesh.n_nodes(), 0);
  for (std::size_t e = 0; e < cells.size(); ++e)
    for (int a = 0; cells[e] && a < mesh::n_corners(mesh.cells[e]); ++a)
      is_of[at(mesh.cells[e][static_cast<std::size_t>(a)])] = 1;
  std::vector<int> nodes;
  for (std::size_t k = 0; k < is_of.size(); ++k)
    if (is_of[k] && !clamped[k]) nodes.push_back(static_cast<int>(k));
  return nodes;
}

}  // namespace

void add_implicit(const Case& c, Setup& s) {
  if (c.implicit.empty()) return;
  s.implicit_cells = all_chosen(c, s);
  refuse_massless_nodes(c, s);
  refuse_mean_dilatation(c, s, s.implicit_cells);
  std::vector<int> nodes = free_nodes_of(s.mesh, s.implicit_cells);
  if (nodes.empty())
    throw case_error(c, first_table, "chooses elements whose nodes are all held", "other elements");
  refuse_contacts(c, s, nodes);
  refuse_many_contacts(c, s, nodes);
  const mesh::Mesh part = mesh_of_cells(s.mesh, s.implicit_cells);
  s.model.implicit.emplace(
      dynamics::ImplicitPart{fem::assemble_stiffness(part, s.materials, s.prestress), nodes});
}

dynamics::CriticalStep explicit_part_step(const Setup& s, dynamics::LaggedDamping damping) {
  const dynamics::Model& m = s.model;
  std::vector<char> others(s.implicit_cells.size());
  std::ranges::transform(s.implicit_cells, others.begin(), [](char chosen) { return !chosen; });
  if (std::ranges::find(others, 1) == others.end())
    return {.step = std::numeric_limits<double>::infinity(), .converged = true};
  const mesh::Mesh part = mesh_of_cells(s.mesh, others);
  // The mass of all is at least that of the part: a bound for its elements holds for them.
  return dynamics::critical_step(
      fem::assemble_stiffness(part, s.materials, s.prestress), m.mass, nodes_with_mass(m), damping,
      fem::element_eigenvalue_bound(part, s.materials, s.prestress) / least_mass_share(m),
      m.threads);
}

}  // namespace rondo::study
