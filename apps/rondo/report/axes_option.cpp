// SPDX-License-Identifier: BSD-3-Clause
#include "report/axes_option.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "report/python_package.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/axes_tables.hpp"

namespace rondo::app {
namespace {

constexpr const char* option = "--axes";
constexpr const char* without = "the columns of rondo, without --axes";

bool is_below_zero(const dynamics::Table& table) {
  return std::ranges::any_of(table.points(), [](const auto& point) { return point[1] < 0.0; });
}

/// @throws InputError: forces of this case have no other axes
void refuse(const study::Case& c, const std::string& axes) {
  const auto fault = [&](const std::string& message, const char* allowed) {
    throw request_error(option, axes, message, allowed);
  };
  if (!study::is_solid(c))
    fault("the body is plane, and other axes are of wheels in three dimensions", without);
  const study::AnalysisKind kind = c.analysis.kind;
  if (kind == study::AnalysisKind::crush || kind == study::AnalysisKind::inflation)
    fault(fmt::format("analysis.kind is \"{}\", and other axes are of wheels that roll",
                      study::rules_of(kind).name),
          without);
  if (!c.ground) fault("the case has no [ground], whose forces other axes are of", without);
  for (const auto& [key, table] :
       {std::pair{"motion.speed", &c.motion.speed},
        std::pair{"motion.angular_velocity", &c.motion.angular_velocity}})
    if (is_below_zero(*table))
      fault(fmt::format("the wheel rolls backwards ({} < 0), for which the systems define their "
                        "signs differently",
                        key),
            "the mirror image, with motion.speed and motion.angular_velocity > 0");
}

void demand_python() {
  static_cast<void>(find_python(find_python_package()));
}

}  // namespace

void add_axes(CLI::App& command, std::string& axes) {
  command
      .add_option(option, axes,
                  fmt::format("Of wheels in three dimensions: writes the forces in these axes as "
                              "well, into a table beside the results, and prints the last: {}",
                              fmt::join(io::axes_names, " | ")))
      ->check([](const std::string& text) -> std::string {
        if (std::ranges::find(io::axes_names, text) != io::axes_names.end()) return {};
        return fmt::format("no such axes: {} (allowed: {})", text, fmt::join(io::axes_names, ", "));
      });
}

void demand_axes(const study::Case& c, const std::string& axes) {
  if (axes.empty()) return;
  refuse(c, axes);
  demand_python();
}

void demand_axes(SweepArguments& arguments) {
  if (arguments.axes.empty()) return;
  if (arguments.dry_run || !arguments.shard.empty())
    throw request_error(option, arguments.axes, "is of a whole sweep that is made",
                        "--axes without --dry-run and --shard; with --collect, or rondo axes");
  demand_python();
  arguments.request.accept = [axes = arguments.axes](const study::Case& c) { refuse(c, axes); };
}

int write_axes(const std::filesystem::path& directory, const std::string& axes, int code,
               const Telling& tell) {
  if (axes.empty()) return code;
  if (code == exit_interrupted) {
    spdlog::warn(
        "no table in other axes was written; once the results are complete: rondo axes {} --axes "
        "{}",
        directory.string(), axes);
    return code;
  }
  const int written = run_python({"axes", "--axes", axes, "--unfinished", "--", directory.string()},
                                 tell.quiet || tell.json);
  return code != exit_done ? code : written;
}

}  // namespace rondo::app
