// SPDX-License-Identifier: BSD-3-Clause
#include "commands.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <functional>
#include <numbers>

#include "default_directory.hpp"
#include "documents/documents.hpp"
#include "progress.hpp"
#include "signals.hpp"

namespace rondo::app {
namespace {

void print_modes(const study::ModesReport& r) {
  fmt::print("{:>5}  {:>12}  {:>14}  {:>12}  {:>9}  {:<9} {:>9}\n", "mode", "spin (rad/s)",
             "omega (rad/s)", "f (Hz)", "diameters", "wave", "residual");
  int number = 0;
  for (const study::ModeLine& m : r.modes)
    fmt::print("{:>5}  {:>12.6g}  {:>14.8g}  {:>12.6g}  {:>9}  {:<9} {:>9.1e}\n", ++number,
               m.angular_velocity, m.omega, m.omega / (2.0 * std::numbers::pi),
               m.diameters < 0 ? "-" : fmt::to_string(m.diameters), study::name_of(m.wave),
               m.residual);
}

void print_critical(const study::ModesReport& r) {
  if (r.critical.empty()) return;
  fmt::print("critical speeds    n: rotation speed (rad/s), rim speed (m/s)\n");
  for (const auto& c : r.critical)
    fmt::print("{:>18}: {:.6g}, {:.6g}\n", c.diameters, c.spin, c.spin * r.outer_radius);
}

void print_report(const study::ModesReport& r) {
  print_modes(r);
  print_critical(r);
  if (r.on_ground)
    fmt::print(
        "standing           center {:.6g} m above the ground, load {:.6g} N, {} nodes touch\n",
        r.on_ground->height, r.on_ground->load, r.on_ground->nodes);
  fmt::print("files              {}\n", r.directory.string());
}

}  // namespace

int modes(ModesArguments arguments, Telling& tell) {
  if (tell.quiet) spdlog::set_level(spdlog::level::warn);
  const study::Case c = study::read_case(arguments.case_file, arguments.settings);
  study::ModesRequest& request = arguments.request;
  if (request.run.directory.empty())
    request.run.directory = default_directory(arguments.case_file, "-modes");
  request.run.warn = [](const std::string& text) { spdlog::warn(text); };
  request.run.stop = &stop_requested();
  request.run.before_loop = catch_stop_signals;
  Progress progress("spin");
  if (!tell.quiet) request.run.progress = std::ref(progress);
  const study::ModesReport r = study::run_modes(c, request);
  if (tell.json)
    tell.result = modes_document(r);
  else
    print_report(r);
  switch (r.run.status) {
    case study::RunStatus::failed:
      spdlog::error("{}; what there is is in {}", r.run.message, r.directory.string());
      return exit_numerical;
    case study::RunStatus::interrupted:
      warn_of_end(tell, fmt::format("interrupted after {}; their modes are in {}", r.run.reached,
                                    r.directory.string()));
      return exit_interrupted;
    case study::RunStatus::done:
      break;
  }
  spdlog::info("{} modes of {} degrees of freedom in {:.2f} s", r.modes.size(), r.dofs, r.wall_s);
  return exit_done;
}

}  // namespace rondo::app
