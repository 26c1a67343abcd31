// SPDX-License-Identifier: BSD-3-Clause
/// @file  Upright bars, one element wide, above the ground y = 0: one-dimensional because ν = 0.
#pragma once
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "support/blocks.hpp"
#include "support/stepping.hpp"

namespace rondo::test {

struct Bar {
  double youngs_modulus = 900.0, density = 1.0;  ///< [Pa], [kg/m³]
  double length = 10.0;                          ///< [m]
  double gap = 5.0;                              ///< below it                         [m]
  int elements = 100;                            ///< over its length
  double courant = 0.9;                          ///< c Δt/h
  fem::Plane plane = fem::Plane::stress;         ///< the same at ν = 0
  bool held = false;                             ///< whether its upper end is clamped
  bool massless = false;                         ///< whether its foot is massless
  bool in_frame = false;  ///< as if clamped, it moves in the co-rotating frame, which is at rest

  [[nodiscard]] double wave_speed() const { return std::sqrt(youngs_modulus / density); }
  [[nodiscard]] double element() const { return length / elements; }
  [[nodiscard]] double step() const { return courant * element() / wave_speed(); }
  /// Ten element lengths. From one length on, the fastest mode is the one that alternates along the
  /// bar, with frequency 2c/h. The wider the bar, the slower are the modes across it, which
  /// round-off would excite at a Courant number of 1.
  [[nodiscard]] double width() const { return 10.0 * element(); }
  [[nodiscard]] double mass() const { return density * length * width(); }  ///< [kg/m]
};

inline mesh::Mesh bar_mesh(const Bar& bar) {
  mesh::Mesh mesh;
  add_block(mesh, {.corner = {0.0, bar.gap},
                   .width = bar.width(),
                   .height = bar.length,
                   .columns = 1,
                   .rows = bar.elements});
  const int n = static_cast<int>(mesh.n_nodes());
  if (bar.held) mesh.clamped = {n - 2, n - 1};
  // Only the foot may touch the ground.
  mesh.boundary = {0, 1};
  mesh.tributary.assign(2, 0.5 * bar.width());
  mesh.contact_edges = {{0, 1}};
  return mesh;
}

/// The bar above flat ground, without friction and restitution.
inline dynamics::Model bar_model(const Bar& bar) {
  const mesh::Mesh mesh = bar_mesh(bar);
  const fem::Material material{bar.youngs_modulus, 0.0, bar.density, bar.plane};
  dynamics::Model model = body_model(mesh, material, 0.0, 0.0, 1.0);
  model.dt = bar.step();
  add_ground(model, mesh, {}, {});
  if (!bar.massless && !bar.in_frame) return model;
  model.free_bodies.clear();
  model.free_body.clear();
  if (bar.massless) make_contact_massless(mesh, model);
  return model;
}

/// The response of a bar over time, per unit area of its foot.
struct BarCourse {
  std::vector<double> time;      ///< t_{n+1}                                          [s]
  std::vector<double> pressure;  ///< r_n/Δt of the step at t_{n+1}                    [Pa]
  std::vector<double> energy;    ///< kinetic + strain, at t_{n+1/2}                   [J/m²]
  std::vector<double> lost;      ///< in impacts before t_{n+1/2}                      [J/m²]
  double relative = 0.0;         ///< largest residual of the ledger / exchanged energy
};

inline BarCourse course_of(const Bar& bar, Stepping& run, double end) {
  BarCourse course;
  run.advance_to(end, [&](const dynamics::StepReport& step) {
    course.time.push_back(step.frame.time);
    course.pressure.push_back(step.contact.impulse.y / bar.step() / bar.width());
    course.energy.push_back((step.balance.kinetic + step.balance.strain) / bar.width());
    course.lost.push_back(step.balance.works.loss_impact / bar.width());
  });
  course.relative = run.balance().relative;
  return course;
}

/// A period of contact: its first and its last step.
struct Phase {
  std::size_t first = 0, last = 0;
};
/// Steps with pressure above `least` [Pa]; those
/// less than `apart` [s] apart belong to one phase.
inline std::vector<Phase> phases(const BarCourse& course, double apart, double least = 0.0) {
  std::vector<Phase> found;
  for (std::size_t i = 0; i < course.time.size(); ++i) {
    if (course.pressure[i] <= least) continue;
    if (found.empty() || course.time[i] - course.time[found.back().last] > apart)
      found.push_back({i, i});
    found.back().last = i;
  }
  return found;
}

/// Time by which a wave front may be early or late on this mesh: short waves are slower and spread
/// the front over h^{2/3} L^{1/3} after a distance L [s].
inline double front_spread(const Bar& bar) {
  return std::cbrt(bar.element() * bar.element() * bar.length) / bar.wave_speed();
}

/// The rod of V4 over some periods, with steps near the critical one.
struct EnergyGrowth {
  double energy = 0.0;    ///< largest, relative to that at the start
  double left = 0.0;      ///< at the end, relative to that at the start
  double relative = 0.0;  ///< residual of the ledger
};

/// @param share fraction of the critical step, which damping reduces (docs/theory.md, 3.8)
/// @param damping ratio of the highest wave, β ω_max/2 with ω_max = 2c/h
inline EnergyGrowth energy_growth(int elements, double share, double damping, contact::Law law = {},
                                  int periods = 200) {
  const Bar bar{.youngs_modulus = 1.0,
                .density = 1.0,
                .length = 1.0,
                .gap = -1e-9,
                .elements = elements,
                .courant = share * (std::hypot(1.0, damping) - damping),
                .held = true};
  dynamics::Model model = bar_model(bar);
  model.contact->law = law;
  model.stiffness_damping = damping * bar.element() / bar.wave_speed();
  std::vector<Vec2> u(model.n_nodes());
  for (std::size_t k = 0; k < u.size(); ++k) u[k].y = 0.5 * (1.0 - model.reference[k].y);
  Stepping run(model, start(model, u, std::vector<Vec2>(u.size())));
  const BarCourse course = course_of(bar, run, 3.0 * periods);
  const double most = *std::max_element(course.energy.begin(), course.energy.end());
  return {most / course.energy.front(), course.energy.back() / course.energy.front(),
          course.relative};
}

}  // namespace rondo::test
