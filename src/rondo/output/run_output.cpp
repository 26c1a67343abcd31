// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/run_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "rondo/io/files.hpp"

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

namespace {

/// The steps whose snapshots are there already.
std::size_t n_taken(const SnapshotSchedule& schedule, const Checkpoint* from) {
  if (!from) return 0;
  const auto& steps = schedule.steps;
  return static_cast<std::size_t>(std::upper_bound(steps.begin(), steps.end(), from->state.step) -
                                  steps.begin());
}

io::Csv history_file(const std::filesystem::path& directory,
                     const std::vector<std::string>& columns, const Checkpoint* from) {
  const std::filesystem::path file = directory / "history.csv";
  return from ? io::Csv(file, columns, from->files.history_bytes) : io::Csv(file, columns);
}

Snapshots snapshot_files(const RunOutput::Plan& plan, const Checkpoint* from) {
  const std::size_t planned = plan.schedule.steps.size();
  if (!from) return {plan.directory, plan.c, plan.setup, planned};
  return {plan.directory,           plan.c, plan.setup, planned, from->files.snapshots,
          from->files.contact_bytes};
}

}  // namespace

RunOutput::RunOutput(const Plan& plan, const Checkpoint* from)
    : directory_(plan.directory),
      schedule_(plan.schedule),
      next_(n_taken(schedule_, from)),
      history_(plan.c, plan.setup, from ? from->history : HistoryPlace{}),
      n_columns_(static_cast<std::ptrdiff_t>(history_.columns().size())),
      numbers_at_once_(rows_at_once * history_.columns().size()),
      rows_(no_rows(numbers_at_once_)),
      saved_step_(from ? from->state.step : 0),
      snapshots_(snapshot_files(plan, from)),
      history_csv_(history_file(plan.directory, history_.columns(), from)),
      slots_(make_slots(plan.setup)),
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
  const std::size_t nodes = schedule_.steps.empty() ? 0 : setup.model.n_nodes();
  const std::size_t contacts =
      schedule_.steps.empty() || !has_candidates(setup.model) ? 0 : 2 * setup.mesh.boundary.size();
  const std::size_t bytes = numbers_at_once_ * sizeof(double) + 2 * nodes * sizeof(Vec2) +
                            contacts * sizeof(dynamics::ActiveContact);
  std::vector<Slot> slots(queue_length(schedule_.steps.size(), bytes));
  for (Slot& slot : slots) {
    slot.rows = no_rows(numbers_at_once_);
    slot.state.u.reserve(nodes);
    slot.state.v.reserve(nodes);
    slot.state.active.reserve(contacts);
  }
  return slots;
}

long long RunOutput::next_snapshot() const noexcept {
  return next_ < schedule_.steps.size() ? schedule_.steps[next_]
                                        : std::numeric_limits<long long>::max();
}

void RunOutput::observe(const dynamics::StepReport& step, const dynamics::State* state) {
  history_.observe(step, state, rows_);
  if (rows_.size() == numbers_at_once_) push(nullptr);
}

void RunOutput::observe(const dynamics::State& state) {
  if (state.step != next_snapshot()) return;
  ++next_;
  push(&state);
}

std::vector<double> RunOutput::last_row(const dynamics::StepReport& step,
                                        const dynamics::State* state) {
  std::vector<double> row;
  history_.finish(step, state, row);
  return row;
}

void RunOutput::add_row(std::span<const double> row) {
  rows_.insert(rows_.end(), row.begin(), row.end());
}

void RunOutput::save(Checkpoint checkpoint) {
  checkpoint.history = history_.place();
  checkpoint.schedule = schedule_;
  saving_ = true;
  push(nullptr, std::move(checkpoint));
}

void RunOutput::keep_up() {
  writer_.check();
  if (!rows_.empty() && Clock::now() - handed_over_ > longest_wait) push(nullptr);
}

void RunOutput::push(const dynamics::State* state, std::optional<Checkpoint> checkpoint) {
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
  slot.checkpoint = std::move(checkpoint);
  writer_.hand_over(number);
  handed_over_ = Clock::now();
  wait_s_ += std::chrono::duration<double>(handed_over_ - begin).count();
}

void RunOutput::write(Slot& slot) {
  history_csv_.rows(slot.rows);
  if (!slot.rows.empty()) kept_until_ = *(slot.rows.end() - n_columns_);  // starts the last row
  if (slot.snapshot) snapshots_.write(slot.state);
  if (!slot.checkpoint) return;
  write(*slot.checkpoint);
  slot.checkpoint.reset();
  saving_ = false;
}

/// What it says of the other files must be true whatever happens to the machine: they are synced
/// first.
void RunOutput::write(Checkpoint& checkpoint) {
  io::sync_file(history_csv_.path());
  snapshots_.sync();
  checkpoint.files = {history_csv_.bytes(), snapshots_.contact_bytes(), snapshots_.written()};
  write_checkpoint(directory_, checkpoint);
  saved_step_ = checkpoint.state.step;
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

std::string RunOutput::kept() {
  try {
    close();
  } catch (...) {  // what is asked about
  }
  return fmt::format("kept are history.csv to t = {:.9g} s and {} snapshots", kept_until_,
                     snapshots_.written());
}

OutputCost RunOutput::cost() const {
  return {wait_s_, drain_s_, writer_.busy_s(), writer_.times_full()};
}

}  // namespace rondo::study
