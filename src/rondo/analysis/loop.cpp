// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/loop.hpp"

#include <chrono>
#include <ctime>
#include <utility>

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

class Looper {
 public:
  Looper(const LoopPlan& plan, Recorder& recorder)
      : plan_(plan), analysis_(plan.analysis), recorder_(recorder) {
    if (!plan.from) return;
    wall_before_ = plan.from->loop_wall_s;
    cpu_before_ = plan.from->loop_cpu_s;
  }

  Loop run() {
    const Progress at = analysis_.begin(recorder_);
    if (plan_.options.progress) plan_.options.progress(at.done, at.all);
    look_for_trouble();
    begin_ = saved_ = Clock::now();
    cpu_begin_ = std::clock();
    make_all(at);
    finish();
    count_time();
    return std::move(loop_);
  }

 private:
  void make_all(Progress at) {
    while (loop_.status == RunStatus::done && at.done < at.all) {
      at = analysis_.advance(recorder_);
      look_for_trouble();
      const std::atomic<bool>* stop = plan_.options.stop;
      if (loop_.status == RunStatus::done && at.done < at.all && stop &&
          stop->load(std::memory_order_relaxed))
        loop_.status = RunStatus::interrupted;
      recorder_.keep_up();
      if (plan_.options.progress) plan_.options.progress(at.done, at.all);
      count_time();
      if (at.done < at.all && is_save_due()) save({});
    }
  }

  void look_for_trouble() {
    if (!analysis_.trouble()) return;
    loop_.status = RunStatus::failed;
    loop_.message = *analysis_.trouble();
  }

  void count_time() {
    loop_.wall_s = wall_before_ + std::chrono::duration<double>(Clock::now() - begin_).count();
    loop_.cpu_s = cpu_before_ + static_cast<double>(std::clock() - cpu_begin_) / CLOCKS_PER_SEC;
  }

  [[nodiscard]] bool is_save_due() const {
    const std::chrono::duration<double> since = Clock::now() - saved_;
    return analysis_.resumable() && loop_.status == RunStatus::done &&
           since.count() >= plan_.checkpoint_interval && !recorder_.is_saving();
  }

  void save(std::vector<double> last_row) {
    Checkpoint checkpoint = analysis_.resumable()->save();
    checkpoint.last_row = std::move(last_row);
    checkpoint.loop_wall_s = loop_.wall_s;
    checkpoint.loop_cpu_s = loop_.cpu_s;
    recorder_.save(std::move(checkpoint));
    saved_ = Clock::now();
  }

  /// A state that has failed is no place to go on from.
  void finish() {
    const std::vector<double> row = analysis_.last_row();
    const bool kept = loop_.status == RunStatus::interrupted || plan_.options.keeps_checkpoint;
    if (loop_.status != RunStatus::failed && kept && analysis_.resumable()) save(row);
    recorder_.add_row(row);
    if (loop_.status != RunStatus::done) return;
    analysis_.close();
    look_for_trouble();
  }

  const LoopPlan& plan_;
  Analysis& analysis_;
  Recorder& recorder_;
  Loop loop_;
  double wall_before_ = 0.0, cpu_before_ = 0.0;
  Clock::time_point begin_{}, saved_{};  ///< saved_: the last checkpoint handed over
  std::clock_t cpu_begin_ = 0;
};

}  // namespace

Loop run_loop(const LoopPlan& plan, Recorder& recorder) {
  return Looper(plan, recorder).run();
}

}  // namespace rondo::study
