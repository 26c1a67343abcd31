// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/run_json/run_json.hpp"

#include <fmt/format.h>

#include "rondo/analysis/base/region_figures.hpp"
#include "rondo/analysis/base/shared_members.hpp"
#include "rondo/analysis/base/strain_watch.hpp"
#include "rondo/analysis/build/tyre/inflation_members.hpp"
#include "rondo/analysis/crush/crush.hpp"
#include "rondo/analysis/crush/latin_solver.hpp"
#include "rondo/analysis/dynamic_members.hpp"
#include "rondo/analysis/inflation/inflation.hpp"
#include "rondo/analysis/modes/modes_output.hpp"
#include "rondo/analysis/reduced/wheel.hpp"
#include "rondo/analysis/rubber_watch.hpp"
#include "rondo/analysis/run_session.hpp"
#include "rondo/analysis/steady/steady.hpp"
#include "rondo/core/column.hpp"

namespace rondo::study {

std::vector<MemberGroup> run_json_groups() {
  return {{"all runs", joined({run_file_members(), session_members()})},
          {"several analyses", joined({shared_members(), region_members(), strain_members(),
                                       rubber_members(), inflated_members()})},
          {"dynamic", dynamic_members()},
          {"reduced", wheel_members()},
          {"crush", crush_members()},
          {"latin", latin_members()},
          {"steady-rolling", steady_members()},
          {"inflation", inflation_members()},
          {"modes", modes_members()}};
}

Json run_json_schema() {
  std::vector<MemberText> all;
  for (const MemberGroup& group : run_json_groups())
    all.insert(all.end(), group.members.begin(), group.members.end());
  Json schema = schema_of(all, false);
  for (const MemberText& member : run_file_members())
    if (member.name != "message") schema["required"].push_back(member.name);
  return schema;
}

namespace {

/// Without the marks of Markdown, in quotes.
std::string quoted(std::string_view markdown) {
  std::string text = without_links(markdown);
  std::erase(text, '`');
  return Json(text).dump();
}

}  // namespace

std::string python_members() {
  std::string text =
      "# SPDX"
      "-License-Identifier: BSD-3-Clause\n"  // in parts: this file has its own
      "\"\"\"Members of run.json: unit of a plane body, unit of a wheel in three dimensions, and "
      "meaning.\nWritten from the library's rows "
      "(src/rondo/study/run_json): RONDO_WRITE_MANUAL=1 ctest -R Manual.\"\"\"\n\n"
      "MEMBERS: dict[str, tuple[str, str, str]] = {\n";
  for (const MemberGroup& group : run_json_groups())
    for (const auto& [path, member] : paths_of(group.members))
      text += fmt::format("    \"{}\": (\"{}\", \"{}\", {}),\n", path, member.unit,
                          unit_of(member.unit, true), quoted(member.meaning));
  return text + "}\n";
}

}  // namespace rondo::study
