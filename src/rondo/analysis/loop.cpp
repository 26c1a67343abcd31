// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/loop.hpp"

#include <utility>

namespace rondo::study {

Looper::Looper(const LoopPlan& plan, Recorder& recorder)
    : plan_(plan), analysis_(plan.analysis), recorder_(recorder) {
  if (!plan.from) return;
  loop_.wall_s = plan.from->loop_wall_s;
  loop_.cpu_s = plan.from->loop_cpu_s;
}

void Looper::begin() {
  at_ = analysis_.begin(recorder_);
  if (plan_.options.progress) plan_.options.progress(at_.done, at_.all);
  look_for_trouble();
  saved_ = Clock::now();
}

void Looper::advance() {
  start_time();
  at_ = analysis_.advance(recorder_);
  look_for_trouble();
  const std::atomic<bool>* stop = plan_.options.stop;
  if (!is_over() && stop && stop->load(std::memory_order_relaxed)) interrupt();
  recorder_.keep_up();
  if (plan_.options.progress) plan_.options.progress(at_.done, at_.all);
  count_time();
  if (at_.done < at_.all && is_save_due()) save({});
  count_time();
}

void Looper::interrupt() noexcept {
  if (!is_over()) loop_.status = RunStatus::interrupted;
}

void Looper::look_for_trouble() {
  if (!analysis_.trouble()) return;
  loop_.status = RunStatus::failed;
  loop_.message = *analysis_.trouble();
}

void Looper::start_time() {
  since_ = Clock::now();
  cpu_since_ = std::clock();
}

void Looper::count_time() {
  const Clock::time_point since = since_;
  const std::clock_t cpu_since = cpu_since_;
  start_time();
  loop_.wall_s += std::chrono::duration<double>(since_ - since).count();
  loop_.cpu_s += static_cast<double>(cpu_since_ - cpu_since) / CLOCKS_PER_SEC;
}

bool Looper::is_save_due() const {
  const std::chrono::duration<double> since = Clock::now() - saved_;
  return analysis_.resumable() && loop_.status == RunStatus::done &&
         since.count() >= plan_.checkpoint_interval && !recorder_.is_saving();
}

void Looper::save(std::vector<double> last_row) {
  if (plan_.before_save) plan_.before_save();
  Checkpoint checkpoint = analysis_.resumable()->save();
  checkpoint.last_row = std::move(last_row);
  checkpoint.loop_wall_s = loop_.wall_s;
  checkpoint.loop_cpu_s = loop_.cpu_s;
  recorder_.save(std::move(checkpoint));
  saved_ = Clock::now();
}

/// A state that has failed is no place to go on from.
Loop Looper::finish() {
  start_time();
  const std::vector<double> row = analysis_.last_row();
  const bool kept = loop_.status == RunStatus::interrupted || plan_.options.keeps_checkpoint;
  if (loop_.status != RunStatus::failed && kept && analysis_.resumable()) save(row);
  recorder_.add_row(row);
  if (loop_.status == RunStatus::done) {
    analysis_.close();
    look_for_trouble();
  }
  count_time();
  return std::move(loop_);
}

}  // namespace rondo::study
