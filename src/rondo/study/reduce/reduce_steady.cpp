// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/reduce/reduce_steady.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "rondo/core/error.hpp"
#include "rondo/io/files.hpp"

namespace rondo::study {
namespace {

constexpr std::size_t most_left_out = 12;  ///< largest number of steady states

void check_steady(const io::RunReader& run, bool turning) {
  const std::string name = run.directory().string();
  if (run.n_snapshots() == 0)
    throw request_error(
        "RUN", name, "the steady state has no snapshots",
        "a run of its own (rondo run), or a sweep whose study file says snapshots = true");
  if (turning)
    throw request_error("--frame", "co-rotating",
                        fmt::format("{} is a steady state over a sector's pass: in the co-rotating "
                                    "frame that is one angle of the turn",
                                    name),
                        "--frame rectified, or runs of analysis.kind = \"dynamic\"");
}

}  // namespace

bool is_steady(const io::RunReader& run) {
  return run.analysis() == "steady-rolling";
}

void take_steady(const io::RunReader& run, bool turning, Case& c) {
  check_steady(run, turning);
  const std::filesystem::path file = run.directory() / "run.json";
  const nlohmann::ordered_json json = io::read_json(file);
  const auto number = [&](const char* key) {
    const bool known =
        json.contains("steady") && json["steady"].contains(key) && json["steady"][key].is_number();
    return known ? json["steady"][key].get<double>() : std::numeric_limits<double>::quiet_NaN();
  };
  const double height = number("height"), speed = number("speed");
  if (!std::isfinite(height) || !std::isfinite(speed))
    throw FileError(file.string(), "has no height and speed of the steady state: damaged");
  c.analysis = {};
  c.motion.height = dynamics::Table(height);
  c.motion.speed = dynamics::Table(speed);
  c.time.end = std::numbers::pi / std::abs(c.motion.angular_velocity.at(0.0));
}

Case off_the_ground(Case c) {
  c.initial = {};
  if (c.ground) {
    double top = 0.0;
    for (const Vec2 corner : c.ground->shape.profile) top = std::max(top, corner.y);
    c.motion.height = dynamics::Table(top + 2.0 * c.disk.outer_radius);
  }
  return c;
}

void weigh_steady(std::span<const io::RunReader> runs, std::vector<SnapshotColumn>& columns) {
  double steady = 0.0;
  for (const SnapshotColumn& column : columns) steady += is_steady(runs[column.run]) ? 1.0 : 0.0;
  const double others = static_cast<double>(columns.size()) - steady;
  if (steady == 0.0 || others == 0.0) return;
  for (SnapshotColumn& column : columns)
    if (is_steady(runs[column.run])) column.weight = std::sqrt(others / steady);
}

std::vector<std::size_t> runs_to_leave_out(std::span<const io::RunReader> runs) {
  std::vector<std::size_t> steady, chosen;
  for (std::size_t k = 0; k < runs.size(); ++k) (is_steady(runs[k]) ? steady : chosen).push_back(k);
  if (steady.empty()) return chosen;
  const std::size_t n = std::min(most_left_out, steady.size());
  for (std::size_t k = 0; k < n; ++k) chosen.push_back(steady[k * steady.size() / n]);
  return chosen;
}

}  // namespace rondo::study
