// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/analysis/build/stability.hpp"
#include "rondo/analysis/registry.hpp"
#include "rondo/analysis/simulation/drive.hpp"
#include "rondo/case/case_keys.hpp"
#include "rondo/core/error.hpp"

namespace rondo::study {
namespace {

Stepwise& demand_stepwise(const Case& c, Analysis& analysis) {
  if (Stepwise* found = analysis.stepwise()) return *found;
  throw case_error(c, "analysis.kind", "is no motion in time and has no steps",
                   "\"dynamic\"; other analyses are solved as a whole");
}

void refuse_what_wants_files(const Case& c, const RunOptions& options) {
  if (!options.directory.empty()) return;
  if (options.resume)
    throw request_error("resume", "", "a run in memory has no checkpoint to resume from",
                        "the results directory of a run");
  if (c.dump_contacts > 0)
    throw case_error(c, "solver.dump_contacts", "a run in memory keeps no files",
                     "0, or a results directory");
}

/// It is not the value in the file that is wrong.
InputError as_set(const InputError& error, const std::vector<DrivenValue>& values) {
  std::vector<Fault> faults = error.faults();
  for (Fault& fault : faults) {
    fault.file.clear();
    fault.line = fault.column = 0;
    const auto meant = std::find_if(values.begin(), values.end(),
                                    [&](const DrivenValue& one) { return one.first == fault.key; });
    fault.found = fmt::format("{}", (meant == values.end() ? values.front() : *meant).second);
  }
  return InputError(std::move(faults));
}

}  // namespace

Simulation::Simulation(Case c, RunOptions options)
    : case_(std::move(c)), options_(std::move(options)) {
  static_cast<void>(dispatch_level());  // a wrong one is told before anything is built
  refuse_what_wants_files(case_, options_);
  analysis_ = make_analysis(case_, options_);
  stepwise_ = &demand_stepwise(case_, *analysis_);
  columns_ = stepwise_->row_columns();
  if (options_.directory.empty()) memory_.emplace(analysis_->record_plan(), false);
  stepwise_->pause_at(0);
  session_.emplace(*analysis_, case_, options_, memory_ ? &*memory_ : nullptr);
}

Simulation::~Simulation() = default;

double Simulation::end_time() const noexcept {
  return static_cast<double>(steps_made()) * setup().model.dt;
}

std::string Simulation::trouble() const {
  return analysis_->trouble().value_or(std::string());
}

void Simulation::aim(long long step) {
  target_ = std::clamp(step, steps_made(), setup().n_steps);
  stepwise_->pause_at(target_);
}

bool Simulation::go_on(double seconds) {
  using Clock = RunSession::Clock;
  const auto begin = Clock::now();
  while (!session_->is_over() && steps_made() < target_) {
    session_->advance();
    if (std::chrono::duration<double>(Clock::now() - begin).count() > seconds) break;
  }
  const bool there = session_->is_over() || steps_made() >= target_;
  if (there && shown_) fill();
  return there;
}

/// The frame and the loads of the next step are known already: its end is at t_{n+1}.
void Simulation::drive(const std::vector<DrivenValue>& values, double over) {
  const double dt = setup().model.dt;
  if (!(over >= 0.0) || !std::isfinite(over))
    throw request_error("over", fmt::format("{}", over), "is no duration of a change",
                        "a number of seconds, 0 or more");
  std::vector<dynamics::Table*> tables;
  for (const auto& [key, value] : values) tables.push_back(&driven_table(case_, key, value));
  if (values.empty()) return;
  if (session_->is_over()) {
    if (steps_made() >= setup().n_steps) return;  // a loop over rows comes here with its last one
    throw request_error(values.front().first, fmt::format("{}", values.front().second),
                        "the run has come to its end", "");
  }
  const double from = (static_cast<double>(steps_made()) + 1.25) * dt;
  std::vector<dynamics::Table> before;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    before.push_back(*tables[k]);
    *tables[k] = led_over(before[k], from, from + std::max(over, 0.5 * dt), values[k].second);
  }
  try {
    check_driven(values, from);
    stepwise_->take_tables();
  } catch (const InputError& error) {
    for (std::size_t k = tables.size(); k-- > 0;) *tables[k] = std::move(before[k]);
    throw as_set(error, values);
  }
  session_->case_changed();
}

/// By what the case is refused that `rondo run` and a resume would read. Rules between keys ask
/// whether there is a motion, not how fast it is: they are asked once for each key that is 0 and
/// that is not, of a case whose tables are short.
void Simulation::check_driven(const std::vector<DrivenValue>& values, double from) {
  bool is_new = false;
  Case short_one = case_;
  for (const auto& [key, value] : values) {
    const dynamics::Table& table = driven_table(case_, key);
    if (!std::isfinite(table.at(from)) || !std::isfinite(table.slope(from)))
      throw request_error(key, fmt::format("{}", value), "is too far from the value before",
                          "a value that is nearer");
    driven_table(short_one, key) =
        dynamics::Table({{0.0, table.at(0.0)}, {std::max(from, 1.0), value}});
    is_new = checked_.insert({key, value == 0.0}).second || is_new;
  }
  check_places(case_, setup().mesh);
  if (is_new) static_cast<void>(read_case_text(case_.file, write_case(short_one)));
}

double Simulation::driven(const std::string& key) {
  return driven_table(case_, key).at(end_time());
}

void Simulation::fill() {
  const dynamics::State* state = stepwise_->state();
  if (!state) return;
  std::ranges::copy(FieldView(state->u).values, shown_->displacement.begin());
  std::ranges::copy(FieldView(state->v).values, shown_->velocity.begin());
}

std::shared_ptr<const ShownFields> Simulation::fields() {
  if (!stepwise_->state()) return nullptr;
  if (!shown_) {
    auto shown = std::make_shared<ShownFields>();
    shown->nodes = setup().mesh.n_nodes();
    shown->components = setup().model.solid ? 3 : 2;
    shown->displacement.resize(shown->nodes * shown->components);
    shown->velocity.resize(shown->nodes * shown->components);
    shown_ = std::move(shown);
    fill();
  }
  return shown_;
}

const std::vector<double>* Simulation::rows() const noexcept {
  return memory_ ? &memory_->rows() : nullptr;
}

void Simulation::save() {
  if (!keeps_checkpoints())
    throw request_error("save", "", "this run keeps no checkpoints",
                        "a run that is not reduced, with a results directory");
  if (session_->is_over())
    throw request_error("save", "", "the run has ended, and cannot be resumed",
                        "a checkpoint before its end");
  session_->save();
}

RunReport Simulation::finish() {
  session_->interrupt();
  return session_->finish();
}

}  // namespace rondo::study
