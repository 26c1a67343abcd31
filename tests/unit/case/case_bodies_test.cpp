// SPDX-License-Identifier: BSD-3-Clause
/// Keys of bodies from files, free bodies, contact between bodies, loads and probes; lists of
/// tables.
#include <gtest/gtest.h>

#include "unit/case/case_fixture.hpp"

namespace rondo::study::case_bodies_test {
namespace {

using namespace test;

/// Lines are counted below, from 1.
const std::string thrown = R"(schema = 1
[mesh]
file = "parts/two.msh"
scale = 1e-3
contact = "skin"
[material]
youngs_modulus = 5e6
poissons_ratio = 0.499
density = 1100
integration = "b-bar"
[[material.region]]
surface = "core"
youngs_modulus = 7e10
poissons_ratio = 0.33
density = 2700
[[material.region]]
surface = "cord"
[motion]
gravity = [[0, 0], [0.5, 9.81]]
[contact]
between = "all"
friction = 0.4
restitution = 0.25
[[load.pressure]]
curve = "bore"
value = [[0, 0], [0.1, 2e5]]
[initial]
velocity = [3.0, 1.0]
position = [0.0, 0.5]
turn = 0.25
angular_velocity = -12.5
[[initial.region]]
surface = "core"
velocity = [-1, 2]
[[initial.region]]
surface = "cord"
angular_velocity = 4
[time]
end = 0.2
[solver]
contact_iterations = 77
dump_contacts = 9
[[output.probe]]
name = "top-1"
position = [0.1, 0.2]
[[output.probe]]
name = "bottom_2"
position = [0.1, -0.2]
)";

TEST(ReadBodies, TakesEveryKey) {
  const CaseFile file(thrown);
  const Case c = read_case(file.path());
  ASSERT_TRUE(c.mesh);
  EXPECT_EQ(c.mesh->file, file.path().parent_path() / "parts/two.msh");
  EXPECT_EQ(c.mesh->scale, 1e-3);
  EXPECT_TRUE(c.mesh->clamped.empty());
  EXPECT_EQ(c.mesh->contact, "skin");
  EXPECT_FALSE(is_held(c));
  EXPECT_EQ(c.material.integration, fem::Integration::b_bar);
  ASSERT_EQ(c.regions.size(), 2U);
  EXPECT_EQ(c.regions[0].surface, "core");
  EXPECT_EQ(c.regions[0].material.youngs_modulus, 7e10);
  EXPECT_EQ(c.regions[0].material.density, 2700.0);
  EXPECT_EQ(c.regions[0].material.integration, fem::Integration::b_bar);
  EXPECT_EQ(c.regions[1].material.poissons_ratio, 0.499);  // left out: that of [material]
  EXPECT_EQ(c.motion.gravity.at(0.25), 0.5 * 9.81);
  ASSERT_EQ(c.warnings.size(), 1U);  // b-bar does not lock
  EXPECT_NE(c.warnings[0].find("> 0 turns clockwise now"), std::string::npos) << c.warnings[0];
}

TEST(ReadBodies, TakesEveryKeyOfTheRun) {
  const Case c = read_text(thrown);
  EXPECT_EQ(c.body_contact.between, BodyContact::all);
  EXPECT_EQ(c.body_contact.friction, 0.4);
  EXPECT_EQ(c.body_contact.restitution, 0.25);
  EXPECT_EQ(c.body_contact.impact, contact::Impact::moreau);
  ASSERT_EQ(c.pressures.size(), 1U);
  EXPECT_EQ(c.pressures[0].curve, "bore");
  EXPECT_EQ(c.pressures[0].pressure.at(0.05), 1e5);
  EXPECT_EQ(c.initial.position, (Vec2{0.0, 0.5}));
  EXPECT_EQ(c.initial.turn, 0.25);
  EXPECT_EQ(c.initial.angular_velocity, -12.5);
  ASSERT_EQ(c.initial.regions.size(), 2U);
  EXPECT_EQ(c.initial.regions[0].velocity, (Vec2{-1, 2}));
  EXPECT_EQ(c.initial.regions[0].angular_velocity, -12.5);  // left out: that of [initial]
  EXPECT_EQ(c.initial.regions[1].velocity, (Vec2{3, 1}));
  EXPECT_EQ(c.initial.regions[1].angular_velocity, 4.0);
  EXPECT_EQ(c.contact_iterations, 77);
  EXPECT_EQ(c.dump_contacts, 9);
  ASSERT_EQ(c.output.probes.size(), 2U);
  EXPECT_EQ(c.output.probes[1].name, "bottom_2");
  EXPECT_EQ(c.output.probes[1].position, (Vec2{0.1, -0.2}));
}

TEST(ReadBodies, AMeshMayBeHeld) {
  const std::string text = with_line(5, "clamped = \"rim\"", thrown);
  EXPECT_EQ(faults_of(text, {"contact.between=none"}).size(), 3U);  // the motion of the rim
  const Case c = read_text(text, {"contact.between=none", "motion.angular_velocity=3",
                                  "motion.speed=1", "motion.height=0.3"});
  EXPECT_TRUE(is_held(c));
  EXPECT_EQ(c.mesh->clamped, std::vector<std::string>{"rim"});
}

TEST(ReadBodies, SeveralCurvesMayBeHeld) {
  const std::vector<std::string> motion{"contact.between=none", "motion.angular_velocity=3",
                                        "motion.speed=1", "motion.height=0.3"};
  const auto with = [&](const std::string& value) {
    return with_line(5, "clamped = " + value, thrown);
  };
  const Case c = read_text(with("[\"left\", \"right\"]"), motion);
  EXPECT_EQ(c.mesh->clamped, (std::vector<std::string>{"left", "right"}));
  EXPECT_NE(write_case(c).find("clamped = [\"left\", \"right\"]\n"), std::string::npos);
  EXPECT_TRUE(read_text(with("[]"), {"contact.between=none"}).mesh->clamped.empty());
  for (const char* wrong : {"[\"left\", \"left\"]", "[\"left\", 3]", "[\"\"]", "7"}) {
    const auto faults = faults_of(with(wrong), motion);
    ASSERT_FALSE(faults.empty()) << wrong;
    EXPECT_EQ(faults[0].key, "mesh.clamped") << wrong;
  }
}

TEST(ReadBodies, AnAbsoluteFileStaysWhatItIs) {
  EXPECT_EQ(read_text(thrown, {"mesh.file=/data/a.msh"}).mesh->file, "/data/a.msh");
}

TEST(ReadBodies, LockingIsWarnedOfInEachMaterial) {
  const Case c = read_text(thrown, {"material.integration=full", "material.poissons_ratio=0.3",
                                    "material.region[1].poissons_ratio=0.495"});
  ASSERT_EQ(c.warnings.size(), 2U);  // and that of the sign of spins
  EXPECT_NE(c.warnings[0].find("material.region[1].poissons_ratio = 0.495"), std::string::npos);
  EXPECT_NE(c.warnings[0].find("b-bar"), std::string::npos);
}

struct WrongBody {
  int line;
  std::string replacement, key;
  int fault_line;
  std::vector<std::string> fragments;
};

TEST(WrongBodies, AreToldOnceWithTheirPlace) {
  const std::vector<WrongBody> wrongs{
      {3, "", "mesh.file", 2, {"is missing"}},
      {3, "file = ''", "mesh.file", 3, {"must not be empty"}},
      {4, "scale = 0", "mesh.scale", 4, {"> 0"}},
      {4, "clampd = 'a'", "mesh.clampd", 4, {"did you mean mesh.clamped?", "file, scale, clamped"}},
      {5, "", "contact.between", 21, {"mesh.contact"}},
      {12, "", "material.region[0].surface", 11, {"is missing"}},
      {12, "surface = ''", "material.region[0].surface", 12, {"must not be empty"}},
      {17, "surface = 'core'", "material.region[1].surface", 17, {"another one before it"}},
      {13, "youngs_modulus = -1", "material.region[0].youngs_modulus", 13, {"> 0", "-1"}},
      {13,
       "young_modulus = 1",
       "material.region[0].young_modulus",
       13,
       {"did you mean material.region[].youngs_modulus?", "in [material.region[0]]: surface"}},
      {19, "speed = 3", "motion.speed", 19, {"an unconstrained body", "initial.velocity"}},
      {24, "[[load.presure]]", "load.presure", 24, {"did you mean load.pressure?"}},
      {24, "[load.pressure]", "load.pressure", 24, {"a list of tables", "[[load.pressure]]"}},
      {26, "", "load.pressure[0].value", 24, {"is missing"}},
      {26, "value = 'much'", "load.pressure[0].value", 26, {"a float or an array of pairs"}},
      {28, "state = 'stationary'", "initial.state", 28, {"is not turned by a rim"}},
      {29, "position = 0.5", "initial.position", 29, {"must be an array"}},
      {39, "end = 1\nscheme = 'as-printed'", "time.scheme", 40, {"\"symplectic\""}},
      {41, "operator = 'cyclic'", "solver.operator", 41, {"equal sectors", "\"sparse\""}},
      {44, "name = 'a b'", "output.probe[0].name", 44, {"letters, digits, _ and -"}},
      {44, "name = ''", "output.probe[0].name", 44, {"must not be empty"}},
      {47, "name = 'top-1'", "output.probe[1].name", 47, {"another one before it"}},
      {48, "", "output.probe[1].position", 46, {"is missing"}},
      {48, "position = [0.1, nan]", "output.probe[1].position", 48, {"finite"}},
      {48, "position = [0.1, 1]\nx = 3", "output.probe[1].x", 49, {"name, position"}},
      {7,
       "youngs_modulus = 5e6\nstress_stiffening = 'centrifugal'",
       "material.stress_stiffening",
       8,
       {"a free body is not turned by a rim"}},
  };
  for (const WrongBody& wrong : wrongs) {
    SCOPED_TRACE(wrong.replacement + " at " + std::to_string(wrong.line));
    const auto faults = faults_of(with_line(wrong.line, wrong.replacement, thrown));
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].key, wrong.key);
    EXPECT_EQ(faults[0].line, wrong.fault_line);
    for (const std::string& fragment : wrong.fragments)
      EXPECT_NE(faults[0].text().find(fragment), std::string::npos) << faults[0].text();
  }
}

