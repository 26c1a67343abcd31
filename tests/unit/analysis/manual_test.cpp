// SPDX-License-Identifier: BSD-3-Clause
/// docs/results.md has the columns of history.csv and contact.csv, and the members of run.json,
/// that their tables give; so has python/rondo/data/members.py.
#include "support/manual.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "rondo/analysis/registry.hpp"
#include "rondo/analysis/steady/slip_step.hpp"
#include "rondo/output/columns.hpp"
#include "rondo/study/run_json/run_json.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study::manual_test {
namespace {

using Labels = std::vector<ColumnLabel>;

Labels history_of(const std::vector<std::string>& settings, const std::string& text = test::base) {
  const Case c = test::read_text(text, settings);
  return make_analysis(c, {})->record_plan().columns;
}

Labels further_contact_of(const std::vector<std::string>& settings) {
  const Case c = test::read_text(test::base, settings);
  return labels_of(make_analysis(c, {})->record_plan().contact_columns);
}

/// Behind those that every history has, or every one with these features.
Labels further(Labels labels, const HistoryFeatures& features = {}) {
  const auto shared = static_cast<std::ptrdiff_t>(history_labels(features).size());
  labels.erase(labels.begin(), labels.begin() + shared);
  return labels;
}

rondo::test::ManualTable table_of(std::string_view what, const Labels& labels) {
  std::string rows = "| column | unit | |\n|---|---|---|\n";
  for (const auto& [name, unit, meaning] : labels)
    rows += rondo::test::manual_row({fmt::format("`{}`", name), unit, meaning});
  return {fmt::format("columns: {}", what), rows};
}

TEST(Manual, HasTheColumns) {
  const Labels probe = history_of({"output.probe=[{name = 'NAME', position = [0.2, 0.0]}]"});
  const Labels rim = history_of({"rim.free=[]"});
  const Labels massless = history_of({"solver.contact_mass=singular"});
  const Labels hati =
      history_of({"time.scheme=hati", "solver.hati.ratio=1", "solver.hati.fine.layers=[12]"});
  const Labels rubber = history_of({}, test::rubber("model = \"neo-hooke\"\nshear_modulus = 1e6"));
  const Labels crush = history_of({"analysis.kind=crush", "analysis.depth=0.01",
                                   "analysis.increments=1", "ground.profile=flat"});
  const Labels solid = history_of({"disk.width=0.1", "ground.profile=flat", "motion.height=0.3"});
  const Labels wheel_crush =
      history_of({"analysis.kind=crush", "analysis.load=100", "analysis.increments=1",
                  "ground.profile=flat", "disk.width=0.1"});
  const std::vector<std::string> rolls{"analysis.kind=steady-rolling", "ground.profile=flat"};
  const Labels steady = history_of(rolls);
  rondo::test::expect_in_manual(
      test::source_folder() / "docs" / "results.md",
      {table_of("history.csv", history_labels({})), table_of("probe", further(probe)),
       table_of("rim", further(rim)), table_of("massless", further(massless)),
       table_of("hati", further(hati)), table_of("rubber", further(rubber)),
       table_of("crush", further(crush)),
       table_of("crush of a wheel in three dimensions", further(wheel_crush, {.solid = true})),
       table_of("steady-rolling", further(steady)),
       table_of("wheel in three dimensions", further(solid)),
       table_of("contact.csv", labels_of(contact_columns(false))),
       table_of("contact.csv of a wheel in three dimensions", labels_of(contact_columns(true))),
       table_of("contact.csv in time", further_contact_of({})),
       table_of("contact.csv steady-rolling", further_contact_of(rolls)),
       table_of("slip-step.csv", slip_step_labels())});
}

TEST(Manual, HasTheMembersOfRunJson) {
  std::vector<rondo::test::ManualTable> tables;
  std::set<std::string> all;
  for (const MemberGroup& group : run_json_groups()) {
    std::string rows = "| key | type | unit | meaning |\n|---|---|---|---|\n";
    for (const auto& [path, member] : paths_of(group.members)) {
      EXPECT_TRUE(all.insert(path).second) << path << " has two rows";
      rows += rondo::test::manual_row({fmt::format("`{}`", path), std::string(member.type),
                                       std::string(member.unit), std::string(member.meaning)});
    }
    tables.push_back({fmt::format("members: {}", group.of), rows});
  }
  rondo::test::expect_in_manual(test::source_folder() / "docs" / "results.md", tables);
  rondo::test::expect_file(test::source_folder() / "python" / "rondo" / "data" / "members.py",
                           python_members());
}

}  // namespace
}  // namespace rondo::study::manual_test
