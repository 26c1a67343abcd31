// SPDX-License-Identifier: BSD-3-Clause
/// cases/schema has the schema of studies that the table of their keys gives.
#include <gtest/gtest.h>

#include <algorithm>

#include "rondo/study/sweep/keys/study_keys.hpp"
#include "support/key_meaning.hpp"
#include "support/manual.hpp"

namespace rondo::study::study_schema_test {
namespace {

TEST(Manual, HasTheSchemaOfStudies) {
  const std::filesystem::path cases(RONDO_CASES);
  rondo::test::expect_file(cases / "schema" / "study.json", study_schema().dump(2) + "\n");
}

TEST(StudySchema, HasEveryKey) {
  Json schema = study_schema();
  for (const StudyKey& key : study_keys()) {
    const Json& table = table_in(schema, table_of(key.path));
    EXPECT_TRUE(table["properties"].contains(std::string(leaf_of(key.path)))) << key.path;
    EXPECT_TRUE(table["additionalProperties"].contains("not")) << key.path;
  }
}

TEST(StudySchema, EveryMeaningIsUnderstoodAlone) {
  for (const StudyKey& key : study_keys())
    EXPECT_EQ(rondo::test::fault_of_meaning(key.meaning), "") << key.path << ": " << key.meaning;
}

TEST(StudySchema, NamesEveryKeyOfACaseThatMayVary) {
  Json schema = study_schema();
  const Json& names = table_in(schema, "vary[]")["properties"]["key"]["anyOf"];
  std::size_t named = 0, items = 0;
  for (const CaseKey& key : case_keys()) {
    if (!may_be_varied(key.path)) continue;
    const bool item = key.path.find("[]") != std::string_view::npos;
    (item ? items : named) += 1;
    if (!item) {
      EXPECT_NE(std::ranges::find(names[0]["enum"], Json(key.path)), names[0]["enum"].end());
    }
  }
  EXPECT_EQ(names[0]["enum"].size(), named);
  const std::string pattern = names[1]["pattern"];
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(pattern, '|')) + 1, items);
}

}  // namespace
}  // namespace rondo::study::study_schema_test
