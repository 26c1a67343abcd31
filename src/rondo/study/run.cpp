// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/dynamics/stepper.hpp"
#include "rondo/io/files.hpp"
#include "rondo/study/build.hpp"
#include "rondo/study/case_source.hpp"
#include "rondo/study/crush_run.hpp"
#include "rondo/study/observers.hpp"
#include "rondo/study/run_files.hpp"
#include "rondo/study/run_output.hpp"
#include "rondo/study/version.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

/// Largest and total figures of the contact over a run.
struct ContactStatistics {
  double residual = 0.0;       ///< largest law residual over the largest |w_free| so far
  double free_velocity = 0.0;  ///< largest |w_free| so far                            [m/s]
  double penetration = 0.0;    ///< [m]
  long long contact_steps = 0;
  int nodes_max = 0;
  long long pairs = 0;
  long long pairs_not_converged = 0;
  long long clusters = 0;
  long long clusters_not_converged = 0;
  int cluster_largest = 0;
  int cluster_iterations = 0;  ///< most of one
  int between_bodies = 0;      ///< most in a step

  void add(const dynamics::ContactReport& r) {
    free_velocity = std::max(free_velocity, r.free_velocity);
    const double relative = r.residual / free_velocity;
    if (r.residual != 0.0 && !(relative <= residual)) residual = relative;  // NaN comes through
    penetration = std::max(penetration, r.penetration);
    contact_steps += r.nodes > 0 ? 1 : 0;
    nodes_max = std::max(nodes_max, r.nodes);
    pairs += r.pairs;
    pairs_not_converged += r.pairs_not_converged;
    clusters += r.clusters;
    clusters_not_converged += r.clusters_not_converged;
    cluster_largest = std::max(cluster_largest, r.cluster_largest);
    cluster_iterations = std::max(cluster_iterations, r.cluster_iterations);
    between_bodies = std::max(between_bodies, r.between_bodies);
  }
};

struct Loop {
  RunStatus status = RunStatus::done;
  std::string message;
  ContactStatistics contact;
  dynamics::Balance balance;
  long long steps = 0;
  double wall_s = 0.0;
  double cpu_s = 0.0;
  std::size_t snapshots = 0;
  int dumped = 0;  ///< contact problems kept as files
  OutputCost output;
};

/// What is out of bound, and when: a half step (velocities, ledger) comes before its step's
/// contact.
struct Trouble {
  std::string what;  ///< empty while all is well
  bool at_half_step = false;
  bool not_finite = false;
};

/// Name of the first quantity of the state that is not finite; `otherwise` if all are.
std::string not_finite(const dynamics::State& state, const std::string& otherwise) {
  const auto first = [](const std::vector<Vec2>& field, const char* name) -> std::string {
    for (std::size_t i = 0; i < field.size(); ++i)
      if (!std::isfinite(field[i].x) || !std::isfinite(field[i].y))
        return fmt::format("the {} of node {} is not finite", name, i);
    return {};
  };
  const std::string velocity = first(state.v_next, "velocity");
  const std::string found = velocity.empty() ? first(state.u, "displacement") : velocity;
  return found.empty() ? otherwise : found;
}

Trouble find_trouble(const dynamics::Balance& b, const ContactStatistics& contact,
                     double ledger_bound) {
  if (!std::isfinite(b.kinetic + b.strain) || !std::isfinite(b.residual))
    return {fmt::format("the energy is out of range (kinetic {:.3g}, strain {:.3g})", b.kinetic,
                        b.strain),
            true, true};
  if (std::abs(b.works.scheme) > 10.0 * b.otherwise)
    return {fmt::format("work_scheme = {:.6g} J/m, more than ten times the energy exchanged "
                        "otherwise ({:.6g} J/m): the scheme as printed has blown up",
                        b.works.scheme, b.otherwise),
            true};
  if (b.relative > ledger_bound)
    return {fmt::format("the energy ledger does not close: relative residual {:.3g}, bound {:.0e}",
                        b.relative, ledger_bound),
            true};
  if (!(contact.residual <= residual_bound))
    return {fmt::format("contact residual {:.3g}, bound {:.0e}", contact.residual, residual_bound),
            false};
  return {};
}

/// The message names the step that made the trouble: what a half step shows came from the step
/// before.
void judge(const Setup& setup, const dynamics::StepReport& step,
           const dynamics::Integrator& integrator, Loop& loop) {
  const double ledger_bound =
      setup.model.free_bodies.empty() ? residual_bound : free_residual_bound;
  Trouble trouble = find_trouble(step.balance, loop.contact, ledger_bound);
  if (trouble.what.empty()) return;
  if (trouble.not_finite) {
    dynamics::State now(setup.model);  // after the steps of this call
    integrator.fields(now);
    trouble.what = not_finite(now, trouble.what);
  }
  loop.status = RunStatus::failed;
  const double half = trouble.at_half_step ? 0.5 * setup.model.dt : 0.0;
  loop.message =
      fmt::format("step {} of {}, t = {:.9g} s: {}", step.step - (trouble.at_half_step ? 1 : 0),
                  setup.n_steps, step.frame.time - half, trouble.what);
}

