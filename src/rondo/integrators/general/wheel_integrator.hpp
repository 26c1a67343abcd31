// SPDX-License-Identifier: BSD-3-Clause
/// @file  The step of a body on a loaded rim (docs/theory.md, section 10): central differences of
/// absolute positions, so that momenta are kept, and contact that is not coupled to the rim. One
/// readable pass a term: the reference that the fused steps are held to.
#pragma once
#include <memory>
#include <vector>

#include "rondo/integrators/general/general_contact.hpp"
#include "rondo/model/integrator.hpp"
#include "rondo/model/internal_force.hpp"
#include "rondo/model/loaded_rim.hpp"

namespace rondo::dynamics {

class WheelIntegrator final : public Integrator, public Resumable {
 public:
  /// @pre model.rim and the assembled stiffness are there, no free body; scheme "symplectic".
  WheelIntegrator(const Model& model, const State& start);

  void advance(std::span<StepReport> reports, State* last = nullptr) noexcept override;
  void fields(State& state) const noexcept override;
  [[nodiscard]] Resumable* resumable() noexcept override { return this; }
  [[nodiscard]] SavedState save() const override;
  void restore(const SavedState& saved) override;
  [[nodiscard]] std::vector<contact::ProblemFile> take_difficult() override {
    return contact_.coupled().difficult.take();
  }

 private:
  /// Forces on the nodes in the co-rotating frame, n each [N/m]: the gradient is of the material.
  struct Forces {
    std::vector<Vec2> damping;  ///< β times the rate of the gradient; empty: β = 0
    std::vector<Vec2> load;     ///< forces of pressures; empty: none
    std::vector<Vec2> all;      ///< q: gradient, damping, and α m v⁻
  };
  StepReport step() noexcept;
  void move(StepEnergy& energy) noexcept;
  [[nodiscard]] RimForce find_forces(double& strain) noexcept;
  ContactReport push(Vec2 gravity) noexcept;
  void find_next() noexcept;
  void add_works(Vec2 gravity, Works& works) const noexcept;
  void relative_after(std::span<Vec2> velocity) const noexcept;
  void relative_before(std::span<Vec2> velocity) const noexcept;

  const Model& model_;
  LoadedRim rim_;
  State state_;          ///< u_{n+1}; v and v_next are absolute velocities in the axes of R_{n+1}
  Field before_, next_;  ///< (n) u_n, u_{n+2}                                     [m]
  std::vector<Vec2> absolute_;  ///< (n) V of the half step after, fixed frame            [m/s]
  Ledger ledger_;
  const std::unique_ptr<InternalForce> internal_;
  GeneralContact contact_;
  Forces forces_;
  RimForce rim_load_;  ///< force of the pressures on clamped nodes
};

}  // namespace rondo::dynamics
