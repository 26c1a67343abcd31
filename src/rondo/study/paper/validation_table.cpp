// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/paper/validation_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "rondo/case/case_source.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/io/files.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {
namespace {

using Figures = ValidationFigures;

/// Of a mean force or of its fluctuation by the mean vertical one.
double of_load(const Figures& f, const FullReduced& force) {
  return share_of(force.reduced - force.full, f.force_y.full);
}

double friction_error(const Figures& f) {
  return share_of(f.friction_power.reduced - f.friction_power.full, f.friction_power.full);
}

double speed_up(const Figures& f) {
  return share_of(f.loop_wall.full, f.loop_wall.reduced);
}

std::string field_of(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string said(1, '"');
  for (const char c : text) said.append(c == '"' ? 2 : 1, c);
  said.push_back('"');
  return said;
}

std::string number(double value) {
  return std::isnan(value) ? "nan" : fmt::format("{}", value);
}

/// A line of the table on the terminal.
struct Line {
  const char* what;
  std::string (*text)(const Figures&);
};

std::string percent(double share) {
  return std::isnan(share) ? "-" : fmt::format("{:.2f} %", 100.0 * share);
}

std::string plain(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.6g}", value);
}

std::string both(const FullReduced& pair) {
  return fmt::format("{} | {}", plain(pair.full), plain(pair.reduced));
}

constexpr std::array lines{
    Line{"window, s",
         [](const Figures& f) { return fmt::format("{:.6g} to {:.6g}", f.from, f.to); }},
    Line{"snapshots compared", [](const Figures& f) { return fmt::format("{}", f.snapshots); }},
    Line{"the modes leave out, relative", [](const Figures&) { return std::string(); }},
    Line{"  of the displacement", [](const Figures& f) { return percent(f.displacement_left); }},
    Line{"  of the velocity", [](const Figures& f) { return percent(f.velocity_left); }},
    Line{"errors of the prediction", [](const Figures&) { return std::string(); }},
    Line{"  displacement", [](const Figures& f) { return percent(f.displacement_error); }},
    Line{"  velocity", [](const Figures& f) { return percent(f.velocity_error); }},
    Line{"  displacement, mean",
         [](const Figures& f) { return percent(f.displacement_mean_error); }},
    Line{"  velocity, mean", [](const Figures& f) { return percent(f.velocity_mean_error); }},
    Line{"  pressure, mean profile", [](const Figures& f) { return percent(f.pressure_error); }},
    Line{"  shear, by the pressure", [](const Figures& f) { return percent(f.shear_error); }},
    Line{"  F_x, by F_y", [](const Figures& f) { return percent(of_load(f, f.force_x)); }},
    Line{"  F_y", [](const Figures& f) { return percent(of_load(f, f.force_y)); }},
    Line{"  friction, dissipated", [](const Figures& f) { return percent(friction_error(f)); }},
    Line{"full | reduced", [](const Figures&) { return std::string(); }},
    Line{"  F_x, mean, N/m", [](const Figures& f) { return both(f.force_x); }},
    Line{"  F_y, mean, N/m", [](const Figures& f) { return both(f.force_y); }},
    Line{"  F_x, fluctuation, N/m", [](const Figures& f) { return both(f.force_x_fluctuation); }},
    Line{"  F_y, fluctuation, N/m", [](const Figures& f) { return both(f.force_y_fluctuation); }},
    Line{"  friction, dissipated, W/m", [](const Figures& f) { return both(f.friction_power); }},
    Line{"  steps", [](const Figures& f) { return both(f.steps); }},
    Line{"  threads", [](const Figures& f) { return both(f.threads); }},
    Line{"  time of the loop and its snapshots, s",
         [](const Figures& f) {
           return fmt::format("{:.3g} | {:.3g}", f.loop_wall.full, f.loop_wall.reduced);
         }},
    Line{"speed-up, snapshots included", [](const Figures& f) {
           return fmt::format("{:.3g}{}", speed_up(f), f.same_host ? "" : " (other machines)");
         }}};

void write_profiles(const Validated& run) {
  io::Csv csv(run.reduced / "profiles.csv", {"angle_rad", "pressure_full_pa", "pressure_reduced_pa",
                                             "shear_full_pa", "shear_reduced_pa"});
  std::vector<double> rows;
  const Profile &full = run.full_profile, &reduced = run.reduced_profile;
  for (std::size_t k = 0; k < full.angle.size(); ++k)
    rows.insert(rows.end(), {full.angle[k], full.pressure[k], reduced.pressure[k], full.shear[k],
                             reduced.shear[k]});
  csv.rows(rows);
  csv.close();
}

const char* word(RunStatus status) {
  return status == RunStatus::done ? "done" : "failed";
}

}  // namespace