/// Steps made in one call: enough to hide what a call costs, few enough to hear a signal soon.
std::size_t steps_at_once(const Setup& setup) {
  const bool cyclic = setup.model.stiffness_operator == dynamics::StiffnessOperator::cyclic;
  const double dof_steps = cyclic ? 5e7 : 1e7;  // some 0.05 s
  const double fewest = cyclic ? 8.0 : 1.0;     // two passes of the cyclic operator
  const double dofs = 2.0 * static_cast<double>(setup.model.free.size());
  return static_cast<std::size_t>(std::clamp(dof_steps / dofs, fewest, 64.0));
}

/// Contact problems kept as files, at the most.
constexpr int most_dumped = 1000;

/// The loop of a run and what it works with.
class Runner {
 public:
  /// Takes the initial fields of the setup, which are not needed twice.
  Runner(const Case& c, Setup& setup, const RunOptions& options, RunOutput& output)
      : title_(c.title),
        setup_(setup),
        options_(options),
        output_(output),
        reports_(steps_at_once(setup)),
        state_(start(setup.model, std::move(setup.displacement), std::move(setup.velocity))) {}

  Loop run() {
    output_.observe(state_);
    for (std::vector<Vec2>* field : {&state_.v, &state_.force_before})
      std::vector<Vec2>().swap(*field);  // memory that the integrator will have
    integrator_ = make_integrator(setup_.model, state_);
    for (std::vector<Vec2>* field : {&state_.force, &state_.v_next})
      std::vector<Vec2>().swap(*field);
    state_.v.resize(state_.u.size());
    const auto wall = Clock::now();
    const std::clock_t cpu = std::clock();
    while (loop_.steps < setup_.n_steps && loop_.status == RunStatus::done) advance();
    if (loop_.status == RunStatus::done) close_ledger();
    loop_.wall_s = std::chrono::duration<double>(Clock::now() - wall).count();
    loop_.cpu_s = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    return std::move(loop_);
  }

 private:
  /// Steps up to the next one whose state is wanted, at most as many as there are reports.
  void advance() {
    const long long left = std::min(setup_.n_steps, output_.next_state()) - loop_.steps;
    const auto n =
        static_cast<std::size_t>(std::min(static_cast<long long>(reports_.size()), left));
    const std::span reports = std::span(reports_).first(n);
    // With probes a run that is interrupted has a last row of its own.
    const bool seen = reports.size() == static_cast<std::size_t>(left) || !setup_.probes.empty();
    integrator_->advance(reports, seen ? &state_ : nullptr);
    keep_difficult_contacts();
    const bool stop = options_.stop && options_.stop->load(std::memory_order_relaxed);
    for (std::size_t i = 0; i < n && loop_.status == RunStatus::done; ++i)
      take(reports[i], stop && i + 1 == n, seen && i + 1 == n ? &state_ : nullptr);
    if (seen && state_.step == loop_.steps) output_.observe(state_);
    output_.keep_up();
    if (options_.progress) options_.progress(loop_.steps, setup_.n_steps);
  }

  void take(const dynamics::StepReport& step, bool stop, const dynamics::State* state) {
    ++loop_.steps;
    loop_.contact.add(step.contact);
    loop_.balance = step.balance;
    judge(setup_, step, *integrator_, loop_);
    if (loop_.status == RunStatus::done && stop) loop_.status = RunStatus::interrupted;
    output_.observe(step, loop_.steps == setup_.n_steps || loop_.status != RunStatus::done, state);
  }

  void keep_difficult_contacts() {
    if (setup_.model.coupled.dump_above == 0) return;
    for (contact::ProblemFile& problem : integrator_->take_difficult()) {
      if (loop_.dumped == most_dumped) return;
      problem.about = fmt::format("{}, after step {}", title_, loop_.steps);
      write_contact_problem(options_.directory, ++loop_.dumped, problem);
    }
  }

  /// A step's works are compared once the next half step is known: one step more, which nobody
  /// sees, brings the last ones into the balance.
  void close_ledger() {
    dynamics::StepReport& beyond = reports_.front();
    integrator_->advance({&beyond, 1});
    loop_.balance = beyond.balance;
    judge(setup_, beyond, *integrator_, loop_);
  }

  const std::string& title_;
  const Setup& setup_;
  const RunOptions& options_;
  RunOutput& output_;
  std::vector<dynamics::StepReport> reports_;
  dynamics::State state_;
  std::unique_ptr<dynamics::Integrator> integrator_;
  Loop loop_;
};

