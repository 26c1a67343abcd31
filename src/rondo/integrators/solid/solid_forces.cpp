// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/solid_forces.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/fem/solid/solid_sector.hpp"

namespace rondo::dynamics {

SolidForces::SolidForces(const Model& model, const SolidField& u)
    : model_(model), now_(model.n_nodes()), before_(model.n_nodes()) {
  RONDO_DEMAND(model.solid && model.solid->axial.size() == model.n_nodes());
  if (!model.solid->pressures.empty()) load_ = SolidField(model.n_nodes());
  fem::apply(model.solid->sector, u.plane, u.axial, now_.plane, now_.axial);
}

void SolidForces::evaluate(const SolidField& u, double time) noexcept {
  std::swap(now_, before_);
  fem::apply(model_.solid->sector, u.plane, u.axial, now_.plane, now_.axial);
  if (!load_.plane.empty()) solid_pressure_forces(model_, time, load_);
}

void solid_pressure_forces(const Model& model, double time, SolidField& load) noexcept {
  const fem::SolidSector& k = model.solid->sector;
  std::ranges::fill(load.plane, Vec2{});
  std::ranges::fill(load.axial, 0.0);
  for (const SolidPressure& p : model.solid->pressures) {
    const double pressure = p.pressure.at(time);
    for (std::size_t j = 0; j < k.turn.size(); ++j)
      for (std::size_t a = 0; a < k.n_local(); ++a) {
        const std::size_t node = k.node(a, j);
        load.put(node, load.at(node) + pressure * (k.turn[j] * p.force[a]));
      }
  }
}

}  // namespace rondo::dynamics
