// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/steady.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <optional>

#include "rondo/analysis/base/disk.hpp"
#include "rondo/analysis/base/strain_watch.hpp"
#include "rondo/analysis/build/physical.hpp"
#include "rondo/analysis/figures/steady_figures.hpp"
#include "rondo/analysis/steady/steady_state.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

using R = SteadySums;
constexpr std::array steady_columns{
    Column<R>{"stick_length_m", "m", "tributary lengths of the nodes that stick, summed",
              [](const R& r) { return r.stick_length; }},
    Column<R>{"slip_length_m", "m", "of those that slip", [](const R& r) { return r.slip_length; }},
    Column<R>{"pressure_max_pa", "Pa", "largest of all contact nodes",
              [](const R& r) { return r.pressure; }},
    Column<R>{"shear_max_pa", "Pa", "likewise", [](const R& r) { return r.shear; }},
    Column<R>{"slip_speed_max", "m/s", "likewise, by the slip that the law of friction sees",
              [](const R& r) { return r.slip; }},
    Column<R>{"friction_power", "W/m", "taken by friction", [](const R& r) { return r.friction; }},
};

using P = ContactRecord;
constexpr std::array pair_columns{
    Column<P>{"slip_speed", "m/s",
              "of the node over the ground, along x, as the law of friction sees it",
              [](const P& r) { return r.slip; }},
    Column<P>{"sticks", "1", "1: it sticks; 0: it slips",
              [](const P& r) { return r.sticks ? 1.0 : 0.0; }},
};

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
        body_(shared_steady_body(c, options.shared)),
        ground_(c.ground->shape),
        strain_(body_->mesh, body_->materials) {
    tell_physical_figures(c, body_->mesh, body_->materials, told_);
    if (options.resume)
      throw case_error(c, "analysis.kind", "steady rolling has no checkpoints to resume from",
                       "\"dynamic\", or --overwrite instead of --resume");
  }

  [[nodiscard]] CheckReport check(double trial) override;
  [[nodiscard]] RecordPlan record_plan() const override;
  void prepare() override;
  [[nodiscard]] std::vector<std::string> warnings() const override {
    std::vector<std::string> all = case_.warnings;
    all.insert(all.end(), body_->warnings.begin(), body_->warnings.end());
    all.insert(all.end(), told_.warnings.begin(), told_.warnings.end());
    return all;
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
  [[nodiscard]] int samples() const noexcept { return case_.analysis.samples_per_sector; }

  const Case& case_;
  int threads_;  ///< 0: chosen by size
  std::shared_ptr<SteadyBody> body_;
  contact::Ground ground_;
  StrainWatch strain_;
  PhysicalFigures told_;
  std::optional<SteadyState> state_;
  double solve_s_ = 0.0;
  Snapshot now_;
  int recorded_ = 0;  ///< places of a sector's pass whose results are kept
  std::optional<std::string> trouble_;
};

CheckReport SteadyRolling::check(double /*trial*/) {
  CheckReport r;
  r.nodes = body_->mesh.n_nodes();
  r.elements = body_->mesh.cells.size();
  r.dofs = 2 * body_->free.size();
  r.candidates = body_->mesh.boundary.size();
  r.wave_speeds = fem::wave_speeds(case_.material);
  r.steps = samples();
  r.snapshots = keeps_fields() ? static_cast<std::size_t>(samples()) : 0;
  r.memory_bytes = steady_memory(case_, *body_);
  r.disk_bytes = disk_needed(record_plan(), false).all;
  r.lines = told_.figures;
  r.lines.emplace_back(
      "sectors", fmt::format("{} of {} degrees of freedom, {} places each", body_->sector.n_sectors,
                             2 * body_->sector.n_local(), samples()));
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
                  .words = words()};
  plan.columns = labels_of(history_columns());
  const std::vector<ColumnLabel> own = labels_of(std::span<const Column<R>>(steady_columns));
  plan.columns.insert(plan.columns.end(), own.begin(), own.end());
  plan.contact_columns = pair_columns;
  plan.n_rows = static_cast<std::size_t>(samples());
  plan.materials = body_->materials;
  plan.ground = &ground_;
  return plan;
}

void SteadyRolling::prepare() {
  find_harmonics(case_, *body_, threads_);
  const auto begin = Clock::now();
  state_.emplace(case_, *body_);
  solve_s_ = std::chrono::duration<double>(Clock::now() - begin).count();
}

void SteadyRolling::describe(Json& j) const {
  j["nodes"] = body_->mesh.n_nodes();
  j["dofs"] = 2 * body_->free.size();
  j["harmonics_wall_s"] = body_->harmonics_wall_s;
  j["solve_wall_s"] = solve_s_;
}

Progress SteadyRolling::begin(Recorder& /*recorder*/) {
  return {0, samples()};
}

Progress SteadyRolling::advance(Recorder& recorder) {
  std::string wrong = state_->trouble();
  if (wrong.empty()) {
    state_->fill(recorded_, now_);
    wrong = strain_.look(now_.u, {}, now_.time);
  }
  if (!wrong.empty()) {
    trouble_ = wrong;
    return {recorded_, samples()};
  }
  if (keeps_fields()) {
    recorder.next_snapshot() = now_;
    recorder.add_snapshot();
  }
  append_values(history_columns(), state_->record(recorded_, now_), recorder.rows());
  append_values(std::span<const Column<R>>(steady_columns), state_->sums(recorded_),
                recorder.rows());
  recorder.rows_added();
  return {++recorded_, samples()};
}

std::string SteadyRolling::look_at_all() {
  std::string wrong = state_->trouble();
  for (recorded_ = 0; wrong.empty() && recorded_ < samples(); ++recorded_) {
    state_->displace(recorded_, now_.u);
    wrong = strain_.look(now_.u, {}, recorded_ * state_->sample_time());
  }
  return wrong;
}

void SteadyRolling::summarise(Json& j, RunReport& r) const {
  r.steps = recorded_;
  r.reached = fmt::format("{} places of a sector", recorded_);
  r.energy_residual_relative = state_->power().residual;
  r.contact_residual_max = state_->solution().residual;
  r.penetration_max_m = state_->mean().penetration;
  strain_.summarise({}, j, r);
  j["steps_done"] = recorded_;
  j["contact_residual_max"] = r.contact_residual_max;
  j["energy_residual_relative"] = r.energy_residual_relative;
  j["penetration_max_m"] = r.penetration_max_m;
  if (recorded_ == 0) return;
  j["steady"] = state_->describe();
  const statics::RollingForces& f = state_->solution().forces;
  r.notes.push_back(fmt::format(
      "traction {:.6g} N/m, load {:.6g} N/m, torque {:.6g} N, rolling resistance {:.6g} N/m", f.x,
      f.y, state_->torque(), state_->resistance()));
  r.notes.push_back(state_->motion_text());
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
  run.figures = steady_figures_of(json);
  return run;
}

}  // namespace rondo::study
