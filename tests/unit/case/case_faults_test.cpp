// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "unit/case/case_fixture.hpp"

namespace rondo::study::case_faults_test {
namespace {

using namespace test;

TEST(WrongCases, SeveralFaultsTogetherInTheFilesOrder) {
  std::string text = with_line(33, "end = -1");
  text = with_line(4, "outer_radius = 'x'", text);
  text = with_line(13, "rho = 1100.0", text);
  text = with_line(27, "friction = [1]", text);
  text = with_line(1, "", text);
  const auto faults = faults_of(text, {"ground.fillet=-1"});
  std::vector<std::pair<int, std::string>> told;
  for (const Fault& fault : faults) told.emplace_back(fault.line, fault.key);
  const std::vector<std::pair<int, std::string>> expected{
      {4, "disk.outer_radius"}, {10, "material.density"}, {13, "material.rho"},
      {27, "ground.friction"},  {33, "time.end"},         {0, "schema"},
      {0, "ground.fillet"}};
  EXPECT_EQ(told, expected);
  EXPECT_EQ(faults.back().file, "--set ground.fillet=-1");
}

TEST(WrongCases, ColumnIsThatOfTheValue) {
  const auto faults = faults_of(with_line(25, "profile = [[-1, 0], [é\"\", 0]]"));
  ASSERT_EQ(faults.size(), 1U);
  const auto more = faults_of(with_line(25, "profile = [['é', 0], ['b', 0]]"));
  ASSERT_EQ(more.size(), 2U);
  EXPECT_EQ(more[0].column, 13);
  EXPECT_EQ(more[0].found, "'é'");
  EXPECT_EQ(more[1].column, 23);
  EXPECT_EQ(more[1].found, "'b'");
}

TEST(WrongCases, LongValuesAreShortened) {
  const auto faults = faults_of(
      with_line(2, "title = [" + std::string(5000, ' ') + "'" + std::string(5000, 'x') + "']"));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_LT(faults[0].found.size(), 80U);
  EXPECT_TRUE(faults[0].found.ends_with("..."));
}

TEST(WrongCases, FewFaultsOfOneLongTable) {
  std::string table;
  for (int i = 0; i < 1000; ++i) table += "[0, 0],";
  EXPECT_LE(faults_of(with_line(20, "speed = [" + table + "]")).size(), 5U);
  std::string words;
  for (int i = 0; i < 1000; ++i) words += "'a',";
  EXPECT_LE(faults_of(with_line(20, "speed = [" + words + "]")).size(), 5U);
}

TEST(WrongCases, AbsentTablesAreOneFaultEach) {
  const auto faults = faults_of("schema = 1\n");
  ASSERT_EQ(faults.size(), 4U);
  EXPECT_EQ(faults[0].key, "disk");
  EXPECT_NE(faults[0].message.find("disk.mesh.radial"), std::string::npos);
  EXPECT_EQ(faults[1].key, "material");
  EXPECT_EQ(faults[2].key, "motion");
  EXPECT_EQ(faults[3].key, "time");
  EXPECT_NE(faults[3].message.find("time.end"), std::string::npos);
}

TEST(WrongCases, Crush) {
  const auto wrong = [](const std::vector<std::string>& more) {
    std::vector<std::string> settings{"analysis.kind=crush", "ground.profile=flat"};
    settings.insert(settings.end(), more.begin(), more.end());
    auto faults = faults_of(base, settings);
    EXPECT_EQ(faults.size(), 1U) << more.back();
    return faults.empty() ? std::string() : faults[0].text();
  };
  const std::string depth = "analysis.depth=0.02", increments = "analysis.increments=4";
  EXPECT_NE(wrong({increments}).find("analysis.depth: is missing"), std::string::npos);
  EXPECT_NE(wrong({depth}).find("analysis.increments: is missing"), std::string::npos);
  EXPECT_NE(wrong({depth, "analysis.increments=0"}).find("1 to 1000000"), std::string::npos);
  const std::string slide = "analysis.slide=0.001", slides = "analysis.slide_increments=4";
  EXPECT_NE(wrong({depth, increments, slide}).find("analysis.slide_increments: is missing"),
            std::string::npos);
  EXPECT_NE(wrong({depth, increments, slides}).find("analysis.slide: is missing"),
            std::string::npos);
  EXPECT_NE(wrong({depth, increments, slide, "analysis.slide_increments=0"}).find("1 to 1000000"),
            std::string::npos);
  EXPECT_NE(wrong({increments, "analysis.depth=0.15"}).find("the rim"), std::string::npos);
  EXPECT_NE(wrong({increments, "analysis.depth=-1"}).find("values >= 0"), std::string::npos);
  EXPECT_NE(wrong({increments, depth, "ground.profile=[[0, 0], [1, 0.1]]"}).find("\"flat\""),
            std::string::npos);
  EXPECT_NE(wrong({increments, depth, "motion.speed='fast'"}).find("a float"), std::string::npos);
}

TEST(WrongCases, ACrushNeedsGround) {
  const auto faults = faults_of(
      "schema = 1\n"
      "disk = {outer_radius = 3, inner_radius = 1, mesh = {radial = 2, circumferential = 8}}\n"
      "material = {youngs_modulus = 1, poissons_ratio = 0, density = 1}\n"
      "analysis = {kind = 'crush', depth = 0.125, increments = 4}\n");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].key, "ground");
  EXPECT_NE(faults[0].message.find("ground.profile"), std::string::npos);
}

