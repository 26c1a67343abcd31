// SPDX-License-Identifier: BSD-3-Clause
/// Histories of a crush, and the rules between its keys.
#include <gtest/gtest.h>

#include "unit/case/case_fixture.hpp"

namespace rondo::study {
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
              {"analysis.depth = [2.5, 0.2]", "whole"});
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
              {"analysis.slide_increments = 4", "counts its own increments"});
}

}  // namespace
}  // namespace rondo::study
