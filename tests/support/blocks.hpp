// SPDX-License-Identifier: BSD-3-Clause
/// @file  Rectangular blocks of quadrilaterals, one or several in a mesh, and models of them.
#pragma once
#include <algorithm>
#include <utility>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/fem/assembly.hpp"
#include "rondo/fem/contact_mass.hpp"
#include "rondo/integrators/integrator.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/mesh/edges.hpp"
#include "rondo/model/stability/critical_step.hpp"

namespace rondo::test {

/// Lower left corner, edges, numbers of cells. Its whole boundary consists of contact candidates.
struct Block {
  Vec2 corner;
  double width = 1.0, height = 1.0;  ///< [m]
  int columns = 1, rows = 1;
  double turned = 0.0;  ///< about the lower left corner, counter-clockwise [rad]
};

/// Adds a block to a mesh: nodes row after row from the lower left corner. Returns its first node.
inline int add_block(mesh::Mesh& mesh, const Block& block) {
  const int first = static_cast<int>(mesh.n_nodes());
  const auto node = [&](int i, int j) { return first + j * (block.columns + 1) + i; };
  const Complex turn = rotation(block.turned);
  for (int j = 0; j <= block.rows; ++j)
    for (int i = 0; i <= block.columns; ++i)
      mesh.coordinates.push_back(block.corner + turn * Vec2{block.width * i / block.columns,
                                                            block.height * j / block.rows});
  for (int j = 0; j < block.rows; ++j)
    for (int i = 0; i < block.columns; ++i)
      mesh.cells.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
  std::vector<int> round;
  for (int i = 0; i < block.columns; ++i) round.push_back(node(i, 0));
  for (int j = 0; j < block.rows; ++j) round.push_back(node(block.columns, j));
  for (int i = block.columns; i > 0; --i) round.push_back(node(i, block.rows));
  for (int j = block.rows; j > 0; --j) round.push_back(node(0, j));
  const auto length = [&](std::size_t a, std::size_t b) {
    return norm(mesh.coordinates[static_cast<std::size_t>(round[b % round.size()])] -
                mesh.coordinates[static_cast<std::size_t>(round[a % round.size()])]);
  };
  for (std::size_t k = 0; k < round.size(); ++k) {
    mesh.boundary.push_back(round[k]);
    mesh.tributary.push_back(0.5 * (length(k, k + 1) + length(k + round.size() - 1, k)));
    mesh.contact_edges.push_back({round[k], round[(k + 1) % round.size()]});
  }
  return first;
}

/// A model of bodies on any mesh, without contact and motion; dt: `safety` × the critical step.
inline dynamics::Model body_model(const mesh::Mesh& mesh, const fem::Material& material,
                                  double alpha, double beta, double safety) {
  const std::span materials(&material, 1);
  dynamics::Model m;
  m.reference = mesh.coordinates;
  m.mass = fem::lumped_mass(mesh, materials);
  m.free = fem::free_nodes(mesh);
  m.stiffness = fem::assemble_stiffness(mesh, materials);
  m.mass_damping = alpha;
  m.stiffness_damping = beta;
  dynamics::find_free_bodies(mesh, m);
  m.dt = safety * dynamics::critical_step(m.stiffness, m.mass, m.free, {beta, 0.0},
                                          fem::element_eigenvalue_bound(mesh, materials))
                      .step;
  return m;
}

inline void add_ground(dynamics::Model& model, const mesh::Mesh& mesh,
                       const contact::GroundShape& shape, contact::Law law) {
  const double spacing = mesh::longest_edge(mesh.coordinates, mesh.contact_edges);
  model.contact.emplace(dynamics::ContactModel{contact::Ground(shape, spacing), law, mesh.boundary,
                                               mesh.tributary, mesh.contact_edges});
}

/// Moves the mass of the ground's candidates to the nodes below (docs/theory.md, 3.10).
/// @pre the model has its ground
inline void make_contact_massless(const mesh::Mesh& mesh, dynamics::Model& model) {
  model.lumped_mass = model.mass;
  model.mass = fem::move_contact_mass(mesh, model.mass, model.contact->nodes).mass;
}

inline void add_surfaces(dynamics::Model& model, const mesh::Mesh& mesh, contact::Law law,
                         bool self = false) {
  model.surfaces.emplace(
      dynamics::SurfaceContact{mesh.boundary, mesh.tributary, mesh.contact_edges, self, law});
}

/// Linear and angular momentum (about the origin) of free bodies; `v` is half a step before u.
struct Momentum {
  Vec2 linear;           ///< [kg m/s /m]
  double angular = 0.0;  ///< [kg m²/s /m]
};
inline Momentum momentum(const dynamics::Model& model, const dynamics::State& state) {
  Momentum sum;
  for (std::size_t k = 0; k < model.n_nodes(); ++k) {
    const Vec2 p = model.mass[k] * state.v.plane()[k];
    sum.linear += p;
    sum.angular += cross(position(model, state, k), p);
  }
  return sum;
}

}  // namespace rondo::test
