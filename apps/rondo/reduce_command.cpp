// SPDX-License-Identifier: BSD-3-Clause
#include "commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <functional>
#include <string>

#include "documents/documents.hpp"
#include "progress.hpp"
#include "rondo/core/bytes.hpp"

namespace rondo::app {
namespace {

void print_report(const study::ReduceRequest& request, const study::ReduceReport& r) {
  fmt::print("modes              {} {} for {} dofs, up to {:.5g} rad/s\n", r.modes,
             r.basis == "pod" ? "of a POD" : "eigenmodes", r.dofs, r.highest);
  if (r.snapshots > 0)
    fmt::print("snapshots          {}; the modes leave out {:.2e} of their energy\n", r.snapshots,
               r.left);
  fmt::print("contact nodes      {}, with tables of compliance at {:.5g} rad/s\n", r.contact_nodes,
             fmt::join(r.spins, ", "));
  fmt::print("time               {:.2f} s\n", r.wall_s);
  fmt::print("wheel              {} ({})\n", request.output.string(), readable_bytes(r.file_bytes));
}

}  // namespace

int reduce(study::ReduceRequest request, Telling& tell) {
  if (tell.quiet) spdlog::set_level(spdlog::level::warn);
  request.warn = [](const std::string& text) { spdlog::warn(text); };
  const study::ReduceReport report = [&] {
    Progress progress("snapshot");
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
