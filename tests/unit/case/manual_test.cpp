// SPDX-License-Identifier: BSD-3-Clause
/// docs/cases.md has the tables of keys that the table of keys gives. With RONDO_WRITE_MANUAL in
/// the environment this test writes them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "rondo/case/case_keys.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study {
namespace {

using namespace test;

constexpr std::string_view end_mark = "<!-- end -->\n";

std::string mark_of(const CaseTable& table) {
  return fmt::format("<!-- keys: {} -->\n", table.path.empty() ? "at the top" : table.path);
}

std::string rows_of(const CaseTable& table) {
  std::string rows =
      "| key | type | unit | allowed | default | meaning |\n|---|---|---|---|---|---|\n";
  for (const CaseKey& key : keys_of(table))
    rows += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.path, type_text(key), key.unit,
                        allowed_text(key), default_text(key), key.meaning);
  return rows;
}

TEST(Manual, IsCurrent) {
  const auto file = source_folder() / "docs" / "cases.md";
  const std::string manual = file_text(file);
  std::string current = manual;
  for (const CaseTable& table : case_tables()) {
    const std::string mark = mark_of(table);
    const auto at = current.find(mark);
    ASSERT_NE(at, std::string::npos) << "docs/cases.md has no place for the keys: " << mark;
    const auto begin = at + mark.size(), end = current.find(end_mark, begin);
    ASSERT_NE(end, std::string::npos) << "no " << end_mark << "after " << mark;
    current.replace(begin, end - begin, rows_of(table));
  }
  if (std::getenv("RONDO_WRITE_MANUAL") != nullptr)
    std::ofstream(file, std::ios::binary) << current;
  else
    EXPECT_EQ(manual, current) << "docs/cases.md is not what the table of keys says; to write it: "
                                  "RONDO_WRITE_MANUAL=1 unit_case --gtest_filter=Manual.*";
}

}  // namespace
}  // namespace rondo::study
