// SPDX-License-Identifier: BSD-3-Clause
/// docs/cases.md has the tables of keys that the table of keys gives, cases/schema the schema.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rondo/case/case_keys.hpp"
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

TEST(Manual, HasTheSchemaOfCases) {
  rondo::test::expect_file(test::source_folder() / "cases" / "schema" / "case.json",
                           case_schema().dump(2) + "\n");
}

}  // namespace
}  // namespace rondo::study::manual_test
