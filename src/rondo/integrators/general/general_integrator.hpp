// SPDX-License-Identifier: BSD-3-Clause
/// @file  The CD-Lagrange step (docs/theory.md, section 3) of any model: displacements and forces
/// at t_n, velocities and impulses at t_{n+1/2}. One readable pass a term: the reference that the
/// fused integrators are held to. What they do not do is done here: bodies that nothing holds, in
/// the fixed frame and in large rotation (section 9), contacts that share nodes, contact between
/// bodies, pressures, other schemes. Source: Fekak et al., Comput. Mech. 60 (2017) 1; Adam et al.,
/// CSMA 2017.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "rondo/integrators/general/body_frames.hpp"
#include "rondo/integrators/general/general_contact.hpp"
#include "rondo/integrators/general/plane_forces.hpp"
#include "rondo/integrators/general/readable_step.hpp"
#include "rondo/integrators/implicit/implicit_elements.hpp"
#include "rondo/integrators/massless/ring_contact.hpp"

namespace rondo::dynamics {

class GeneralIntegrator final : public ReadableStep {
 public:
  /// @pre the assembled stiffness is there, no loaded rim; scheme "symplectic" if a body is free.
  GeneralIntegrator(const Model& model, const State& start);

  [[nodiscard]] std::vector<contact::ProblemFile> take_difficult() override;

 private:
  void make_step(StepEnergy& energy, StepReport& report) noexcept override;
  void save_fields(SavedState& saved) const override;
  void restore_fields(const SavedState& saved) override;
  void set_implicit();
  void move(double& kinetic) noexcept;
  void take_poses() noexcept;
  void find_forces(double& strain) noexcept;
  void free_velocities(const BodyFrames& frames) noexcept;
  void correct_implicit(const BodyFrames& frames, StepEnergy& energy, ContactReport& report);
  void add_works(const BodyFrames& frames, Works& works) const noexcept;
  void move_ring(const ContactStep& step) noexcept;
  ContactReport solve_contacts(const BodyFrames& frames, const StepReport& report) noexcept;
  void add_active(std::span<const ActiveContact> more);
  void report_frame(StepReport& report) const noexcept;

  PlaneForces forces_;
  GeneralContact contact_;
  std::optional<MasslessContact> ring_;  ///< instead of contact_, where contact nodes have no mass
  std::unique_ptr<ImplicitElements> implicit_;  ///< null: there are none
  PlaneField implicit_velocity_;                ///< velocities of their nodes           [m/s]
};

}  // namespace rondo::dynamics
