// SPDX-License-Identifier: BSD-3-Clause
/// Study files of sweeps: what is read, what is refused, and which members they have.
#include "rondo/study/sweep/sweep_study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "rondo/study/sweep/sweep_plan.hpp"

namespace sweep_study_test {

using namespace rondo;
using namespace rondo::study;

namespace {

const std::string top = "schema = 1\nbase = \"case.toml\"\n";

SweepStudy read(const std::string& text) {
  return read_study_text("folder/study.toml", text);
}

std::vector<Fault> faults_of(const std::string& text) {
  try {
    static_cast<void>(read(text));
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

/// Of one [[vary]] of friction with this line.
Vary friction(const std::string& line) {
  return read(top + "[[vary]]\nkey = \"ground.friction\"\n" + line + "\n").parameters.at(0);
}

using Texts = std::vector<std::string>;

}  // namespace

TEST(SweepStudy, AllThatItSays) {
  const SweepStudy study = read(top + R"(title = "Friction"
set = ["time.end=0.1", "ground.profile=flat"]
snapshots = true
[window]
from = 0.02
to = 0.1
[sample]
kind = "latin-hypercube"
count = 20
seed = 7
[[vary]]
key = "ground.friction"
values = [0, 0.25, 1e3]
[[vary]]
key = "motion.speed"
uniform = [5, 10.5]
[[vary]]
key = "rim.force_y"
values = [-1e5, -200000]
)");
  EXPECT_EQ(study.title, "Friction");
  EXPECT_EQ(study.base, "folder/case.toml");
  EXPECT_EQ(study.settings, (Texts{"time.end=0.1", "ground.profile=flat"}));
  EXPECT_TRUE(study.snapshots);
  EXPECT_EQ(study.window.from, 0.02);
  EXPECT_EQ(study.window.to, 0.1);
  ASSERT_TRUE(study.sample);
  EXPECT_EQ(study.sample->count, 20);
  EXPECT_EQ(study.sample->seed, 7U);
  ASSERT_EQ(study.parameters.size(), 3U);
  EXPECT_EQ(study.parameters[0].values, (Texts{"0", "0.25", "1000.0"}));
  EXPECT_EQ(study.parameters[1].uniform, (std::array{5.0, 10.5}));
  EXPECT_EQ(study.parameters[2].values, (Texts{"-100000.0", "-200000"}));
  EXPECT_EQ(study.parameters[2].line, 19);
}

TEST(SweepStudy, LinspaceHasItsEndsAndWholeNumbersWhereTheyFit) {
  EXPECT_EQ(friction("linspace = [0, 0.9, 10]").values.at(2), "0.2");
  EXPECT_EQ(friction("linspace = [0.1, 0.3, 3]").values, (Texts{"0.1", "0.2", "0.3"}));
  EXPECT_EQ(friction("linspace = [0.0, 0.1, 4]").values.back(), "0.1");  // 0.3 / 3 is above it
  EXPECT_EQ(friction("linspace = [10, 30, 3]").values, (Texts{"10", "20", "30"}));
  EXPECT_EQ(friction("linspace = [30, 10, 3]").values, (Texts{"30", "20", "10"}));
  EXPECT_EQ(friction("linspace = [10, 11, 3]").values, (Texts{"10.0", "10.5", "11.0"}));
}

TEST(SweepStudy, ValuesOfAnyKind) {
  EXPECT_EQ(friction(R"(values = ["flat", [[0, 1.5], [2, 3]], true, -1])").values,
            (Texts{"\"flat\"", "[[0, 1.5], [2, 3]]", "true", "-1"}));
}

TEST(SweepStudy, EveryFaultIsNamedAtItsPlace) {
  struct Wrong {
    std::string text, key, message;
    int line;
  };
  const std::string vary = "[[vary]]\nkey = \"ground.friction\"\n";
  const std::string values = vary + "values = [0.1]\n";
  const std::string several = "[[vary]]\nkeys = [\"ground.friction\", \"motion.speed\"]\n";
  for (const Wrong& wrong : std::vector<Wrong>{
           {"base = \"c.toml\"\n" + values, "schema", "is missing", 0},
           {"schema = 2\nbase = \"c.toml\"\n" + values, "schema", "another version", 1},
           {"schema = 1\n" + values, "base", "is missing", 0},
           {top, "vary", "nothing is varied", 0},
           {top + "vary = 3\n", "vary", "list of tables", 3},
           {top + "varied = 3\n" + values, "varied", "unknown key", 3},
           {top + "sample = 3\n" + values, "sample", "must be a table, not an integer", 3},
           {top + "title = 3\n" + values, "title", "must be a string, not an integer", 3},
           {top + values + "[window]\nfrom = \"1\"\n", "window.from", "must be a float", 7},
           {top + "[[vary]]\nkey = \"ground.frction\"\nvalues = [1]\n", "vary[0].key",
            "is no key of a case file", 4},
           {top + "[[vary]]\nvalues = [1]\n", "vary[0]", "has no key", 3},
           {top + vary, "vary[0]", "has no values", 3},
           {top + values + "uniform = [0, 1]\n[sample]\nkind = \"latin-hypercube\"\ncount = 3\n",
            "vary[0]", "values twice", 3},
           {top + vary + "values = []\n", "vary[0].values", "is empty", 5},
           {top + vary + "values = [0.1, 0.1]\n", "vary[0].values", "stands there twice", 5},
           {top + vary + "values = [{a = 1}]\n", "vary[0].values", "no key", 5},
           {top + vary + "values = [[1, [{a = 1}]]]\n", "vary[0].values", "no key", 5},
           {top + vary + "values = [1979-05-27]\n", "vary[0].values", "no key", 5},
           {top + vary + "values = [[0.1, inf]]\n", "vary[0].values", "no key", 5},
           {top + vary + "values = [nan]\n", "vary[0].values", "no key", 5},
           {top + vary + "values = 0.1\n", "vary[0].values", "must be an array", 5},
           {top + vary + "linspace = [0, 1, 1]\n", "vary[0].linspace", "empty range", 5},
           {top + vary + "linspace = [0, 1, 2.5]\n", "vary[0].linspace", "empty range", 5},
           {top + vary + "linspace = [1, 1, 3]\n", "vary[0].linspace", "are the same", 5},
           {top + vary + "linspace = [0, 1]\n", "vary[0].linspace", "3 finite numbers", 5},
           {top + vary + "linspace = [0, inf, 3]\n", "vary[0].linspace", "3 finite numbers", 5},
           {top + vary + "linspace = [1.7e308, 11, 5]\n", "vary[0].linspace", "3 finite numbers",
            5},
           {top + vary + "uniform = [1, 0]\n[sample]\ncount = 3\nkind = \"latin-hypercube\"\n",
            "vary[0].uniform", "empty range", 5},
           {top + vary + "uniform = [0, 1]\n", "sample", "is missing", 0},
           {top + vary + "values = [1, 1.0]\n", "vary[0].values", "stands there twice", 5},
           {top + "[[vary]]\nkey = \"disk.mesh.radial\"\nuniform = [2.5, 4]\n", "vary[0].uniform",
            "not whole", 5},
           {top + values + "[sample]\ncount = 3\n", "sample", "samples nothing", 6},
           {top + vary + "uniform = [0, 1]\n[sample]\ncount = 3\nkind = \"sobol\"\n", "sample.kind",
            "no kind of sample", 8},
           {top + vary + "uniform = [0, 1]\n[sample]\ncount = 0\n", "sample.count", "out of bounds",
            7},
           {top + vary + "targets = 3\n", "vary[0].targets", "unknown key", 5},
           {top + values + values, "vary[1].key", "varied twice", 7},
           {top + values + "[window]\nfrom = 2\nto = 1\n", "window.to", "not after", 8},
           {top + "set = [\"time.end\"]\n" + values, "set", "not a setting", 3},
           {top + "snapshots = 10\n" + values, "snapshots", "must be a boolean", 3},
           {top + several + "values = [[0.1, 1], [0.2]]\n", "vary[0].values",
            "[0.2] is not a value for each of the 2 keys", 5},
           {top + several + "values = [0.1, 0.2]\n", "vary[0].values",
            "0.1 is not a value for each", 5},
           {top + several + "values = [[0.1, 1], [0.1, 1.0]]\n", "vary[0].values",
            "[0.1, 1.0] stands there twice", 5},
           {top + several + "values = [[0.1, {a = 1}]]\n", "vary[0].values", "no key", 5},
           {top + several + "values = []\n", "vary[0].values", "is empty", 5},
           {top + several, "vary[0]", "has no values", 3},
           {top + several + "linspace = [0, 1, 3]\n", "vary[0].linspace", "is of one key", 5},
           {top + several + "target = 3\n", "vary[0].target", "is of one key", 5},
           {top + several + "key = \"time.end\"\nvalues = [[1, 2]]\n", "vary[0].key",
            "stands beside keys", 5},
           {top + "[[vary]]\nkeys = [\"motion.speed\"]\nvalues = [[1]]\n", "vary[0].keys",
            "are fewer than two", 4},
           {top + "[[vary]]\nkeys = [\"motion.speed\", \"motion.sped\"]\nvalues = [[1, 2]]\n",
            "vary[0].keys", "\"motion.sped\" is no key of a case file", 4},
           {top + several + "values = [[1, 2]]\n" + values, "vary[1].key", "varied twice", 7},
           {top + values + several + "values = [[1, 2]]\n", "vary[1].keys",
            "ground.friction is varied twice", 7},
           {top + "columns = [\"a\", 3]\n" + values, "columns", "array of strings", 3},
           {top + "columns = [\"a\", \"a\"]\n" + values, "columns", "\"a\" stands there twice", 3},
           {top + "[[vary]]\nkey = \"analysis.kind\"\nvalues = [\"crush\"]\n", "vary[0].key",
            "the same in all members", 4},
           {top + "[[vary]]\nkey = \"output.probe[0].name\"\nvalues = [\"a\"]\n", "vary[0].key",
            "columns of history.csv", 4}}) {
    const std::vector<Fault> faults = faults_of(wrong.text);
    const auto found = std::ranges::find_if(faults, [&](const Fault& f) {
      return f.key == wrong.key && f.message.find(wrong.message) != std::string::npos;
    });
    ASSERT_NE(found, faults.end()) << wrong.text << (faults.empty() ? "" : faults[0].text());
    EXPECT_EQ(found->line, wrong.line) << wrong.text;
    EXPECT_FALSE(found->allowed.empty()) << wrong.text;
    EXPECT_EQ(found->file, "folder/study.toml");
  }
}

TEST(SweepStudy, AllFaultsAtOnceInTheFilesOrder) {
  const std::vector<Fault> faults =
      faults_of("schema = 1\nbas = \"c\"\n[[vary]]\nkey = \"x\"\nvalues = []\n");
  ASSERT_EQ(faults.size(), 4U);
  EXPECT_EQ(faults[0].key, "bas");
  EXPECT_EQ(faults[1].key, "vary[0].key");
  EXPECT_EQ(faults[2].key, "vary[0].values");
  EXPECT_EQ(faults[3].key, "base");  // nowhere
}

TEST(SweepStudy, OfWhatIsNoFileOrNoToml) {
  EXPECT_EQ(faults_of("schema = ").at(0).message.substr(0, 11), "is not TOML");
  EXPECT_THROW(static_cast<void>(read_study("no/such/file.toml")), InputError);
}

TEST(SweepPlan, TheLastParameterChangesFastest) {
  const SweepStudy study = read(top + R"([[vary]]
key = "ground.friction"
values = [0.1, 0.2]
[[vary]]
key = "motion.speed"
values = [1, 2, 3]
)");
  const std::vector<Member> members = members_of(study);
  ASSERT_EQ(members.size(), 6U);
  EXPECT_EQ(members[0].values, (Texts{"0.1", "1"}));
  EXPECT_EQ(members[1].values, (Texts{"0.1", "2"}));
  EXPECT_EQ(members[5].values, (Texts{"0.2", "3"}));
  EXPECT_EQ(settings_of(study, members[5]), (Texts{"ground.friction=0.2", "motion.speed=3"}));
  EXPECT_EQ(name_of(study, members[5], 6), "run 6 (ground.friction = 0.2, motion.speed = 3)");
}

TEST(SweepPlan, KeysThatGoTogetherAreOneParameterOfTheGrid) {
  const SweepStudy study = read(top + R"(columns = ["tip_ux", "hub_force_x"]
[[vary]]
key = "motion.speed"
values = [1, 2]
[[vary]]
keys = ["ground.friction", "material.youngs_modulus", "ground.profile"]
values = [[0.3, 1e7, "flat"], [0.5, 2e7, [[0, 1], [1, 1]]], [0.3, 2e7, "flat"]]
)");
  EXPECT_EQ(study.columns, (Texts{"tip_ux", "hub_force_x"}));
  ASSERT_EQ(study.parameters.size(), 4U);
  EXPECT_FALSE(study.parameters[1].goes_with_previous);
  EXPECT_TRUE(study.parameters[2].goes_with_previous && study.parameters[3].goes_with_previous);
  const std::vector<Member> members = members_of(study);
  ASSERT_EQ(members.size(), 6U);
  EXPECT_EQ(members[0].values, (Texts{"1", "0.3", "10000000.0", "\"flat\""}));
  EXPECT_EQ(members[1].values, (Texts{"1", "0.5", "20000000.0", "[[0, 1], [1, 1]]"}));
  EXPECT_EQ(members[2].values, (Texts{"1", "0.3", "20000000.0", "\"flat\""}));
  EXPECT_EQ(members[4].values, (Texts{"2", "0.5", "20000000.0", "[[0, 1], [1, 1]]"}));
}

TEST(SweepPlan, TheSampleIsMadeForEachPointOfTheGrid) {
  const SweepStudy study = read(top + R"([sample]
kind = "latin-hypercube"
count = 3
[[vary]]
key = "motion.speed"
uniform = [10, 20]
[[vary]]
key = "ground.friction"
values = [0.1, 0.2]
)");
  const std::vector<Member> members = members_of(study);
  ASSERT_EQ(members.size(), 6U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(members[k].values[1], "0.1");
    EXPECT_EQ(members[k + 3].values[1], "0.2");
    EXPECT_EQ(members[k].values[0], members[k + 3].values[0]);
  }
}

TEST(SweepPlan, IntegersAreSampledEvenly) {
  const SweepStudy study = read(top + R"([sample]
kind = "latin-hypercube"
count = 300
[[vary]]
key = "disk.mesh.radial"
uniform = [2, 4]
)");
  std::multiset<std::string> seen;
  for (const Member& member : members_of(study)) seen.insert(member.values[0]);
  for (const char* value : {"2", "3", "4"}) EXPECT_EQ(seen.count(value), 100U) << value;
}

TEST(SweepPlan, TooManyMembersAreRefused) {
  std::string text = top;
  for (const char* key : {"ground.friction", "motion.speed"})
    text += std::string("[[vary]]\nkey = \"") + key + "\"\nlinspace = [0, 1, 1001]\n";
  EXPECT_THROW(static_cast<void>(members_of(read(text))), InputError);
}

TEST(LatinHypercube, HasOnePointInEachPart) {
  constexpr int n = 50;
  const auto points = latin_hypercube(3, n, 1);
  ASSERT_EQ(points.size(), 3U);
  for (const std::vector<double>& row : points) {
    std::set<int> parts;
    for (const double u : row) parts.insert(static_cast<int>(u * n));
    EXPECT_EQ(parts.size(), static_cast<std::size_t>(n));
    EXPECT_FALSE(std::ranges::is_sorted(row));
    EXPECT_GE(*std::ranges::min_element(row), 0.0);
    EXPECT_LT(*std::ranges::max_element(row), 1.0);
  }
  EXPECT_NE(points[0], points[1]);
}

TEST(LatinHypercube, IsTheSameEverywhereForASeed) {
  EXPECT_EQ(latin_hypercube(2, 9, 4), latin_hypercube(2, 9, 4));
  EXPECT_NE(latin_hypercube(2, 9, 4), latin_hypercube(2, 9, 5));
  // The first number of the engine of seed 0, its upper 53 bits.
  EXPECT_EQ(latin_hypercube(1, 1, 0)[0][0], 0x1p-53 * (2947667278772165694U >> 11U));
}

/// Of a version before; it says what to write now.
TEST(SweepStudy, ATargetIsALoadOfTheRim) {
  const auto only_fault = [](const std::string& key) {
    const auto faults =
        faults_of(top + "[[vary]]\nkey = \"" + key + "\"\ntarget = { force_y = [1e5] }\n");
    EXPECT_EQ(faults.size(), 1U) << key;
    return faults.empty() ? Fault{} : faults[0];
  };
  const Fault height = only_fault("motion.height"), depth = only_fault("analysis.depth");
  for (const Fault& fault : {height, depth}) {
    EXPECT_EQ(fault.key, "vary[0].target");
    EXPECT_EQ(fault.line, 5);
    EXPECT_NE(fault.message.find("known no more"), std::string::npos) << fault.text();
  }
  EXPECT_NE(height.allowed.find("key = \"rim.force_y\""), std::string::npos) << height.allowed;
  EXPECT_NE(height.allowed.find("free = [\"height\"]"), std::string::npos) << height.allowed;
  EXPECT_NE(depth.allowed.find("values of analysis.depth"), std::string::npos) << depth.allowed;
}

}  // namespace sweep_study_test
