// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "rondo/analysis/base/disk.hpp"
#include "rondo/analysis/base/strain_watch.hpp"
#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/crush_setup.hpp"
#include "rondo/analysis/build/physical.hpp"
#include "rondo/analysis/out_of_range.hpp"
#include "rondo/analysis/rubber_watch.hpp"
#include "rondo/core/keep_larger.hpp"
#include "rondo/output/columns.hpp"
#include "rondo/statics/rubber_crush.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

constexpr Vec2 normal{0.0, 1.0};  ///< a contact frame's vector times it is along the fixed axes

/// Of the contact after an increment.
struct Sums {
  Vec2 contact;         ///< of the ground: normal, tangential [N/m]
  Vec2 force;           ///< the same along the fixed axes [N/m]
  double torque = 0.0;  ///< about the center [N]
  int nodes = 0, sticking = 0;
  double length = 0.0;                 ///< [m]
  double pressure = 0.0, shear = 0.0;  ///< largest [Pa]
};

Sums sum_up(const CrushSetup& setup, const statics::CrushState& state) {
  Sums s;
  for (std::size_t k = 0; k < state.force.size(); ++k) {
    const Vec2 r = state.force[k];
    if (!(r.x > 0.0)) continue;
    const auto node = static_cast<std::size_t>(setup.model.nodes[k]);
    const double tributary = setup.mesh.tributary[k];
    s.contact += r;
    s.force += from_frame(normal, r);
    s.torque += cross(setup.mesh.coordinates[node] + state.u[node], from_frame(normal, r));
    ++s.nodes;
    s.sticking += state.status[k] == contact::Status::stick ? 1 : 0;
    s.length += tributary;
    s.pressure = std::max(s.pressure, r.x / tributary);
    s.shear = std::max(s.shear, std::abs(r.y) / tributary);
  }
  return s;
}

/// A row of history.csv beside those of every analysis.
struct CrushRecord {
  const statics::CrushState& state;
  const statics::CrushReport& report;
  const Sums& sums;
};

using R = CrushRecord;
constexpr std::array crush_columns{
    Column<R>{"depth_m", "m",
              "of the center below first touch; with `force_y` the curve of force over depth; the "
              "slide is `center_x_m`",
              [](const R& r) { return r.state.depth; }},
    Column<R>{"pressure_max_pa", "Pa", "largest of all contact nodes",
              [](const R& r) { return r.sums.pressure; }},
    Column<R>{"shear_max_pa", "Pa", "likewise", [](const R& r) { return r.sums.shear; }},
    Column<R>{"contact_residual", "1", "of the contact law, from the whole field",
              [](const R& r) { return r.report.residual; }},
    Column<R>{"sweeps", "1", "of the contact solver",
              [](const R& r) { return static_cast<double>(r.report.sweeps); }},
};

HistoryRecord record_of(const CrushSetup& setup, double parameter, const CrushRecord& r) {
  HistoryRecord h;
  h.time = parameter;
  h.center = setup.center(r.state);
  h.force = r.sums.force;
  h.torque = r.sums.torque;
  h.nodes = r.sums.nodes;
  h.sticking = r.sums.sticking;
  h.contact_length = r.sums.length;
  h.penetration = r.report.penetration;
  const statics::CrushWorks& w = r.state.works;
  h.balance.strain = w.strain;
  h.balance.works.contact = w.contact;
  h.balance.works.dissipation_friction = w.friction;
  h.balance.works.loss_impact = w.impact;
  h.balance.works.rim = w.rim;
  h.balance.residual = w.residual;
  return h;
}

io::ResultsWords words() {
  return {.analysis = "crush",
          .time_unit = "1",
          .time =
              "share of the depth, above 1 while the body slides, of displacement, center, "
              "contact and fields; NaN: snapshot not written",
          .velocity_time = "of velocity: half an increment before /frame/time",
          .velocity_unit = "m",
          .velocity =
              "rate of the displacement over the share of the depth, at "
              "/frame/time_velocity",
          .field_velocity =
              "rate of the displacement of each node over the share of the depth, "
              "along the fixed axes, at /frame/time_velocity",
          .force = "of the equilibrium at /frame/time"};
}

