// SPDX-License-Identifier: BSD-3-Clause
/// Every key of the table is read, written, bounded and left out as its row says.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <type_traits>

#include "support/key_meaning.hpp"
#include "unit/case/key_cases.hpp"

namespace rondo::study::key_table_test {
namespace {

using namespace test;

TEST(KeyTable, KeysOfATableStandTogetherAndAreThereOnce) {
  std::set<std::string_view> seen;
  std::size_t count = 0;
  for (const CaseTable& table : case_tables()) {
    EXPECT_FALSE(keys_of(table).empty()) << table.path;
    for (const CaseKey& key : keys_of(table)) {
      EXPECT_EQ(table_of(key.path), table.path);
      EXPECT_EQ(&key, &case_keys()[count++]) << "order of the tables: " << key.path;
      EXPECT_TRUE(seen.insert(key.path).second) << key.path;
      EXPECT_FALSE(key.meaning.empty() || key.unit.empty()) << key.path;
    }
  }
  EXPECT_EQ(count, case_keys().size());
}

TEST(KeyTable, EveryMeaningIsUnderstoodAlone) {
  for (const CaseKey& key : case_keys())
    EXPECT_EQ(rondo::test::fault_of_meaning(key.meaning), "") << key.path << ": " << key.meaning;
}

/// No two rows share a field, and of a list each table has its own. A number in the place of a
/// table is one of its keys.
TEST(KeyTable, EveryKeyHasAFieldOfItsOwn) {
  Case c = cases_with_every_key()[0];
  for (const CaseTable& table : case_tables())
    if (table.resize) table.resize(c, table.is_list() ? 2 : 1);
  std::set<const void*> seen;
  const auto address = [](auto field) -> const void* {
    if constexpr (std::is_same_v<decltype(field), Choice>)
      return field.target;
    else if constexpr (std::is_same_v<decltype(field), ChoiceList>)
      return field.among[0];
    else
      return field;
  };
  for (const CaseKey& key : case_keys())
    for (std::size_t k = 0; !is_case_table(key.path) && k < (table_with(key).is_list() ? 2U : 1U);
         ++k)
      EXPECT_TRUE(seen.insert(std::visit(address, key.field(c, k))).second) << key.path;
}

/// Other keys hang on it.
bool is_model(const CaseKey& key) {
  return leaf_of(key.path) == "model";
}

/// What is read into another key, and written as that: a key of earlier versions. A file that is
/// read at once has no other one beside it.
bool has_no_other_value(const CaseKey& key) {
  return key.path == "initial.angle" || key.path == "ground.road";
}

/// A value unlike the one before is written, and read back.
TEST(KeyTable, EveryKeyRoundTrips) {
  for (const CaseKey& key : case_keys()) {
    if (key.path == "schema" || key.path == "analysis.kind" || is_model(key))
      continue;  // one value; other keys hang on it
    if (has_no_other_value(key)) continue;
    SCOPED_TRACE(key.path);
    const Case before = case_with(key);
    Case c = with_another_value(key, before);
    const std::string text = write_case(c);
    EXPECT_NE(text, write_case(before));
    const std::string value = value_text(key, key.field(c, 0));
    EXPECT_NE(text.find(fmt::format("\n{} = {}\n", leaf_of(key.path), value)), std::string::npos)
        << text;
    Case again = read_text(text);
    EXPECT_EQ(value_text(key, key.field(again, 0)), value);
    EXPECT_EQ(write_case(again), text);
  }
}

/// A setting that is just out of bounds is the one fault of an otherwise good case.
TEST(KeyTable, EveryNumberHasItsBounds) {
  const auto refused = [](const CaseKey& key, const std::string& value) {
    const std::string path = path_of(key, 0);
    const auto faults = faults_of(write_case(case_with(key)), {path + "=" + value});
    ASSERT_EQ(faults.size(), 1U) << path << " = " << value;
    EXPECT_EQ(faults[0].key, path);
    EXPECT_EQ(faults[0].message, "is out of bounds");
    EXPECT_EQ(faults[0].allowed, allowed_text(key));
  };
  int bounds = 0;
  for (const CaseKey& key : case_keys()) {
    if (key.path == "schema") continue;  // what is above 1 is of a later version
    const bool items = type_of(key) == KeyType::integers;
    const Range& r = key.allowed.range;
    const auto beyond = [&](double bound, bool open, double step) {
      if (!std::isfinite(bound)) return;
      ++bounds;
      if (type_of(key) == KeyType::integer || items)
        refused(key, items ? fmt::format("[{}]", bound + step) : fmt::format("{}", bound + step));
      else
        refused(key, fmt::format("{:.17e}", open ? bound : std::nextafter(bound, step * 1e300)));
    };
    beyond(r.low, r.low_open, -1.0);
    beyond(r.high, r.high_open, 1.0);
  }
  EXPECT_GT(bounds, 50);
}

/// Nothing, or text, in the place of a value; a required key left out.
TEST(KeyTable, EveryKeyHasItsType) {
  for (const CaseKey& key : case_keys()) {
    if (key.path == "analysis.kind" || has_no_other_value(key))
      continue;  // its value decides about other keys
    const std::string path = path_of(key, 0);
    const auto faults = faults_of(write_case(case_with(key)), {path + "=2020-01-01"});
    ASSERT_EQ(faults.size(), 1U) << path;
    EXPECT_EQ(faults[0].key, path);
    EXPECT_NE(faults[0].message.find(", not a date or time"), std::string::npos) << path;
  }
}

TEST(KeyTable, RequiredKeysAreMissed) {
  for (const CaseKey& key : case_keys()) {
    if (!key.use.required) continue;
    Case c = case_with(key);
    std::string text = write_case(c);
    const auto table = table_of(key.path);
    const auto head = table.empty() ? 0 : text.find(fmt::format("\n{}\n", heading_of(table))) + 1;
    const auto line = fmt::format("{} = {}\n", leaf_of(key.path), value_text(key, key.field(c, 0)));
    text.erase(text.find(line, head), line.size());
    const auto faults = faults_of(text);
    ASSERT_EQ(faults.size(), 1U) << key.path << "\n" << text;
    EXPECT_EQ(faults[0].key, path_of(key, 0));
    EXPECT_EQ(faults[0].message, "is missing");
  }
}

/// What is left out of a case is neither in it nor written.
TEST(KeyTable, AKeyThatMeansNothingHasItsDefault) {
  for (const CaseKey& key : case_keys()) {
    if (means_to(key, AnalysisKind::crush) || key.use.analyses.written) continue;
    if (has_no_other_value(key)) continue;
    Case c = with_another_value(key, case_with(key));
    reset(key, c);
    if (table_with(key).is_list()) {
      EXPECT_EQ(table_with(key).count(c), 0U) << key.path;
    } else if (key.use.standard != "none") {
      const std::string standard = default_text(key);
      EXPECT_TRUE(standard.starts_with("required") || standard.starts_with("the center's") ||
                  value_text(key, key.field(c, 0)) == standard)
          << key.path;
    }
  }
  const std::string text = write_case(cases_with_every_key().back());
  for (const char* absent : {"[damping]", "[motion]", "[initial]", "[time]", "[contact]", "fillet",
                             "restitution", "snapshots", "operator"})
    EXPECT_EQ(text.find(absent), std::string::npos) << absent;
}

}  // namespace
}  // namespace rondo::study::key_table_test
