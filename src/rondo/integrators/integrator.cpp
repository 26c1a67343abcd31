// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/integrator.hpp"

#include "rondo/core/contract.hpp"
#include "rondo/integrators/bodies/bodies_integrator.hpp"
#include "rondo/integrators/fused/cyclic_integrator.hpp"
#include "rondo/integrators/fused/dispatch.hpp"
#include "rondo/integrators/fused/solid/solid_cyclic_integrator.hpp"
#include "rondo/integrators/fused/sparse_integrator.hpp"
#include "rondo/integrators/general/general_integrator.hpp"
#include "rondo/integrators/general/wheel_integrator.hpp"
#include "rondo/integrators/hati/hati_integrator.hpp"
#include "rondo/integrators/solid/solid_integrator.hpp"
#include "rondo/integrators/solid/solid_wheel_integrator.hpp"
#include "rondo/model/steps/step_table.hpp"

namespace rondo::dynamics {

std::unique_ptr<Integrator> make_integrator(const Model& model, const State& start) {
  RONDO_DEMAND(model.dt > 0.0 && model.threads >= 1, model.dt, model.threads);
  RONDO_DEMAND(start.u.size() == model.n_nodes() && start.v_next.size() == model.n_nodes() &&
                   start.u.components() == model.components(),
               start.u.size(), start.v_next.size(), start.u.components(), model.n_nodes());
  switch (step_of(model)) {
    case StepKind::cyclic:
      return std::make_unique<CyclicIntegrator>(model, start, kernel_table());
    case StepKind::sparse:
      return std::make_unique<SparseIntegrator>(model, start, kernel_table());
    case StepKind::bodies:
      return std::make_unique<BodiesIntegrator>(model, start, body_table(kernel_table()));
    case StepKind::wheel:
      return std::make_unique<WheelIntegrator>(model, start);
    case StepKind::hati:
      return std::make_unique<HatiIntegrator>(model, start);
    case StepKind::solid_cyclic:
      return std::make_unique<SolidCyclicIntegrator>(model, start, kernel_table());
    case StepKind::solid:
      return std::make_unique<SolidIntegrator>(model, start);
    case StepKind::solid_wheel:
      return std::make_unique<SolidWheelIntegrator>(model, start);
    case StepKind::general:
    case StepKind::reduced:  // of no model
    case StepKind::solid_reduced:
      break;
  }
  return std::make_unique<GeneralIntegrator>(model, start);
}

}  // namespace rondo::dynamics