TEST(WrongBodies, AListOfSomethingElse) {
  const std::string text = with_line(42, "[output]\nprobe = [{name = 'a', position = [0, 0]},\n 7]",
                                     thrown.substr(0, thrown.find("[[output.probe]]")) + "\n");
  const auto faults = faults_of(text);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].key, "output.probe");
  EXPECT_EQ(faults[0].line, 44);
  EXPECT_EQ(faults[0].found, "7");
  EXPECT_NE(faults[0].message.find("not an integer in it"), std::string::npos);
}

TEST(ReadBodies, TheAngleOfEarlierVersionsIsATurnTheOtherWay) {
  std::string old = thrown;
  old.replace(old.find("turn = 0.25"), 11, "angle = 0.25");
  const Case c = read_text(old);
  EXPECT_EQ(c.initial.turn, -0.25);
  EXPECT_EQ(c.initial.angle, 0.0);
  ASSERT_FALSE(c.warnings.empty());
  EXPECT_NE(c.warnings.front().find("initial.turn = -0.25"), std::string::npos);
  const auto from_material = [](const std::string& text) {
    return text.substr(text.find("[material]"));
  };
  EXPECT_EQ(from_material(write_case(c)),
            from_material(write_case(read_text(thrown, {"initial.turn=-0.25"}))));
  const auto faults = faults_of(thrown, {"initial.angle=0.5"});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].key, "initial.angle");
}

