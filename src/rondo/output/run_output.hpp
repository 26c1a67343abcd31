// SPDX-License-Identifier: BSD-3-Clause
/// @file  All output of a run while it goes on, off its loop: the loop hands over numbers, a thread
/// of its own recovers stresses, formats and writes (docs/decisions/014-writer-thread.md).
#pragma once
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rondo/case/setup.hpp"
#include "rondo/integrators/integrator.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/output/checkpoint.hpp"
#include "rondo/output/observers.hpp"
#include "rondo/output/writer_thread.hpp"

namespace rondo::study {

/// Memory of what was handed over and not yet written, at the most; but there is room for two
/// snapshots however large [B].
inline constexpr std::size_t output_queue_bytes = 64'000'000;

/// Snapshots that can wait to be written. @param bytes of one
[[nodiscard]] std::size_t queue_length(std::size_t n_snapshots, std::size_t bytes) noexcept;

/// What output cost a run [s].
struct OutputCost {
  double wait_wall_s = 0.0;   ///< of the loop, handing over: copies, waiting for a free slot
  double drain_wall_s = 0.0;  ///< after the loop, until everything was written
  double write_wall_s = 0.0;  ///< of the thread, at work
  long long queue_full = 0;   ///< how often the loop had to wait for a free slot
};

/// history.csv, results.h5, fields.xdmf and contact.csv. Every call throws what the thread met
/// (FileError, std::bad_alloc) since the last one.
class RunOutput {
 public:
  /// What a run writes, and where.
  struct Plan {
    const std::filesystem::path& directory;
    const Case& c;
    const Setup& setup;
    const SnapshotSchedule& schedule;
  };

  /// Creates the files or, from a checkpoint, goes on with those that are there. Case and setup
  /// must outlive it. @throws FileError
  explicit RunOutput(const Plan& plan, const Checkpoint* from = nullptr);
  /// Writes what is there, as far as that is possible; errors are reported where close() is called.
  ~RunOutput();
  RunOutput(const RunOutput&) = delete;
  RunOutput& operator=(const RunOutput&) = delete;

  /// The next step of which a snapshot is wanted; the largest number where none is left.
  [[nodiscard]] long long next_snapshot() const noexcept;
  /// The next step of which the state is wanted, for a snapshot or for probes.
  [[nodiscard]] long long next_state() const noexcept {
    return std::min(next_snapshot(), history_.next_probed());
  }
  /// Every step, in turn. @param state of this step, where there is one at hand: probes are read
  /// from it
  void observe(const dynamics::StepReport& step, const dynamics::State* state = nullptr);
  /// A snapshot, if state.step is next_snapshot().
  void observe(const dynamics::State& state);
  /// The row of the last step, where none was due: else empty.
  [[nodiscard]] std::vector<double> last_row(const dynamics::StepReport& step,
                                             const dynamics::State* state);
  /// After the last step, snapshot and checkpoint. @pre a row, or empty
  void add_row(std::span<const double> row);
  /// Writes directory/checkpoint.h5 once all before it is written; its `history`, `schedule` and
  /// `files` are filled in. A run that goes on from it drops what add_row() adds.
  void save(Checkpoint checkpoint);
  /// One is not yet written: a second would take as much memory again.
  [[nodiscard]] bool is_saving() const noexcept { return saving_.load(); }
  /// Step of the last checkpoint written; 0: none.
  [[nodiscard]] long long saved_step() const noexcept { return saved_step_.load(); }
  /// To be called now and then: hands over rows that would else wait for a snapshot, or for more
  /// rows.
  void keep_up();
  /// Writes everything and closes the files.
  void close();

  /// What the files hold, in words, after a call has thrown: for the message. Closes them.
  [[nodiscard]] std::string kept();
  /// Complete once closed.
  [[nodiscard]] OutputCost cost() const;
  /// Snapshots in the files. @pre closed.
  [[nodiscard]] std::size_t written() const { return snapshots_.written(); }

 private:
  using Clock = std::chrono::steady_clock;

  /// Of what is handed over: rows of history.csv, then a snapshot.
  struct Slot {
    std::vector<double> rows;
    bool snapshot = false;
    dynamics::State state;  ///< step, frame, u, v, poses and active only
    std::optional<Checkpoint> checkpoint;
  };

  [[nodiscard]] std::vector<Slot> make_slots(const Setup& setup) const;
  void push(const dynamics::State* state, std::optional<Checkpoint> checkpoint = std::nullopt);
  void write(Slot& slot);
  void write(Checkpoint& checkpoint);

  const std::filesystem::path& directory_;
  SnapshotSchedule schedule_;
  std::size_t next_ = 0;
  History history_;
  std::ptrdiff_t n_columns_;     ///< of history.csv
  std::size_t numbers_at_once_;  ///< of some rows
  std::vector<double> rows_;     ///< not yet handed over
  Clock::time_point handed_over_ = Clock::now();
  double wait_s_ = 0.0, drain_s_ = 0.0;
  bool closed_ = false;
  double kept_until_ = 0.0;  ///< time of the last row written [s]; the thread's
  std::atomic<bool> saving_{false};
  std::atomic<long long> saved_step_{0};
  // The thread's from its start to its end.
  Snapshots snapshots_;  ///< first: what fails while it copies leaves all files as they were
  io::Csv history_csv_;
  std::vector<Slot> slots_;
  WriterThread writer_;  ///< last: ends before what it works with
};

}  // namespace rondo::study
