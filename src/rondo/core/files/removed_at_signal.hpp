// SPDX-License-Identifier: BSD-3-Clause
/// @file  Unfinished files that must be removed even if a signal ends the program at once, when no
/// destructor runs.
#pragma once
#include <filesystem>

namespace rondo {

/// While an object of this class lives, remove_at_signal() removes its file, or its folder if that
/// is empty by then. If very many objects live at once, or a path is longer than the system allows,
/// some are left out.
class RemovedAtSignal {
 public:
  explicit RemovedAtSignal(const std::filesystem::path& path) noexcept;
  ~RemovedAtSignal();
  RemovedAtSignal(const RemovedAtSignal&) = delete;
  RemovedAtSignal& operator=(const RemovedAtSignal&) = delete;

 private:
  int place_ = -1;  ///< index in the list; -1: left out
};

/// Removes the files that this process has listed, not those listed by the process that forked it.
/// May be called from a signal handler.
void remove_at_signal() noexcept;

}  // namespace rondo
