// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/reduced/reduced.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/dynamic.hpp"
#include "rondo/analysis/reduced/known_error.hpp"
#include "rondo/analysis/reduced/prepare.hpp"
#include "rondo/case/case_source.hpp"

namespace rondo::study {
namespace {

/// Warns of values that the motion is led over to; what was said before is not said again.
void warn_of_values(const Case& c, const Setup& setup, ReducedRun& run) {
  const ModelRanges& built = run.file.ranges;
  const auto last = [](const dynamics::Table& table) { return table.points().back()[1]; };
  std::vector<std::string> said;
  const auto check = [&](const char* what, const ModelRange& range, double value) {
    ModelRange wanted;
    wanted.take(value);
    add_said(outside(what, range, wanted, 0.0), said);
  };
  check("motion.angular_velocity", built.angular_velocity, last(c.motion.angular_velocity));
  check("motion.speed", built.speed, last(c.motion.speed));
  check("motion.height", built.height, last(c.motion.height));
  add_said(passed_points(c, setup, c.motion.angular_velocity.largest(), run), said);
  for (std::string& warning : said)
    if (std::ranges::find(run.warnings, warning) == run.warnings.end())
      run.warnings.push_back(std::move(warning));
}

/// The step of a spin that stays makes a whole number of phases of a sector, see step_of().
void refuse_other_phases(const Case& c, const ReducedRun& run) {
  const bool phases = c.ground && run.file.model.form == rom::ContactForm::nodes;
  if (!phases || !run.constant_spin || c.motion.angular_velocity.points().size() == 1) return;
  throw case_error(c, "motion.angular_velocity",
                   "the step of this reduced run is made for a constant spin",
                   "motion.angular_velocity as a table from the start, [[0, w], [1, w]]");
}

constexpr JsonMember<ForceErrors> estimate_rows[] = {
    {"force_x", "number", "", "Error of the mean F_x, over the mean F_y",
     [](const ForceErrors& e) -> Json { return e.x; }},
    {"force_y", "number", "", "Error of the mean F_y, over itself",
     [](const ForceErrors& e) -> Json { return e.y; }},
    {"force_x_of_itself", "number", "", "Error of the mean F_x, over itself; null: unknown",
     [](const ForceErrors& e) { return known(e.x_of_itself); }},
    {"friction_power", "number", "",
     "Error of the mean power taken by friction, over itself; null: unknown",
     [](const ForceErrors& e) { return known(e.friction_power); }},
};

struct Reduced {
  const ReducedRun& run;
  const RunOptions& options;
};
constexpr JsonMember<Reduced> reduced_rows[] = {
    {"reduced_model", "string", "", "File of the model",
     [](const Reduced& k) -> Json { return as_utf8(k.options.reduced.string()); }},
    {"reduced_modes", "integer", "", "Number of modes",
     [](const Reduced& k) -> Json { return k.run.file.model.size(); }},
    {"displacement_modes", "integer", "", "Modes from displacements",
     [](const Reduced& k) -> Json { return k.run.file.displacement_modes; }},
    {"velocity_modes", "integer", "", "Modes from velocities",
     [](const Reduced& k) -> Json { return k.run.file.velocity_modes; }},
    {"reduced_frame", "string", "", "Frame of the modes: \"rectified\" or \"co-rotating\"",
     [](const Reduced& k) -> Json { return name_in(frame_names, k.run.file.model.frame); }},
    {"reduced_contact", "string", "", "Kind of contact: \"places\" or \"nodes\"",
     [](const Reduced& k) -> Json { return name_in(contact_names, k.run.file.model.form); }},
    {"reduced_step", "string", "", "Kind of step: \"midpoint\" or \"explicit\"",
     [](const Reduced& k) -> Json { return k.options.reduced_step; }},
    {"contact_points", "integer", "", "Number of contact points; not with contact at nodes",
     [](const Reduced& k) {
       const rom::ReducedModel& m = k.run.file.model;
       return m.form == rom::ContactForm::nodes ? absent() : Json(m.contact.points.size());
     }},
    {"step_factor", "number", "", "Step over `full_step`",
     [](const Reduced& k) -> Json { return k.run.step_factor; }},
    {"full_step", "number", "s", "Step of the full run",
     [](const Reduced& k) -> Json { return k.run.full_step; }},
    {"lifted", "boolean", "", "Snapshots are fields, not [of modes](#snapshots-of-modes)",
     [](const Reduced& k) -> Json { return k.run.lifts; }},
    {"reduced_error_estimate", "object or null", "",
     "Estimate of the error by the model ([reduced.md](reduced.md#7-files)); null: there is none",
     [](const Reduced& k) {
       const ErrorEstimate& estimate = k.run.file.estimate;
       return estimate.errors.empty() ? Json() : object_of(estimate_rows, estimate.estimate());
     },
     [] { return texts_of(estimate_rows); }},
    {"reduced_error_estimate_missing", "string", "", "Reason why there is no estimate",
     [](const Reduced& k) {
       const ErrorEstimate& estimate = k.run.file.estimate;
       return estimate.errors.empty() ? Json(as_utf8(estimate.none)) : absent();
     }},
};

struct ReducedEnd {
  const rom::StepFigures& f;
  double time;  ///< simulated [s]
};
constexpr JsonMember<ReducedEnd> figure_rows[] = {
    {"matrices_factored", "integer", "", "How often a change of spin required new matrices",
     [](const ReducedEnd& e) -> Json { return e.f.factored; }},
    {"factor_wall_s", "number", "s", "Wall time of the changes of matrices",
     [](const ReducedEnd& e) -> Json { return e.f.factor_wall_s; }},
    {"step_wall_s", "number", "s", "Wall time of all steps",
     [](const ReducedEnd& e) -> Json { return e.f.wall_s; }},
    {"contact_wall_s", "number", "s", "Wall time of the contact in all steps",
     [](const ReducedEnd& e) -> Json { return e.f.contact_wall_s; }},
    {"slowest_step_s", "number", "s", "Wall time of the slowest step",
     [](const ReducedEnd& e) -> Json { return e.f.slowest_step_s; }},
    {"realtime_factor", "number", "", "Simulated time over `step_wall_s`",
     [](const ReducedEnd& e) -> Json { return e.f.wall_s > 0.0 ? e.time / e.f.wall_s : 0.0; }},
    {"contact_tables", "integer", "", "Number of phases of contact nodes",
     [](const ReducedEnd& e) -> Json { return e.f.tables; }},
    {"contact_steps", "integer", "", "Steps with contact",
     [](const ReducedEnd& e) -> Json { return e.f.contact_steps; }},
    {"contact_iterations_mean", "number", "",
     "Mean number of iterations of the contact law in a step with contact",
     [](const ReducedEnd& e) -> Json {
       return static_cast<double>(e.f.iterations) /
              static_cast<double>(std::max(1LL, e.f.contact_steps));
     }},
    {"contact_iterations_max", "integer", "", "Most iterations in a step",
     [](const ReducedEnd& e) -> Json { return e.f.iterations_max; }},
    {"contacts_max", "integer", "", "Most contact points at once",
     [](const ReducedEnd& e) -> Json { return e.f.contacts_max; }},
    {"steps_with_more_rows_than_modes", "integer", "", "Steps with more rows of contact than modes",
     [](const ReducedEnd& e) -> Json { return e.f.more_rows_than_modes; }},
    {"steps_not_converged", "integer", "", "Steps whose contact missed the tolerance",
     [](const ReducedEnd& e) -> Json { return e.f.not_converged; }},
};
constexpr JsonMember<ReducedEnd> reduced_end_rows[] = {
    {"reduced", "object", "", "Effort of the reduced steps",
     [](const ReducedEnd& e) { return object_of(figure_rows, e); },
     [] { return texts_of(figure_rows); }},
};

/// Snapshots of modes: no field of all nodes, and no stress.
void plan_modes(const ReducedRun& run, io::ResultsLayout& results) {
  const rom::ReducedModel& m = run.file.model;
  const auto r = static_cast<std::size_t>(m.size());
  results.stress = false;
  results.modes = {
      {m.basis.data(), static_cast<std::size_t>(m.basis.size())}, r, name_in(frame_names, m.frame)};
  results.series = {
      {"/reduced/displacement", "kg^(1/2) m", "coefficients q of /reduced/modes", r},
      {"/reduced/velocity", "kg^(1/2) m/s",
       "coefficients p of /reduced/modes, at /frame/time_velocity", r},
      {"/reduced/angle", "rad",
       "angles that lift displacement and velocity from the rectified frame, counter-clockwise",
       2}};
}

/// The loop, the files and the figures are those of motion in time; the steps are those of the
/// modes.
class ReducedAnalysis final : public DynamicAnalysis {
 public:
  ReducedAnalysis(const Case& c, const RunOptions& options)
      : DynamicAnalysis(c, options),
        case_(c),
        options_(options),
        run_(prepare_reduced(c, options, own_setup())) {
    plan_snapshots();
  }

