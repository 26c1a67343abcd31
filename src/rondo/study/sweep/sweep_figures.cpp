// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/sweep_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "rondo/core/error.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/io/files.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/study/sweep/history_statistics.hpp"

namespace rondo::study {
namespace {

constexpr std::array dynamic_columns{
    FigureColumn{"force_x_mean", "N/m", "of the ground on the body, mean over the window"},
    FigureColumn{"force_x_peak", "N/m", "the value of largest magnitude in the window"},
    FigureColumn{"force_x_fluctuation", "N/m", "root mean square about the mean"},
    FigureColumn{"force_y_mean", "N/m", "of the ground on the body, mean over the window"},
    FigureColumn{"force_y_peak", "N/m", "the value of largest magnitude in the window"},
    FigureColumn{"force_y_fluctuation", "N/m", "root mean square about the mean"},
    FigureColumn{"torque_mean", "N", "about the centre, mean over the window"},
    FigureColumn{"torque_peak", "N", "the value of largest magnitude in the window"},
    FigureColumn{"torque_fluctuation", "N", "root mean square about the mean"},
    FigureColumn{"contact_length_mean_m", "m", "mean over the window"},
    FigureColumn{"contact_length_peak_m", "m", "largest in the window"},
    FigureColumn{"slip_ratio_mean", "1", "mean over the window"},
    FigureColumn{"friction_power", "W/m", "dissipated by friction in the window, over its length"},
    FigureColumn{"impact_power", "W/m", "lost in impacts in the window, over its length"},
    FigureColumn{"energy_residual_relative", "1", "of the ledger, of the whole run"},
    FigureColumn{"contact_residual_max", "1", "of the contact law, of the whole run"},
    FigureColumn{"penetration_max_m", "m", "of the whole run"},
};

constexpr std::array crush_columns{
    FigureColumn{"depth_m", "m", "of the centre below first touch, at the end"},
    FigureColumn{"force_x", "N/m", "of the ground on the body, at the end"},
    FigureColumn{"force_y", "N/m", "of the ground on the body, at the end"},
    FigureColumn{"torque", "N", "about the centre, at the end"},
    FigureColumn{"contact_length_m", "m", "at the end"},
    FigureColumn{"pressure_max_pa", "Pa", "at the end"},
    FigureColumn{"shear_max_pa", "Pa", "at the end"},
    FigureColumn{"strain", "J/m", "strain energy at the end"},
    FigureColumn{"dissipation_friction", "J/m", "dissipated by friction"},
    FigureColumn{"energy_residual_relative", "1", "of the balance of energies"},
    FigureColumn{"contact_residual_max", "1", "of the contact law"},
    FigureColumn{"penetration_max_m", "m", "of all increments"},
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

double number_of(const Json& j, const char* key) {
  return j.contains(key) && j[key].is_number() ? j[key].get<double>()
                                               : std::numeric_limits<double>::quiet_NaN();
}

void add_residuals(const std::filesystem::path& directory, std::vector<double>& figures) {
  const Json j = io::read_json(directory / "run.json");
  for (const char* key : {"energy_residual_relative", "contact_residual_max", "penetration_max_m"})
    figures.push_back(number_of(j, key));
}

std::vector<double> of_dynamics(const std::filesystem::path& directory, const Window& window) {
  const Rows rows(directory, window);
  std::vector<double> figures;
  for (const char* name : {"force_x", "force_y", "torque"}) {
    const Intervals f = rows.of(name);
    figures.insert(figures.end(), {mean(f), peak(f), deviation(f)});
  }
  const Intervals length = rows.of("contact_length_m");
  figures.insert(figures.end(), {mean(length), peak(length), mean(rows.of("slip_ratio")),
                                 rows.rate("dissipation_friction"), rows.rate("loss_impact")});
  return figures;
}

std::vector<double> of_crush(const std::filesystem::path& directory) {
  const std::filesystem::path file = directory / "history.csv";
  const Columns history = io::read_columns(file);
  std::vector<double> figures;
  for (const char* name : {"depth_m", "force_x", "force_y", "torque", "contact_length_m",
                           "pressure_max_pa", "shear_max_pa", "strain", "dissipation_friction"})
    figures.push_back(column(history, name, file).back());
  return figures;
}

}  // namespace

std::span<const FigureColumn> figure_columns(AnalysisKind kind) noexcept {
  if (kind == AnalysisKind::crush) return crush_columns;
  return dynamic_columns;
}

std::vector<double> figures_of(const std::filesystem::path& directory, AnalysisKind kind,
                               const Window& window) {
  std::vector<double> figures =
      kind == AnalysisKind::crush ? of_crush(directory) : of_dynamics(directory, window);
  add_residuals(directory, figures);
  return figures;
}

}  // namespace rondo::study
