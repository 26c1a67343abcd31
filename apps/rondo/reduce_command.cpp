// SPDX-License-Identifier: BSD-3-Clause
#include "commands.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <functional>
#include <string>

#include "documents/documents.hpp"
#include "progress.hpp"
#include "rondo/core/bytes.hpp"

namespace rondo::app {
namespace {

void print_part(const study::ReducePart& part, double left) {
  fmt::print("{:<19}{} modes of {} snapshots; they leave {:.2e} of the energy, all modes {:.2e}\n",
             part.field, part.modes, part.snapshots, part.discarded, left);
}

void print_report(const study::ReduceRequest& request, const study::ReduceReport& r) {
  fmt::print("modes              {} for {} dofs\n", r.modes, r.dofs);
  print_part(r.displacement, r.displacement_left);
  print_part(r.velocity, r.velocity_left);
  fmt::print("contact points     {} {} round the disk{}\n", r.contact_points, r.contact,
             r.contact_step > 0.0 ? fmt::format(", one passed in {:.6g} s", r.contact_step) : "");
  fmt::print("critical steps     {:.6g} s of the mesh, {:.6g} s of the modes (explicit)\n",
             r.full_critical_step, r.reduced_critical_step);
  fmt::print("error estimate     {}\n", study::in_words(r.estimate));
  fmt::print("time               {:.2f} s\n", r.wall_s);
  fmt::print("model              {} ({})\n", request.output.string(), readable_bytes(r.file_bytes));
}

}  // namespace

int reduce(study::ReduceRequest request, Telling& tell) {
  if (tell.quiet) spdlog::set_level(spdlog::level::warn);
  request.warn = [](const std::string& text) { spdlog::warn(text); };
  const study::ReduceReport report = [&] {
    Progress progress("value");
    if (!tell.quiet) request.progress = std::ref(progress);
    return study::run_reduce(request);
  }();
  if (tell.json)
    tell.result = reduce_document(request, report);
  else
    print_report(request, report);
  return exit_done;
}

}  // namespace rondo::app
