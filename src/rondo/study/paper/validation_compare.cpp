// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/paper/validation_compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/io/files.hpp"
#include "rondo/study/paper/paper_results.hpp"
#include "rondo/study/pod/pod_input.hpp"
#include "rondo/study/sweep/sweep_figures.hpp"

namespace rondo::study {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

using Readers = std::vector<io::RunReader>;

/// One field of one run, rectified or, without a shift, in the turning frame, times √M.
struct FieldOfRun {
  std::vector<double> time;
  RunSnapshots snapshots;

  FieldOfRun(const io::RunReader& run, io::Quantity quantity,
             std::optional<pod::Shift> shift = pod::Shift::fourier)
      : FieldOfRun(std::span(&run, 1), {quantity, Weight::mass, shift},
                   all_columns(run, quantity)) {}

  VectorXd at(std::size_t snapshot) {
    MatrixXd column(snapshots.rows(), 1);
    snapshots.read_columns(static_cast<Index>(snapshot), column);
    return column.col(0);
  }

 private:
  FieldOfRun(std::span<const io::RunReader> run, const SnapshotChoice& choice,
             const std::vector<Column>& columns)
      : snapshots(run, columns, choice) {
    for (const Column& column : columns) time.push_back(column.time);
  }

  static std::vector<Column> all_columns(const io::RunReader& run, io::Quantity quantity) {
    const bool velocity = quantity == io::Quantity::velocity;
    const io::RunTimes& of = run.times();
    std::vector<Column> columns;
    for (std::size_t j = 0; j < run.n_snapshots(); ++j)
      columns.push_back({0, j, velocity ? of.time_velocity[j] : of.time[j],
                         velocity ? of.angle_velocity[j] : of.angle[j]});
    return columns;
  }
};

/// The prediction at a time of the full run: its field stands nearly still in the rectified frame,
/// where a line between two snapshots says what is between them.
class Interpolated {
 public:
  explicit Interpolated(FieldOfRun& field) : field_(field) {}

  VectorXd at(const Between& place) {
    const VectorXd& before = snapshot(place.first);
    if (place.weight == 0.0) return before;
    return (1.0 - place.weight) * before + place.weight * snapshot(place.first + 1);
  }

 private:
  /// Times rise: the last two are enough.
  const VectorXd& snapshot(std::size_t j) {
    auto& [number, field] = kept_[j % 2];
    if (field.size() == 0 || number != j) {
      number = j;
      field = field_.at(j);
    }
    return field;
  }

  FieldOfRun& field_;
  std::array<std::pair<std::size_t, VectorXd>, 2> kept_;
};

struct FieldErrors {
  SquareSums left, error;
  VectorXd full, reduced;  ///< sums of the snapshots compared
  std::size_t compared = 0;

