// SPDX-License-Identifier: BSD-3-Clause
/// Histories of a crush, and the rules between its keys.
#include <gtest/gtest.h>

#include "unit/case/case_fixture.hpp"

namespace rondo::study::crush_rules_test {
namespace {

using namespace test;

const std::string start = R"(schema = 1
disk = {outer_radius = 3, inner_radius = 1, mesh = {radial = 2, circumferential = 8}}
material = {youngs_modulus = 1, poissons_ratio = 0, density = 1}
ground = {profile = "flat"}
)";

/// The text of the one fault; empty where there is none.
std::string wrong(const std::string& analysis, const std::vector<std::string>& settings = {}) {
  const auto faults = faults_of(start + "[analysis]\nkind = \"crush\"\n" + analysis, settings);
  EXPECT_LE(faults.size(), 1U) << analysis << "\n" << (faults.size() < 2 ? "" : faults[1].text());
  return faults.empty() ? std::string() : faults[0].text();
}

void expect_told(const std::string& analysis, const std::vector<std::string>& parts) {
  const std::string text = wrong(analysis);
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nnot in\n" << text;
}

TEST(CrushHistories, AreReadWrittenAndReadAgain) {
  const Case c = read_text(start +
                           "[analysis]\nkind = \"crush\"\nincrements = 8\n"
                           "depth = [[0, 0], [2, 0.5], [6, 0.5], [8, 0]]\n"
                           "slide = [[0, 0], [2, 0], [8, -0.25]]\n");
  EXPECT_EQ(c.analysis.depth.at(1.0), 0.25);
  EXPECT_EQ(c.analysis.depth.at(8.0), 0.0);
  EXPECT_EQ(c.analysis.slide.at(5.0), -0.125);
  EXPECT_EQ(c.analysis.slide_increments, 0);
  EXPECT_TRUE(c.warnings.empty());
  const std::string text = write_case(c);
  const Case again = read_text(text);
  EXPECT_EQ(again.analysis.depth.points(), c.analysis.depth.points());
  EXPECT_EQ(again.analysis.slide.points(), c.analysis.slide.points());
  EXPECT_EQ(write_case(again), text);
  EXPECT_EQ(text.find("slide_increments"), std::string::npos);
  EXPECT_EQ(wrong("depth = [[0, 0], [8, 0.5]]\nincrements = 8"), "");
}

TEST(CrushHistories, BeginAtFirstTouch) {
  for (const char* depth : {"[[0, 0.1], [8, 0.2]]", "[[1, 0], [8, 0.2]]", "[[0, 0.5]]"})
    expect_told(std::string("increments = 8\ndepth = ") + depth,
                {"analysis.depth", "the first point must be [0, 0]"});
  expect_told("increments = 8\ndepth = [[0, 0], [8, 1]]\nslide = [[0, 1], [8, 1]]",
              {"analysis.slide = [0, 1]", "the first point must be [0, 0]"});
}

TEST(CrushHistories, GoToTheLastIncrementByWholeOnes) {
  expect_told("increments = 8\ndepth = [[0, 0], [7, 0.2]]",
              {"analysis.depth = [7, 0.2]", "at increment 8", "analysis.increments = 8"});
  expect_told("increments = 8\ndepth = [[0, 0], [8, 0.2]]\nslide = [[0, 0], [9, 1]]",
              {"analysis.slide = [9, 1]", "at increment 8"});
  expect_told("increments = 8\ndepth = [[0, 0], [2.5, 0.2], [8, 0.2]]",
              {"analysis.depth = [2.5, 0.2]", "must be an integer"});
  expect_told("increments = 8\ndepth = [[0, 0], [5, 1], [5, 0.5], [8, 1]]",
              {"the increments must increase", "[[increment, value], ...]"});
}

TEST(CrushHistories, PressTheBodyAndNotTheRim) {
  expect_told("increments = 8\ndepth = [[0, 0], [4, -0.1], [8, 1]]", {"values >= 0"});
  expect_told("increments = 8\ndepth = [[0, 0], [4, 2], [8, 1]]",
              {"rim would reach", "> 0 and < "});
  expect_told("increments = 8\ndepth = [[0, 0], [8, 0]]", {"not be pressed", "> 0 and < "});
  expect_told("increments = 8\ndepth = 0", {"not be pressed", "> 0 and < "});
  expect_told("increments = 8\ndepth = 2.0", {"rim would reach", "2"});
}

TEST(CrushHistories, AreBothTables) {
  expect_told("increments = 8\ndepth = 0.5\nslide = [[0, 0], [8, 1]]",
              {"analysis.depth = 0.5", "beside a table of analysis.slide", "[k, 0.5], [8, 0.5]]"});
  expect_told("increments = 8\ndepth = [[0, 0], [8, 1]]\nslide = 0.25",
              {"analysis.slide = 0.25", "beside a table of analysis.depth", "[8, 0.25]]"});
  expect_told("increments = 8\ndepth = [[0, 0], [8, 1]]\nslide_increments = 4",
              {"analysis.slide_increments = 4", "increments are counted by"});
}

/// A wheel in three dimensions may be pressed by a load, and leans; it stands.
TEST(CrushOfAWheel, HasADepthOrALoad) {
  const std::vector<std::string> wide{"disk.width=1"};
  const std::string loaded = "increments = 8\nload = 100.0\n";
  const Case c = read_text(start + "[analysis]\nkind = \"crush\"\n" + loaded,
                           {"disk.width=1", "motion.camber=0.1"});
  EXPECT_EQ(c.analysis.load, 100.0);
  EXPECT_EQ(c.motion.camber, 0.1);
  EXPECT_EQ(c.analysis.samples_per_sector, 1);
  EXPECT_EQ(c.analysis.inertia, RollingMasses::none);
  EXPECT_EQ(write_case(read_text(write_case(c))), write_case(c));
  EXPECT_EQ(wrong(loaded, wide), "");
  EXPECT_NE(wrong(loaded).find("the body is plane"), std::string::npos);
  EXPECT_NE(wrong(loaded + "depth = 0.5\n", wide).find("one of analysis.depth"), std::string::npos);
  EXPECT_NE(wrong(loaded + "slide = [[0, 0], [8, 1]]\n", wide).find("equal parts"),
            std::string::npos);
  EXPECT_NE(wrong("increments = 8\n", wide).find("analysis.depth"), std::string::npos);
  EXPECT_NE(wrong(loaded + "solver = \"latin\"\n", wide).find("for plane bodies"),
            std::string::npos);
}

const std::string pressed = "increments = 8\ndepth = 0.5\n";

TEST(CrushSolvers, HaveKeysOfTheirOwn) {
  const std::string crush = start + "[analysis]\nkind = \"crush\"\n" + pressed;
  const Case direct = read_text(crush), latin = read_text(crush, {"analysis.solver=latin"}),
             pgd = read_text(crush, {"analysis.solver=latin-pgd", "analysis.relaxation=1"});
  EXPECT_EQ(direct.analysis.solver, CrushMethod::direct);
  EXPECT_EQ(latin.analysis.solver, CrushMethod::latin);
  EXPECT_EQ(latin.analysis.search_direction, 0.0);
  EXPECT_EQ(latin.analysis.relaxation, 0.8);
  EXPECT_EQ(latin.analysis.tolerance, 1e-3);
  EXPECT_EQ(pgd.analysis.relaxation, 1.0);
  for (const char* key : {"search_direction", "relaxation", "tolerance", "downsizing"}) {
    EXPECT_EQ(write_case(direct).find(key), std::string::npos) << key;
    EXPECT_NE(write_case(pgd).find(key), std::string::npos) << key;
  }
  EXPECT_EQ(write_case(latin).find("downsizing"), std::string::npos);
  EXPECT_EQ(write_case(read_text(write_case(pgd))), write_case(pgd));
}

TEST(CrushSolvers, DropMoreModesWhereItSlides) {
  const std::string crush = start + "[analysis]\nkind = \"crush\"\nsolver = \"latin-pgd\"\n";
  const std::vector<std::string> slide{"analysis.slide=0.1", "analysis.slide_increments=4"};
  EXPECT_EQ(read_text(crush + pressed).analysis.downsizing, 0.3);
  EXPECT_EQ(read_text(crush + pressed, slide).analysis.downsizing, 1.0);
  EXPECT_EQ(read_text(crush + pressed + "downsizing = 0", slide).analysis.downsizing, 0.0);
  const std::string tables = "increments = 8\ndepth = [[0, 0], [8, 1]]\nslide = ";
  EXPECT_EQ(read_text(crush + tables + "[[0, 0], [8, 0]]").analysis.downsizing, 0.3);
  EXPECT_EQ(read_text(crush + tables + "[[0, 0], [8, -1]]").analysis.downsizing, 1.0);
}

TEST(CrushSolvers, RefuseWhatTheyDoNotHave) {
  for (const char* key : {"search_direction", "relaxation", "tolerance"})
    expect_told(pressed + key + " = 0.1", {key, "analysis.solver = \"direct\"", "\"latin\""});
  expect_told(pressed + "downsizing = 1", {"solver = \"direct\"", "\"latin-pgd\""});
  expect_told(pressed + "solver = \"latin\"\ndownsizing = 1",
              {"analysis.downsizing = 1", "\"latin\"", "\"latin-pgd\" beside it"});
  expect_told(pressed + "solver = \"latin\"\nsearch_direction = -1.0", {"out of bounds", ">= 0"});
  expect_told(pressed + "solver = \"latin\"\nrelaxation = 0.0", {"out of bounds", "> 0"});
  expect_told(pressed + "solver = \"latin\"\ntolerance = 0.2", {"out of bounds", "0.1"});
  expect_told(pressed + "solver = \"pgd\"", {"\"direct\", \"latin\" or \"latin-pgd\""});
  const auto faults = faults_of(
      "schema = 1\n"
      "disk = {outer_radius = 3, inner_radius = 1, mesh = {radial = 2, circumferential = 8}}\n"
      "material = {model = 'neo-hooke', shear_modulus = 1, poissons_ratio = 0.4, density = 1}\n"
      "ground = {profile = 'flat'}\n"
      "analysis = {kind = 'crush', depth = 0.5, increments = 8, solver = 'latin'}\n");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].text().find("linear elasticity only"), std::string::npos);
  EXPECT_NE(faults[0].text().find("analysis.solver = \"direct\""), std::string::npos);
}

TEST(CrushSolvers, AreOfACrushAlone) {
  for (const char* key : {"solver=latin", "search_direction=1e7", "relaxation=0.5"}) {
    const auto faults = faults_of(base, {std::string("analysis.") + key});
    ASSERT_EQ(faults.size(), 1U) << key;
    EXPECT_NE(faults[0].text().find("analysis.kind = \"crush\""), std::string::npos) << key;
  }
}

}  // namespace
}  // namespace rondo::study::crush_rules_test
