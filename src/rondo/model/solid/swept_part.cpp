// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/solid/swept_part.hpp"

#include <utility>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/fem/solid/solid_sector.hpp"

namespace rondo::dynamics {

fem::finite::SweptForces swept_forces(const Model& model) {
  RONDO_DEMAND(model.solid && model.solid->swept, model.n_nodes());
  std::vector<Vec3> x;
  for (std::size_t k = 0; k < model.n_nodes(); ++k)
    x.emplace_back(model.reference[k], model.solid->axial[k]);
  return {model.solid->swept->faces, std::move(x), model.solid->sector.n_sectors};
}

double stored_energy(const Model& model, std::span<const Vec3> u) {
  std::vector<Vec3> force(model.n_nodes());
  fem::apply(model.solid->linear(), u, force);
  double linear = 0.0;
  for_free_nodes(model, [&](std::size_t k) { linear += 0.5 * dot(u[k], force[k]); });
  return linear + swept_forces(model).add_to(u, force);
}

}  // namespace rondo::dynamics
