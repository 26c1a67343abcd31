// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/dynamic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <utility>

#include "rondo/analysis/base/disk.hpp"
#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/build/step_limit.hpp"
#include "rondo/analysis/dynamic_members.hpp"
#include "rondo/analysis/elements/combinations.hpp"
#include "rondo/analysis/elements/massless_boundary.hpp"
#include "rondo/analysis/rubber_watch.hpp"
#include "rondo/case/case_source.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/model/friction_work.hpp"
#include "rondo/output/friction_record.hpp"
#include "rondo/output/resume.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

/// Contact problems kept as files, at the most.
constexpr int most_problems_kept = 1000;

/// Steps made in one call: enough to hide what a call costs, few enough to hear a signal soon.
std::size_t steps_at_once(const Setup& setup) {
  const bool cyclic = setup.model.stiffness_operator == dynamics::StiffnessOperator::cyclic;
  const double dof_steps = cyclic ? 5e7 : 1e7;  // some 0.05 s
  const double fewest = cyclic ? 8.0 : 1.0;     // two passes of the cyclic operator
  // The parts of a coarse step are made twice, the fine one in many steps.
  const int made = setup.model.subdomains ? 2 * setup.model.subdomains->ratio : 1;
  const double dofs = made * static_cast<double>(count_dofs(setup.model));
  return static_cast<std::size_t>(std::clamp(dof_steps / dofs, fewest, 64.0));
}

Steps steps_of(const RunOptions& options) {
  return options.reduced.empty() ? Steps::of_full_run : Steps::of_reduced_wheel;
}

}  // namespace

DynamicAnalysis::DynamicAnalysis(const Case& c, const RunOptions& options)
    : case_(c),
      options_(options),
      setup_(build(c, options.threads, options.shared, steps_of(options))) {
  plan_snapshots();
  fastest_ = c.motion.angular_velocity.largest();
}

void DynamicAnalysis::plan_snapshots() {
  schedule_ = snapshot_schedule(case_.output, setup_.model.dt, setup_.n_steps);
}

std::unique_ptr<dynamics::Integrator> DynamicAnalysis::make_integrator(dynamics::State& start) {
  if (!setup_.model.subdomains) start.v = Field();  // whose steps begin with v_0
  return dynamics::make_integrator(setup_.model, start);
}

double DynamicAnalysis::seconds_per_step(double trial) {
  if (trial <= 0.0) return 0.0;
  dynamics::State state =
      start(setup_.model, setup_.displacement, setup_.velocity, setup_.half_velocity);
  const auto integrator = make_integrator(state);
  std::array<dynamics::StepReport, 8> reports;  // only their time is of interest
  const auto begin = Clock::now();
  double seconds = 0.0;
  long long steps = 0;
  while (steps < setup_.n_steps && seconds < trial) {
    integrator->advance(reports);
    steps += static_cast<long long>(reports.size());
    seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  }
  return steps > 0 ? seconds / static_cast<double>(steps) : 0.0;
}

CheckReport DynamicAnalysis::check(double trial) {
  CheckReport r;
  r.nodes = setup_.mesh.n_nodes();
  r.elements = setup_.mesh.n_elements();
  r.dofs = count_dofs(setup_.model);
  r.bodies = count_bodies(setup_.model);
  r.free_bodies = static_cast<int>(setup_.model.free_bodies.size());
  r.candidates = setup_.mesh.boundary.size();
  r.wave_speeds = fem::wave_speeds(case_.material);
  r.steps = setup_.n_steps;
  r.threads = setup_.model.threads;
  r.snapshots = schedule_.steps.size();
  r.memory_bytes = motion_memory(case_, setup_.mesh);
  r.disk_bytes = disk_needed(record_plan(), resumable() != nullptr).all;
  r.seconds = seconds_per_step(trial) * static_cast<double>(setup_.n_steps);
  r.lines = setup_.figures;
  r.lines.emplace_back("integrator", told_integrator());
  for (auto& told : step_lines(case_, setup_)) r.lines.push_back(std::move(told));
  r.warnings = warnings();
  return r;
}

