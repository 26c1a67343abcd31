// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/figures/window_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rondo/core/error.hpp"
#include "rondo/io/csv.hpp"

namespace rondo::study {
namespace {

constexpr double window_round_off = 1.0 + 1e-12;

}  // namespace

WindowRows::WindowRows(const std::filesystem::path& directory, const Window& window)
    : file_(directory / "history.csv"), history_(io::read_columns(file_)) {
  const double end = column(history_, "time_s", file_).back();
  to_ = std::min(window.to.value_or(end), end);
  from_ = window.from.value_or(0.5 * to_);
  if (of("time_s").value.empty())
    throw FileError(file_.string(),
                    fmt::format("has no row between {:.6g} and {:.6g} s", from_, to_));
}

/// Rows whose interval ends in the window.
Intervals WindowRows::of(std::string_view name) const {
  Intervals f = intervals(history_, name, from_, file_);
  std::size_t n = 0;
  while (n < f.value.size() && f.middle[n] + 0.5 * f.length[n] <= to_ * window_round_off) ++n;
  f.middle.resize(n);
  f.length.resize(n);
  f.value.resize(n);
  return f;
}

double WindowRows::rate(std::string_view name) const {
  const std::vector<double>& time = column(history_, "time_s", file_);
  const std::vector<double>& value = column(history_, name, file_);
  const Intervals inside = of(name);
  const double first = inside.middle.front() - 0.5 * inside.length.front();
  double before = 0.0, after = 0.0, begin = 0.0, end = 0.0;
  for (std::size_t k = 0; k < time.size() && time[k] <= to_ * window_round_off; ++k) {
    if (time[k] <= first * window_round_off) {
      before = value[k];
      begin = time[k];
    }
    after = value[k];
    end = time[k];
  }
  return (after - before) / (end - begin);
}

}  // namespace rondo::study