/// The curve of force over depth, a value for each snapshot.
std::vector<io::Series> series() {
  return {{"/crush/depth", "m", "depth of the center below first touch"},
          {"/crush/force", "N/m", "force of the ground on the body: normal, tangential", 2},
          {"/crush/contact_length", "m", "/mesh/tributary of the nodes in contact, summed"},
          {"/crush/pressure_max", "Pa", "largest pressure of all contact nodes"}};
}

double depth_of(const AnalysisCase& a, int k) {
  return a.depth * std::min(k, a.increments) / a.increments;
}

double slide_of(const AnalysisCase& a, int k) {
  return k <= a.increments ? 0.0 : a.slide * (k - a.increments) / a.slide_increments;
}

/// What increment k brings the center to.
std::string target(const AnalysisCase& a, int k) {
  const std::string depth = fmt::format("depth {:.6g} m", depth_of(a, k));
  return k <= a.increments ? depth : fmt::format("{}, slide {:.6g} m", depth, slide_of(a, k));
}

struct KeptCrush {
  std::string key;
  std::shared_ptr<statics::Condensation> body;
};

/// Factorised, and nothing condensed: that of the run before where it fits.
std::shared_ptr<statics::Condensation> factorised(const Case& c, const CrushSetup& setup,
                                                  SharedBody* shared) {
  const std::string key = shared ? body_key(c) : std::string();
  const auto* kept = shared ? std::any_cast<KeptCrush>(&shared->other) : nullptr;
  if (kept && kept->key == key) {
    kept->body->clear();
    return kept->body;
  }
  auto body = std::make_shared<statics::Condensation>(
      fem::assemble_stiffness(setup.mesh, setup.materials), setup.free, setup.model.nodes);
  if (shared) shared->other = KeptCrush{key, body};
  return body;
}

class CrushAnalysis final : public Analysis {
 public:
  CrushAnalysis(const Case& c, const RunOptions& options)
      : case_(c),
        options_(options),
        setup_(build_crush(c)),
        ground_(c.ground->shape),
        strain_(setup_.mesh, setup_.materials) {
    tell_physical_figures(c, setup_);
    if (options.resume)
      throw case_error(c, "analysis.kind", "a crush has no checkpoints to resume from",
                       "\"dynamic\", or --overwrite instead of --resume");
  }

  [[nodiscard]] CheckReport check(double trial) override;
  [[nodiscard]] RecordPlan record_plan() const override;
  void prepare() override;
  [[nodiscard]] std::vector<std::string> warnings() const override {
    std::vector<std::string> all = case_.warnings;
    all.insert(all.end(), setup_.warnings.begin(), setup_.warnings.end());
    return all;
  }
  void describe(Json& json) const override;

  Progress begin(Recorder& recorder) override;
  Progress advance(Recorder& recorder) override;
  [[nodiscard]] const std::optional<std::string>& trouble() const override { return trouble_; }
  void summarise(Json& json, RunReport& report) const override;

 private:
  [[nodiscard]] int n_increments() const noexcept {
    return case_.analysis.increments + case_.analysis.slide_increments;
  }
  /// In the place of time: k/increments, above 1 while the body slides.
  [[nodiscard]] double parameter_of(int k) const noexcept {
    return static_cast<double>(k) / case_.analysis.increments;
  }
  statics::CrushReport solve_increment(int k);
  void count(const statics::CrushReport& report);
  void record_row(const statics::CrushReport& report, const Sums& sums, Recorder& recorder) const;
  void fill(const std::vector<Vec2>& before, const Sums& sums, Snapshot& snapshot) const;

