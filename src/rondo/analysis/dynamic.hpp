// SPDX-License-Identifier: BSD-3-Clause
/// @file  Motion in time: explicit steps from the start, or from a checkpoint, to time.end.
#pragma once
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rondo/analysis/base/analysis.hpp"
#include "rondo/analysis/base/between_nodes.hpp"
#include "rondo/analysis/base/stepwise.hpp"
#include "rondo/analysis/base/strain_watch.hpp"
#include "rondo/analysis/boundary_watch.hpp"
#include "rondo/analysis/build/rim.hpp"
#include "rondo/analysis/friction_watch.hpp"
#include "rondo/analysis/out_of_range.hpp"
#include "rondo/analysis/rubber_step.hpp"
#include "rondo/case/setup.hpp"
#include "rondo/integrators/integrator.hpp"
#include "rondo/output/contact_statistics.hpp"
#include "rondo/output/history.hpp"
#include "rondo/output/snapshot_schedule.hpp"

namespace rondo::study {

class DynamicAnalysis : public Analysis, public Resumable, public Stepwise {
 public:
  /// @throws InputError as build()
  DynamicAnalysis(const Case& c, const RunOptions& options);

  [[nodiscard]] CheckReport check(double trial) override;
  [[nodiscard]] RecordPlan record_plan() const override;
  [[nodiscard]] std::vector<std::string> warnings() const override;
  void describe(Json& json) const override;
  [[nodiscard]] Case kept_case(const Case& c) const override;
  [[nodiscard]] Resumable* resumable() noexcept override { return this; }
  [[nodiscard]] Stepwise* stepwise() noexcept override { return this; }

  Progress begin(Recorder& recorder) override;
  Progress advance(Recorder& recorder) override;
  [[nodiscard]] const std::optional<std::string>& trouble() const override { return trouble_; }
  [[nodiscard]] std::vector<double> last_row() override;
  void close() override;
  void summarise(Json& json, RunReport& report) const override;

  [[nodiscard]] const Checkpoint* find(const std::filesystem::path& directory) override;
  [[nodiscard]] Checkpoint save() const override;

  void pause_at(long long step) override;
  [[nodiscard]] long long steps_made() const noexcept override { return steps_; }
  [[nodiscard]] const Setup& setup() const noexcept override { return setup_; }
  [[nodiscard]] const dynamics::State* state() override;
  [[nodiscard]] std::vector<double> row() const override;
  [[nodiscard]] std::vector<ColumnLabel> row_columns() const override;
  void take_tables() override;

 protected:
  /// The model must outlive it. @param start at t = 0; what is not needed of it may be freed
  [[nodiscard]] virtual std::unique_ptr<dynamics::Integrator> make_integrator(
      dynamics::State& start);
  [[nodiscard]] Setup& own_setup() noexcept { return setup_; }
  /// The law sees velocities alone. Gaps in it push bodies out of the ground, which does work.
  [[nodiscard]] virtual bool guards_impacts() const noexcept { return true; }
  /// Largest relative residual of the law of contact.
  [[nodiscard]] virtual double contact_bound() const noexcept { return residual_bound; }
  /// What to try where it is larger, after "; "; empty: nothing.
  [[nodiscard]] virtual std::string_view contact_cure() const noexcept { return {}; }
  /// Which step it makes, in words.
  [[nodiscard]] virtual std::string told_integrator() const;
  /// While it runs, or at its end.
  void warn(std::string warning);
  /// Plans the snapshots by the step: at the start, and again when the step was chosen anew.
  void plan_snapshots();

 private:
  /// Contacts have the velocities that go with their impulses.
  [[nodiscard]] bool knows_slip() const noexcept;
  [[nodiscard]] long long next_snapshot() const noexcept;
  void start_integrator();
  void add_depth_between_nodes(dynamics::StepReport& step);
  void take(const dynamics::StepReport& step, const dynamics::State* state, Recorder& recorder);
  void judge(const dynamics::StepReport& step);
  [[nodiscard]] Looks looks() const noexcept;
  [[nodiscard]] bool is_looked_at() const noexcept;
  void look();
  [[nodiscard]] std::string look_at_rim(const dynamics::StepReport& step);
  void warn_of_no_contact();
  void warn_of_left_corners();
  void warn_of_impacts(const dynamics::StepReport& step);
  void record_state(Recorder& recorder);
  void record_snapshot(Recorder& recorder);
  void keep_difficult_contacts();
  void warn_of_faster_spin();
  [[nodiscard]] double seconds_per_step(double trial);

  const Case& case_;
  const RunOptions& options_;
  Setup setup_;
  SnapshotSchedule schedule_;
  std::size_t next_ = 0;            ///< snapshot of the schedule
  std::optional<Checkpoint> from_;  ///< gone on with; its fields are freed once taken
  std::optional<History> history_;
  long long pause_ = std::numeric_limits<long long>::max();
  std::optional<History> since_pause_;  ///< none: nobody pauses
  double fastest_ = 0.0;                ///< spin that was looked at for softening      [rad/s]
  std::vector<dynamics::StepReport> reports_;
  dynamics::State state_;
  dynamics::State boundary_state_;  ///< state for rows that need no more than the contact boundary
  std::unique_ptr<dynamics::Integrator> integrator_;
  long long steps_ = 0;
  ContactStatistics contact_;
  std::optional<StrainWatch> strain_;
  RubberStepWatch rubber_step_;
  dynamics::Balance balance_;
  dynamics::MaterialReport material_;
  std::optional<std::string> trouble_;
  std::vector<std::string> warnings_;  ///< given while it ran
  Bounds bounds_;
  std::optional<BoundaryWatch> watch_;
  std::optional<BetweenNodes> between_nodes_;
  std::optional<FrictionWatch> friction_;
  std::optional<HubWatch> hub_;
  bool impacts_told_ = false;
  int problems_kept_ = 0;                       ///< contact problems kept as files
  const dynamics::StepReport* last_ = nullptr;  ///< the last step taken; none: all were made before
  const dynamics::State* last_state_ = nullptr;  ///< its state, if it is at hand
};

[[nodiscard]] std::unique_ptr<Analysis> make_dynamic(const Case& c, const RunOptions& options);

}  // namespace rondo::study