std::string DynamicAnalysis::told_integrator() const {
  return told_step(case_, setup_.model);
}

RecordPlan DynamicAnalysis::record_plan() const {
  RecordPlan plan;
  plan.results = {.mesh = &setup_.mesh,
                  .mass = lumped_mass_of(setup_.model),
                  .n_snapshots = schedule_.steps.size(),
                  .contact = has_candidates(setup_.model),
                  .stress = case_.output.stress,
                  .free_body = setup_.model.free_body,
                  .components = setup_.model.solid ? std::size_t{3} : std::size_t{2},
                  .camber = setup_.model.motion.camber};
  if (has_massless_contact(setup_.model)) plan.results.mass_dynamic = setup_.model.mass;
  plan_friction_work(setup_.model, plan.results);
  if (knows_slip()) plan.contact_columns = {&friction_column(), 1};
  plan.columns = History(case_, setup_).columns();
  const double interval = std::max(case_.output.history_interval, setup_.model.dt);
  plan.n_rows = static_cast<std::size_t>(case_.time.end / interval) + 2;
  plan.materials = setup_.materials;
  if (setup_.model.contact && setup_.model.contact->axes.are_straight())
    plan.ground = &setup_.model.contact->ground;
  if (!setup_.model.free_bodies.empty()) plan.model = &setup_.model;
  return plan;
}

/// The scheme "hati" adds up impulses of steps with different slips; reduced wheels have gaps.
bool DynamicAnalysis::knows_slip() const noexcept {
  return !setup_.model.subdomains && setup_.reduced.empty();
}

std::vector<std::string> DynamicAnalysis::warnings() const {
  std::vector<std::string> warnings = case_.warnings;
  warnings.insert(warnings.end(), setup_.warnings.begin(), setup_.warnings.end());
  if (setup_.n_steps + 1 < case_.output.snapshots)
    warnings.push_back(
        fmt::format("{} snapshots instead of {}: the run has {} steps, and each gives one "
                    "at the most",
                    schedule_.steps.size(), case_.output.snapshots, setup_.n_steps));
  return warnings;
}

void DynamicAnalysis::describe(Json& j) const {
  describe_dynamic(case_, setup_, j);
}

/// A run that became longer with all of its snapshots.
Case DynamicAnalysis::kept_case(const Case& c) const {
  Case kept = c;
  if (from_ && schedule_.steps.size() > static_cast<std::size_t>(c.output.snapshots))
    kept.output.snapshots = static_cast<int>(schedule_.steps.size());
  return kept;
}

const Checkpoint* DynamicAnalysis::find(const std::filesystem::path& directory) {
  from_ = find_checkpoint(identity_of(case_, setup_), case_, setup_, directory);
  if (!from_) return nullptr;
  schedule_ = from_->schedule;
  steps_ = from_->state.step;
  const auto& steps = schedule_.steps;
  next_ = static_cast<std::size_t>(std::upper_bound(steps.begin(), steps.end(), steps_) -
                                   steps.begin());
  return &*from_;
}

long long DynamicAnalysis::next_snapshot() const noexcept {
  return next_ < schedule_.steps.size() ? schedule_.steps[next_]
                                        : std::numeric_limits<long long>::max();
}

