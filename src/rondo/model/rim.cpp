// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/rim.hpp"

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {

void DrivenRim::restore(long long step, std::span<const double> saved) {
  RONDO_DEMAND(step >= 0 && saved.empty(), step, saved.size());
  step_ = step;
}

std::unique_ptr<Rim> make_rim(const Model& model) {
  return std::make_unique<DrivenRim>(model.motion, model.dt);
}

}  // namespace rondo::dynamics
