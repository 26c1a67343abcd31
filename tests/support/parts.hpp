// SPDX-License-Identifier: BSD-3-Clause
/// @file  Bodies in two parts with different steps, for the scheme "hati".
#pragma once
#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "rondo/integrators/hati/hati_integrator.hpp"
#include "support/bars.hpp"
#include "support/models.hpp"

namespace rondo::test {

/// Changes the model to the scheme "hati", with a coarse step of dt.
inline void divide(dynamics::Model& model, const mesh::Mesh& mesh, const fem::Material& material,
                   const std::vector<char>& is_fine, int ratio, double dt) {
  model.subdomains = dynamics::make_subdomains(mesh, {&material, 1}, {}, is_fine, ratio);
  model.scheme = dynamics::Scheme::hati;
  model.dt = dt;
}

/// (e) 1: all corners are at least `radius` from the origin.
inline std::vector<char> cells_beyond(const mesh::Mesh& mesh, double radius) {
  std::vector<char> beyond;
  for (const mesh::Cell& cell : mesh.cells)
    beyond.push_back(std::ranges::all_of(cell, [&](int node) {
      return norm(mesh.coordinates[static_cast<std::size_t>(node)]) > radius;
    }));
  return beyond;
}

/// Critical step of the fine part when it is free at the interface.
inline double fine_critical_step(const dynamics::Model& model, const mesh::Mesh& mesh,
                                 const fem::Material& material) {
  const dynamics::Subdomain& fine = model.subdomains->fine;
  return dynamics::critical_step(fine.stiffness, fine.mass, fine.free,
                                 {model.stiffness_damping, 0.0},
                                 fem::element_eigenvalue_bound(mesh, {&material, 1}))
      .step;
}

/// A bar like that of bars.hpp with a tip of finer elements.
struct TippedBar {
  mesh::Mesh mesh;
  fem::Material material;
  std::vector<char> is_tip;  ///< (e)
};
/// @param tip its length, divided into `elements`; the rest has elements of bar.element()   [m]
inline TippedBar tipped_bar(const Bar& bar, double tip, int elements) {
  TippedBar b{{}, {bar.youngs_modulus, 0.0, bar.density, bar.plane}, {}};
  const auto row = [&](double y) {
    for (const double x : {0.0, bar.width()}) b.mesh.coordinates.push_back({x, bar.gap + y});
  };
  const int rest = static_cast<int>(std::lround((bar.length - tip) / bar.element()));
  for (int j = 0; j <= elements; ++j) row(tip * j / elements);
  for (int j = 1; j <= rest; ++j) row(tip + (bar.length - tip) * j / rest);
  for (int j = 0; j < elements + rest; ++j) {
    b.mesh.cells.push_back({2 * j, 2 * j + 1, 2 * j + 3, 2 * j + 2});
    b.is_tip.push_back(j < elements ? 1 : 0);
  }
  b.mesh.boundary = {0, 1};
  b.mesh.tributary.assign(2, 0.5 * bar.width());
  b.mesh.contact_edges = {{0, 1}};
  return b;
}

/// The bar above flat ground, without friction. It is free and nothing rotates: it moves like one
/// that is clamped in a frame at rest.
inline dynamics::Model tipped_model(const TippedBar& b, int ratio, double dt) {
  dynamics::Model model = body_model(b.mesh, b.material, 0.0, 0.0, 1.0);
  model.free_bodies.clear();
  model.free_body.clear();
  add_ground(model, b.mesh, {}, {});
  divide(model, b.mesh, b.material, b.is_tip, ratio, dt);
  return model;
}

}  // namespace rondo::test
