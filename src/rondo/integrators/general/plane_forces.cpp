// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/general/plane_forces.hpp"

#include "rondo/core/contract.hpp"
#include "rondo/model/pressure.hpp"

namespace rondo::dynamics {

PlaneForces::PlaneForces(const Model& model, const State& start)
    : model_(model),
      internal_(make_internal_force(model, start.u, start.poses)),
      gradient_(internal_->gradient()),
      damping_(model.stiffness_damping > 0.0 ? model.n_nodes() : 0),
      load_(model.pressures.empty() ? 0 : model.n_nodes()) {}

double PlaneForces::evaluate(std::span<const Vec2> u, std::span<const Vec2> v,
                             const FrameStep& frame) noexcept {
  RONDO_ASSERT(u.size() == model_.n_nodes() && v.size() == u.size(), u.size(), v.size());
  internal_->evaluate(u);
  gradient_ = internal_->gradient();
  const double energy = internal_->half_step_energy(u, v);  // damping() overwrites what it needs
  if (!damping_.empty()) internal_->damping(damping_);
  if (!load_.empty()) pressure_forces(model_, u, frame.time, load_);
  return energy;
}

}  // namespace rondo::dynamics
