// SPDX-License-Identifier: BSD-3-Clause
/// @file  What one thread does around each step of a fused integrator, beside the pass over memory:
/// velocities that hang together over many nodes. Steps are then made one by one.
#pragma once
#include <vector>

#include "rondo/contact/coupled/problem_file.hpp"
#include "rondo/integrators/fused/step_context.hpp"
#include "rondo/model/saved_state.hpp"

namespace rondo::dynamics {

class StepTail {
 public:
  virtual ~StepTail() = default;
  StepTail() = default;
  StepTail(const StepTail&) = delete;
  StepTail& operator=(const StepTail&) = delete;

  /// Keeps the values that the pass will overwrite.
  virtual void before() noexcept = 0;
  /// Puts right what the pass has made. @param part of the step, to be filled
  virtual void after(const StepContext& step, PartialStep& part) noexcept = 0;
  /// (nb) candidates whose contacts are solved here; null: none.
  [[nodiscard]] virtual const char* held() const noexcept { return nullptr; }

  /// Adds the contacts of the last step.
  virtual void save_active(std::vector<ActiveContact>& active) const = 0;
  /// The values that go from step to step: save() adds them to `saved`, restore() takes them.
  virtual void save(SavedState& saved) const = 0;
  virtual void restore(const SavedState& saved) = 0;
  /// See Integrator::take_difficult().
  [[nodiscard]] virtual std::vector<contact::ProblemFile> take_difficult() { return {}; }
};

}  // namespace rondo::dynamics
