// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/ground/profile_file.hpp"

#include <gtest/gtest.h>

#include "case_fixture.hpp"

namespace rondo::study::profile_file_test {
namespace {

using test::CaseFile;

/// The base of the tests with a profile from a file beside the case.
class ProfileCase {
 public:
  explicit ProfileCase(const std::string& csv, const std::string& name = "road.csv")
      : case_(test::with_line(25, "profile = \"" + name + "\"", test::with_line(26, ""))) {
    std::ofstream(csv_file(), std::ios::binary) << csv;
  }
  [[nodiscard]] std::filesystem::path csv_file() const {
    return case_.path().parent_path() / "road.csv";
  }
  [[nodiscard]] Case read(const std::vector<std::string>& settings = {}) const {
    return read_case(case_.path(), settings);
  }
  /// All that is said, a line each, with the folder left out.
  [[nodiscard]] std::string faults(const std::vector<std::string>& settings = {}) const {
    try {
      static_cast<void>(read(settings));
    } catch (const InputError& error) {
      std::string text = error.what();
      const std::string folder = case_.path().parent_path().string() + "/";
      for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder))
        text.erase(at, folder.size());
      return text;
    }
    return {};
  }

 private:
  CaseFile case_;
};

const std::vector<Vec2> ramp{{0.0, 0.0}, {0.5, 0.0}, {1.5, 0.25}};

TEST(ProfileFile, CommasOrSpacesHeaderAndComments) {
  for (const char* text :
       {"0,0\n0.5,0\n1.5,0.25\n", "x,y\n0,0\n0.5,0\n1.5,0.25",
        "# a ramp\n\"x (m)\", \"y (m)\"\r\n0, 0\r\n\r\n.5\t 0 # foot\r\n+15e-1 , .25\r\n",
        "\xEF\xBB\xBF  0 0\n0.5 0\n 1.5   0.25  \n"}) {
    const ProfileFile found = parse_profile("road.csv", text);
    EXPECT_TRUE(found.faults.empty()) << found.faults.front().text();
    EXPECT_EQ(found.points, ramp) << text;
  }
  EXPECT_EQ(parse_profile("road.csv", "x y\n\n0 0\n# between\n1 0\n").lines, (std::vector{3, 5}));
}

TEST(ProfileFile, FaultsNameLineAndColumn) {
  const auto said = [](const char* text) {
    const ProfileFile found = parse_profile("road.csv", text);
    EXPECT_TRUE(found.points.empty() || found.faults.empty());
    return found.faults.empty() ? "" : found.faults.front().text();
  };
  const auto begins = [&](const char* text, const std::string& beginning) {
    EXPECT_EQ(said(text).substr(0, beginning.size()), beginning);
  };
  begins("x, y\n0, 0\n1, 0,1\n",
         "road.csv:3:6: ground.profile = 1: the line must have 2 numbers, not 3");
  begins("0 0\n1\n", "road.csv:2:1: ground.profile = 1: the line must have 2 numbers, not 1");
  begins("0, 0,\n1, 0\n", "road.csv:1:6: ground.profile: the line must have 2 numbers, not 3");
  begins("O, 0\n1, 0\n", "road.csv:1:1: ground.profile = O: is not a number");
  begins("x, y\nz, w\n", "road.csv:2:1: ground.profile = z: is not a number");
  begins("0;0\n1;0\n", "road.csv:1:1: ground.profile = 0;0: the line must have 2 numbers, not 1");
  begins("1e3;2e3\n2e3;0\n",
         "road.csv:1:1: ground.profile = 1e3;2e3: the line must have 2 numbers, not 1");
  begins("x;y\n0;0\n", "road.csv:2:1: ground.profile = 0;0: the line must have 2 numbers, not 1");
  EXPECT_NE(said("0;0\n").find("comma or white space between x and y"), std::string::npos);
  begins("0, 0\n1, 1mm\n", "road.csv:2:4: ground.profile = 1mm: is not a number");
  begins("0, 0\n1, ,\n", "road.csv:2:5: ground.profile: the line must have 2 numbers, not 3");
  begins("0, 0\n1, nan\n", "road.csv:2:4: ground.profile = nan: must be a finite number");
  begins("0, 0\n1e999, 0\n", "road.csv:2:1: ground.profile = 1e999: must be a finite number");
  begins("x, y\n0, 0\n", "road.csv: ground.profile: must have at least two points");
  begins("", "road.csv: ground.profile: must have at least two points");
  EXPECT_EQ(parse_profile("road.csv", "x\ny\nz\n0 1 2\na b\nc d\ne f\n").faults.size(), 5U);
}

TEST(ProfileFile, NoMorePointsThanACaseHolds) {
  std::string text;
  for (std::size_t k = 0; k < most_profile_points; ++k) text += std::to_string(k) + " 0\n";
  EXPECT_EQ(parse_profile("road.csv", text).points.size(), most_profile_points);
  const ProfileFile more = parse_profile("road.csv", text + "1000000 0\n");
  ASSERT_EQ(more.faults.size(), 1U);
  EXPECT_NE(more.faults[0].message.find("more than 100000 points"), std::string::npos);
  EXPECT_EQ(more.faults[0].line, 100001);
}