const std::vector<ValidationColumn>& validation_columns() {
  using F = Figures;
  static const std::vector<ValidationColumn> columns{
      {"from_s", "s", "window of the comparison", [](const F& f) { return f.from; }},
      {"to_s", "s", "its end", [](const F& f) { return f.to; }},
      {"snapshots", "1", "compared", [](const F& f) { return static_cast<double>(f.snapshots); }},
      {"displacement_left", "1", "out by the modes",
       [](const F& f) { return f.displacement_left; }},
      {"velocity_left", "1", "out by the modes", [](const F& f) { return f.velocity_left; }},
      {"displacement_error", "1", "of the prediction",
       [](const F& f) { return f.displacement_error; }},
      {"velocity_error", "1", "of the prediction", [](const F& f) { return f.velocity_error; }},
      {"displacement_mean_error", "1", "of the mean field",
       [](const F& f) { return f.displacement_mean_error; }},
      {"velocity_mean_error", "1", "of the mean field",
       [](const F& f) { return f.velocity_mean_error; }},
      {"pressure_error", "1", "of the mean profile", [](const F& f) { return f.pressure_error; }},
      {"shear_error", "1", "of the mean profile, by the pressure",
       [](const F& f) { return f.shear_error; }},
      {"force_x_error", "1", "of the mean, by force_y",
       [](const F& f) { return of_load(f, f.force_x); }},
      {"force_y_error", "1", "of the mean", [](const F& f) { return of_load(f, f.force_y); }},
      {"friction_error", "1", "of what friction dissipates", friction_error},
      {"force_x_full_n_m", "N/m", "mean", [](const F& f) { return f.force_x.full; }},
      {"force_x_reduced_n_m", "N/m", "mean", [](const F& f) { return f.force_x.reduced; }},
      {"force_y_full_n_m", "N/m", "mean", [](const F& f) { return f.force_y.full; }},
      {"force_y_reduced_n_m", "N/m", "mean", [](const F& f) { return f.force_y.reduced; }},
      {"force_x_fluctuation_full_n_m", "N/m", "root mean square about the mean",
       [](const F& f) { return f.force_x_fluctuation.full; }},
      {"force_x_fluctuation_reduced_n_m", "N/m", "likewise",
       [](const F& f) { return f.force_x_fluctuation.reduced; }},
      {"force_y_fluctuation_full_n_m", "N/m", "likewise",
       [](const F& f) { return f.force_y_fluctuation.full; }},
      {"force_y_fluctuation_reduced_n_m", "N/m", "likewise",
       [](const F& f) { return f.force_y_fluctuation.reduced; }},
      {"friction_power_full_w_m", "W/m", "dissipated by friction in the window",
       [](const F& f) { return f.friction_power.full; }},
      {"friction_power_reduced_w_m", "W/m", "likewise",
       [](const F& f) { return f.friction_power.reduced; }},
      {"steps_full", "1", "of the whole run", [](const F& f) { return f.steps.full; }},
      {"steps_reduced", "1", "of the whole run", [](const F& f) { return f.steps.reduced; }},
      {"loop_wall_full_s", "s", "of all steps", [](const F& f) { return f.loop_wall.full; }},
      {"loop_wall_reduced_s", "s", "of all steps", [](const F& f) { return f.loop_wall.reduced; }},
      {"speed_up", "1", "of the loop", speed_up},
      {"threads_full", "1", "", [](const F& f) { return f.threads.full; }},
      {"threads_reduced", "1", "", [](const F& f) { return f.threads.reduced; }},
      {"same_host", "1", "1 if both were done on one machine",
       [](const F& f) { return f.same_host ? 1.0 : 0.0; }},
  };
  return columns;
}

std::string validation_csv(const ValidationReport& report) {
  std::string text = "run";
  for (const ValidationColumn& column : validation_columns())
    text += fmt::format(",{}", column.name);
  text.push_back('\n');
  for (const Validated& run : report.runs) {
    text += field_of(run.name);
    for (const ValidationColumn& column : validation_columns())
      text += fmt::format(
          ",{}", run.status == RunStatus::done ? number(column.value(run.figures)) : "nan");
    text.push_back('\n');
  }
  return text;
}

std::string validation_text(const ValidationReport& report) {
  std::vector<std::vector<std::string>> columns(1);
  columns[0] = {"held out"};
  for (const Line& line : lines) columns[0].emplace_back(line.what);
  for (const Validated& run : report.runs) {
    std::vector<std::string> column{run.name};
    for (const Line& line : lines)
      column.push_back(run.status == RunStatus::done ? line.text(run.figures) : "failed");
    columns.push_back(std::move(column));
  }
  std::string text;
  for (std::size_t row = 0; row <= lines.size(); ++row) {
    std::string whole;
    for (const std::vector<std::string>& column : columns) {
      std::size_t width = 0;
      for (const std::string& cell : column) width = std::max(width, cell.size());
      whole += &column == &columns.front() ? fmt::format("{:<{}}", column[row], width)
                                           : fmt::format("  {:>{}}", column[row], width);
    }
    whole.erase(whole.find_last_not_of(' ') + 1);
    text += fmt::format("{}\n", whole);
  }
  return text;
}

void write_validation(const ValidationRequest& request, const ValidationReport& report) {
  Json runs = Json::array();
  for (const Validated& run : report.runs) {
    if (!run.full_profile.angle.empty()) write_profiles(run);
    runs.push_back({{"name", as_utf8(run.name)},
                    {"full", as_utf8(run.full.string())},
                    {"status", word(run.status)},
                    {"message", run.message},
                    {"profiles", !run.full_profile.angle.empty()}});
  }
  Json json;
  json["format"] = validation_format;
  json["status"] = word(report.status());
  describe_program(json);
  json["model"] = as_utf8(request.model.string());
  json["step_factor"] = request.step_factor;
  json["runs"] = std::move(runs);
  Json columns = Json::object();
  for (const ValidationColumn& column : validation_columns())
    columns[std::string(column.name)] = column.unit;
  json["units"] = std::move(columns);
  io::write_file(report.directory / validation_table_name, validation_csv(report));
  io::write_json(report.directory / validation_record_name, json);
}

}  // namespace rondo::study
