// SPDX-License-Identifier: BSD-3-Clause
/// @file  The steps of any model: bodies that nothing holds, in the fixed frame and in large
/// rotation (docs/theory.md, section 9), contacts that share nodes, contact between bodies,
/// pressures. One readable pass a term, the same scheme as stepper.hpp: what the fast integrators
/// do not do is done here.
#pragma once
#include <vector>

#include "rondo/integrators/body_frames.hpp"
#include "rondo/integrators/general_contact.hpp"
#include "rondo/integrators/integrator.hpp"

namespace rondo::dynamics {

class GeneralIntegrator final : public Integrator {
 public:
  /// @pre the assembled stiffness is there; scheme "symplectic" if a body is free.
  GeneralIntegrator(const Model& model, const State& start);

  void advance(std::span<StepReport> reports, State* last = nullptr) noexcept override;
  void fields(State& state) const noexcept override;
  [[nodiscard]] SavedState save() const override;
  void restore(const SavedState& saved) override;
  [[nodiscard]] std::vector<contact::ProblemFile> take_difficult() override {
    return contact_.take_difficult();
  }

 private:
  StepReport step() noexcept;
  void move(double& kinetic) noexcept;
  [[nodiscard]] double half_step_strain() const noexcept;
  void find_forces() noexcept;
  void add_damping() noexcept;
  void free_velocities(const BodyFrames& frames) noexcept;
  void add_works(const BodyFrames& frames, Works& works) const noexcept;
  void report_frame(StepReport& report) const noexcept;

  const Model& model_;
  State state_;
  Ledger ledger_;
  GeneralContact contact_;
  std::vector<Vec2> elastic_;           ///< (n) e                                        [m]
  std::vector<Vec2> product_, before_;  ///< (n) K e_{n+1}, K e_n                         [N/m]
  std::vector<Vec2> gradient_, gradient_before_;  ///< (n) derivative of the energy      [N/m]
  std::vector<Vec2> damping_;  ///< (n) β of the force, in the nodes' frames; empty: β = 0 [N/m]
  std::vector<Vec2> load_;     ///< (n) of pressures; empty: none                        [N/m]
  std::vector<double> energy_, energy_before_;  ///< (free_bodies) ½ eᵀ K e              [J/m]
};

}  // namespace rondo::dynamics
