// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/steady.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>

#include "rondo/analysis/base/disk.hpp"
#include "rondo/analysis/base/shared_members.hpp"
#include "rondo/analysis/base/strain_watch.hpp"
#include "rondo/analysis/build/ground/held_ground.hpp"
#include "rondo/analysis/build/physical.hpp"
#include "rondo/analysis/build/plausible/plausible.hpp"
#include "rondo/analysis/figures/steady_figures.hpp"
#include "rondo/analysis/steady/scheme_power.hpp"
#include "rondo/analysis/steady/steady_case.hpp"
#include "rondo/analysis/steady/steady_members.hpp"
#include "rondo/output/kept/kept_files.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

io::ResultsWords words() {
  io::ResultsWords w;
  w.analysis = "steady-rolling";
  w.velocity_time = "of velocity: that of /frame/time";
  w.force = "of steady rolling at /frame/time";
  return w;
}

class SteadyRolling final : public Analysis {
 public:
  SteadyRolling(const Case& c, const RunOptions& options)
      : case_(c),
        threads_(options.threads),
        body_(rolled_body(c, options.shared)),
        ground_(c.ground->shape),
        strain_(body_->mesh, body_->materials),
        directory_(options.directory) {
    if (has_large_strains(c)) strain_.take_large_strains();
    refuse_held_in_ground(c, body_->mesh);
    if (has_slip_step(c))
      refuse_many_steps(c, stepped_wheel(), speed_after_step(c, stepped_wheel()));
    tell_physical_figures(c, {body_->mesh, body_->materials, body_->inflation}, told_);
    if (options.resume)
      throw case_error(c, "analysis.kind", "steady rolling has no checkpoints to resume from",
                       "\"dynamic\", or --overwrite instead of --resume");
  }

  [[nodiscard]] CheckReport check(double trial) override;
  [[nodiscard]] RecordPlan record_plan() const override;
  void prepare() override;
  [[nodiscard]] std::vector<std::string> warnings() const override {
    return all_warnings(case_, *body_, told_.warnings);
  }
  void describe(Json& json) const override;

  Progress begin(Recorder& recorder) override;
  Progress advance(Recorder& recorder) override;
  [[nodiscard]] const std::optional<std::string>& trouble() const override { return trouble_; }
  /// All that begin() and advance() do, but for what is recorded. @return what is wrong; empty:
  /// done
  [[nodiscard]] std::string look_at_all();
  void summarise(Json& json, RunReport& report) const override;

 private:
  /// A sweep without snapshots asks for none.
  [[nodiscard]] bool keeps_fields() const noexcept { return case_.output.snapshots > 0; }
  [[nodiscard]] std::string look(double time);
  [[nodiscard]] std::string wrong_state() const;
  [[nodiscard]] std::vector<std::string> warnings_of_state() const;
  [[nodiscard]] int samples() const noexcept { return case_.analysis.samples_per_sector; }
  [[nodiscard]] SteppedWheel stepped_wheel() const {
    return {body_->radius, body_->mesh.n_sectors * samples()};
  }

  const Case& case_;
  int threads_;  ///< 0: chosen by size
  std::shared_ptr<RolledBody> body_;
  contact::Ground ground_;
  StrainWatch strain_;
  PhysicalFigures told_;
  std::unique_ptr<RolledState> state_;
  double solve_s_ = 0.0;
  Snapshot now_;
  std::filesystem::path directory_;        ///< empty: into memory
  std::optional<io::CsvPlace> slip_step_;  ///< of slip-step.csv
  int recorded_ = 0;                       ///< places of a sector's pass whose results are kept
  std::optional<std::string> trouble_;
};

CheckReport SteadyRolling::check(double /*trial*/) {
  CheckReport r;
  r.lines = told_.figures;
  add_body(case_, *body_, r);
  r.steps = samples();
  r.snapshots = keeps_fields() ? static_cast<std::size_t>(samples()) : 0;
  r.disk_bytes = disk_needed(record_plan(), false).all;
  r.lines.emplace_back(
      "sectors", fmt::format("{} of {} degrees of freedom, {} samples each", body_->mesh.n_sectors,
                             body_->sector_dofs, samples()));
  if (has_slip_step(case_))
    r.lines.emplace_back("slip step", told_of_steps(case_, stepped_wheel()));
  r.warnings = warnings();
  return r;
}