TEST(ProfileFile, IsRelativeToTheCase) {
  const ProfileCase here("x y\n0 0\n0.5 0\n1.5 0.25\n");
  const Case c = here.read();
  EXPECT_EQ(c.ground->shape.profile, ramp);
  EXPECT_EQ(here.read({"ground.profile=road.csv"}).ground->shape.profile, ramp);
  EXPECT_EQ(here.read({"ground.profile=" + here.csv_file().string()}).ground->shape.profile, ramp);
  // What is kept has the points, and wants no file.
  const Case again = read_case_text("elsewhere/case.toml", write_case(c));
  EXPECT_EQ(again.ground->shape.profile, ramp);
  EXPECT_EQ(write_case(again), write_case(c));
}

TEST(ProfileFile, ForeignNumbersAreNamedWithTheirCause) {
  const auto said = [](const char* text) {
    const ProfileFile found = parse_profile("road.csv", text);
    return found.faults.empty() ? "" : found.faults.front().message;
  };
  EXPECT_EQ(said("0,0 0,0\n0,5 0,1\n"),
            "the line must have 2 numbers, not 4; a comma divides items, a point is in a number: "
            "0.3, not 0,3");
  EXPECT_EQ(said("0;0\n1;0\n"),
            "the line must have 2 numbers, not 1; a semicolon divides no numbers here");
  EXPECT_EQ(said("0 0\n1.5D-01 0\n"),
            "is not a number; it has an exponent with D, as Fortran writes it: write 1.5e-01");
  EXPECT_EQ(said("0 0\n1 \u22120.1\n"),
            "is not a number; it has the minus sign U+2212 where - is to stand");
  EXPECT_EQ(said("\u22121 \u22122\n0 0\n1 0\n"),
            "is not a number; it has the minus sign U+2212 where - is to stand")
      << "it is no header";
}

TEST(ProfileFile, OpenCrgRoadsAreToldFromProfiles) {
  for (const char* text : {"$CT\nCRG file example\n$\n", "a comment\n$ROAD_CRG\n$\n",
                           "\n$KD_DEFINITION\n#:LRFI\n$\n"}) {
    const ProfileFile found = parse_profile("road.csv", text);
    ASSERT_EQ(found.faults.size(), 1U);
    EXPECT_NE(found.faults.front().text().find("is an OpenCRG road file"), std::string::npos);
    EXPECT_NE(found.faults.front().allowed.find("ground.road = "), std::string::npos);
  }
  const CaseFile named(test::with_line(25, "profile = \"road.CRG\"", test::with_line(26, "")));
  std::ofstream(named.path().parent_path() / "road.CRG") << std::string(17'000'000, ' ');
  try {
    static_cast<void>(read_case(named.path()));
    FAIL() << "it is taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("road.CRG: is an OpenCRG road file"),
              std::string::npos)
        << error.what();
    EXPECT_NE(error.faults().front().allowed.find("one section along the road"), std::string::npos);
  }
}

TEST(ProfileFile, OfManyFaultsOfAKeyTheFirstAreTold) {
  std::string csv;
  for (int k = 0; k < 1000; ++k) csv += std::to_string(k % 2 == 0 ? k : k - 3) + " 0\n";
  const std::string text = ProfileCase(csv).faults();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5) << text.substr(0, 2000);
  EXPECT_NE(text.find("ground.profile: and "), std::string::npos) << text;
  EXPECT_NE(text.find(" more of this kind"), std::string::npos) << text;
}

TEST(ProfileFile, FaultsOfTheShapeNameTheLine) {
  const ProfileCase back("x y\n0 0\n\n1 0\n0.5 0\n");
  EXPECT_EQ(back.faults().find("road.csv:5:1: ground.profile: the profile goes back to the left"),
            0U)
      << back.faults();
  const ProfileCase twice("0 0\n1 0\n1 0\n");
  EXPECT_EQ(twice.faults(), "road.csv:3:1: ground.profile: coincides with the point before it");
}

TEST(ProfileFile, FaultsOfTheFileNameItAndTheCase) {
  EXPECT_EQ(
      ProfileCase("0 0\n1 0\n", "rode.csv").faults(),
      "case.toml:25:11: ground.profile = \"rode.csv\": rode.csv: there is no such file (allowed: "
      "\"flat\", [[x, y], ...] from left to right, or the name of a CSV file with columns x, y)");
  const ProfileCase good("0 0\n1 0\n");
  EXPECT_EQ(good.faults({"ground.profile=fla"})
                .find("--set ground.profile=fla: ground.profile = fla: "
                      "fla: there is no such file"),
            0U)
      << good.faults({"ground.profile=fla"});
  EXPECT_NE(good.faults({"ground.profile=\"\""}).find("is a directory, not a profile"),
            std::string::npos)
      << good.faults({"ground.profile=\"\""});
  const ProfileCase two("0 0\n1 a\nb 0\n2 0\n");
  EXPECT_EQ(two.faults({"ground.friction=-1"}).find("road.csv:2:3: "), 0U);
  EXPECT_NE(two.faults().find("\nroad.csv:3:1: "), std::string::npos) << two.faults();
}

}  // namespace
}  // namespace rondo::study::profile_file_test
