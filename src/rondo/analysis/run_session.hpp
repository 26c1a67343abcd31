// SPDX-License-Identifier: BSD-3-Clause
/// @file  A run that its caller takes to its end, step by step: in its results directory, or in
/// memory alone.
#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "rondo/analysis/base/analysis.hpp"
#include "rondo/analysis/loop.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/directory.hpp"
#include "rondo/output/run_options.hpp"

namespace rondo::study {

/// Its constructor makes all that comes before the first step; then advance() until is_over(), and
/// finish(). The analysis, the case that it was made of and the options must outlive it.
class RunSession {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param memory takes what is recorded, in place of options.directory; null: files do
  /// @param begin where the time that the run takes in all is counted from
  /// @throws InputError (the case cannot run; nothing is left behind), FileError
  RunSession(Analysis& analysis, const Case& c, const RunOptions& options,
             Recorder* memory = nullptr, Clock::time_point begin = Clock::now());
  /// Without finish() files are left as by a run that was killed.
  ~RunSession();
  RunSession(const RunSession&) = delete;
  RunSession& operator=(const RunSession&) = delete;

  /// The error of files that broke it off; null: none.
  [[nodiscard]] const FileError* broken_by() const noexcept {
    return broken_by_ ? &*broken_by_ : nullptr;
  }
  /// At its end, failed, stopped, or broken off by an error of files.
  [[nodiscard]] bool is_over() const noexcept {
    return was_complete_ || broken_ || looper_->is_over();
  }
  /// The analysis' next steps or increment. @pre !is_over() @throws FileError: run.json says so
  void advance();
  /// A checkpoint of where it is, with the case as it is now; it is on the disk afterwards.
  /// @pre not over; the analysis is resumable @throws FileError
  void save();
  /// It ends where it is: finish() then leaves a run that can be resumed.
  void interrupt() noexcept;
  /// Closes its files. To be called once. @throws FileError
  [[nodiscard]] RunReport finish();
  /// Tells that the case has changed from here on: the next checkpoint, and the end, keep it so.
  void case_changed() noexcept { case_changed_ = true; }
  /// run.json as far as it has come: complete after finish().
  [[nodiscard]] const Json& json() const noexcept { return json_; }

 private:
  void take_directory();
  void find_checkpoint();
  void demand_disk_of() const;
  void open_recorder();
  void keep_case();
  void guarded(const std::function<void()>& work);
  [[nodiscard]] bool has_files() const noexcept { return memory_ == nullptr; }
  [[nodiscard]] std::string what_is_kept();
  [[nodiscard]] Json describe() const;
  [[nodiscard]] Json array_before(const char* key) const;
  [[nodiscard]] Json warnings_with_earlier() const;
  [[nodiscard]] Json resumed_at() const;
  [[nodiscard]] RunReport report_of(const Loop& loop) const;
  [[nodiscard]] RunReport nothing_to_do() const;
  void drop_checkpoint(RunStatus status) const;

  Analysis& analysis_;
  const Case& case_;
  const RunOptions& options_;
  Recorder* const memory_;
  const Clock::time_point begin_;
  RecordPlan plan_;
  const Checkpoint* from_ = nullptr;  ///< gone on from; null: from the start
  bool was_complete_ = false;
  bool broken_ = false;  ///< by an error that run.json tells
  std::optional<FileError> broken_by_;
  bool case_changed_ = false;
  std::optional<io::DirectoryLock> lock_;
  std::unique_ptr<FileRecorder> files_;
  std::optional<Looper> looper_;
  Json json_;
};

/// Members that a session itself adds to run.json, besides run_file_members() and its analysis'.
std::vector<MemberText> session_members();

}  // namespace rondo::study
