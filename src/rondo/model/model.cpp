// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/model.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/stiffness_product.hpp"
#include "rondo/model/solid/wheel_ground.hpp"

namespace rondo::dynamics {

State::State(const Model& model) : u(model.n_nodes(), model.components()), v(u), v_next(u) {
  if (model.contact) active.reserve(2 * model.contact->nodes.size());
  for (const FreeBody& body : model.free_bodies) poses.push_back({body.center});
}

State boundary_state(const Model& model) {
  State state(model);
  state.v = state.v_next = Field();
  return state;
}

void find_free_bodies(const mesh::Mesh& mesh, Model& model) {
  const mesh::Bodies bodies = mesh::find_bodies(mesh);
  std::vector<char> held(static_cast<std::size_t>(bodies.count), 0);
  for (const int node : mesh.clamped) {
    const int body = bodies.of_node[at(node)];
    if (body >= 0) held[at(body)] = 1;
  }
  std::vector<int> place(held.size(), -1);
  model.free_bodies.clear();
  for (std::size_t b = 0; b < held.size(); ++b) {
    if (held[b]) continue;
    place[b] = static_cast<int>(model.free_bodies.size());
    model.free_bodies.emplace_back();
  }
  model.free_body.clear();
  model.body = bodies.of_node;
  if (model.free_bodies.empty()) return;
  model.free_body.assign(mesh.n_nodes(), -1);
  for (std::size_t k = 0; k < mesh.n_nodes(); ++k) {
    const int body = bodies.of_node[k];
    if (body < 0 || held[at(body)]) continue;
    model.free_body[k] = place[at(body)];
    FreeBody& free = model.free_bodies[at(model.free_body[k])];
    free.nodes.push_back(static_cast<int>(k));
    free.mass += model.mass[k];
    free.center += model.mass[k] * model.reference[k];
  }
  for (FreeBody& free : model.free_bodies) free.center = free.center / free.mass;
}

std::vector<int> nodes_with_mass(const Model& model) {
  std::vector<int> nodes = model.free;
  std::erase_if(nodes, [&](int node) { return model.mass[at(node)] == 0.0; });
  return nodes;
}

double least_mass_share(const Model& model) noexcept {
  double least = 1.0;
  for (std::size_t k = 0; k < model.lumped_mass.size(); ++k)
    if (model.mass[k] > 0.0) least = std::min(least, model.mass[k] / model.lumped_mass[k]);
  return least;
}

std::vector<int> places_among(std::span<const int> nodes, std::size_t n) {
  std::vector<int> place(n, -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) place[at(nodes[i])] = static_cast<int>(i);
  return place;
}

bool has_sharp_corners(const Model& model) noexcept {
  if (!model.contact) return false;
  for (std::size_t set = 0; set < profile_count(*model.contact); ++set)
    if (!profile_of(*model.contact, set).corners().empty()) return true;
  return false;
}

void apply_stiffness(const Model& model, std::span<const Vec2> u, std::span<Vec2> out) {
  if (!model.stiffness.row_start.empty()) return fem::apply(model.stiffness, u, out, model.threads);
  RONDO_DEMAND(model.sector.has_value());
  fem::apply(*model.sector, u, out);
}

}  // namespace rondo::dynamics