TEST(WrongCases, Tread) {
  const auto wrong = [](const std::string& from, const std::string& to) {
    std::string text = treaded();
    text.replace(text.find(from), from.size(), to);
    auto faults = faults_of(text);
    EXPECT_EQ(faults.size(), 1U) << to;
    return faults.empty() ? Fault{} : faults[0];
  };
  EXPECT_TRUE(faults_of(treaded()).empty());
  EXPECT_EQ(wrong("pitches = 60", "pitches = 2").key, "disk.tread.pitches");
  EXPECT_EQ(wrong("depth = 0.02", "depth = 0").key, "disk.tread.depth");
  EXPECT_EQ(wrong("depth = 0.02", "depth = 0.15").line, 40);
  EXPECT_EQ(wrong("depth = 0.02", "").key, "disk.tread.depth");
  EXPECT_EQ(wrong("land_columns = 3", "land_columns = 0").key, "disk.tread.land_columns");
  EXPECT_EQ(wrong("groove_columns = 1", "groove_columns = 0").key, "disk.tread.groove_columns");
  EXPECT_EQ(wrong("layers = 2", "layers = -2").key, "disk.tread.layers");
  EXPECT_EQ(wrong("layers = 2", "layers = 2\nwidth = 1").key, "disk.tread.width");
  const auto many = faults_of(treaded(), {"disk.tread.pitches=10000000", "disk.mesh.radial=60"});
  ASSERT_EQ(many.size(), 1U);  // more nodes than an int counts
  EXPECT_EQ(many[0].key, "disk.tread.pitches");
}

TEST(WrongCases, MeshOfTooManyNodes) {
  const auto faults =
      faults_of(with_line(7, "radial = 300", with_line(8, "circumferential = 10000000")));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].key, "disk.mesh.circumferential");
  EXPECT_EQ(faults[0].line, 8);
  EXPECT_EQ(faults[0].message, "the mesh would have 3010000000 nodes");
  EXPECT_NE(faults[0].allowed.find("2147483648"), std::string::npos);
}

std::string file_fault(const std::filesystem::path& file) {
  try {
    read_case(file);
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 1U);
    EXPECT_EQ(error.faults()[0].file, file.string());
    return error.faults()[0].message;
  }
  return "";
}

TEST(WrongFiles, AreNamed) {
  EXPECT_EQ(file_fault("/nowhere/case.toml"), "there is no such file");
  EXPECT_EQ(file_fault(std::filesystem::temp_directory_path()), "is a directory, not a case file");
  EXPECT_EQ(file_fault(CaseFile("").path()), "the file is empty");
  EXPECT_EQ(file_fault(CaseFile(" \n\t\n").path()), "the file is empty");
  EXPECT_EQ(file_fault(CaseFile(std::string("\x7f"
                                            "ELF\0\0\1",
                                            7))
                           .path()),
            "is not a text file: it holds NUL bytes");
  EXPECT_NE(file_fault(CaseFile("\x89PNG\r\n\x1a\n\xff\xd8").path()).find("is not TOML"),
            std::string::npos);
  EXPECT_EQ(file_fault(CaseFile(std::string(16'000'001, '#')).path()),
            "is longer than a case file may be");
  EXPECT_EQ(file_fault("/dev/zero"), "is a device, not a case file");
}

TEST(WrongFiles, NestingHasALimit) {
  std::string keys = "a", arrays = "a = ";
  for (int i = 0; i < 100000; ++i) {
    keys += ".a";
    arrays += "[";
  }
  EXPECT_NE(file_fault(CaseFile(keys + " = 1").path()).find("nested"), std::string::npos);
  EXPECT_NE(file_fault(CaseFile("[" + keys + "]").path()).find("nested"), std::string::npos);
  EXPECT_NE(file_fault(CaseFile("b = {" + keys + " = 1}").path()).find("nested"),
            std::string::npos);
  EXPECT_NE(file_fault(CaseFile(arrays).path()).find("is not TOML"), std::string::npos);
  EXPECT_EQ(faults_of(base, {keys + "=1"}).size(), 1U);
  EXPECT_EQ(faults_of(base, {"time.end={" + keys + "=1}"}).size(), 1U);
}

TEST(WrongFiles, UnreadableFile) {
  const CaseFile file(base);
  std::filesystem::permissions(file.path(), std::filesystem::perms::none);
  if (std::ifstream(file.path())) GTEST_SKIP() << "this user may read any file";
  EXPECT_NE(file_fault(file.path()).find("cannot be read"), std::string::npos);
}

}  // namespace
}  // namespace rondo::study::case_faults_test