RecordPlan SteadyRolling::record_plan() const {
  RecordPlan plan;
  plan.results = {.mesh = &body_->mesh,
                  .mass = body_->mass,
                  .n_snapshots = keeps_fields() ? static_cast<std::size_t>(samples()) : 0,
                  .contact = true,
                  .stress = case_.output.stress,
                  .components = is_solid(case_) ? 3U : 2U,
                  .camber = case_.motion.camber,
                  .words = words()};
  plan.n_rows = static_cast<std::size_t>(samples());
  plan.materials = body_->materials;
  plan.ground = &ground_;
  body_->add_columns(plan);
  return plan;
}

void SteadyRolling::prepare() {
  body_->find_harmonics(case_, threads_);
  if (!body_->has_solution()) {
    trouble_ = no_solution(case_);
    return;
  }
  const auto begin = Clock::now();
  state_ = body_->solve(case_);
  solve_s_ = std::chrono::duration<double>(Clock::now() - begin).count();
}

void SteadyRolling::describe(Json& j) const {
  describe_body(case_, *body_, j);
  describe_steady(body_->harmonics_wall_s, solve_s_, j);
}

Progress SteadyRolling::begin(Recorder& /*recorder*/) {
  if (state_ && state_->slip_step() && !directory_.empty())
    slip_step_ = write_slip_step(*state_->slip_step(), directory_);
  return {0, samples()};
}

std::string SteadyRolling::look(double time) {
  return strain_.look(now_.u, {}, time);
}

std::string SteadyRolling::wrong_state() const {
  if (!state_) return *trouble_;
  std::string wrong = state_->trouble();
  return wrong.empty() ? scheme_trouble(case_, state_->power()) : wrong;
}

std::vector<std::string> SteadyRolling::warnings_of_state() const {
  std::vector<std::string> all{scheme_warning(case_, state_->power()), state_->warning()};
  const std::optional<Wall> wall = wall_of(body_->mesh);
  if (case_.analysis.load && wall)
    all.push_back(hardly_pressed("analysis.load", state_->deflection(), wall->radius));
  std::erase(all, std::string());
  if (const SlipStep* step = state_->slip_step())
    for (std::string& warning : study::warnings_of(case_, *step)) all.push_back(std::move(warning));
  return all;
}

Progress SteadyRolling::advance(Recorder& recorder) {
  std::string wrong = wrong_state();
  if (wrong.empty()) {
    state_->fill(recorded_, now_);
    wrong = look(now_.time);
  }
  if (!wrong.empty()) {
    trouble_ = wrong;
    return {recorded_, samples()};
  }
  if (keeps_fields()) {
    recorder.next_snapshot() = now_;
    recorder.add_snapshot();
  }
  state_->append_row(recorded_, now_, recorder.rows());
  recorder.rows_added();
  return {++recorded_, samples()};
}

std::string SteadyRolling::look_at_all() {
  std::string wrong = wrong_state();
  for (recorded_ = 0; wrong.empty() && recorded_ < samples(); ++recorded_) {
    state_->displace(recorded_, now_);
    wrong = look(recorded_ * state_->sample_time());
  }
  return wrong;
}

void SteadyRolling::summarise(Json& j, RunReport& r) const {
  r.steps = recorded_;
  r.reached = fmt::format("{} samples of a sector", recorded_);
  if (!state_) return;
  const SteadyResiduals residuals = state_->residuals();
  r.energy_residual_relative = residuals.energy;
  r.energy_residual_bound = residual_bound;
  r.contact_residual_max = residuals.contact;
  r.penetration_max_m = residuals.penetration;
  strain_.summarise({}, j, r);
  add_steps_done(r, j);
  add_contact_residual(r, j);
  add_energy_residual(r, {}, j);
  add_penetration(r, j);
  if (slip_step_) j["files"]["slip-step.csv"] = as_json(*slip_step_);
  if (recorded_ == 0) return;
  state_->describe(j);
  for (std::string& note : state_->notes()) r.notes.push_back(std::move(note));
  for (std::string warning : warnings_of_state()) {
    j["warnings"].push_back(warning);
    r.warnings.push_back(std::move(warning));
  }
}

}  // namespace

std::unique_ptr<Analysis> make_steady_rolling(const Case& c, const RunOptions& options) {
  return std::make_unique<SteadyRolling>(c, options);
}

DirectRun solve_steady_rolling(const Case& c, const RunOptions& options) {
  SteadyRolling analysis(c, options);
  analysis.prepare();
  DirectRun run;
  run.trouble = analysis.look_at_all();
  Json json;
  RunReport report;
  analysis.summarise(json, report);
  run.steps = report.steps;
  if (!run.trouble.empty()) return run;
  run.figures = steady_figures_of(json, is_solid(c));
  return run;
}

}  // namespace rondo::study
