// SPDX-License-Identifier: BSD-3-Clause
/// docs/cases.md has the tables of keys that the table of keys gives, cases/schema the schema.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "rondo/case/case_keys.hpp"
#include "rondo/case/features/case_features.hpp"
#include "rondo/case/schema/case_schema.hpp"
#include "support/manual.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study::manual_test {
namespace {

std::string rows_of(const CaseTable& table) {
  std::string rows =
      "| key | type | unit | allowed | default | meaning |\n|---|---|---|---|---|---|\n";
  for (const CaseKey& key : keys_of(table))
    rows += rondo::test::manual_row({fmt::format("`{}`", key.path), std::string(type_text(key)),
                                     std::string(key.unit), allowed_text(key), default_text(key),
                                     std::string(key.meaning)});
  return rows;
}

TEST(Manual, HasTheKeys) {
  std::vector<rondo::test::ManualTable> tables;
  for (const CaseTable& table : case_tables())
    tables.push_back(
        {fmt::format("keys: {}", table.path.empty() ? "at the top" : table.path), rows_of(table)});
  rondo::test::expect_in_manual(test::source_folder() / "docs" / "cases.md", tables);
}

/// "yes", or "no" with the number of the reason, which is added to `reasons` if it is new.
std::string cell_of(const dynamics::StepRow& step, dynamics::Features of,
                    std::vector<std::string_view>& reasons) {
  const dynamics::Limit* const limit = why_not(step.kind, of | step.needs);
  if (limit == nullptr) return "yes";
  auto known = std::ranges::find(reasons, limit->why);
  if (known == reasons.end()) known = reasons.insert(known, limit->why);
  return fmt::format("no ({})", known - reasons.begin() + 1);
}

std::string features_by_steps() {
  std::string head = "| |", line = "|---|", rows, numbered;
  std::vector<std::string_view> reasons;
  for (const dynamics::StepRow& step : dynamics::step_rows()) {
    head += fmt::format(" {} |", step.name);
    line += "---|";
  }
  for (const dynamics::FeatureName& feature : dynamics::feature_names()) {
    if (feature.of == dynamics::has::reduced) continue;  // a column
    std::vector<std::string> cells{std::string(feature.name)};
    for (const dynamics::StepRow& step : dynamics::step_rows())
      cells.push_back(cell_of(step, feature.of, reasons));
    rows += rondo::test::manual_row(cells);
  }
  for (std::size_t k = 0; k < reasons.size(); ++k)
    numbered += fmt::format("{}. {}\n", k + 1, reasons[k]);
  return head + "\n" + line + "\n" + rows + "\n" + numbered;
}

std::string refused_pairs() {
  std::string rows = "| refused | with | because |\n|---|---|---|\n";
  for (const dynamics::Limit& limit : dynamics::step_limits())
    if (limit.is_refusal())
      rows += rondo::test::manual_row({std::string(dynamics::name_of(limit.at)),
                                       std::string(dynamics::name_of(limit.with)),
                                       std::string(limit.why)});
  return rows;
}

TEST(Manual, HasWhatGoesWithWhat) {
  rondo::test::expect_in_manual(test::source_folder() / "docs" / "cases.md",
                                {{"what goes with what: steps", features_by_steps()},
                                 {"what goes with what: refused", refused_pairs()}});
}

TEST(Manual, HasTheSchemaOfCases) {
  rondo::test::expect_file(test::source_folder() / "cases" / "schema" / "case.json",
                           case_schema().dump(2) + "\n");
}

}  // namespace
}  // namespace rondo::study::manual_test
