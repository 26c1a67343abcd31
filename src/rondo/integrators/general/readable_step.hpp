// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the readable steps have in common: they make steps one by one, keep the state in the
/// order of the nodes and the ledger, and save both. A readable step computes one term per pass;
/// the fused steps are tested against it.
#pragma once
#include "rondo/model/integrator.hpp"

namespace rondo::dynamics {

class ReadableStep : public Integrator, public Resumable {
 public:
  void advance(std::span<StepReport> reports, State* last = nullptr) noexcept final;
  /// u_{n+1} + Δt v_{n+3/2} of the free nodes, and v_{n+3/2}.
  void fields(State& state) const noexcept override;
  [[nodiscard]] Resumable* resumable() noexcept final { return this; }
  [[nodiscard]] SavedState save() const final;
  void restore(const SavedState& saved) final;

 protected:
  /// The model must outlive it. @pre `start` is of this model
  ReadableStep(const Model& model, const State& start);

  /// Moves `state_` to t_{n+1}, whose number it has already, and fills the frame and the contacts
  /// of the report and the energy of the half step before.
  virtual void make_step(StepEnergy& energy, StepReport& report) noexcept = 0;
  /// Fills those of both fields that are not empty with v_{n+1/2} and v_{n+3/2}.
  virtual void velocities(Field& before, Field& after) const noexcept;
  /// The rest of the state: by default u_{n+1} and v_{n+3/2} are saved.
  virtual void save_fields(SavedState& saved) const;
  virtual void restore_fields(const SavedState& saved);

  const Model& model_;
  State state_;

 private:
  Ledger ledger_;
};

/// Position of a node in the undeformed body, from the center of the wheel [m].
template <class Vec>
Vec reference_of(const Model& model, std::size_t node) noexcept {
  if constexpr (requires(Vec a) { a.z; })
    return {model.reference[node], model.solid->axial[node]};
  else
    return model.reference[node];
}

}  // namespace rondo::dynamics