TEST(WrongBodies, ABondedDiskIsPlacedByItsRim) {
  const auto faults = faults_of(
      base, {"initial.angle=0.5", "initial.angular_velocity=1", "initial.region[0].surface=core"});
  ASSERT_EQ(faults.size(), 3U);
  for (const Fault& fault : faults)
    EXPECT_NE(fault.message.find("unconstrained bodies"), std::string::npos) << fault.text();
}

TEST(WrongBodies, OfACrush) {
  const std::vector<std::string> crush{"analysis.kind=crush", "analysis.depth=0.01",
                                       "analysis.increments=4", "ground.profile=flat"};
  const auto wrong = [&](const std::string& setting, const std::string& more = "") {
    auto settings = crush;
    settings.push_back(setting);
    if (!more.empty()) settings.push_back(more);
    const auto faults = faults_of(base, settings);
    EXPECT_EQ(faults.size(), 1U) << setting;
    return faults.empty() ? std::string() : faults[0].key;
  };
  EXPECT_EQ(wrong("disk.rim=free"), "disk.rim");
  EXPECT_EQ(wrong("contact.between=bodies"), "contact.between");
  EXPECT_EQ(wrong("load.pressure[0].curve=rim", "load.pressure[0].value=1"), "load.pressure[0]");
  EXPECT_EQ(faults_of(thrown, {"analysis.kind=crush", "analysis.depth=0.01", "contact.between=none",
                               "analysis.increments=4", "ground.profile=flat", "load.pressure=[]"})
                .at(0)
                .key,
            "mesh.clamped");
}