  [[nodiscard]] Resumable* resumable() noexcept override { return nullptr; }
  void close() override { DynamicAnalysis::close(); }
  [[nodiscard]] RecordPlan record_plan() const override {
    RecordPlan plan = DynamicAnalysis::record_plan();
    if (!run_.lifts) plan_modes(run_, plan.results);
    return plan;
  }
  [[nodiscard]] std::vector<std::string> warnings() const override {
    std::vector<std::string> all = DynamicAnalysis::warnings();
    all.insert(all.end(), run_.warnings.begin(), run_.warnings.end());
    return all;
  }
  void take_tables() override {
    refuse_other_phases(case_, run_);
    DynamicAnalysis::take_tables();
    const std::size_t told = run_.warnings.size();
    warn_of_values(case_, own_setup(), run_);
    for (std::size_t k = told; k < run_.warnings.size(); ++k) warn(run_.warnings[k]);
  }
  void describe(Json& json) const override {
    DynamicAnalysis::describe(json);
    add_members(reduced_rows, {run_, options_}, json);
  }
  void summarise(Json& json, RunReport& report) const override {
    DynamicAnalysis::summarise(json, report);
    add_members(reduced_end_rows, {run_.figures, report.end_time}, json);
    report.notes.push_back("error estimate of the model: " + in_words(run_.file.estimate));
    report.step_wall_s = run_.figures.wall_s;
    report.slowest_step = run_.figures.slowest_step_s / setup().model.dt;
  }

