// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/solid_steady.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <optional>

#include "rondo/analysis/base/disk.hpp"
#include "rondo/analysis/base/strain_watch.hpp"
#include "rondo/analysis/build/physical.hpp"
#include "rondo/analysis/figures/steady_figures.hpp"
#include "rondo/analysis/steady/solid_steady_state.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

using R = SolidSteadySums;
constexpr std::array own_columns{
    Column<R>{"stick_area_m2", "m2", "tributary areas of the nodes that stick, summed",
              [](const R& r) { return r.stick_area; }},
    Column<R>{"slip_area_m2", "m2", "of those that slip", [](const R& r) { return r.slip_area; }},
    Column<R>{"pressure_max_pa", "Pa", "largest of all contact nodes",
              [](const R& r) { return r.pressure; }},
    Column<R>{"shear_max_pa", "Pa", "likewise", [](const R& r) { return r.shear; }},
    Column<R>{"slip_speed_max", "m/s", "likewise, by the slip that the law of friction sees",
              [](const R& r) { return r.slip; }},
    Column<R>{"friction_power", "W", "taken by friction", [](const R& r) { return r.friction; }},
};

using P = ContactRecord;
constexpr std::array pair_columns{
    Column<P>{"slip_speed", "m/s", "of the node over the ground, as the law of friction sees it",
              [](const P& r) { return r.slip; }},
};

io::ResultsWords words() {
  io::ResultsWords w;
  w.analysis = "steady-rolling";
  w.velocity_time = "of velocity: that of /frame/time";
  w.force = "of steady rolling at /frame/time";
  return w;
}

std::vector<ColumnLabel> all_columns() {
  std::vector<ColumnLabel> all = history_labels(true);
  for (const auto& more :
       {labels_of(solid_columns()), labels_of(std::span<const Column<R>>(own_columns))})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

class SolidSteadyRolling final : public Analysis {
 public:
  SolidSteadyRolling(const Case& c, const RunOptions& options)
      : case_(c),
        threads_(options.threads),
        body_(shared_solid_steady_body(c, options.shared)),
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
  [[nodiscard]] std::string look(double time);

  const Case& case_;
  int threads_;  ///< 0: chosen by size
  std::shared_ptr<SolidSteadyBody> body_;
  contact::Ground ground_;
  StrainWatch strain_;
  PhysicalFigures told_;
  std::optional<SolidSteadyState> state_;
  double solve_s_ = 0.0;
  Snapshot now_;
  int recorded_ = 0;  ///< places of a sector's pass whose results are kept
  std::optional<std::string> trouble_;
};

CheckReport SolidSteadyRolling::check(double /*trial*/) {
  CheckReport r;
  r.nodes = body_->mesh.n_nodes();
  r.elements = body_->mesh.n_elements();
  r.dofs = body_->dofs;
  r.candidates = body_->mesh.boundary.size();
  r.wave_speeds = fem::wave_speeds(case_.material);
  r.steps = samples();
  r.snapshots = keeps_fields() ? static_cast<std::size_t>(samples()) : 0;
  r.memory_bytes = steady_memory(case_, body_->mesh);
  r.disk_bytes = disk_needed(record_plan(), false).all;
  r.lines = told_.figures;
  r.lines.emplace_back(
      "sectors", fmt::format("{} of {} degrees of freedom, {} places each", body_->sector.n_sectors,
                             3 * body_->sector.n_local(), samples()));
  r.warnings = warnings();
  return r;
}

RecordPlan SolidSteadyRolling::record_plan() const {
  RecordPlan plan;
  plan.results = {.mesh = &body_->mesh,
                  .mass = body_->mass,
                  .n_snapshots = keeps_fields() ? static_cast<std::size_t>(samples()) : 0,
                  .contact = true,
                  .stress = case_.output.stress,
                  .components = 3,
                  .camber = case_.motion.camber,
                  .words = words()};
  plan.columns = all_columns();
  plan.contact_columns = pair_columns;
  plan.n_rows = static_cast<std::size_t>(samples());
  plan.materials = body_->materials;
  plan.ground = &ground_;
  return plan;
}

void SolidSteadyRolling::prepare() {
  find_harmonics(case_, *body_, threads_);
  const auto begin = Clock::now();
  state_.emplace(case_, *body_);
  solve_s_ = std::chrono::duration<double>(Clock::now() - begin).count();
}

void SolidSteadyRolling::describe(Json& j) const {
  j["nodes"] = body_->mesh.n_nodes();
  j["dofs"] = body_->dofs;
  j["dimensions"] = 3;
  j["sectors"] = body_->sector.n_sectors;
  j["camber"] = case_.motion.camber;
  j["harmonics_wall_s"] = body_->harmonics_wall_s;
  j["solve_wall_s"] = solve_s_;
}

Progress SolidSteadyRolling::begin(Recorder& /*recorder*/) {
  return {0, samples()};
}

std::string SolidSteadyRolling::look(double time) {
  return strain_.look(now_.u, {}, time, now_.axial_u);
}

Progress SolidSteadyRolling::advance(Recorder& recorder) {
  std::string wrong = state_->trouble();
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
  const HistoryRecord record = state_->record(recorded_, now_);
  append_values(history_columns(), record, recorder.rows());
  append_values(solid_columns(), record, recorder.rows());
  append_values(std::span<const Column<R>>(own_columns), state_->sums(recorded_), recorder.rows());
  recorder.rows_added();
  return {++recorded_, samples()};
}

std::string SolidSteadyRolling::look_at_all() {
  std::string wrong = state_->trouble();
  for (recorded_ = 0; wrong.empty() && recorded_ < samples(); ++recorded_) {
    state_->displace(recorded_, now_);
    wrong = look(recorded_ * state_->sample_time());
  }
  return wrong;
}

void SolidSteadyRolling::summarise(Json& j, RunReport& r) const {
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
  for (std::string& note : state_->notes()) r.notes.push_back(std::move(note));
}

}  // namespace

std::unique_ptr<Analysis> make_solid_steady_rolling(const Case& c, const RunOptions& options) {
  return std::make_unique<SolidSteadyRolling>(c, options);
}

DirectRun solve_solid_steady_rolling(const Case& c, const RunOptions& options) {
  SolidSteadyRolling analysis(c, options);
  analysis.prepare();
  DirectRun run;
  run.trouble = analysis.look_at_all();
  Json json;
  RunReport report;
  analysis.summarise(json, report);
  run.steps = report.steps;
  if (!run.trouble.empty()) return run;
  run.figures = solid_steady_figures_of(json);
  return run;
}

}  // namespace rondo::study
