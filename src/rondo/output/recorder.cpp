// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/io/files.hpp"
#include "rondo/output/snapshot_files.hpp"

namespace rondo::study {
namespace {

constexpr const char* history_name = "history.csv";
constexpr std::size_t rows_at_once = 32;
constexpr std::chrono::milliseconds longest_wait{200};  ///< for a row to be handed over

std::vector<double> no_rows(std::size_t numbers) {
  std::vector<double> rows;
  rows.reserve(numbers);
  return rows;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::optional<io::Csv> history_file(const std::filesystem::path& directory,
                                    const std::vector<ColumnLabel>& columns,
                                    const Checkpoint* from) {
  if (columns.empty()) return {};
  const std::filesystem::path file = directory / history_name;
  const std::vector<std::string> names = names_of(columns);
  return from ? io::Csv(file, names, from->files.table(history_name)) : io::Csv(file, names);
}

/// Time in the last complete row of history.csv at the checkpoint; 0: it has no row.
double time_kept(const std::filesystem::path& directory, const Checkpoint* from) {
  if (!from) return 0.0;
  std::ifstream file(directory / history_name, std::ios::binary);
  std::string text(from->files.table(history_name).bytes, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (text.size() < 2) return 0.0;
  const std::size_t row = text.rfind('\n', text.size() - 2) + 1;
  return row == 0 ? 0.0 : std::strtod(text.c_str() + row, nullptr);
}

[[maybe_unused]] bool times_increase(std::span<const double> rows, std::size_t n_columns) {
  for (std::size_t i = n_columns; i < rows.size(); i += n_columns)
    if (!(rows[i] > rows[i - n_columns])) return false;
  return true;
}

}  // namespace

std::size_t queue_length(std::size_t n_snapshots, std::size_t bytes) noexcept {
  constexpr std::size_t rows_only = 8;  // slots for rows between snapshots
  constexpr std::size_t most = 512;     // so that writing is never far behind the run
  const std::size_t wanted = std::min(n_snapshots + rows_only, most);
  return std::clamp<std::size_t>(output_queue_bytes / std::max<std::size_t>(bytes, 1), 2, wanted);
}

FileRecorder::FileRecorder(std::filesystem::path directory, const RecordPlan& plan,
                           const Checkpoint* from)
    : directory_(std::move(directory)),
      time_unit_(plan.results.words.time_unit),
      n_columns_(plan.columns.size()),
      numbers_at_once_(rows_at_once * n_columns_),
      kept_until_(time_kept(directory_, from)),
      saved_step_(from ? from->state.step : 0),
      snapshots_(plan.results.mesh ? std::make_unique<SnapshotFiles>(directory_, plan, from)
                                   : nullptr),
      history_csv_(history_file(directory_, plan.columns, from)),
      slots_(make_slots(plan)),
      writer_(slots_.size(), [this](std::size_t slot) { write(slots_[slot]); }) {
  RONDO_DEMAND(!from || (snapshots_ && history_csv_), n_columns_);  // only such runs are saved
  rows_.reserve(numbers_at_once_);
}

FileRecorder::~FileRecorder() {
  try {
    close();
  } catch (...) {  // reported if close() is called
  }
}

/// Their memory is reserved but mapped only when it is first written: a run whose output keeps up
/// uses only a few of them.
std::vector<FileRecorder::Slot> FileRecorder::make_slots(const RecordPlan& plan) const {
  const io::ResultsLayout& layout = plan.results;
  RONDO_DEMAND(layout.n_snapshots == 0 || layout.mesh, layout.n_snapshots);
  const std::size_t nodes = layout.n_snapshots == 0 ? 0 : layout.mesh->n_nodes();
  const std::size_t contacts =
      layout.n_snapshots == 0 || !layout.contact ? 0 : 2 * layout.mesh->boundary.size();
  std::size_t series = 0;
  if (layout.n_snapshots > 0)
    for (const io::Series& s : layout.series) series += s.components;
  const std::size_t bytes = (numbers_at_once_ + 2 * nodes * layout.components) * sizeof(double) +
                            contacts * sizeof(ContactForce) + series * sizeof(double);
  std::vector<Slot> slots(queue_length(layout.n_snapshots, bytes));
  for (Slot& slot : slots) {
    slot.rows = no_rows(numbers_at_once_);
    slot.snapshot.u.reserve(nodes, layout.components);
    slot.snapshot.v.reserve(nodes, layout.components);
    slot.snapshot.contacts.reserve(contacts);
    slot.snapshot.series.reserve(series);
  }
  return slots;
}

void FileRecorder::rows_added() {
  RONDO_DEMAND(!closed_ && (n_columns_ > 0 ? rows_.size() % n_columns_ == 0 : rows_.empty()),
               closed_, rows_.size(), n_columns_);
  if (rows_.size() < numbers_at_once_) return;
  take_slot();
  hand_over();
}

void Recorder::add_row(std::span<const double> row) {
  if (row.empty()) return;
  rows_.insert(rows_.end(), row.begin(), row.end());
  rows_added();
}

Snapshot& FileRecorder::next_snapshot() {
  RONDO_DEMAND(snapshots_ && !closed_, closed_);
  Slot& slot = take_slot();
  slot.has_snapshot = true;
  return slot.snapshot;
}

void FileRecorder::add_snapshot() {
  RONDO_DEMAND(slots_[slot_].has_snapshot, slot_);  // by next_snapshot()
  hand_over();
}

void FileRecorder::save(Checkpoint checkpoint) {
  RONDO_DEMAND(snapshots_ && history_csv_ && !closed_, closed_);
  RONDO_DEMAND(checkpoint.state.step >= saved_step_, checkpoint.state.step, saved_step_.load());
  const dynamics::SavedState& state = checkpoint.state;
  RONDO_DEMAND(state.u.size() == state.v.size() && state.poses.size() == state.energy.size(),
               state.u.size(), state.v.size(), state.poses.size(), state.energy.size());
  saving_ = true;
  take_slot().checkpoint = std::move(checkpoint);
  hand_over();
}

void FileRecorder::keep_up() {
  writer_.check();
  if (rows_.empty() || Clock::now() - handed_over_ <= longest_wait) return;
  take_slot();
  hand_over();
}

/// Takes a free slot and moves the rows so far into it.
FileRecorder::Slot& FileRecorder::take_slot() {
  taken_ = Clock::now();
  slot_ = writer_.take();
  Slot& slot = slots_[slot_];
  slot.rows.swap(rows_);
  rows_.clear();
  slot.has_snapshot = false;
  slot.checkpoint.reset();
  return slot;
}

void FileRecorder::hand_over() {
  writer_.hand_over(slot_);
  handed_over_ = Clock::now();
  wait_s_ += std::chrono::duration<double>(handed_over_ - taken_).count();
}

void FileRecorder::write(Slot& slot) {
  if (!slot.rows.empty()) {
    RONDO_DEMAND(history_csv_ && slot.rows.size() >= n_columns_, slot.rows.size(), n_columns_);
    RONDO_ASSERT(times_increase(slot.rows, n_columns_), kept_until_, slot.rows.front());
    history_csv_->rows(slot.rows);
    kept_until_ = slot.rows[slot.rows.size() - n_columns_];
  }
  if (slot.has_snapshot) snapshots_->write(slot.snapshot);
  if (!slot.checkpoint) return;
  write(*slot.checkpoint);
  slot.checkpoint.reset();
  saving_ = false;
}

/// What the checkpoint says of the other files must be true even if the machine fails, so these are
/// synced first.
void FileRecorder::write(Checkpoint& checkpoint) {
  io::sync_file(history_csv_->path());
  snapshots_->sync();
  checkpoint.files = files();
  write_checkpoint(directory_, checkpoint);
  saved_step_ = checkpoint.state.step;
}

void FileRecorder::close() {
  if (closed_) return;
  closed_ = true;
  if (!rows_.empty()) {
    take_slot();
    hand_over();
  }
  const auto begin = Clock::now();
  writer_.finish();
  if (history_csv_) history_csv_->close();
  if (snapshots_) snapshots_->close();
  drain_s_ = seconds_since(begin);
}

std::string FileRecorder::kept() {
  try {
    close();
  } catch (...) {  // the state of files is asked for after an error
  }
  if (!history_csv_ || !snapshots_) return "what was written is kept";
  const std::string until = time_unit_ == "s" ? fmt::format("t = {:.9g} s", kept_until_)
                                              : fmt::format("{:.9g} of the load", kept_until_);
  return fmt::format("kept are history.csv to {} and {} snapshots", until, snapshots_->written());
}

KeptFiles FileRecorder::files() const {
  KeptFiles all;
  if (history_csv_) all.tables[history_name] = history_csv_->place();
  if (snapshots_) snapshots_->add_to(all);
  return all;
}

OutputCost FileRecorder::cost() const {
  return {wait_s_, drain_s_, writer_.busy_s(), writer_.times_full()};
}

std::size_t FileRecorder::written() const {
  RONDO_DEMAND(closed_, n_columns_);
  return snapshots_ ? snapshots_->written() : 0;
}

}  // namespace rondo::study