/// Takes the initial fields of the setup, which are not needed twice.
Progress DynamicAnalysis::begin(Recorder& recorder) {
  history_.emplace(case_, setup_, from_ ? from_->history : HistoryPlace{});
  bounds_ = {energy_residual_bound(setup_),
             largest_strain_energy(setup_),
             impact_cure(setup_.model),
             guards_impacts(),
             unit_of("J/m", setup_.model.solid.has_value()),
             contact_bound(),
             contact_cure()};
  watch_.emplace(case_, setup_);
  between_nodes_.emplace(setup_.model);
  friction_.emplace(setup_);
  if (history_->needs_boundary()) boundary_state_ = dynamics::boundary_state(setup_.model);
  hub_.emplace(setup_);
  reports_.resize(steps_at_once(setup_));
  state_ = start(setup_.model, std::move(setup_.displacement), std::move(setup_.velocity),
                 std::exchange(setup_.half_velocity, {}));
  strain_.emplace(setup_.mesh, setup_.materials, &setup_.model);
  const auto& solid = setup_.model.solid;
  if (solid && solid->swept && solid->swept->rubber) strain_->take_large_strains();
  if (setup_.model.friction_work) setup_.model.friction_work->clear();
  if (!from_) record_state(recorder);
  Field v = since_pause_ ? state_.v : Field();
  start_integrator();
  if (!v.empty()) state_.v = std::move(v);
  return {steps_, setup_.n_steps};
}

/// Memory that the integrator has as well is given back.
void DynamicAnalysis::start_integrator() {
  state_.force_before = Field();
  integrator_ = make_integrator(state_);
  state_.force = state_.v_next = Field();
  state_.v = Field(state_.u.size(), state_.u.components());
  if (!from_) return;
  dynamics::SavedState& saved = from_->state;
  integrator_->resumable()->restore(saved);
  if (setup_.model.friction_work) setup_.model.friction_work->restore(saved.friction_work);
  saved = {};  // as much memory as the steps have
  saved.step = steps_;
  contact_ = from_->contact;
  strain_->restore(from_->deformation);
  problems_kept_ = from_->problems_kept;
}

/// Steps up to the next one whose state is wanted, or the displacements of its contact boundary for
/// a row; at most as many as there are reports. A run that is interrupted has a last row of its
/// own.
Progress DynamicAnalysis::advance(Recorder& recorder) {
  const long long every = looks().steps, next_look = (steps_ / every + 1) * every;
  const bool may_be_deep = between_nodes_->may_be_deep(last_ ? &last_->frame : nullptr, every);
  const bool whole = may_be_deep || history_->needs_state();  // a row takes the whole state
  const long long next_row =
      whole || history_->needs_boundary() ? history_->next_row() : HistoryPlace::never;
  const long long next_state = std::min(
      {setup_.n_steps, next_snapshot(), next_look, pause_, whole ? next_row : HistoryPlace::never});
  const long long left = std::min(next_state, next_row) - steps_;
  const auto n = static_cast<std::size_t>(std::min(static_cast<long long>(reports_.size()), left));
  const std::span reports = std::span(reports_).first(n);
  dynamics::State* seen = history_->needs_boundary() ? &boundary_state_ : nullptr;
  if (steps_ + static_cast<long long>(n) == next_state || history_->needs_state()) seen = &state_;
  integrator_->advance(reports, seen);
  keep_difficult_contacts();
  if (may_be_deep && seen == &state_ && state_.step == next_row)
    add_depth_between_nodes(reports.back());
  for (std::size_t i = 0; i < n && !trouble_; ++i)
    take(reports[i], i + 1 == n ? seen : nullptr, recorder);
  if (seen == &state_ && state_.step == steps_) record_state(recorder);
  return {steps_, setup_.n_steps};
}

void DynamicAnalysis::add_depth_between_nodes(dynamics::StepReport& step) {
  step.contact.penetration = std::max(step.contact.penetration, between_nodes_->depth(state_));
}

void DynamicAnalysis::take(const dynamics::StepReport& step, const dynamics::State* state,
                           Recorder& recorder) {
  last_ = &step;
  last_state_ = state;
  ++steps_;
  contact_.add(step.contact);
  balance_ = step.balance;
  material_ = step.material;
  judge(step);
  if (state && friction_->watches() && step.step == history_->next_row())
    friction_->look(*state, contact_);
  history_->observe(step, state, recorder.rows());
  if (since_pause_) since_pause_->observe(step, state, recorder.rows());
  recorder.rows_added();
}

