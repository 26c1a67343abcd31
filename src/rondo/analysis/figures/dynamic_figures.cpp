// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/figures/dynamic_figures.hpp"
#include "rondo/io/files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "rondo/analysis/figures/history_statistics.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/csv.hpp"

namespace rondo::study {
namespace {

constexpr std::array dynamic_columns{
    FigureColumn{"force_x_mean", "N/m", "of the ground on the body, mean over the window"},
    FigureColumn{"force_x_peak", "N/m", "the value of largest magnitude in the window"},
    FigureColumn{"force_x_fluctuation", "N/m", "root mean square about the mean"},
    FigureColumn{"force_y_mean", "N/m", "of the ground on the body, mean over the window"},
    FigureColumn{"force_y_peak", "N/m", "the value of largest magnitude in the window"},
    FigureColumn{"force_y_fluctuation", "N/m", "root mean square about the mean"},
    FigureColumn{"torque_mean", "N·m/m", "about the center, mean over the window"},
    FigureColumn{"torque_peak", "N·m/m", "the value of largest magnitude in the window"},
    FigureColumn{"torque_fluctuation", "N·m/m", "root mean square about the mean"},
    FigureColumn{"contact_length_mean_m", "m", "mean over the window"},
    FigureColumn{"contact_length_peak_m", "m", "largest in the window"},
    FigureColumn{"slip_ratio_mean", "1", "mean over the window"},
    FigureColumn{"center_y_mean", "m", "height of the center, mean over the window"},
    FigureColumn{"speed_mean", "m/s", "of the center along x, mean over the window"},
    FigureColumn{"spin_mean", "rad/s", "> 0 clockwise, mean over the window"},
    FigureColumn{"friction_power", "W/m", "dissipated by friction in the window, over its length"},
    FigureColumn{"impact_power", "W/m", "lost in impacts in the window, over its length"},
    FigureColumn{"energy_residual_relative", "1", "of the energy balance, of the whole run"},
    FigureColumn{"contact_residual_max", "1", "of the contact law, of the whole run"},
    FigureColumn{"penetration_max_m", "m", "of the whole run"},
    FigureColumn{"strain_max", "1", "largest principal strain, of the whole run"},
    FigureColumn{"jacobian_min", "1", "least area of an element over that undeformed"},
};

/// Of a run's rows those in the window.
class Rows {
 public:
  Rows(const std::filesystem::path& directory, const Window& window)
      : file_(directory / "history.csv"), history_(io::read_columns(file_)) {
    const double end = column(history_, "time_s", file_).back();
    to_ = std::min(window.to.value_or(end), end);
    from_ = window.from.value_or(0.5 * to_);
    length_ = until(intervals(history_, "force_y", from_, file_)).length;
    if (length_.empty())
      throw FileError(file_.string(),
                      fmt::format("has no row between {:.6g} and {:.6g} s", from_, to_));
  }

  [[nodiscard]] Intervals of(const char* name) const {
    return until(intervals(history_, name, from_, file_));
  }

  /// Increase of a cumulative column over the window, by its length.
  [[nodiscard]] double rate(const char* name) const {
    const std::vector<double>& time = column(history_, "time_s", file_);
    const std::vector<double>& value = column(history_, name, file_);
    const double first = of(name).middle.front() - 0.5 * length_.front();
    double before = 0.0, after = 0.0, begin = 0.0, end = 0.0;
    for (std::size_t k = 0; k < time.size() && time[k] <= to_ * (1.0 + 1e-12); ++k) {
      if (time[k] <= first * (1.0 + 1e-12)) {
        before = value[k];
        begin = time[k];
      }
      after = value[k];
      end = time[k];
    }
    return (after - before) / (end - begin);
  }

 private:
  /// Rows whose interval ends in the window.
  [[nodiscard]] Intervals until(Intervals f) const {
    std::size_t n = 0;
    while (n < f.value.size() && f.middle[n] + 0.5 * f.length[n] <= to_ * (1.0 + 1e-12)) ++n;
    f.middle.resize(n);
    f.length.resize(n);
    f.value.resize(n);
    return f;
  }

  std::filesystem::path file_;
  Columns history_;
  double from_ = 0.0, to_ = 0.0;
  std::vector<double> length_;
};

double peak(const Intervals& f) {
  return *std::ranges::max_element(f.value, {}, [](double value) { return std::abs(value); });
}

std::vector<double> figures_of(const std::filesystem::path& directory, const Window& window) {
  const Rows rows(directory, window);
  std::vector<double> figures;
  for (const char* name : {"force_x", "force_y", "torque"}) {
    const Intervals f = rows.of(name);
    figures.insert(figures.end(), {mean(f), peak(f), deviation(f)});
  }
  const Intervals length = rows.of("contact_length_m");
  figures.insert(figures.end(),
                 {mean(length), peak(length), mean(rows.of("slip_ratio")),
                  mean(rows.of("center_y_m")), rows.rate("center_x_m"), rows.rate("angle_rad"),
                  rows.rate("dissipation_friction"), rows.rate("loss_impact")});
  add_figures_of_all(io::read_json(directory / "run.json"), figures);
  return figures;
}

}  // namespace

FigureTable dynamic_figures() noexcept {
  return {dynamic_columns, figures_of, true};
}

}  // namespace rondo::study
