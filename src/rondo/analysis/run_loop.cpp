// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/run_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "rondo/analysis/out_of_range.hpp"
#include "rondo/analysis/reduced_run.hpp"
#include "rondo/core/keep_larger.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {

void ContactStatistics::add(const dynamics::ContactReport& r) noexcept {
  free_velocity = std::max(free_velocity, r.free_velocity);
  const double relative = r.residual / free_velocity;
  if (r.residual != 0.0) residual = keep_larger(residual, relative);
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

namespace {

using Clock = std::chrono::steady_clock;

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

/// Largest values that are no trouble.
struct Bounds {
  double ledger = 0.0;         ///< relative residual
  double strain_energy = 0.0;  ///< [J/m]
};

Trouble find_trouble(const dynamics::Balance& b, const ContactStatistics& contact,
                     const Bounds& bounds) {
  if (!std::isfinite(b.kinetic + b.strain) || !std::isfinite(b.residual))
    return {fmt::format("the energy is out of range (kinetic {:.3g}, strain {:.3g})", b.kinetic,
                        b.strain),
            true, true};
  if (std::abs(b.works.scheme) > 10.0 * b.otherwise)
    return {fmt::format("work_scheme = {:.6g} J/m, more than ten times the energy exchanged "
                        "otherwise ({:.6g} J/m): the scheme as printed has blown up",
                        b.works.scheme, b.otherwise),
            true};
  if (std::abs(b.strain) > bounds.strain_energy)
    return {fmt::format("the strain energy, {:.3g} J/m, is that of strains above 100: the body has "
                        "left what small strains mean",
                        b.strain),
            true};
  if (b.relative > bounds.ledger)
    return {fmt::format("the energy ledger does not close: relative residual {:.3g}, bound {:.0e}",
                        b.relative, bounds.ledger),
            true};
  if (!(contact.residual <= residual_bound))
    return {fmt::format("contact residual {:.3g}, bound {:.0e}", contact.residual, residual_bound),
            false};
  return {};
}

/// The message names the step that made the trouble: what a half step shows came from the step
/// before.
void judge(const Setup& setup, const Bounds& bounds, const dynamics::StepReport& step,
           const dynamics::Integrator& integrator, Loop& loop) {
  Trouble trouble = find_trouble(step.balance, loop.contact, bounds);
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
  Runner(const LoopPlan& plan, Setup& setup, RunOutput& output)
      : plan_(plan),
        setup_(setup),
        output_(output),
        bounds_{setup.model.free_bodies.empty() ? residual_bound : free_residual_bound,
                largest_strain_energy(setup)},
        reports_(steps_at_once(setup)),
        state_(start(setup.model, std::move(setup.displacement), std::move(setup.velocity))) {}

  Loop run() {
    if (!plan_.from) observe_state();
    make_integrator();
    if (plan_.options.progress) plan_.options.progress(loop_.steps, setup_.n_steps);
    const auto wall = Clock::now();
    const std::clock_t cpu = std::clock();
    saved_ = wall;
    const double wall_before = loop_.wall_s, cpu_before = loop_.cpu_s;
    const auto count_time = [&] {
      loop_.wall_s = wall_before + std::chrono::duration<double>(Clock::now() - wall).count();
      loop_.cpu_s = cpu_before + static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    };
    while (loop_.steps < setup_.n_steps && loop_.status == RunStatus::done) {
      advance();
      count_time();
      if (is_save_due()) save();
    }
    finish();
    count_time();
    return std::move(loop_);
  }

 private:
  /// Memory that the integrator has as well is given back.
  void make_integrator() {
    std::vector<Vec2>().swap(state_.force_before);
    if (!plan_.reduced) std::vector<Vec2>().swap(state_.v);
    integrator_ = plan_.reduced ? study::make_integrator(*plan_.reduced, setup_, state_)
                                : dynamics::make_integrator(setup_.model, state_);
    for (std::vector<Vec2>* field : {&state_.force, &state_.v_next})
      std::vector<Vec2>().swap(*field);
    state_.v.resize(state_.u.size());
    if (!plan_.from) return;
    dynamics::SavedState& state = plan_.from->state;
    integrator_->resumable()->restore(state);
    const long long step = state.step;
    state = {};  // as much memory as the steps have
    state.step = step;
    loop_.contact = plan_.from->contact;
    loop_.steps = plan_.from->state.step;
    loop_.wall_s = plan_.from->loop_wall_s;
    loop_.cpu_s = plan_.from->loop_cpu_s;
    loop_.dumped = plan_.from->problems_kept;
  }

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
    const std::atomic<bool>* stop = plan_.options.stop;
    const bool stopped = stop && stop->load(std::memory_order_relaxed);
    for (std::size_t i = 0; i < n && loop_.status == RunStatus::done; ++i) {
      last_ = &reports[i];
      last_state_ = seen && i + 1 == n ? &state_ : nullptr;
      take(*last_, last_state_);
    }
    if (loop_.status == RunStatus::done && stopped && loop_.steps < setup_.n_steps)
      loop_.status = RunStatus::interrupted;
    if (seen && state_.step == loop_.steps) observe_state();
    output_.keep_up();
    if (plan_.options.progress) plan_.options.progress(loop_.steps, setup_.n_steps);
  }

  void take(const dynamics::StepReport& step, const dynamics::State* state) {
    ++loop_.steps;
    loop_.contact.add(step.contact);
    loop_.balance = step.balance;
    judge(setup_, bounds_, step, *integrator_, loop_);
    output_.observe(step, state);
  }

  /// A snapshot, if one is due and the files can hold it.
  void observe_state() {
    const std::string beyond =
        state_.step == output_.next_snapshot() ? beyond_files(setup_, state_) : std::string();
    if (beyond.empty()) return output_.observe(state_);
    if (loop_.status == RunStatus::failed) return;  // and that is why
    loop_.status = RunStatus::failed;
    loop_.message = fmt::format("step {} of {}, t = {:.9g} s: {}", state_.step, setup_.n_steps,
                                state_.frame.time, beyond);
  }

  void keep_difficult_contacts() {
    if (setup_.model.coupled.dump_above == 0) return;
    for (contact::ProblemFile& problem : integrator_->take_difficult()) {
      if (loop_.dumped == most_dumped) return;
      problem.about = fmt::format("{}, after step {}", plan_.c.title, loop_.steps);
      write_contact_problem(plan_.options.directory, ++loop_.dumped, problem);
    }
  }

  [[nodiscard]] bool is_save_due() const {
    const std::chrono::duration<double> since = Clock::now() - saved_;
    return integrator_->resumable() && loop_.status == RunStatus::done &&
           loop_.steps < setup_.n_steps && since.count() >= plan_.c.output.checkpoint_interval &&
           !output_.is_saving();
  }

  void save(std::vector<double> last_row = {}) {
    Checkpoint checkpoint;
    checkpoint.last_row = std::move(last_row);
    checkpoint.identity = plan_.identity;
    checkpoint.state = integrator_->resumable()->save();
    checkpoint.n_steps = setup_.n_steps;
    checkpoint.contact = loop_.contact;
    checkpoint.problems_kept = loop_.dumped;
    checkpoint.loop_wall_s = loop_.wall_s;
    checkpoint.loop_cpu_s = loop_.cpu_s;
    output_.save(std::move(checkpoint));
    saved_ = Clock::now();
  }

  /// A state that has failed is no place to go on from.
  void finish() {
    if (!last_ && !plan_.from) return;  // the start itself is out of range
    const std::vector<double> row =
        last_ ? output_.last_row(*last_, last_state_) : plan_.from->last_row;
    const bool kept = loop_.status == RunStatus::interrupted || plan_.options.keeps_checkpoint;
    if (loop_.status != RunStatus::failed && kept && integrator_->resumable()) save(row);
    output_.add_row(row);
    if (loop_.status == RunStatus::done) close_ledger();
  }

  /// A step's works are compared once the next half step is known: one step more, which nobody
  /// sees, brings the last ones into the balance.
  void close_ledger() {
    dynamics::StepReport beyond;
    integrator_->advance({&beyond, 1});
    loop_.balance = beyond.balance;
    judge(setup_, bounds_, beyond, *integrator_, loop_);
  }

  const LoopPlan& plan_;
  const Setup& setup_;
  RunOutput& output_;
  const Bounds bounds_;
  std::vector<dynamics::StepReport> reports_;
  dynamics::State state_;
  std::unique_ptr<dynamics::Integrator> integrator_;
  Loop loop_;
  Clock::time_point saved_;                     ///< the last checkpoint handed over
  const dynamics::StepReport* last_ = nullptr;  ///< the last step taken; none: all were made before
  const dynamics::State* last_state_ = nullptr;  ///< its state, if it is at hand
};

}  // namespace

Loop run_loop(const LoopPlan& plan, Setup& setup, RunOutput& output) {
  return Runner(plan, setup, output).run();
}

}  // namespace rondo::study
