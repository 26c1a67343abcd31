// SPDX-License-Identifier: BSD-3-Clause
/// Friction on the ground as a number and as a table: settings, writing, and what is refused.
#include <gtest/gtest.h>

#include "rondo/case/case_keys.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study::friction_rules_test {
namespace {

using namespace test;

const std::string tabled = with_line(
    27,
    "[ground.friction]\ncoefficient = 0.9\nslip_speed = [[0, 1], [0.5, 1.25], [10, 0.7]]\n"
    "pressure_exponent = -0.15\npressure_reference = 1e5",
    with_line(28, ""));
const std::string flat = with_line(25, "profile = \"flat\"", with_line(26, ""));
const std::string patch = "ground.patch=[{from = 1, to = 2, factor = 0.5}]";

std::string faults(const std::string& text, const std::vector<std::string>& settings = {}) {
  std::string all;
  for (const Fault& fault : faults_of(text, settings))
    all += fault.key + ": " + fault.message + " (" + fault.allowed + ")\n";
  return all;
}

TEST(FrictionOfTheGround, IsReadAsATable) {
  const Case c = read_text(tabled);
  const contact::FrictionTable& friction = c.ground->friction;
  EXPECT_EQ(friction.coefficient, 0.9);
  EXPECT_EQ(friction.slip,
            (std::vector<std::array<double, 2>>{{0.0, 1.0}, {0.5, 1.25}, {10.0, 0.7}}));
  EXPECT_EQ(friction.pressure_exponent, -0.15);
  EXPECT_EQ(friction.pressure_reference, 1e5);
  EXPECT_EQ(read_text(write_case(c)).ground->friction.slip, friction.slip);
}

TEST(FrictionOfTheGround, ThatIsANumberIsWrittenAsANumber) {
  for (const auto& setting : {"ground.friction=0.7", "ground.friction={coefficient = 0.7}",
                              "ground.friction.coefficient=0.7"}) {
    const Case c = read_text(base, {setting});
    EXPECT_EQ(c.ground->friction.coefficient, 0.7) << setting;
    EXPECT_TRUE(c.ground->friction.is_constant()) << setting;
    EXPECT_NE(write_case(c).find("\nfriction = 0.7\n"), std::string::npos) << write_case(c);
    EXPECT_EQ(write_case(c).find("[ground.friction]"), std::string::npos) << write_case(c);
  }
}

TEST(FrictionOfTheGround, TheLastSettingCounts) {
  const Case number = read_text(tabled, {"ground.friction=0.3"});
  EXPECT_TRUE(number.ground->friction.is_constant());
  EXPECT_EQ(number.ground->friction.coefficient, 0.3);

  const Case one_key = read_text(tabled, {"ground.friction.coefficient=0.3"});
  EXPECT_EQ(one_key.ground->friction.coefficient, 0.3);
  EXPECT_EQ(one_key.ground->friction.slip.size(), 3U);

  const Case opened = read_text(base, {"ground.friction.pressure_exponent=-0.1"});
  EXPECT_EQ(opened.ground->friction.coefficient, 0.3);  // that of the file
  EXPECT_EQ(opened.ground->friction.pressure_exponent, -0.1);

  const Case both =
      read_text(tabled, {"ground.friction=0.3", "ground.friction.slip_speed=[[0, 1], [1, 2]]"});
  EXPECT_EQ(both.ground->friction.coefficient, 0.3);
  EXPECT_EQ(both.ground->friction.slip.size(), 2U);
  EXPECT_EQ(both.ground->friction.pressure_exponent, 0.0);
}

TEST(FrictionOfTheGround, ATableWithoutItsCoefficientIsIncomplete) {
  const std::string missing = "ground.friction.coefficient: is missing (0 to 100)\n";
  EXPECT_EQ(faults(tabled, {"ground.friction={}"}), missing);
  EXPECT_EQ(faults(tabled, {"ground.friction={pressure_reference = 1e5}"}), missing);
  EXPECT_EQ(faults(tabled, {"ground.friction={pressure_exponent = 0.1}"}), missing);
}

TEST(FrictionOfTheGround, ThatIsNeitherNumberNorTableIsRefused) {
  EXPECT_EQ(faults(base, {"ground.friction=rubber"}),
            "ground.friction: must be a float, not a string (0 to 100; or a table "
            "[ground.friction])\n");
  EXPECT_NE(faults(base, {"ground.mu=0.3"}).find("did you mean ground.friction?"),
            std::string::npos);
  EXPECT_NE(faults(base, {"ground.friction.slip=0.3"}).find("ground.friction.slip"),
            std::string::npos);
}

TEST(FrictionOfTheGround, SlipSpeedsIncreaseAndFactorsAreBounded) {
  const auto slip = [](const std::string& points) {
    return faults(tabled, {"ground.friction.slip_speed=" + points});
  };
  EXPECT_EQ(slip("[[0, 1], [0, 2]]"),
            "ground.friction.slip_speed: the speeds must increase, by 1e-09 m/s at the least, but "
            "0 follows 0 ()\n");
  EXPECT_EQ(slip("[[-1, 1]]"), "ground.friction.slip_speed: the speed -1 is below 0 ()\n");
  EXPECT_EQ(slip("[[0, -1]]"),
            "ground.friction.slip_speed: the factor -1 is not from 0 to 100 ()\n");
  EXPECT_EQ(slip("[[0, 101]]"),
            "ground.friction.slip_speed: the factor 101 is not from 0 to 100 ()\n");
}

TEST(FrictionOfTheGround, PatchesHaveALengthAndASide) {
  EXPECT_EQ(faults(base, {"ground.patch=[{from = 1, to = 1, factor = 0.5}]"}),
            "ground.patch[0].to: must be more than from, or the patch has no length (> 1)\n");
  EXPECT_EQ(faults(base, {patch, "ground.patch[0].side=left"}),
            "ground.patch[0].side: a plane body has no left and no right side (\"both\"; or a "
            "wheel in three dimensions, with disk.width or a [section])\n");
  EXPECT_EQ(faults(base, {patch}), "");
  EXPECT_EQ(faults(flat, {patch, "ground.patch[0].side=left", "disk.width=0.2"}), "");
  EXPECT_EQ(faults(base, {"ground.patch=[{from = 1, to = 2}]"}),
            "ground.patch[0].factor: is missing (0 to 100)\n");
}

/// The key that is refused is named, and a table that is a constant is taken. Steady rolling takes
/// all tables, but no patches.
TEST(FrictionOfTheGround, AnalysesRefuseWhatTheyCannotTake) {
  const std::vector<std::string> steady{"analysis.kind=steady-rolling", "ground.profile=flat",
                                        "ground.fillet=0"};
  const auto refused = [&](std::vector<std::string> more) {
    more.insert(more.begin(), steady.begin(), steady.end());
    return faults(tabled, more);
  };
  EXPECT_EQ(refused({}), "");
  EXPECT_EQ(refused({patch}).substr(0, 33), "ground.patch[0]: a wheel that pas");
  EXPECT_EQ(refused({patch, "ground.friction=0.5"}).substr(0, 33),
            "ground.patch[0]: a wheel that pas");
  const std::vector<std::string> start{"initial.state=steady-rolling", "ground.profile=flat",
                                       "ground.fillet=0"};
  EXPECT_EQ(faults(tabled, start), "");
  EXPECT_EQ(faults(tabled, {start[0], start[1], start[2], patch}).substr(0, 33),
            "ground.patch[0]: a start in stead");
  EXPECT_EQ(refused({"ground.friction={coefficient = 0.5, slip_speed = [[0, 1.1], [1, 1.1]]}"}),
            "");
  EXPECT_EQ(refused({patch, "ground.friction=0"}), "");
  const auto crushed = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"analysis.kind=crush", "analysis.depth=0.01",
                               "analysis.increments=2", "ground.profile=flat", "ground.fillet=0"});
    return faults(tabled, more);
  };
  const std::string no_slip = "ground.friction.slip_speed=[[0, 1.1], [1, 1.1]]";
  EXPECT_EQ(crushed({}).substr(0, 46), "ground.friction.slip_speed: a crush is so slow");
  EXPECT_EQ(crushed({patch}).substr(0, 46), "ground.friction.slip_speed: a crush is so slow");
  EXPECT_EQ(crushed({patch, no_slip}), "");
  EXPECT_EQ(crushed({patch, "ground.friction=0.5"}), "");
  EXPECT_EQ(crushed({no_slip, "analysis.solver=latin"}).substr(0, 33),
            "ground.friction: LATIN solves all");
  EXPECT_EQ(crushed({patch, "ground.friction=0.5", "analysis.solver=latin-pgd"}).substr(0, 33),
            "ground.patch[0]: LATIN solves all");
  EXPECT_NE(faults(tabled, {"time.scheme=hati"}).find("ground.friction: "), std::string::npos);
}

}  // namespace
}  // namespace rondo::study::friction_rules_test
