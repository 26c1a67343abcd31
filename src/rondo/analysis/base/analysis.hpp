// SPDX-License-Identifier: BSD-3-Clause
/// @file  The concept of an analysis: what is built from a case, advanced in a loop and recorded.
/// Each kind has files of its own and a row in registry.cpp; nothing else asks which one it is.
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rondo/fem/elasticity.hpp"
#include "rondo/output/recorder.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {

/// How far an analysis has come, in steps or increments.
struct Progress {
  long long done = 0, all = 0;
};

/// The report of `rondo check` on a case, and of a sweep on its members.
struct CheckReport {
  std::size_t nodes = 0, elements = 0, dofs = 0, candidates = 0;
  int bodies = 1, free_bodies = 0;
  fem::WaveSpeeds wave_speeds;  ///< [m/s]
  long long steps = 0;          ///< or increments
  std::size_t snapshots = 0;
  std::size_t memory_bytes = 0;  ///< estimated
  std::size_t disk_bytes = 0;    ///< estimated
  double seconds = 0.0;  ///< time of all steps, estimated from some made here; 0: not estimated [s]
  int threads = 1;
  /// Further lines, what is told and its value, in the words of the analysis.
  std::vector<std::pair<std::string, std::string>> lines;
  std::vector<std::string> warnings;
  std::vector<ColumnLabel> columns;  ///< columns of history.csv, where they were asked for
};

/// An analysis that can go on from a checkpoint to the same bits.
class Resumable {
 public:
  virtual ~Resumable() = default;
  /// The checkpoint of this very run in the directory; the analysis then goes on from there. Null:
  /// there is none yet. Called at most once, before begin(). @throws InputError: of another run;
  /// FileError
  [[nodiscard]] virtual const Checkpoint* find(const std::filesystem::path& directory) = 0;
  /// The analysis as it stands between two calls of advance(), but for times and files.
  [[nodiscard]] virtual Checkpoint save() const = 0;
};

class Stepwise;

class Analysis {
 public:
  Analysis() = default;
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;
  virtual ~Analysis() = default;

  // Before anything is written ------------------------------------------------------------------
  /// @param trial time to spend on steps, for `seconds` [s] @throws InputError as a run would
  [[nodiscard]] virtual CheckReport check(double trial) = 0;
  [[nodiscard]] virtual RecordPlan record_plan() const = 0;
  /// Does what takes long and may still refuse the case. @throws InputError
  virtual void prepare() {}
  [[nodiscard]] virtual std::vector<std::string> warnings() const = 0;
  /// Adds to run.json what is known before the first step.
  virtual void describe(Json& json) const = 0;
  /// The case as the results directory keeps it.
  [[nodiscard]] virtual Case kept_case(const Case& c) const { return c; }
  /// Null: it keeps no checkpoints.
  [[nodiscard]] virtual Resumable* resumable() noexcept { return nullptr; }
  /// Null: it is no motion in time.
  [[nodiscard]] virtual Stepwise* stepwise() noexcept { return nullptr; }

  // The loop ------------------------------------------------------------------------------------
  /// Records the start, unless it goes on from a checkpoint.
  virtual Progress begin(Recorder& recorder) = 0;
  /// Some steps, as few as a signal can wait for, or an increment: rows and snapshots to the
  /// recorder.
  virtual Progress advance(Recorder& recorder) = 0;
  /// The trouble since the last call of advance() or close(), with its place; none: all is well.
  [[nodiscard]] virtual const std::optional<std::string>& trouble() const = 0;
  /// The row of the last step where none was due; else empty. It is not part of a checkpoint.
  [[nodiscard]] virtual std::vector<double> last_row() { return {}; }
  /// After the last step of a run that came to its end.
  virtual void close() {}

  // After it ------------------------------------------------------------------------------------
  /// Adds to run.json, with later "warnings", and to the report: status, times, snapshots are there
  virtual void summarise(Json& json, RunReport& report) const = 0;
};

}  // namespace rondo::study