  const Case& case_;
  const RunOptions& options_;
  CrushSetup setup_;
  contact::Ground ground_;
  StrainWatch strain_;
  std::shared_ptr<statics::Condensation> body_;  ///< null: of rubber
  std::optional<statics::RubberCrush> rubber_;
  double factor_s_ = 0.0;
  statics::CrushState state_;
  int increments_ = 0;        ///< done, whose results are kept
  double residual_ = 0.0;     ///< largest of the law
  double equilibrium_ = 0.0;  ///< largest of K u = Hᵀ r
  double penetration_ = 0.0;  ///< largest [m]
  int sweeps_ = 0;            ///< most of an increment
  int pivoted_ = 0;           ///< increments that the sweeps alone did not solve
  std::optional<std::string> trouble_;
};

std::string reached(int increments, double depth, double slide) {
  const std::string text = fmt::format("{} increments to a depth of {:.6g} m", increments, depth);
  return slide == 0.0 ? text : fmt::format("{} and a slide of {:.6g} m", text, slide);
}

CheckReport CrushAnalysis::check(double /*trial*/) {
  CheckReport r;
  r.nodes = setup_.mesh.n_nodes();
  r.elements = setup_.mesh.cells.size();
  r.dofs = setup_.n_dofs();
  r.bodies = mesh::find_bodies(setup_.mesh).count;
  r.candidates = setup_.mesh.boundary.size();
  r.wave_speeds = fem::wave_speeds(case_.material);
  r.steps = n_increments();
  r.snapshots = static_cast<std::size_t>(n_increments());
  r.memory_bytes = crush_memory(case_, setup_);
  r.disk_bytes = disk_needed(record_plan(), false).all;
  r.lines = setup_.figures;
  r.lines.insert(
      r.lines.end(),
      {{"condensed", fmt::format("{} contact nodes", setup_.within_reach)},
       {"increments", reached(n_increments(), case_.analysis.depth, case_.analysis.slide)}});
  r.warnings = warnings();
  return r;
}

RecordPlan CrushAnalysis::record_plan() const {
  RecordPlan plan;
  plan.results = {.mesh = &setup_.mesh,
                  .mass = setup_.mass,
                  .n_snapshots = static_cast<std::size_t>(n_increments()),
                  .contact = true,
                  .stress = case_.output.stress,
                  .words = words(),
                  .series = series()};
  plan.columns = labels_of(history_columns());
  const std::vector<ColumnLabel> own = labels_of(std::span<const Column<R>>(crush_columns));
  plan.columns.insert(plan.columns.end(), own.begin(), own.end());
  plan.columns.front().unit.assign(1, '1');
  plan.n_rows = plan.results.n_snapshots + 1;
  plan.materials = setup_.materials;
  plan.ground = &ground_;
  return plan;
}

void CrushAnalysis::prepare() {
  const auto begin = Clock::now();
  if (fem::has_rubber(setup_.materials)) {
    auto body = std::make_shared<const fem::Hyperelasticity>(setup_.mesh, setup_.materials);
    rubber_.emplace(setup_.model, std::move(body), setup_.free, setup_.reach);
    return;
  }
  body_ = factorised(case_, setup_, options_.shared);
  condense(case_, setup_, *body_);
  factor_s_ = std::chrono::duration<double>(Clock::now() - begin).count();
}

void CrushAnalysis::describe(Json& j) const {
  j["nodes"] = setup_.mesh.n_nodes();
  j["dofs"] = setup_.n_dofs();
  j["depth"] = case_.analysis.depth;
  j["increments"] = case_.analysis.increments;
  j["slide"] = case_.analysis.slide;
  j["slide_increments"] = case_.analysis.slide_increments;
  j["factor_wall_s"] = factor_s_;
}

/// The first row is that of first touch.
Progress CrushAnalysis::begin(Recorder& recorder) {
  state_ = statics::start_crush(setup_.model, setup_.mesh.n_nodes());
  record_row({}, sum_up(setup_, state_), recorder);
  static_cast<void>(strain_.look(state_.u, {}, 0.0));  // undeformed
  return {0, n_increments()};
}

statics::CrushReport CrushAnalysis::solve_increment(int k) {
  const AnalysisCase& a = case_.analysis;
  if (rubber_) return rubber_->bring_to(depth_of(a, k), slide_of(a, k), state_);
  return statics::bring_to(setup_.model, depth_of(a, k), slide_of(a, k), *body_, state_);
}

