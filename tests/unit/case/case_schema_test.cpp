// SPDX-License-Identifier: BSD-3-Clause
/// The schema says of every key what its row says.
#include <gtest/gtest.h>

#include <cmath>

#include "rondo/case/schema/case_schema.hpp"

namespace rondo::study::case_schema_test {
namespace {

TEST(CaseSchema, HasEveryKeyWithItsRow) {
  Json schema = case_schema();
  for (const CaseKey& key : case_keys()) {
    const Json& table = table_in(schema, table_of(key.path));
    const auto found = table["properties"].find(std::string(leaf_of(key.path)));
    ASSERT_NE(found, table["properties"].end()) << key.path;
    Json alone = *found;
    if (is_case_table(key.path)) {  // a table may be in its place
      alone.erase("properties");
      alone.erase("required");
    }
    EXPECT_EQ(alone, schema_of(key)) << key.path;
    const std::string text = (*found)["description"];
    EXPECT_NE(text.find(allowed_text(key)), std::string::npos) << key.path;
    EXPECT_TRUE(key.unit == "-" || text.find("Unit: " + std::string(key.unit)) != std::string::npos)
        << key.path;
    EXPECT_EQ(text.find("]("), std::string::npos) << key.path;
  }
}

/// No table lets an unknown key pass.
void expect_closed(const Json& schema, const std::string& path) {
  if (schema.contains("items")) {
    if (schema["items"].is_object()) expect_closed(schema["items"], path + "[]");
    return;
  }
  const Json type = schema.value("type", Json());
  if (type != "object" && type != Json::array({"number", "object"})) return;
  EXPECT_TRUE(schema["additionalProperties"].contains("not")) << path;
  for (const auto& [name, inner] : schema["properties"].items())
    expect_closed(inner, path + "." + name);
}

TEST(CaseSchema, TablesAreClosed) {
  expect_closed(case_schema(), "");
}

TEST(CaseSchema, NumbersHaveTheBoundsOfTheirRow) {
  int bounds = 0;
  for (const CaseKey& key : case_keys()) {
    if (type_of(key) != KeyType::number && type_of(key) != KeyType::integer) continue;
    const Json schema = schema_of(key);
    const Range& range = key.allowed.range;
    if (range.low == range.high) continue;
    EXPECT_EQ(schema.contains("minimum"), std::isfinite(range.low)) << key.path;
    EXPECT_EQ(schema.contains("maximum"), std::isfinite(range.high)) << key.path;
    EXPECT_EQ(schema.value("exclusiveMinimum", false), range.low_open) << key.path;
    EXPECT_EQ(schema.value("exclusiveMaximum", false), range.high_open) << key.path;
    for (const auto& [name, bound] : {std::pair("minimum", range.low), {"maximum", range.high}})
      if (schema.contains(name)) {
        EXPECT_EQ(schema[name].get<double>(), bound) << key.path;
        ++bounds;
      }
  }
  EXPECT_GT(bounds, 50);
}

TEST(CaseSchema, RequiresWhatIsAlwaysRequired) {
  Json schema = case_schema();
  const auto required = [&](const char* table) { return table_in(schema, table)["required"]; };
  EXPECT_EQ(required(""), Json::array({"schema", "material"}));
  EXPECT_EQ(required("disk"), Json::array({"outer_radius", "inner_radius", "mesh"}));
  EXPECT_EQ(required("disk.mesh"), Json::array({"radial"}));
  EXPECT_EQ(required("section"), Json::array({"file", "clamped"}));
  EXPECT_EQ(required("material.viscosity[]"), Json::array({"relative_modulus", "time"}));
  EXPECT_EQ(required("ground.friction"), Json::array({"coefficient"}));
  EXPECT_EQ(required("ground"), Json());
}

TEST(CaseSchema, DefaultsAreThoseOfTheCase) {
  const auto standard = [](const char* path) {
    return schema_of(*find_case_key(path)).value("default", Json());
  };
  EXPECT_EQ(standard("time.scheme"), "symplectic");
  EXPECT_EQ(standard("output.snapshots"), Case{}.output.snapshots);
  EXPECT_EQ(standard("initial.velocity"), Json::array({0.0, 0.0}));
  EXPECT_EQ(standard("output.stress"), true);
  EXPECT_EQ(standard("time.end"), Json());
  EXPECT_EQ(standard("title"), Json());
}

TEST(JsonSchema, LinksAreTakenOutOfMarkdown) {
  EXPECT_EQ(without_links("see [theory](theory.md), `[[a, b], ...]` (docs/x.md, [y](#z))"),
            "see theory, `[[a, b], ...]` (docs/x.md, y)");
}

}  // namespace
}  // namespace rondo::study::case_schema_test
