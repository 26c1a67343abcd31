// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/ground/road_ground.hpp"

#include <gtest/gtest.h>

#include "case_fixture.hpp"
#include "rondo/case/ground/profile_file.hpp"
#include "rondo/road/surface.hpp"
#include "support/crg_files.hpp"

namespace rondo::study::road_ground_test {
namespace {

using rondo::test::crg_of;
using rondo::test::CrgParts;

/// Five rows half a metre apart from u = 2 m on, and heights at v = -1, 0, 2 m.
CrgParts small_road() {
  CrgParts parts;
  parts.format = "LDFI";
  parts.road = "REFERENCE_LINE_START_U = 2.0\nREFERENCE_LINE_INCREMENT = 0.5\n";
  parts.channels = {"long section at v = -1.0,m", "long section at v = 0.0,m",
                    "long section at v = 2.0,m"};
  parts.rows = {
      {7.0, 5.0, 9.0}, {7.0, 5.25, 9.5}, {7.0, 5.5, 9.0}, {7.0, 5.25, 9.0}, {7.0, 5.125, 9.0}};
  return parts;
}

/// The base of the tests on a road beside the case.
class RoadCaseFile {
 public:
  explicit RoadCaseFile(const std::string& crg = crg_of(small_road()),
                        const std::string& lines = "road = \"a.crg\"",
                        const std::string& base = test::base)
      : case_(test::with_line(25, lines, test::with_line(26, "", base))) {
    std::ofstream(case_.path().parent_path() / "a.crg", std::ios::binary) << crg;
  }
  [[nodiscard]] Case read(const std::vector<std::string>& settings = {}) const {
    return read_case(case_.path(), settings);
  }
  [[nodiscard]] std::vector<Vec2> points(const std::vector<std::string>& settings = {}) const {
    return read(settings).ground->shape.profile;
  }
  /// All faults, a line each, with the folder left out.
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
  test::CaseFile case_;
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(RoadGround, IsTheSectionAtTheReferenceLineFromHalfAMetreOn) {
  const Case c = RoadCaseFile().read();
  EXPECT_EQ(c.ground->shape.profile, (std::vector<Vec2>{{-1.5, -0.25},
                                                        {-0.5, -0.25},
                                                        {0.0, 0.0},
                                                        {0.5, 0.25},
                                                        {1.0, 0.0},
                                                        {1.5, -0.125},
                                                        {2.5, -0.125}}));
  EXPECT_EQ(c.ground->road.height, 5.25);
  EXPECT_EQ(c.ground->road.start, 2.5);
  EXPECT_STREQ(ground_key(c), "ground.road");
}

TEST(RoadGround, StartAndOffsetBetweenTheLinesOfTheGrid) {
  const RoadCaseFile file;
  const std::vector<std::string> settings{"ground.road_start=2.25", "ground.road_offset=0.5"};
  const std::vector<Vec2> found = file.points(settings);
  // A quarter of the way from v = 0 to 2: 6, 6.3125, 6.375, ...
  ASSERT_EQ(found.size(), 7U);
  EXPECT_EQ(found[1], (Vec2{-0.25, 6.0 - 6.15625}));
  EXPECT_EQ(found[2], (Vec2{0.25, 6.3125 - 6.15625}));
  EXPECT_EQ(found[3], (Vec2{0.75, 6.375 - 6.15625}));
  EXPECT_EQ(file.read(settings).ground->road.height, 6.15625);
}

TEST(RoadGround, BordersAreThoseOfTheFileOrOfTheCase) {
  CrgParts parts = small_road();
  parts.blocks = "$ROAD_CRG_OPTS\nBORDER_MODE_U = 1\nBORDER_OFFSET_U = 5.0\n$\n";
  const RoadCaseFile zero(crg_of(parts));
  std::vector<Vec2> found = zero.points();
  ASSERT_EQ(found.size(), 8U);  // the first row has the height of the border
  EXPECT_EQ(found[0], (Vec2{-1.5, -0.25}));
  EXPECT_EQ(found[6], (Vec2{1.5, -0.25}));
  found = zero.points({"ground.road_border=zero"});
  ASSERT_EQ(found.size(), 9U);
  EXPECT_EQ(found[0], (Vec2{-1.5, -5.25})) << "the offset goes with the mode of the file";
  EXPECT_EQ(found[1], (Vec2{-0.5, -5.25}));
  EXPECT_EQ(found[2], (Vec2{-0.5, -0.25}));
  EXPECT_EQ(zero.points({"ground.road_border=keep"}), RoadCaseFile().points());
  for (const char* mode : {"0", "3", "4"}) {
    parts.blocks = std::string("$ROAD_CRG_OPTS\nBORDER_MODE_U = ") + mode + "\n$\n";
    const RoadCaseFile other(crg_of(parts));
    const std::string said = other.faults();
    EXPECT_TRUE(has(said, "ground.road") && has(said, std::string("BORDER_MODE_U = ") + mode) &&
                has(said, "ground.road_border = \"keep\" or \"zero\""))
        << said;
    EXPECT_EQ(other.points({"ground.road_border=keep"}), RoadCaseFile().points());
  }
}

TEST(RoadGround, WrittenAsPointsThatAreReadAgain) {
  const Case c = RoadCaseFile().read({"ground.road_start=2.3"});
  const std::string text = write_case(c);
  EXPECT_FALSE(has(text, "road")) << text;
  const Case again = test::read_text(text);
  EXPECT_EQ(again.ground->shape.profile, c.ground->shape.profile);
  EXPECT_STREQ(ground_key(again), "ground.profile");
}

TEST(RoadGround, ASettingOfOneShapeReplacesTheOther) {
  const RoadCaseFile file(crg_of(small_road()), "road = \"a.crg\"\nroad_offset = 0.5");
  EXPECT_EQ(file.points({"ground.profile=flat"}), contact::GroundShape{}.profile);
  const RoadCaseFile profile(crg_of(small_road()), "profile = \"flat\"");
  EXPECT_EQ(profile.points({"ground.road=a.crg"}), RoadCaseFile().points());
  EXPECT_TRUE(has(file.faults({"ground.profile=flat", "ground.road_offset=0.5"}),
                  "ground.road_offset = 0.5: has no effect without ground.road"));
}

TEST(RoadGround, OneShapeAndPlacesOnTheRoad) {
  const RoadCaseFile file;
  const std::string both =
      RoadCaseFile(crg_of(small_road()), "road = \"a.crg\"\nprofile = \"flat\"").faults();
  EXPECT_TRUE(has(both, "ground.road = \"a.crg\": is given together with ground.profile")) << both;
  EXPECT_TRUE(has(RoadCaseFile("", "").faults(), "ground.profile: is missing"));
  EXPECT_TRUE(
      has(RoadCaseFile("", "road = \"\"").faults(), "ground.road = \"\": must not be empty"));
  EXPECT_TRUE(has(file.faults({"ground.road_start=4.01"}), "(allowed: 2 to 4, u of the road)"));
  EXPECT_TRUE(has(file.faults({"ground.road_start=1.99"}), "x = 0 would not be on the road"));
  EXPECT_TRUE(has(file.faults({"ground.road_offset=2.01"}), "(allowed: -1 to 2, v of the road)"));
  EXPECT_TRUE(has(file.faults({"ground.road_border=reflect"}), "is not one of the choices"));
  const std::string repeat = file.faults({"ground.road_border=repeat"});
  EXPECT_TRUE(has(repeat,
                  "ground.road_border = repeat: asks (\"repeat\") for what the ground of a "
                  "plane body does not do beyond the ends of a road (allowed: \"keep\" or "
                  "\"zero\")"))
      << repeat;
  EXPECT_EQ(file.faults({"ground.road_start=4", "ground.road_offset=2"}), "");
  CrgParts brief = small_road();
  brief.rows.resize(2);
  brief.road = "REFERENCE_LINE_INCREMENT = 0.125\n";
  EXPECT_TRUE(has(RoadCaseFile(crg_of(brief)).faults(), "ground.road_start: is missing"));
}

TEST(RoadGround, WhatIsWrongWithTheFile) {
  const std::string whole = crg_of(small_road());
  const std::string cut = RoadCaseFile(whole.substr(0, whole.size() - 30)).faults();
  EXPECT_TRUE(has(cut, "case.toml:25:8: ground.road = \"a.crg\": a.crg: line ")) << cut;
  CrgParts misspelt = small_road();
  misspelt.road += "REFERENCE_LINE_STRAT_Z = 1.0\n";
  const std::string line = RoadCaseFile(crg_of(misspelt)).faults();
  EXPECT_EQ(line.find("a.crg:7:"), 0U) << line;
  EXPECT_TRUE(has(RoadCaseFile(whole, "road = \"b.crg\"").faults(), "b.crg")) << line;
  CrgParts holes = small_road();
  holes.blocks = "$ROAD_CRG_MODS\nGRID_NAN_MODE = 0\n$\n$ROAD_CRG_OPTS\nBORDER_MODE_V = 0\n$\n";
  holes.rows[1][2] = rondo::test::missing_height;
  const RoadCaseFile missing(crg_of(holes));
  EXPECT_EQ(missing.faults(), "");
  const std::string hole = missing.faults({"ground.road_offset=1"});
  EXPECT_TRUE(has(hole, "has no height at u = 2.5 m, v = 1 m")) << hole;
}

TEST(RoadGround, NoMorePointsThanACaseHolds) {
  CrgParts parts = small_road();
  parts.rows.assign(most_profile_points - 3, {0.0, 0.0, 0.0});
  EXPECT_TRUE(has(RoadCaseFile(crg_of(parts)).faults(), "a file with the part that the wheel"));
  parts.rows.pop_back();
  EXPECT_EQ(RoadCaseFile(crg_of(parts)).faults(), "");
}

TEST(RoadGround, FlatGroundAndShapes) {
  const std::string steady =
      RoadCaseFile().faults({"analysis.kind=steady-rolling", "time.end=0.1"});
  EXPECT_TRUE(has(steady, "ground.road = \"a.crg\": steady rolling needs flat ground")) << steady;
  CrgParts spike = small_road();
  spike.rows[2] = {7.0, 90.0, 9.0};
  const std::string turned = RoadCaseFile(crg_of(spike)).faults();
  EXPECT_TRUE(has(turned,
                  "ground.road = \"a.crg\": the profile turns back on itself here, at x = "
                  "0.5 m"))
      << turned;
  const std::string fillet = RoadCaseFile().faults({"ground.fillet=3"});
  EXPECT_TRUE(has(fillet, "the fillet does not fit")) << fillet;
}

const std::vector<std::string> in_space{"disk.width=0.1", "ground.fillet=0"};

std::vector<std::string> and_(std::vector<std::string> settings, const std::string& more) {
  settings.push_back(more);
  return settings;
}

TEST(RoadGround, UnderAWheelWithAWidthTheSurfaceIsKept) {
  const RoadCaseFile file;
  const Case c = file.read(and_(in_space, "ground.road_offset=1"));
  EXPECT_TRUE(is_on_road_surface(c));
  EXPECT_EQ(c.ground->shape.profile, contact::GroundShape{}.profile);
  EXPECT_EQ(*c.ground->road.start, 2.5);
  EXPECT_EQ(c.ground->road.height,
            road::Surface(*c.ground->road.read, edges_of(c.ground->road)).at(2.5, 1.0).height);
  EXPECT_NE(c.ground->road.height, 7.375) << "that of the bilinear surface";
  const std::string text = write_case(c);
  EXPECT_FALSE(has(text, "profile") || has(text, "road_border")) << text;
  const Case again = test::read_text(text);
  EXPECT_EQ(write_case(again), text);
  EXPECT_EQ(again.ground->road.height, c.ground->road.height);
}

TEST(RoadGround, BordersUnderAWheelWithAWidth) {
  CrgParts parts = small_road();
  for (const int mode : {1, 2, 3, 4}) {
    parts.blocks = "$ROAD_CRG_OPTS\nBORDER_MODE_U = " + std::to_string(mode) + "\n$\n";
    const Case c = RoadCaseFile(crg_of(parts)).read(in_space);
    EXPECT_EQ(static_cast<int>(edges_of(c.ground->road).u), mode);
    const Case repeats =
        RoadCaseFile(crg_of(parts)).read(and_(in_space, "ground.road_border=repeat"));
    EXPECT_EQ(edges_of(repeats.ground->road).u, road::Border::repeat);
    EXPECT_TRUE(has(write_case(repeats), "road_border = \"repeat\""));
  }
  parts.blocks = "$ROAD_CRG_OPTS\nBORDER_MODE_U = 0\n$\n";
  const std::string none = RoadCaseFile(crg_of(parts)).faults(in_space);
  EXPECT_TRUE(
      has(none, "a.crg asks by BORDER_MODE_U = 0 (\"none\") for what the ground of a wheel") &&
      has(none, "ground.road_border = \"keep\", \"zero\" or \"repeat\" beside it"))
      << none;
}

TEST(RoadGround, WhatIsRefusedUnderAWheelWithAWidth) {
  const std::string fillet = RoadCaseFile().faults({"disk.width=0.1", "ground.fillet=0.01"});
  EXPECT_TRUE(has(fillet, "ground.fillet = 0.01: rounds corners")) << fillet;
  CrgParts holes = small_road();
  holes.blocks = "$ROAD_CRG_MODS\nGRID_NAN_MODE = 0\n$\n$ROAD_CRG_OPTS\nBORDER_MODE_V = 0\n$\n";
  holes.rows[1][2] = rondo::test::missing_height;
  const std::string hole =
      RoadCaseFile(crg_of(holes)).faults(and_(in_space, "ground.road_offset=1"));
  EXPECT_TRUE(has(hole, "has no height at u = 2.5 m, v = 1 m, where x = 0")) << hole;
  CrgParts longest = small_road();
  longest.rows.assign(most_profile_points, {0.0, 0.0, 0.0});
  EXPECT_EQ(RoadCaseFile(crg_of(longest)).faults(in_space), "") << "only plane ground has few rows";
}

}  // namespace
}  // namespace rondo::study::road_ground_test