  void take(const VectorXd& field, const VectorXd& predicted) {
    error.difference += (predicted - field).squaredNorm();
    error.of += field.squaredNorm();
    full = compared == 0 ? field : full + field;
    reduced = compared == 0 ? predicted : reduced + predicted;
    ++compared;
  }
  [[nodiscard]] double of_means() const {
    return SquareSums{(reduced - full).squaredNorm(), full.squaredNorm()}.relative();
  }
};

/// What the modes leave of each snapshot of the window, and what the prediction misses of those
/// that lie between two of its own.
FieldErrors field_errors(const ReducedFile& model, const ValidationWindow& window,
                         const Readers& runs, io::Quantity quantity) {
  FieldOfRun full(runs[0], quantity), reduced(runs[1], quantity);
  std::optional<pod::Shift> shift = pod::Shift::fourier;
  if (model.model.frame == rom::ModelFrame::turning) shift.reset();
  FieldOfRun own(runs[0], quantity, shift);  // in the frame of the modes
  Interpolated predicted(reduced);
  const VectorXd roots = rom::mass_roots(model.mass);
  FieldErrors found;
  for (std::size_t j = 0; j < full.time.size(); ++j) {
    if (full.time[j] < window.from || full.time[j] > window.to) continue;
    const VectorXd field = full.at(j);
    const double norm = field.squaredNorm();
    if (const std::optional<Between> place = between(reduced.time, full.time[j]))
      found.take(field, predicted.at(*place));
    VectorXd weighted = own.at(j);
    own.snapshots.unweight(weighted);
    weighted.array() *= roots.array().square();
    const VectorXd inside = model.model.basis.transpose() * weighted;
    found.left.difference += std::max(0.0, norm - inside.squaredNorm());
    found.left.of += norm;
  }
  return found;
}

Profile profile_of(const io::RunReader& run, const ValidationWindow& window) {
  ProfileSum sum(run.mesh());
  std::vector<Vec2> force(run.mesh().boundary.size());
  const io::RunTimes& times = run.times();
  bool any = false;
  for (std::size_t j = 0; j < times.time.size(); ++j) {
    if (times.time[j] < window.from || times.time[j] > window.to) continue;
    run.read(io::Quantity::contact, j, 0, force);
    sum.add(times.angle[j], force);
    any = true;
  }
  return any ? sum.mean() : Profile{};
}

void compare_fields(const ReducedFile& model, const ValidationWindow& window, const Readers& runs,
                    ValidationFigures& c) {
  const FieldErrors u = field_errors(model, window, runs, io::Quantity::displacement);
  const FieldErrors v = field_errors(model, window, runs, io::Quantity::velocity);
  c.snapshots = std::min(u.compared, v.compared);
  c.displacement_left = u.left.relative();
  c.velocity_left = v.left.relative();
  c.displacement_error = u.error.relative();
  c.velocity_error = v.error.relative();
  c.displacement_mean_error = u.of_means();
  c.velocity_mean_error = v.of_means();
}

void compare_profiles(const ValidationWindow& window, const Readers& runs, Validated& run) {
  if (!runs[0].has(io::Quantity::contact)) return;
  const Profile full = profile_of(runs[0], window), reduced = profile_of(runs[1], window);
  if (full.angle.empty() || reduced.angle.empty()) return;
  run.figures.pressure_error = profile_error(full.pressure, reduced.pressure, full.pressure);
  run.figures.shear_error = profile_error(full.shear, reduced.shear, full.pressure);
  run.full_profile = full;
  run.reduced_profile = reduced;
}

/// Steps, or rows, longer than the window leave nothing to take means of.
void demand_rows(const std::filesystem::path& directory, const ValidationWindow& window) {
  const std::filesystem::path file = directory / "history.csv";
  const Columns history = io::read_columns(file);
  const std::vector<double>& time = column(history, "time_s", file);
  for (std::size_t k = 1; k < time.size(); ++k)
    if (time[k - 1] >= window.from && time[k] <= window.to) return;
  throw request_error("--validate-from, --validate-to",
                      fmt::format("{:.9g} to {:.9g} s", window.from, window.to),
                      fmt::format("no row of {} lies in this window", file.string()),
                      "a longer window; a smaller --step-factor, where it is that of a prediction");
}

void take_history(const std::filesystem::path& directory, const ValidationWindow& window,
                  double FullReduced::*side, ValidationFigures& c) {
  demand_rows(directory, window);
  const std::vector<double> figures =
      figures_of(directory, AnalysisKind::dynamic, {window.from, window.to});
  const std::span<const FigureColumn> columns = figure_columns(AnalysisKind::dynamic);
  const auto figure = [&](std::string_view name) {
    const auto found = std::ranges::find(columns, name, &FigureColumn::name);
    RONDO_DEMAND(found != columns.end(), columns.size());
    return figures[static_cast<std::size_t>(found - columns.begin())];
  };
  c.force_x.*side = figure("force_x_mean");
  c.force_y.*side = figure("force_y_mean");
  c.force_x_fluctuation.*side = figure("force_x_fluctuation");
  c.force_y_fluctuation.*side = figure("force_y_fluctuation");
  c.friction_power.*side = figure("friction_power");
}

std::string take_summary(const std::filesystem::path& directory, double FullReduced::*side,
                         ValidationFigures& c) {
  const nlohmann::ordered_json json = io::read_json(directory / "run.json");
  const auto number = [&](const char* key) {
    return json.contains(key) && json[key].is_number() ? json[key].get<double>() : no_figure;
  };
  c.steps.*side = number("steps_done");
  c.loop_wall.*side = number("loop_wall_s");
  c.threads.*side = number("threads");
  return json.contains("host") && json["host"].is_string() ? json["host"].get<std::string>() : "";
}

}  // namespace

ValidationWindow window_of(const ValidationRequest& request, const std::filesystem::path& run) {
  const io::RunReader reader(run);
  const std::vector<double>& times = reader.times().time;
  ValidationWindow window;
  window.to = request.to.value_or(times.back());
  window.from = request.from.value_or(0.75 * window.to);
  const auto inside = [&](double t) { return t >= window.from && t <= window.to; };
  if (std::ranges::none_of(times, inside))
    throw request_error("--validate-from, --validate-to",
                        fmt::format("{:.9g} to {:.9g} s", window.from, window.to),
                        fmt::format("no snapshot of {} is in this window", run.string()),
                        fmt::format("a window that meets [{:.9g}, {:.9g}] s, where its {} "
                                    "snapshots are",
                                    times.front(), times.back(), times.size()));
  return window;
}

void compare(const ReducedFile& model, const ValidationWindow& window, Validated& run) {
  Readers runs;
  runs.emplace_back(run.full);
  runs.emplace_back(run.reduced);
  const std::string difference = io::mesh_difference(runs[0], runs[1]);
  if (!difference.empty())
    throw request_error(
        "--validate", run.full.string(),
        fmt::format("not the mesh that this version makes of its case: {}", difference),
        "the run done again by this version");
  ValidationFigures& c = run.figures;
  c.from = window.from;
  c.to = window.to;
  compare_fields(model, window, runs, c);
  compare_profiles(window, runs, run);
  take_history(run.full, window, &FullReduced::full, c);
  take_history(run.reduced, window, &FullReduced::reduced, c);
  const std::string host = take_summary(run.full, &FullReduced::full, c);
  c.same_host = host == take_summary(run.reduced, &FullReduced::reduced, c) && !host.empty();
}

}  // namespace rondo::study
