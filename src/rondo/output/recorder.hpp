// SPDX-License-Identifier: BSD-3-Clause
/// @file  Writes all result files during an analysis, outside its loop: the loop hands over
/// numbers, and a separate thread computes stresses, formats and writes
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

/// Largest memory of data that was handed over and not yet written; but two snapshots always have
/// room, whatever their size [B].
inline constexpr std::size_t output_queue_bytes = 64'000'000;

/// Number of snapshots that can wait to be written. @param bytes of one snapshot
[[nodiscard]] std::size_t queue_length(std::size_t n_snapshots, std::size_t bytes) noexcept;

/// Cost of the output of a run [s].
struct OutputCost {
  double wait_wall_s = 0.0;   ///< of the loop, handing over: copying, waiting for a free slot
  double drain_wall_s = 0.0;  ///< after the loop, until everything was written
  double write_wall_s = 0.0;  ///< of the thread, working
  long long queue_full = 0;   ///< how often the loop had to wait for a free slot
};

/// What an analysis records; everything that it points to must outlive the recorder.
struct RecordPlan {
  io::ResultsLayout results;         ///< of results.h5, fields.xdmf; no mesh: no such files
  std::vector<ColumnLabel> columns;  ///< of history.csv; the first is the time. Empty: no such file
  /// Columns of contact.csv after those that it always has.
  std::span<const Column<ContactRecord>> contact_columns;
  std::size_t own_bytes = 0;                 ///< on disk, of files that the analysis itself writes
  std::size_t n_rows = 0;                    ///< expected number of rows of history.csv
  std::span<const fem::Material> materials;  ///< of the mesh's regions, for stress
  const contact::Ground* ground = nullptr;   ///< for the abscissa; null: none
  const dynamics::Model* model = nullptr;    ///< if there are free bodies; else null
};

class SnapshotFiles;

/// Receives what an analysis hands over while it runs.
class Recorder {
 public:
  Recorder() = default;
  virtual ~Recorder() = default;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// The caller appends one row of the history, or none, and then calls rows_added().
  [[nodiscard]] std::vector<double>& rows() noexcept { return rows_; }
  [[nodiscard]] const std::vector<double>& rows() const noexcept { return rows_; }
  virtual void rows_added() = 0;
  void add_row(std::span<const double> row);
  /// A snapshot for the caller to fill, with its memory reserved; then add_snapshot(). Nothing else
  /// may be called in between.
  [[nodiscard]] virtual Snapshot& next_snapshot() = 0;
  virtual void add_snapshot() = 0;
  /// A run that is resumed from it drops everything added after this call.
  virtual void save(Checkpoint checkpoint) = 0;
  /// Whether a checkpoint is not yet written: a second one would need the same memory again.
  [[nodiscard]] virtual bool is_saving() const noexcept = 0;
  /// Must be called from time to time.
  virtual void keep_up() = 0;

 protected:
  std::vector<double> rows_;  ///< not yet handed over
};

/// history.csv, results.h5, fields.xdmf, contact.csv and checkpoint.h5. Every call rethrows an
/// exception of the thread (FileError, std::bad_alloc) since the previous call.
class FileRecorder : public Recorder {
 public:
  /// Creates the files or, after a checkpoint, continues the existing ones. @throws FileError
  FileRecorder(std::filesystem::path directory, const RecordPlan& plan,
               const Checkpoint* from = nullptr);
  /// Writes the pending data as far as possible; errors are reported only if close() is called.
  ~FileRecorder() override;

  /// Hands the rows over if there are many.
  void rows_added() override;
  [[nodiscard]] Snapshot& next_snapshot() override;
  void add_snapshot() override;
  /// Writes checkpoint.h5 after everything before it; fills in its `files`.
  void save(Checkpoint checkpoint) override;
  [[nodiscard]] bool is_saving() const noexcept override { return saving_.load(); }
  /// Hands over rows that would otherwise wait for a snapshot or for more rows.
  void keep_up() override;
  /// Step of the last checkpoint written; 0: none.
  [[nodiscard]] long long saved_step() const noexcept { return saved_step_.load(); }
  /// Writes everything and closes the files.
  void close();

  /// The contents of the files in words, for the message after a call has thrown. Closes them.
  [[nodiscard]] std::string kept();
  /// Complete once the files are closed.
  [[nodiscard]] OutputCost cost() const;
  /// The contents of the files. @pre closed, or called by the writing thread
  [[nodiscard]] KeptFiles files() const;
  /// Number of snapshots in the files. @pre closed
  [[nodiscard]] std::size_t written() const;
  /// Time in the last row of history.csv; 0: no rows. @pre closed.
  [[nodiscard]] double last_time() const noexcept { return kept_until_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// Data handed over together, in this order: rows of history.csv, a snapshot, a checkpoint.
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
  const std::size_t numbers_at_once_;  ///< size at which rows are handed over
  std::size_t slot_ = 0;               ///< the current slot
  Clock::time_point taken_{}, handed_over_ = Clock::now();
  double wait_s_ = 0.0, drain_s_ = 0.0;
  bool closed_ = false;
  double kept_until_ = 0.0;  ///< time of the last row written; used by the thread
  std::atomic<bool> saving_{false};
  std::atomic<long long> saved_step_{0};
  // Used by the thread only, from its start to its end.
  std::unique_ptr<SnapshotFiles> snapshots_;  ///< first: if copying fails, all
                                              ///< files remain unchanged. Null: none
  std::optional<io::Csv> history_csv_;
  std::vector<Slot> slots_;
  WriterThread writer_;  ///< last: ends before the members that it uses
};

}  // namespace rondo::study
