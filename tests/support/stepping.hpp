// SPDX-License-Identifier: BSD-3-Clause
/// @file  The steps of a test, one or many at a time, by either operator, as in a run.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rondo/integrators/integrator.hpp"
#include "support/models.hpp"

namespace rondo::dynamics {

/// Prints the operator in the names of tests.
inline void PrintTo(StiffnessOperator of, std::ostream* out) {
  *out << (of == StiffnessOperator::cyclic ? "cyclic" : "sparse");
}

}  // namespace rondo::dynamics

namespace rondo::test {

inline constexpr std::array both_operators{dynamics::StiffnessOperator::cyclic,
                                           dynamics::StiffnessOperator::sparse};

inline std::string name(dynamics::StiffnessOperator of) {
  return testing::PrintToString(of);
}
/// variant_operator, used in the names of tests.
inline std::string name(const char* variant, dynamics::StiffnessOperator of) {
  return fmt::format("{}_{}", variant, name(of));
}

/// The model with the stiffness that the operator needs, and without that of the other.
inline dynamics::Model model_with(const Built& b, dynamics::StiffnessOperator of) {
  dynamics::Model model = b.model;
  model.stiffness_operator = of;
  if (of == dynamics::StiffnessOperator::sparse) return model;
  model.sector = fem::assemble_sector(b.mesh, b.materials, b.prestress);
  if (!has_massless_contact(model)) model.stiffness = {};
  return model;
}

/// Keeps the model on which its integrator works.
class Stepping {
 public:
  Stepping(dynamics::Model model, dynamics::State start)
      : model_(std::move(model)),
        state_(std::move(start)),
        integrator_(dynamics::make_integrator(model_, state_)) {}
  /// Starts from rest.
  Stepping(const Built& b, dynamics::StiffnessOperator of)
      : Stepping(b, of, std::vector<Vec2>(b.model.n_nodes()),
                 std::vector<Vec2>(b.model.n_nodes())) {}
  Stepping(const Built& b, dynamics::StiffnessOperator of, std::vector<Vec2> u0,
           std::vector<Vec2> v0)
      : Stepping(model_with(b, of), std::move(u0), std::move(v0)) {}
  Stepping(const Stepping&) = delete;
  Stepping& operator=(const Stepping&) = delete;

  /// Makes one step.
  const dynamics::ContactReport& advance() {
    advance(1);
    return report().contact;
  }
  /// Makes n steps in batches of 64; the state is that of the last.
  void advance(long long n) {
    advance(n, [](const dynamics::StepReport&) {});
  }
  /// The same; calls look(report) for every step.
  template <class Look>
  void advance(long long n, Look&& look) {
    while (n > 0) {
      const long long count = std::min(n, static_cast<long long>(reports_.size()));
      n -= count;
      const std::span batch = std::span(reports_).first(static_cast<std::size_t>(count));
      integrator_->advance(batch, n == 0 ? &state_ : nullptr);
      for (const dynamics::StepReport& report : batch) look(report);
      last_ = batch.back();
    }
  }
  /// Advances to the first step at or after `time` [s].
  template <class Look>
  void advance_to(double time, Look&& look) {
    advance(std::llround(std::ceil(time / model_.dt)) - last_.step, look);
  }
  void advance_to(double time) {
    advance_to(time, [](const dynamics::StepReport&) {});
  }

  /// State after the last step; `force` is not updated.
  [[nodiscard]] const dynamics::State& state() const { return state_; }
  [[nodiscard]] const dynamics::StepReport& report() const { return last_; }
  [[nodiscard]] const dynamics::Balance& balance() const { return last_.balance; }
  [[nodiscard]] const dynamics::Integrator& integrator() const { return *integrator_; }
  [[nodiscard]] const dynamics::Model& model() const { return model_; }

 private:
  Stepping(dynamics::Model&& model, std::vector<Vec2> u0, std::vector<Vec2> v0)
      : model_(std::move(model)),
        state_(dynamics::start(model_, std::move(u0), std::move(v0))),
        integrator_(dynamics::make_integrator(model_, state_)) {}

  dynamics::Model model_;
  dynamics::State state_;
  std::unique_ptr<dynamics::Integrator> integrator_;
  std::vector<dynamics::StepReport> reports_ = std::vector<dynamics::StepReport>(64);
  dynamics::StepReport last_;
};

}  // namespace rondo::test
