// SPDX-License-Identifier: BSD-3-Clause
/// @file  What both operators share: the steps of a call in batches, which the threads make without
/// coming back in between; the ledger of them.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rondo/core/barrier.hpp"
#include "rondo/core/threads.hpp"
#include "rondo/integrators/fused/corners/held_contact.hpp"
#include "rondo/integrators/fused/rubber/rubber_work.hpp"
#include "rondo/integrators/fused/step_context.hpp"
#include "rondo/integrators/fused/tail/step_tail.hpp"
#include "rondo/integrators/fused/wheel_sums.hpp"
#include "rondo/model/integrator.hpp"

namespace rondo::dynamics {

class BatchIntegrator : public Integrator, public Resumable, protected CandidateFields {
 public:
  void advance(std::span<StepReport> reports, State* last) noexcept final;
  void fields(State& state) const noexcept final;
  [[nodiscard]] Resumable* resumable() noexcept final { return this; }
  [[nodiscard]] SavedState save() const final;
  void restore(const SavedState& saved) final;
  [[nodiscard]] std::vector<contact::ProblemFile> take_difficult() final;

 protected:
  struct Batch {
    std::span<const StepContext> steps;
    PartialStep* parts;    ///< (steps, n_parts_): to be filled, but for those of HeldContact
    long long first;       ///< number of the last step made before
    RubberEnergy* rubber;  ///< (steps) to be filled, where there is rubber
  };

  /// @param n_parts of the body, of which each step has sums
  /// @param n_pieces of work that threads share: no more threads are started
  BatchIntegrator(const Model& model, const State& start, std::size_t n_parts,
                  std::size_t n_pieces);

  /// A thread's share of a batch; all threads are in it at the same time.
  virtual void make_steps(const Batch& batch, Share share) noexcept = 0;
  /// After a step and its tail: what others read of this share's fields.
  virtual void show_changes(Share /*share*/) noexcept {}
  /// On a loaded rim, after make_steps() of one step: a thread's share of u_{n+2}.
  /// @param step number of the last step made before
  virtual void go_on(const kernels::WheelWay& way, long long step, Share share) noexcept = 0;
  enum class Nodes { free, candidates };
  /// u_{n+1} of these nodes and v_{n+1/2} of the free ones, n the last step made.
  virtual void save_displacement(Nodes of, Field& u) const noexcept = 0;
  virtual void save_velocity(Field& v) const noexcept = 0;
  /// u, v and force of the free nodes, as they are held; the force where `saved` has room for it;
  /// u_before with a loaded rim.
  virtual void save_fields(SavedState& saved) const noexcept = 0;
  virtual void restore_fields(const SavedState& saved) noexcept = 0;
  /// Adds the contacts of the last step made; the two of a node one after the other.
  virtual void save_active(std::vector<ActiveContact>& active) const noexcept = 0;

  /// The candidates, and all that is near corners with them, can be held within make_steps() by the
  /// one who makes their steps: corners_within() then tells of whom. Else steps are made one by
  /// one.
  virtual bool hold_within(std::span<const int> candidates) noexcept;
  [[nodiscard]] HeldContact* corners_within() noexcept {
    return within_ ? corners_.get() : nullptr;
  }

  /// In the constructor, where the model has such tails; in the order in which they are worked.
  void add_tail(std::unique_ptr<StepTail> tail);

  /// In the constructor, where forces are nonlinear: their work is kept. @param start as there
  void add_work(const State& start);

  /// In the constructor, where the model has rubber. @param start as of the constructor
  void set_rubber(RubberForces& forces, const State& start);

  /// In make_steps(): until all threads are here.
  void wait_for_others(Share share) noexcept {
    if (share.n_threads > 1) barrier_.wait(static_cast<unsigned>(share.n_threads));
  }

  const Model& model_;
  const std::size_t n_parts_;  ///< the last one is of HeldContact, if there are sharp corners;
                               ///< those before it are of the tails
  long long step_;             ///< number of the last step made

 private:
  void advance_batch(std::span<StepReport> reports) noexcept;
  void set_step(std::size_t i) noexcept;
  void set_pressures(std::size_t i) noexcept;
  void look_for_corners(std::span<StepContext> steps) noexcept;
  template <class Work>
  void in_all_threads(Work&& work) noexcept;
  void make_batch(const Batch& batch, Share share) noexcept;
  void make_alone(const Batch& batch, Share share) noexcept;
  [[nodiscard]] std::size_t part_of_tail(std::size_t tail) const noexcept;
  // On a loaded rim:
  void advance_on_rim(std::span<StepReport> reports) noexcept;
  void expect_steps(std::size_t n) noexcept;
  void make_steps_on_rim(std::span<StepReport> reports, long long first, Share share) noexcept;
  void begin_step(long long before) noexcept;
  [[nodiscard]] bool keeps_force() const noexcept {
    return rim_ || model_.stiffness_damping > 0.0 || (model_.solid && model_.solid->swept);
  }
  void end_step(StepReport& report) noexcept;

  const int threads_;
  const std::size_t n_pressures_;
  std::vector<StepContext> steps_;  ///< steps of a batch
  std::vector<double> pressures_;   ///< (steps of a batch, n_pressures_)                  [Pa]
  std::vector<PartialStep> parts_;  ///< (steps of a batch, n_parts_)
  std::vector<RubberEnergy> rubber_energy_;  ///< (steps of a batch) of rubber alone
  std::optional<RubberWork> rubber_work_;
  RubberForces* rubber_forces_ = nullptr;
  std::unique_ptr<HeldContact> corners_;
  std::optional<SolidRim> rim_;
  std::vector<std::unique_ptr<StepTail>> tails_;
  kernels::WheelWay way_{};  ///< factors of the step in hand, on a loaded rim
  bool within_ = false;      ///< corners are near, and make_steps() takes care of them
  Barrier barrier_;
  Ledger ledger_;
};

/// Threads that the steps of model.stiffness_operator can be shared among: more have no work.
[[nodiscard]] int most_threads(const Model& model) noexcept;

}  // namespace rondo::dynamics
