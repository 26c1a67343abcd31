// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/run_output.hpp"

#include <algorithm>
#include <limits>

namespace rondo::study {
namespace {

constexpr std::size_t rows_at_once = 32;
constexpr std::chrono::milliseconds longest_wait{200};  ///< of a row before it is handed over

std::vector<double> no_rows(std::size_t numbers) {
  std::vector<double> rows;
  rows.reserve(numbers);
  return rows;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

std::size_t queue_length(std::size_t n_snapshots, std::size_t bytes) noexcept {
  constexpr std::size_t rows_only = 8;  // slots for rows between the snapshots
  constexpr std::size_t most = 512;     // what is written must not be far behind the run
  const std::size_t wanted = std::min(n_snapshots + rows_only, most);
  return std::clamp<std::size_t>(output_queue_bytes / bytes, 2, wanted);
}

RunOutput::RunOutput(const std::filesystem::path& directory, const Case& c, const Setup& setup)
    : steps_(snapshot_steps(c.output.snapshots, c.output.snapshots_from, setup.model.dt,
                            setup.n_steps)),
      history_(c, setup),
      numbers_at_once_(rows_at_once * history_.columns().size()),
      rows_(no_rows(numbers_at_once_)),
      history_csv_(directory / "history.csv", history_.columns()),
      snapshots_(directory, c, setup, steps_.size()),
      slots_(make_slots(setup)),
      writer_(slots_.size(), [this](std::size_t slot) { write(slots_[slot]); }) {}

RunOutput::~RunOutput() {
  try {
    close();
  } catch (...) {  // reported where close() is called
  }
}

/// Their memory is reserved, and becomes the process's own as it is first written to: a run whose
/// output keeps up takes but a few of them.
std::vector<RunOutput::Slot> RunOutput::make_slots(const Setup& setup) const {
  const std::size_t nodes = steps_.empty() ? 0 : setup.model.n_nodes();
  const std::size_t contacts =
      steps_.empty() || !has_candidates(setup.model) ? 0 : 2 * setup.mesh.boundary.size();
  const std::size_t bytes = numbers_at_once_ * sizeof(double) + 2 * nodes * sizeof(Vec2) +
                            contacts * sizeof(dynamics::ActiveContact);
  std::vector<Slot> slots(queue_length(steps_.size(), bytes));
  for (Slot& slot : slots) {
    slot.rows = no_rows(numbers_at_once_);
    slot.state.u.reserve(nodes);
    slot.state.v.reserve(nodes);
    slot.state.active.reserve(contacts);
  }
  return slots;
}

long long RunOutput::next_snapshot() const noexcept {
  return next_ < steps_.size() ? steps_[next_] : std::numeric_limits<long long>::max();
}

void RunOutput::observe(const dynamics::StepReport& step, bool last, const dynamics::State* state) {
  history_.observe(step, last, state, rows_);
  if (rows_.size() == numbers_at_once_) push(nullptr);
}

void RunOutput::observe(const dynamics::State& state) {
  if (state.step != next_snapshot()) return;
  ++next_;
  push(&state);
}

void RunOutput::keep_up() {
  writer_.check();
  if (!rows_.empty() && Clock::now() - handed_over_ > longest_wait) push(nullptr);
}

void RunOutput::push(const dynamics::State* state) {
  const auto begin = Clock::now();
  const std::size_t number = writer_.take();
  Slot& slot = slots_[number];
  slot.rows.swap(rows_);
  rows_.clear();
  slot.snapshot = state != nullptr;
  if (slot.snapshot) {
    slot.state.step = state->step;
    slot.state.frame = state->frame;
    slot.state.u = state->u;
    slot.state.v = state->v;
    slot.state.poses = state->poses;
    slot.state.active = state->active;
  }
  writer_.hand_over(number);
  handed_over_ = Clock::now();
  wait_s_ += std::chrono::duration<double>(handed_over_ - begin).count();
}

void RunOutput::write(const Slot& slot) {
  history_csv_.rows(slot.rows);
  if (slot.snapshot) snapshots_.write(slot.state);
}

void RunOutput::close() {
  if (closed_) return;
  closed_ = true;
  if (!rows_.empty()) push(nullptr);
  const auto begin = Clock::now();
  writer_.finish();
  history_csv_.close();
  snapshots_.close();
  drain_s_ = seconds_since(begin);
}

OutputCost RunOutput::cost() const {
  return {wait_s_, drain_s_, writer_.busy_s(), writer_.times_full()};
}

}  // namespace rondo::study
