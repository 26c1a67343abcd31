// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/figures/history_statistics.hpp"

#include <fmt/format.h>

#include <cmath>

#include "rondo/core/error.hpp"

namespace rondo::study {
namespace {

/// Σ length · term(k) / Σ length.
template <class Term>
double mean_of(const Intervals& f, Term&& term) noexcept {
  double sum = 0.0, lengths = 0.0;
  for (std::size_t k = 0; k < f.value.size(); ++k) {
    sum += f.length[k] * term(f.value[k]);
    lengths += f.length[k];
  }
  return sum / lengths;
}

}  // namespace

const std::vector<double>& column(const Columns& history, std::string_view name,
                                  const std::filesystem::path& file) {
  const auto found = history.find(name);
  if (found == history.end()) throw FileError(file.string(), fmt::format("has no column {}", name));
  if (found->second.empty()) throw FileError(file.string(), "has no rows");
  return found->second;
}

Intervals intervals(const Columns& history, std::string_view name, double from,
                    const std::filesystem::path& file) {
  const std::vector<double>& time = column(history, "time_s", file);
  const std::vector<double>& value = column(history, name, file);
  Intervals found;
  double before = 0.0;
  for (std::size_t k = 0; k < time.size(); before = time[k++]) {
    if (!std::isfinite(time[k]) || time[k] < 0.0 || (k > 0 && time[k] <= before))
      throw FileError(file.string(), fmt::format("time_s is {} in row {}, after {}: damaged",
                                                 time[k], k + 1, before));
    if (before < from) continue;
    found.middle.push_back(0.5 * (before + time[k]));
    found.length.push_back(time[k] - before);
    found.value.push_back(value[k]);
  }
  if (found.value.empty())
    throw FileError(file.string(), fmt::format("has no rows after {:.6g} s", from));
  return found;
}

double mean(const Intervals& f) noexcept {
  return mean_of(f, [](double value) { return value; });
}

double deviation(const Intervals& f) noexcept {
  const double m = mean(f);
  return std::sqrt(mean_of(f, [m](double value) { return (value - m) * (value - m); }));
}

}  // namespace rondo::study
