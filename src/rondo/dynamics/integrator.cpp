// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/dynamics/integrator.hpp"

#include <utility>

#include "rondo/dynamics/cyclic_integrator.hpp"
#include "rondo/dynamics/dispatch.hpp"
#include "rondo/dynamics/stepper.hpp"

namespace rondo::dynamics {
namespace {

class ReferenceIntegrator : public Integrator {
 public:
  ReferenceIntegrator(const Model& model, State start) : model_(model), state_(std::move(start)) {
    if (model.contact) state_.active.reserve(2 * model.contact->nodes.size());  // a copy has none
  }

  void advance(std::span<StepReport> reports, State* last) noexcept override {
    for (StepReport& report : reports) {
      report.contact = dynamics::advance(model_, state_, ledger_);
      report.step = state_.step;
      report.frame = state_.frame;
      report.balance = ledger_.last();
    }
    if (last) *last = state_;
  }

  void fields(State& state) const noexcept override {
    state.u = state_.u;
    state.v_next = state_.v_next;
  }

 private:
  const Model& model_;
  State state_;
  Ledger ledger_;
};

}  // namespace

std::unique_ptr<Integrator> make_integrator(const Model& model, const State& start) {
  if (model.stiffness_operator == StiffnessOperator::cyclic)
    return std::make_unique<CyclicIntegrator>(model, start, kernel_table());
  return std::make_unique<ReferenceIntegrator>(model, start);
}

}  // namespace rondo::dynamics