/// A look at its strains and its boundary, if one is due; a snapshot, if one is and the files can
/// hold it.
void DynamicAnalysis::record_state(Recorder& recorder) {
  const bool looked_at = is_looked_at();
  record_snapshot(recorder);
  if (!looked_at) return;
  look();
}

void DynamicAnalysis::record_snapshot(Recorder& recorder) {
  if (state_.step != next_snapshot()) return;
  const std::string beyond = beyond_files(setup_, state_);
  if (beyond.empty()) {
    ++next_;
    fill_snapshot(setup_, state_, recorder.next_snapshot());
    return recorder.add_snapshot();
  }
  if (!trouble_)  // else that is why
    trouble_ = fmt::format("step {} of {}, t = {:.9g} s: {}", state_.step, setup_.n_steps,
                           state_.frame.time, beyond);
}

void DynamicAnalysis::keep_difficult_contacts() {
  if (setup_.model.coupled.dump_above == 0 || options_.directory.empty()) return;
  for (contact::ProblemFile& problem : integrator_->take_difficult()) {
    if (problems_kept_ == most_problems_kept) return;
    problem.about = fmt::format("{}, after step {}", case_.title, steps_);
    write_contact_problem(options_.directory, ++problems_kept_, problem);
  }
}

Checkpoint DynamicAnalysis::save() const {
  Checkpoint checkpoint;
  checkpoint.identity = identity_of(case_, setup_);
  checkpoint.state = integrator_->resumable()->save();
  if (setup_.model.friction_work)
    checkpoint.state.friction_work = setup_.model.friction_work->save();
  checkpoint.n_steps = setup_.n_steps;
  checkpoint.history = history_->place();
  checkpoint.schedule = schedule_;
  checkpoint.contact = contact_;
  checkpoint.deformation = strain_->largest();
  checkpoint.problems_kept = problems_kept_;
  return checkpoint;
}

std::vector<double> DynamicAnalysis::last_row() {
  if (!last_) return from_ ? from_->last_row : std::vector<double>();
  std::vector<double> row;
  history_->finish(*last_, last_state_, row);
  return row;
}

/// A step's works are compared once the next half step is known: one step more, which nobody
/// sees, brings the last ones into the balance. The strains of the end are no part of a checkpoint:
/// a run that goes on later has not looked there.
void DynamicAnalysis::close() {
  dynamics::StepReport beyond;
  integrator_->advance({&beyond, 1});
  balance_ = beyond.balance;
  judge(beyond);
  warn_of_no_contact();
  warn_of_left_corners();
  if (std::string alternates = friction_->warning(contact_); !alternates.empty())
    warn(std::move(alternates));
  if (state_.step == steps_ && !is_looked_at()) look();
}

void DynamicAnalysis::summarise(Json& j, RunReport& r) const {
  const auto dofs = static_cast<double>(count_dofs(setup_.model));
  const double time = static_cast<double>(steps_) * setup_.model.dt;
  r.steps = steps_;
  r.end_time = time;
  r.reached = fmt::format("{} steps to t = {:.6g} s", steps_, time);
  r.simulated_s = static_cast<double>(steps_ - r.resumed_at) * setup_.model.dt;
  r.step_wall_s = r.loop_wall_s;
  r.ns_per_dof_step = 1e9 * r.loop_wall_s / (dofs * static_cast<double>(std::max(1LL, steps_)));
  r.energy_residual_relative = balance_.relative;
  r.energy_residual_bound = energy_residual_bound(setup_);
  r.contact_residual_max = contact_.residual;
  r.penetration_max_m = contact_.penetration;
  for (const std::string& warning : warnings_) j["warnings"].push_back(warning);
  strain_->summarise({}, j, r);
  if (has_internal_work(setup_)) summarise_rubber(material_, balance_.exchanged, j, r);
  summarise_dynamic({r, contact_, balance_.exchanged, problems_kept_, *friction_}, j);
}

std::unique_ptr<Analysis> make_dynamic(const Case& c, const RunOptions& options) {
  return std::make_unique<DynamicAnalysis>(c, options);
}

}  // namespace rondo::study
