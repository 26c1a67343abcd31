// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/elements/massless_boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "rondo/analysis/elements/parts.hpp"
#include "rondo/case/case_keys.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/contact_mass.hpp"
#include "rondo/integrators/massless/ring_matrix.hpp"

namespace rondo::study {
namespace {

constexpr const char* key = "solver.contact_mass";

void refuse_pressed_nodes(const Case& c, const mesh::Mesh& mesh, const dynamics::Model& m) {
  std::vector<char> touches(mesh.n_nodes(), 0);
  for (const int node : mesh.boundary) touches[at(node)] = 1;
  for (std::size_t k = 0; k < m.pressures.size(); ++k)
    for (const mesh::Edge& edge : m.pressures[k].edges)
      if (touches[at(edge[0])] != 0 || touches[at(edge[1])] != 0)
        throw case_error(c, key,
                         fmt::format("the pressure on \"{}\" acts on contact nodes, which without "
                                     "mass take forces of the ground only",
                                     c.pressures[k].curve),
                         "\"lumped\", or a pressure on a curve that has no contact node");
}

InputError no_neighbour(const Case& c, const mesh::Mesh& mesh, int node) {
  const Vec2 x = mesh.coordinates[at(node)];
  return case_error(
      c, key,
      fmt::format("contact node {} at ({:.6g}, {:.6g}) m has no free node beside it that keeps its "
                  "mass: all of its cells' nodes are contact nodes or held",
                  node, x.x, x.y),
      "\"lumped\", or a mesh with two layers of cells behind the contact boundary at least");
}

/// Thickness of the outermost layer at a contact node over that of the next, going straight on from
/// it; 0: there is no next.
double layer_ratio(const mesh::Mesh& mesh, const std::vector<std::vector<int>>& beside,
                   const std::vector<double>& mass, int node) {
  const Vec2 x = mesh.coordinates[at(node)];
  double ratio = 0.0;
  for (const int below : beside[at(node)]) {
    if (mass[at(below)] == 0.0) continue;
    const Vec2 way = mesh.coordinates[at(below)] - x;
    double straightest = 0.7;  // cos of 45 degrees
    for (const int next : beside[at(below)]) {
      const Vec2 on = mesh.coordinates[at(next)] - mesh.coordinates[at(below)];
      const double along = dot(way, on) / (norm(way) * norm(on));
      if (mass[at(next)] == 0.0 || along <= straightest) continue;
      straightest = along;
      ratio = norm(way) / norm(on);
    }
  }
  return ratio;
}

/// (n) Nodes that an edge of a cell joins.
std::vector<std::vector<int>> joined_nodes(const mesh::Mesh& mesh) {
  std::vector<std::vector<int>> beside(mesh.n_nodes());
  for (const mesh::Cell& cell : mesh.cells) {
    const int n = mesh::n_corners(cell);
    for (int a = 0; a < n; ++a)
      for (const int b : {(a + 1) % n, (a + n - 1) % n})
        beside[at(cell[at(a)])].push_back(cell[at(b)]);
  }
  return beside;
}

/// Warns of concave corners if the body comes as low as one of them.
void warn_of_concave_corners(const Case& c, Setup& s) {
  double radius = 0.0, lowest = c.motion.height.at(0.0);
  for (const Vec2 x : s.mesh.coordinates) radius = std::max(radius, norm(x));
  for (const auto& point : c.motion.height.points()) lowest = std::min(lowest, point[1]);
  const std::vector<Vec2>& p = c.ground->shape.profile;
  bool reached = false;
  for (std::size_t i = 1; i + 1 < p.size(); ++i)
    reached |= cross(p[i] - p[i - 1], p[i + 1] - p[i]) > 0.0 && p[i].y >= lowest - radius;
  if (!reached) return;
  s.warnings.push_back(fmt::format(
      "{}: the ground has concave corners: the run ends where one of them holds a contact node by "
      "two facets at once",
      key));
}

void warn_of_thin_layer(Setup& s) {
  constexpr double thin = 0.5 * (1.0 - 1e-9);
  const auto beside = joined_nodes(s.mesh);
  std::vector<double> ratios;
  for (const int node : s.mesh.boundary) {
    const double ratio = layer_ratio(s.mesh, beside, s.model.mass, node);
    if (ratio > 0.0) ratios.push_back(ratio);
  }
  if (ratios.empty()) return;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  if (*middle >= thin) return;
  s.warnings.push_back(fmt::format(
      "{}: the outermost layer of elements is {:.2g} of the next one as thick: below a half it "
      "traps its own wave, which nothing but damping takes away; layers that do not grow thinner "
      "towards the contact boundary",
      key, *middle));
}

}  // namespace

void make_contact_massless(const Case& c, Setup& s) {
  if (c.contact_mass == ContactMass::lumped) return;
  dynamics::Model& m = s.model;
  refuse_pressed_nodes(c, s.mesh, m);
  fem::MovedMass moved = fem::move_contact_mass(s.mesh, m.mass, m.contact->nodes);
  if (moved.without_neighbour >= 0) throw no_neighbour(c, s.mesh, moved.without_neighbour);
  if (c.contact_mass == ContactMass::singular_kept &&
      !fem::keep_moments(s.mesh, m.mass, m.free, moved.mass))
    throw case_error(c, key,
                     "the center and the moment of inertia cannot be kept: the nodes with mass are "
                     "too few, or one of them would have none",
                     "\"singular\", or a finer mesh");
  m.lumped_mass = std::exchange(m.mass, std::move(moved.mass));
  warn_of_thin_layer(s);
  warn_of_concave_corners(c, s);
}

void demand_held_ring(const Case& c, const dynamics::Model& model) {
  if (!has_massless_contact(model)) return;
  const dynamics::RingMatrix ring(model.stiffness, model.contact->nodes);
  if (ring.is_positive_definite()) return;
  throw case_error(c, key,
                   "parts of the contact boundary can move without strain while all other nodes "
                   "stand still: without mass their place is undetermined",
                   "\"lumped\", or a mesh in which each contact node belongs to cells with two "
                   "nodes at least that are no contact nodes");
}

const char* contact_mass_name(const Case& c) noexcept {
  if (c.contact_mass == ContactMass::lumped) return "lumped";
  return c.contact_mass == ContactMass::singular ? "singular" : "singular-kept";
}

std::string told_critical_step(const Setup& s) {
  const std::string told = fmt::format("{:.6g} s", s.critical.step);
  if (!has_massless_contact(s.model) || s.model.implicit) return told;
  return fmt::format("{} ({:.6g} s with mass at the contact nodes)", told, s.critical_plain);
}

}  // namespace rondo::study