TEST(SettingsOfLists, ChangeOneTable) {
  const Case c = read_text(thrown, {"output.probe[0].position=[1, 2]", "output.probe[1].name=b"});
  EXPECT_EQ(c.output.probes[0].position, (Vec2{1, 2}));
  EXPECT_EQ(c.output.probes[0].name, "top-1");
  EXPECT_EQ(c.output.probes[1].name, "b");
}

TEST(SettingsOfLists, AddOneAndReplaceAll) {
  const Case more =
      read_text(thrown, {"output.probe[2].name=c", "output.probe[2].position=[1, 2]"});
  ASSERT_EQ(more.output.probes.size(), 3U);
  EXPECT_EQ(more.output.probes[2].position, (Vec2{1, 2}));
  const Case other =
      read_text(thrown, {"output.probe=[{name = 'x', position = [0, 0]}]", "load.pressure=[]"});
  ASSERT_EQ(other.output.probes.size(), 1U);
  EXPECT_EQ(other.output.probes[0].name, "x");
  EXPECT_TRUE(other.pressures.empty());
  const Case whole = read_text(thrown, {"output.probe[1]={name = 'y', position = [4, 5]}"});
  ASSERT_EQ(whole.output.probes.size(), 2U);
  EXPECT_EQ(whole.output.probes[1].name, "y");
}

TEST(SettingsOfLists, FaultsNameTheSetting) {
  const auto faults =
      faults_of(thrown, {"output.probe[3].name=c", "output.probe.name=d", "output.probe[0].nme=e",
                         "output.probe[x].name=f", "title[0]=g"});
  ASSERT_EQ(faults.size(), 5U);
  EXPECT_EQ(faults[0].key, "output.probe.name");
  EXPECT_NE(faults[0].message.find("did you mean output.probe[].name?"), std::string::npos);
  EXPECT_EQ(faults[1].key, "output.probe[0].nme");
  EXPECT_EQ(faults[2].key, "title[0]");
  EXPECT_EQ(faults[3].file, "--set output.probe[3].name=c");
  EXPECT_NE(faults[3].message.find("there are 2 tables in output.probe"), std::string::npos);
  EXPECT_EQ(faults[4].file, "--set output.probe[x].name=f");
}

TEST(SettingsOfLists, AMissingKeyOfANewTableIsTold) {
  const auto faults = faults_of(base, {"output.probe[0].name=c"});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].key, "output.probe[0].position");
  EXPECT_NE(faults[0].message.find("is missing"), std::string::npos);
}

}  // namespace
}  // namespace rondo::study::case_bodies_test
