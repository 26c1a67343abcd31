// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steps of bodies that nothing holds and of bodies that touch each other, in few passes
/// over memory (docs/theory.md, sections 3, 4.7, 4.8 and 9; docs/performance.md). The same as
/// GeneralIntegrator's to round-off. What is between the passes is over a whole body: its mean
/// rotation, the moment of its forces; and contact, which looks at the boundary alone.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "rondo/core/barrier.hpp"
#include "rondo/core/large_array.hpp"
#include "rondo/core/threads.hpp"
#include "rondo/integrators/bodies/bodies_contact.hpp"
#include "rondo/integrators/bodies/body_loads.hpp"
#include "rondo/integrators/bodies/body_plan.hpp"
#include "rondo/model/integrator.hpp"

namespace rondo::dynamics {

/// The passes of the level that the fused kernels are at.
[[nodiscard]] const kernels::BodyTable& body_table(const kernels::Table& level);

class BodiesIntegrator final : public Integrator, public Resumable {
 public:
  /// @pre the table of steps (model/steps/step_table.hpp) says that it can do the model;
  /// model.stiffness is there. @throws std::bad_alloc
  BodiesIntegrator(const Model& model, const State& start, const kernels::BodyTable& table);

  void advance(std::span<StepReport> reports, State* last = nullptr) noexcept override;
  void fields(State& state) const noexcept override;
  [[nodiscard]] Resumable* resumable() noexcept override { return this; }
  [[nodiscard]] SavedState save() const override;
  void restore(const SavedState& saved) override;
  [[nodiscard]] std::vector<contact::ProblemFile> take_difficult() override;

 private:
  /// A group in the step in hand.
  struct GroupStep {
    kernels::GroupPose pose;
    kernels::GroupTurning turning;
    kernels::StepFactors factors{};
    double inertia = 0.0;  ///< |Z|                                                    [kg m]
  };
  /// Sums of a block.
  struct BlockSums {
    std::array<double, kernels::n_force_sums> force{};
    std::array<double, kernels::n_velocity_sums> velocity{};
    std::array<double, kernels::n_move_sums> move{};
  };
  /// The change that contact makes to the velocity of a row.
  struct Correction {
    int row = 0;
    Vec2 before, after;            ///< v⁻, v⁺                                         [m/s]
    Vec2 gradient, damping, load;  ///< forces on it                                   [N/m]
  };

  // Passes of a step, and what one thread does between them.
  void advance_batch(std::span<StepReport> reports) noexcept;
  void make_steps(std::span<StepReport> reports, Share share) noexcept;
  void begin_step() noexcept;
  void find_pose(const BodyGroup& group, GroupStep& step) noexcept;
  void find_elastic(std::size_t block) noexcept;
  void find_forces(std::size_t block) noexcept;
  void between(StepReport& report) noexcept;
  void find_turning() noexcept;
  [[nodiscard]] double farthest_travel() const noexcept;
  void solve_contacts(StepReport& report) noexcept;
  void find_velocities(std::size_t block) noexcept;
  void correct(const Correction& on, BlockSums& sums) noexcept;
  void move(std::size_t block, const kernels::StepFactors* factors) noexcept;
  void end_step(StepReport& report) noexcept;

  [[nodiscard]] kernels::BodyBlock block_of(std::size_t block, double* sums) noexcept;
  void rest_padding(const RowBlock& block) noexcept;
  [[nodiscard]] double find_strain() noexcept;
  template <class Sums, class Sum>
  [[nodiscard]] double sum_of(const BodyGroup& group, Sums BlockSums::*sums,
                              Sum sum) const noexcept;
  void load(std::span<const Vec2> u, std::span<const Vec2> v) noexcept;
  void begin(const State& start) noexcept;
  void set_pose(const BodyGroup& group, GroupStep& step) noexcept;
  [[nodiscard]] Vec2 displacement_of(int row) const noexcept;
  [[nodiscard]] Correction forces_on(int row) const noexcept;
  [[nodiscard]] Vec2 frame_at(int row) const noexcept;
  [[nodiscard]] Vec2 free_velocity(const Correction& on) const noexcept;
  void report_frame(StepReport& report) const noexcept;
  void save_motion(std::span<Vec2> u, std::span<Vec2> v) const noexcept;

  const Model& model_;
  const kernels::BodyTable& table_;
  BodyPlan plan_;
  const bool beta_;
  const int threads_;
  LargeArray motion_, elastic_, force_;
  kernels::BodyFields fields_{};
  BodyLoads loads_;
  std::optional<BodiesContact> contact_;  ///< absent: nothing to touch
  long long step_;                        ///< number of the last step made
  FrameStep frame_;
  std::vector<GroupStep> groups_;  ///< steps of the plan's groups
  std::vector<BlockSums> sums_;    ///< sums of the plan's blocks
  std::vector<Pose> poses_;        ///< (free_bodies) at t_{n+1}
  std::vector<double>
      energy_;  ///< (free_bodies) of (9.7), what belongs to t_{n+1}: U/2 + Δt v⁺·G/4
  std::vector<Correction> corrections_;  ///< corrections of the step in hand, ascending rows
  double kinetic_ = 0.0;                 ///< Σ m |v|² before u_{n+1}
  Ledger ledger_;
  Barrier barrier_;
};

}  // namespace rondo::dynamics
