// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "commands.hpp"
#include "documents/documents.hpp"
#include "rondo/core/bytes.hpp"

namespace rondo::app {

int matrices(MatricesArguments arguments, Telling& tell) {
  if (tell.quiet) spdlog::set_level(spdlog::level::warn);
  study::MatricesRequest& request = arguments.request;
  request.warn = [](const std::string& text) { spdlog::warn(text); };
  const study::Case c = study::read_case(arguments.case_file, arguments.settings);
  const study::MatricesReport r = study::write_matrices(c, request);
  if (tell.json) {
    tell.result = matrices_document(r);
    return exit_done;
  }
  if (tell.quiet) return exit_done;
  fmt::print("unknowns           {} of {} nodes\n", r.unknowns, r.nodes);
  fmt::print("stiffness          {} entries\n", r.entries);
  if (r.contact_nodes > 0)
    fmt::print("contact rows       {} nodes, at {:.6g} s\n", r.contact_nodes, r.time);
  else
    fmt::print("contact rows       none: there is no ground\n");
  fmt::print("matrices           {} ({})\n", r.file.string(), readable_bytes(r.bytes));
  return exit_done;
}

}  // namespace rondo::app
