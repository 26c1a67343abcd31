// SPDX-License-Identifier: BSD-3-Clause
/// @file  Columns of a history.csv and their means over time.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rondo::study {

/// Columns of a history.csv by name.
using Columns = std::map<std::string, std::vector<double>, std::less<>>;

/// @throws FileError naming `file`: no such column, or no rows
[[nodiscard]] const std::vector<double>& column(const Columns& history, std::string_view name,
                                                const std::filesystem::path& file);

/// A column as a function of time, each row the mean over an interval.
struct Intervals {
  std::vector<double> middle;  ///< (m) of the interval [s]
  std::vector<double> length;  ///< (m) of it [s]
  std::vector<double> value;   ///< (m)
};

/// The rows whose interval begins at `from` or later. @throws FileError naming `file`: no such
/// column, no such rows, or times that do not rise
[[nodiscard]] Intervals intervals(const Columns& history, std::string_view name, double from,
                                  const std::filesystem::path& file);

[[nodiscard]] double mean(const Intervals& f) noexcept;
/// Root mean square about the mean.
[[nodiscard]] double deviation(const Intervals& f) noexcept;

}  // namespace rondo::study
