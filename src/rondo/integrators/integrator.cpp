// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/integrator.hpp"

#include "rondo/integrators/bodies/bodies_integrator.hpp"
#include "rondo/integrators/fused/cyclic_integrator.hpp"
#include "rondo/integrators/fused/dispatch.hpp"
#include "rondo/integrators/fused/solid/solid_cyclic_integrator.hpp"
#include "rondo/integrators/fused/sparse_integrator.hpp"
#include "rondo/integrators/general/general_integrator.hpp"
#include "rondo/integrators/general/wheel_integrator.hpp"
#include "rondo/integrators/hati/hati_integrator.hpp"
#include "rondo/integrators/solid/solid_wheel_integrator.hpp"

namespace rondo::dynamics {

std::unique_ptr<Integrator> make_integrator(const Model& model, const State& start) {
  if (model.solid && model.rim) return std::make_unique<SolidWheelIntegrator>(model, start);
  if (model.solid) return std::make_unique<SolidCyclicIntegrator>(model, start, kernel_table());
  if (model.subdomains) return std::make_unique<HatiIntegrator>(model, start);
  if (model.rim && is_general(model)) return std::make_unique<WheelIntegrator>(model, start);
  if (is_of_bodies(model))
    return std::make_unique<BodiesIntegrator>(model, start, body_table(kernel_table()));
  if (is_general(model)) return std::make_unique<GeneralIntegrator>(model, start);
  if (model.stiffness_operator == StiffnessOperator::cyclic)
    return std::make_unique<CyclicIntegrator>(model, start, kernel_table());
  return std::make_unique<SparseIntegrator>(model, start, kernel_table());
}

}  // namespace rondo::dynamics
