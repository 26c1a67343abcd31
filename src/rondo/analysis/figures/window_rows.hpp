// SPDX-License-Identifier: BSD-3-Clause
/// @file  The rows of a history.csv that lie in a window of time.
#pragma once
#include <filesystem>
#include <string_view>

#include "rondo/analysis/figures/figures.hpp"
#include "rondo/analysis/figures/history_statistics.hpp"

namespace rondo::study {

class WindowRows {
 public:
  /// @throws FileError: the file cannot be read, or holds no row in the window
  WindowRows(const std::filesystem::path& directory, const Window& window);

  /// @throws FileError: no such column
  [[nodiscard]] Intervals of(std::string_view name) const;
  /// Increase of a cumulative column over the window, by its length. @throws FileError
  [[nodiscard]] double rate(std::string_view name) const;

 private:
  std::filesystem::path file_;
  Columns history_;
  double from_ = 0.0, to_ = 0.0;  ///< [s]
};

}  // namespace rondo::study