 protected:
  [[nodiscard]] bool guards_impacts() const noexcept override {
    return sees_velocities_alone(run_);
  }
  [[nodiscard]] History::Length reported_length() const noexcept override {
    return History::Length::deformed;
  }
  [[nodiscard]] std::unique_ptr<dynamics::Integrator> make_integrator(
      dynamics::State& start) override {
    auto made = std::make_unique<rom::ReducedIntegrator>(
        rom::IntegratorInput{setup().mesh, setup().model, run_.file.model, run_.figures,
                             run_.scheme, lifts_states()},
        start);
    integrator_ = made.get();
    return made;
  }
  void complete(dynamics::State& state) override {
    if (integrator_ && !lifts_states()) integrator_->lift(state);
  }
  void add_series(const dynamics::State& state, Snapshot& snapshot) override {
    if (run_.lifts) return;
    if (integrator_)
      return fill_series(integrator_->displacement(), integrator_->state_velocity(),
                         {snapshot.angle, integrator_->state_velocity_angle()}, snapshot);
    rom::Lift lift(setup().mesh, run_.file.model);
    const std::vector<double>& mass = setup().model.mass;
    fill_series(lift.restrict_to_modes(0.0, state.u, mass),
                lift.restrict_to_modes(0.0, state.v, mass), {0.0, 0.0}, snapshot);
  }

 private:
  /// Probes want their cells at every row.
  [[nodiscard]] bool lifts_states() const noexcept { return run_.lifts || !setup().probes.empty(); }
  static void fill_series(const Eigen::VectorXd& q, const Eigen::VectorXd& p,
                          const std::array<double, 2>& angles, Snapshot& snapshot) {
    std::vector<double>& values = snapshot.series;
    values.assign(q.begin(), q.end());
    values.insert(values.end(), p.begin(), p.end());
    values.insert(values.end(), angles.begin(), angles.end());
  }

  const Case& case_;
  const RunOptions& options_;
  ReducedRun run_;
  rom::ReducedIntegrator* integrator_ = nullptr;  ///< none before the first step
};

}  // namespace

std::unique_ptr<Analysis> make_reduced(const Case& c, const RunOptions& options) {
  return std::make_unique<ReducedAnalysis>(c, options);
}

std::vector<MemberText> reduced_members() {
  return joined({texts_of(reduced_rows), texts_of(reduced_end_rows)});
}

}  // namespace rondo::study
