// SPDX-License-Identifier: BSD-3-Clause
/// @file  All files of results while an analysis goes on, off its loop: the loop hands over
/// numbers, a thread of its own recovers stresses, formats and writes
/// (docs/decisions/014-writer-thread.md).
#pragma once
#include <atomic>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rondo/contact/ground.hpp"
#include "rondo/core/column.hpp"
#include "rondo/fem/elasticity.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/io/results.hpp"
#include "rondo/output/checkpoint.hpp"
#include "rondo/output/columns.hpp"
#include "rondo/output/snapshot.hpp"
#include "rondo/output/writer_thread.hpp"

namespace rondo::study {

/// Memory of what was handed over and not yet written, at the most; but there is place for two
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

/// What an analysis records; all that it points to must outlive the recorder.
struct RecordPlan {
  io::ResultsLayout results;  ///< of results.h5 and fields.xdmf; no mesh: none, nor contact.csv
  std::vector<ColumnLabel> columns;  ///< of history.csv; the first is the time. Empty: none
  /// Of contact.csv behind those that it always has.
  std::span<const Column<ContactRecord>> contact_columns;
  std::size_t own_bytes = 0;                 ///< on disk, of files that the analysis writes itself
  std::size_t n_rows = 0;                    ///< of history.csv, expected
  std::span<const fem::Material> materials;  ///< of the mesh's regions, for stress
  const contact::Ground* ground = nullptr;   ///< for abscissas; null: none
  const dynamics::Model* model = nullptr;    ///< where there are free bodies; else null
};

class SnapshotFiles;

/// Takes what an analysis hands over while it goes on.
class Recorder {
 public:
  Recorder() = default;
  virtual ~Recorder() = default;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// A row of the history, or none, is appended by the caller; then rows_added().
  [[nodiscard]] std::vector<double>& rows() noexcept { return rows_; }
  [[nodiscard]] const std::vector<double>& rows() const noexcept { return rows_; }
  virtual void rows_added() = 0;
  void add_row(std::span<const double> row);
  /// A snapshot to be filled, whose memory is reserved; then add_snapshot(). Nothing else is called
  /// in between.
  [[nodiscard]] virtual Snapshot& next_snapshot() = 0;
  virtual void add_snapshot() = 0;
  /// A run that goes on from it drops what is added after.
  virtual void save(Checkpoint checkpoint) = 0;
  /// A checkpoint is not yet written: a second would take as much memory again.
  [[nodiscard]] virtual bool is_saving() const noexcept = 0;
  /// To be called now and then.
  virtual void keep_up() = 0;

 protected:
  std::vector<double> rows_;  ///< not yet handed over
};

/// history.csv, results.h5, fields.xdmf, contact.csv and checkpoint.h5. Every call throws what the
/// thread met (FileError, std::bad_alloc) since the last one.
class FileRecorder : public Recorder {
 public:
  /// Creates the files or, from a checkpoint, goes on with those that are there. @throws FileError
  FileRecorder(std::filesystem::path directory, const RecordPlan& plan,
               const Checkpoint* from = nullptr);
  /// Writes what is there, as far as that is possible; errors are reported where close() is called.
  ~FileRecorder() override;

  /// Hands rows over where there are many of them.
  void rows_added() override;
  [[nodiscard]] Snapshot& next_snapshot() override;
  void add_snapshot() override;
  /// Writes checkpoint.h5 once all before it is written; its `files` are filled in.
  void save(Checkpoint checkpoint) override;
  [[nodiscard]] bool is_saving() const noexcept override { return saving_.load(); }
  /// Hands over rows that would else wait for a snapshot, or for more rows.
  void keep_up() override;
  /// Step of the last checkpoint written; 0: none.
  [[nodiscard]] long long saved_step() const noexcept { return saved_step_.load(); }
  /// Writes everything and closes the files.
  void close();

  /// What the files hold, in words, after a call has thrown: for the message. Closes them.
  [[nodiscard]] std::string kept();
  /// Complete once closed.
  [[nodiscard]] OutputCost cost() const;
  /// What they hold. @pre closed, or called by the thread that writes
  [[nodiscard]] KeptFiles files() const;
  /// Snapshots in the files. @pre closed.
  [[nodiscard]] std::size_t written() const;
  /// First number of the last row of history.csv; 0: none. @pre closed.
  [[nodiscard]] double last_time() const noexcept { return kept_until_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// Of what is handed over: rows of history.csv, then a snapshot, then a checkpoint.
  struct Slot {
    std::vector<double> rows;
    bool has_snapshot = false;
    Snapshot snapshot;
    std::optional<Checkpoint> checkpoint;
  };

  [[nodiscard]] std::vector<Slot> make_slots(const RecordPlan& plan) const;
  Slot& take_slot();
  void hand_over();
  void write(Slot& slot);
  void write(Checkpoint& checkpoint);

  const std::filesystem::path directory_;
  const std::string time_unit_;
  const std::size_t n_columns_;        ///< of history.csv
  const std::size_t numbers_at_once_;  ///< of some rows
  std::size_t slot_ = 0;               ///< in hand
  Clock::time_point taken_{}, handed_over_ = Clock::now();
  double wait_s_ = 0.0, drain_s_ = 0.0;
  bool closed_ = false;
  double kept_until_ = 0.0;  ///< time of the last row written; the thread's
  std::atomic<bool> saving_{false};
  std::atomic<long long> saved_step_{0};
  // The thread's from its start to its end.
  std::unique_ptr<SnapshotFiles> snapshots_;  ///< first: what fails while it copies leaves all
                                              ///< files as they were. Null: none
  std::optional<io::Csv> history_csv_;
  std::vector<Slot> slots_;
  WriterThread writer_;  ///< last: ends before what it works with
};

}  // namespace rondo::study