Progress CrushAnalysis::advance(Recorder& recorder) {
  const int k = increments_ + 1, n = n_increments();
  const std::vector<Vec2> before = state_.u;
  const statics::CrushReport report = solve_increment(k);
  count(report);
  std::string wrong = rubber_ && !report.converged
                          ? rubber_not_solved(report)
                          : crush_trouble(report, state_.works, setup_.model.bound);
  if (wrong.empty()) wrong = beyond_files(setup_, state_);
  if (wrong.empty()) wrong = strain_.look(state_.u, {}, parameter_of(k));
  if (!wrong.empty()) {
    trouble_ = fmt::format("increment {} of {}, {}: {}", k, n, target(case_.analysis, k), wrong);
    return {increments_, n};
  }
  increments_ = k;
  const Sums sums = sum_up(setup_, state_);
  record_row(report, sums, recorder);
  fill(before, sums, recorder.next_snapshot());
  recorder.add_snapshot();
  return {k, n};
}

void CrushAnalysis::count(const statics::CrushReport& r) {
  residual_ = keep_larger(residual_, r.residual);
  equilibrium_ = keep_larger(equilibrium_, r.equilibrium);
  penetration_ = std::max(penetration_, r.penetration);
  sweeps_ = std::max(sweeps_, r.sweeps);
  pivoted_ += r.pivoting != statics::Pivoting::none ? 1 : 0;
}

void CrushAnalysis::record_row(const statics::CrushReport& report, const Sums& sums,
                               Recorder& recorder) const {
  const CrushRecord r{state_, report, sums};
  append_values(history_columns(), record_of(setup_, parameter_of(increments_), r),
                recorder.rows());
  append_values(std::span<const Column<R>>(crush_columns), r, recorder.rows());
  recorder.rows_added();
}

void CrushAnalysis::fill(const std::vector<Vec2>& before, const Sums& sums, Snapshot& s) const {
  const int increments = case_.analysis.increments;
  s.time = parameter_of(increments_);
  s.time_velocity = (static_cast<double>(increments_) - 0.5) / increments;
  s.center = setup_.center(state_);
  s.u = state_.u;
  s.v.resize(state_.u.size());
  for (std::size_t i = 0; i < s.v.size(); ++i)
    s.v[i] = static_cast<double>(increments) * (state_.u[i] - before[i]);
  s.contacts.clear();
  for (std::size_t k = 0; k < state_.force.size(); ++k)
    s.contacts.push_back({k, state_.force[k], from_frame(normal, state_.force[k]), true});
  s.series = {state_.depth, sums.contact.x, sums.contact.y, sums.length, sums.pressure};
}

void CrushAnalysis::summarise(Json& j, RunReport& r) const {
  r.steps = increments_;
  r.reached = reached(increments_, state_.depth, state_.slide);
  r.energy_residual_relative = state_.works.relative;
  r.contact_residual_max = residual_;
  r.penetration_max_m = penetration_;
  strain_.summarise({"", " of the depth"}, j, r);
  j["increments_done"] = increments_;
  j["steps_done"] = increments_;
  j["candidates_condensed"] = rubber_ ? rubber_->condensed() : body_->set().size();
  if (rubber_) {
    dynamics::MaterialReport material;
    material.internal_work = state_.works.internal;
    material.stored_energy = state_.works.strain;
    summarise_rubber(material, state_.works.exchanged, j, r);
  }
  j["contact_residual_max"] = residual_;
  j["equilibrium_residual_max"] = equilibrium_;
  j["energy_residual_relative"] = state_.works.relative;
  j["energy_exchanged"] = state_.works.exchanged;
  j["penetration_max_m"] = penetration_;
  j["sweeps_max"] = sweeps_;
  j["pivoted_increments"] = pivoted_;
}

}  // namespace

std::unique_ptr<Analysis> make_crush(const Case& c, const RunOptions& options) {
  return std::make_unique<CrushAnalysis>(c, options);
}

}  // namespace rondo::study
