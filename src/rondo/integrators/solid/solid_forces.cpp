// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/solid_forces.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/fem/solid/solid_sector.hpp"

namespace rondo::dynamics {

SolidForces::SolidForces(const Model& model, const State& start)
    : model_(model), now_(model.n_nodes()), before_(model.n_nodes()) {
  RONDO_DEMAND(model.solid && model.solid->axial.size() == model.n_nodes());
  if (!model.solid->pressures.empty()) load_.resize(model.n_nodes());
  rest_ = rest_forces(model);
  fem::apply(model.solid->sector, start.u, now_);
}

double SolidForces::evaluate(std::span<const Vec3> u, std::span<const Vec3> /*v*/,
                             double time) noexcept {
  RONDO_ASSERT(u.size() == now_.size(), u.size(), now_.size());
  std::swap(now_, before_);
  fem::apply(model_.solid->sector, u, now_);
  if (!load_.empty()) solid_pressure_forces(model_, time, load_);
  moment_ = rest_moment(rest_, u);
  double energy = 0.0;
  for_free_nodes(model_, [&](std::size_t k) { energy += 0.5 * dot(u[k], before_[k]); });
  return energy;
}

std::vector<Vec3> rest_forces(const Model& model) {
  const fem::SolidSector& k = model.solid->sector;
  std::vector<Vec3> all;
  for (const SolidPressure& p : model.solid->pressures) {
    if (!p.of_rest) continue;
    all.resize(model.n_nodes());
    for (std::size_t j = 0; j < k.turn.size(); ++j)
      for (std::size_t a = 0; a < k.n_local(); ++a) all[k.node(a, j)] += k.turn[j] * p.force[a];
  }
  return all;
}

/// They are along x, so that x itself adds nothing.
double rest_moment(std::span<const Vec3> rest, std::span<const Vec3> u) noexcept {
  double moment = 0.0;
  RONDO_ASSERT(rest.empty() || rest.size() == u.size(), rest.size(), u.size());
  for (std::size_t k = 0; k < rest.size(); ++k) moment -= cross(u[k].plane(), rest[k].plane());
  return moment;
}

void solid_pressure_forces(const Model& model, double time, std::span<Vec3> load) noexcept {
  const fem::SolidSector& k = model.solid->sector;
  std::ranges::fill(load, Vec3{});
  RONDO_ASSERT(load.size() == model.n_nodes(), load.size(), model.n_nodes());
  for (const SolidPressure& p : model.solid->pressures) {
    RONDO_ASSERT(p.force.size() == k.n_local(), p.force.size(), k.n_local());
    const double pressure = p.pressure.at(time);
    for (std::size_t j = 0; j < k.turn.size(); ++j)
      for (std::size_t a = 0; a < k.n_local(); ++a)
        load[k.node(a, j)] += pressure * (k.turn[j] * p.force[a]);
  }
}

}  // namespace rondo::dynamics