Json describe(const Case& c, const Setup& setup) {
  Json j = describe_run(c, "dynamic", setup.model.n_nodes(), 2 * setup.model.free.size());
  if (c.mesh) j["mesh_file"] = as_utf8(c.mesh->file.string());
  j["bodies"] = count_bodies(setup.model);
  j["free_bodies"] = setup.model.free_bodies.size();
  j["operator"] = operator_name(setup.model.stiffness_operator);
  j["threads"] = setup.model.threads;
  j["critical_step"] = setup.critical.step;
  j["largest_frequency"] = setup.critical.omega;
  j["step"] = setup.model.dt;
  j["steps"] = setup.n_steps;
  j["dispatch"] = dispatch_level();
  return j;
}

double per_dof_step(const Setup& setup, const Loop& loop) {
  const double dofs = 2.0 * static_cast<double>(setup.model.free.size());
  return 1e9 * loop.wall_s / (dofs * static_cast<double>(std::max(1LL, loop.steps)));
}

Json describe(const OutputCost& cost) {
  return {{"wait_wall_s", cost.wait_wall_s},
          {"drain_wall_s", cost.drain_wall_s},
          {"write_wall_s", cost.write_wall_s},
          {"queue_full", cost.queue_full}};
}

void add_outcome(Json& j, const Setup& setup, const Loop& loop) {
  add_status(j, loop.status, loop.message);
  j["steps_done"] = loop.steps;
  j["end_time"] = static_cast<double>(loop.steps) * setup.model.dt;
  j["loop_wall_s"] = loop.wall_s;
  j["loop_cpu_s"] = loop.cpu_s;
  j["ns_per_dof_step"] = per_dof_step(setup, loop);
  j["energy_residual_relative"] = loop.balance.relative;
  j["energy_exchanged"] = loop.balance.exchanged;
  j["contact_residual_max"] = loop.contact.residual;
  j["penetration_max_m"] = loop.contact.penetration;
  j["contact"] = {{"steps_in_contact", loop.contact.contact_steps},
                  {"nodes_max", loop.contact.nodes_max},
                  {"free_velocity_max", loop.contact.free_velocity},
                  {"pairs_solved", loop.contact.pairs},
                  {"pairs_not_converged", loop.contact.pairs_not_converged},
                  {"clusters_solved", loop.contact.clusters},
                  {"clusters_not_converged", loop.contact.clusters_not_converged},
                  {"cluster_largest", loop.contact.cluster_largest},
                  {"cluster_iterations_max", loop.contact.cluster_iterations},
                  {"between_bodies_max", loop.contact.between_bodies},
                  {"problems_kept", loop.dumped}};
  j["peak_memory_bytes"] = peak_memory_bytes();
  j["snapshots"] = loop.snapshots;
  j["output"] = describe(loop.output);
}

RunReport report_of(const Setup& setup, const Loop& loop) {
  RunReport r;
  r.status = loop.status;
  r.message = loop.message;
  r.steps = loop.steps;
  r.end_time = static_cast<double>(loop.steps) * setup.model.dt;
  r.loop_wall_s = loop.wall_s;
  r.ns_per_dof_step = per_dof_step(setup, loop);
  r.energy_residual_relative = loop.balance.relative;
  r.contact_residual_max = loop.contact.residual;
  r.penetration_max_m = loop.contact.penetration;
  r.snapshots = loop.snapshots;
  return r;
}

std::vector<std::string> all_warnings(const Case& c, const Setup& setup) {
  std::vector<std::string> warnings = c.warnings;
  warnings.insert(warnings.end(), setup.warnings.begin(), setup.warnings.end());
  const std::size_t there =
      snapshot_steps(c.output.snapshots, c.output.snapshots_from, setup.model.dt, setup.n_steps)
          .size();
  if (there < static_cast<std::size_t>(c.output.snapshots))
    warnings.push_back(
        fmt::format("{} snapshots instead of {}: the run has {} steps, and each gives one "
                    "at the most",
                    there, c.output.snapshots, setup.n_steps));
  return warnings;
}

/// The loop with its output. A file that cannot be written ends the run: run.json says so, where
/// it can still be written itself.
Loop record(const Case& c, Setup& setup, const RunOptions& options, const Json& json) {
  try {
    RunOutput output(options.directory, c, setup);
    Loop loop = Runner(c, setup, options, output).run();
    output.close();
    loop.snapshots = output.written();
    loop.output = output.cost();
    return loop;
  } catch (const FileError& error) {
    note_failure(options, json, error);
    throw;
  }
}

}  // namespace

RunReport run_case(const Case& c, const RunOptions& options) {
  if (c.analysis.kind == AnalysisKind::crush) return run_crush(c, options);
  const auto begin = Clock::now();
  static_cast<void>(dispatch_level());  // a wrong one is told before anything is built
  Setup setup = build(c, options.threads);
  give_warnings(all_warnings(c, setup), options);
  Json json = describe(c, setup);
  begin_directory(c, options, json);

  const Loop loop = record(c, setup, options, json);
  add_outcome(json, setup, loop);
  json["total_wall_s"] = std::chrono::duration<double>(Clock::now() - begin).count();
  io::write_json(options.directory / "run.json", json);
  return report_of(setup, loop);
}

}  // namespace rondo::study
