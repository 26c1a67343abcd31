// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "rondo/case/case_keys.hpp"
#include "rondo/case/toml_text.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study::case_test {
namespace {

using namespace test;

/// Each key as often as it is there; the text of a number is that of its bits.
std::string values_of(Case c) {
  std::string values;
  for (const CaseTable& table : case_tables())
    for (std::size_t k = 0; k < table.count(c); ++k)
      for (const CaseKey& key : keys_of(table)) {
        if (key.use.when(c))
          values += fmt::format("{} {}\n", path_of(key, k), value_text(key, key.field(c, k)));
      }
  return values;
}

void expect_round_trip(const Case& c) {
  const std::string text = write_case(c);
  SCOPED_TRACE(text);
  const Case again = read_text(text);
  EXPECT_EQ(values_of(c), values_of(again));
  EXPECT_EQ(text, write_case(again));
}

/// A case with a value of its own, unlike the default, for each key.
const std::string everything = R"(schema = 1
title = "All \"keys\" of C:\\rondo, \u00e4 日本\nsecond line"
[disk]
outer_radius = 0.31
inner_radius = 0.16
[disk.mesh]
radial = 9
grading = 1.25
[disk.tread]
pitches = 50
depth = 0.02
land_columns = 4
groove_columns = 2
layers = 3
[material]
youngs_modulus = 2.1e7
poissons_ratio = 0.31
density = 1150
plane = "stress"
integration = "full"
stress_stiffening = "none"
[damping]
mass = 201.5
stiffness = 2.0e-5
[motion]
angular_velocity = [[0, 0], [0.01, 33.3], [1, -5e-3]]
speed = [[0.5, 10]]
height = 0.29
start_x = -0.35
gravity = 9.81
[ground]
profile = [[-10, -0.1], [0, -0.1], [0, 0], [10, 0]]
fillet = 0.02
friction = 0.3
restitution = 0.5
[initial]
state = "stationary"
velocity = [1.5, -0.0]
displacement_gradient = [[0.001, 2], [-3.5, 1e-300]]
[analysis]
kind = "dynamic"
[time]
end = 0.12
step = 1.0e-6
scheme = "as-printed"
[solver]
operator = "sparse"
[output]
history_interval = 0
snapshots = 17
snapshots_from = 0.07
stress = false
checkpoint_interval = 30
)";

TEST(ReadCase, TakesEveryKey) {
  const Case c = read_text(everything);
  EXPECT_EQ(c.title, "All \"keys\" of C:\\rondo, \u00e4 日本\nsecond line");
  EXPECT_EQ(c.disk.outer_radius, 0.31);
  EXPECT_EQ(c.disk.inner_radius, 0.16);
  EXPECT_EQ(c.disk.radial, 9);
  EXPECT_EQ(c.disk.grading, 1.25);
  ASSERT_TRUE(c.disk.tread);
  EXPECT_EQ(c.disk.tread->pitches, 50);
  EXPECT_EQ(c.disk.tread->depth, 0.02);
  EXPECT_EQ(c.disk.tread->land_columns, 4);
  EXPECT_EQ(c.disk.tread->groove_columns, 2);
  EXPECT_EQ(c.disk.tread->layers, 3);
  EXPECT_EQ(c.material.youngs_modulus, 2.1e7);
  EXPECT_EQ(c.material.poissons_ratio, 0.31);
  EXPECT_EQ(c.material.density, 1150.0);
  EXPECT_EQ(c.material.plane, fem::Plane::stress);
  EXPECT_EQ(c.damping.mass, 201.5);
  EXPECT_EQ(c.damping.stiffness, 2.0e-5);
  const std::vector<std::array<double, 2>> spin{{0, 0}, {0.01, 33.3}, {1, -5e-3}};
  EXPECT_EQ(c.motion.angular_velocity.points(), spin);
  EXPECT_EQ(c.motion.speed.at(0.0), 10.0);
  EXPECT_EQ(c.motion.height.at(3.0), 0.29);
  EXPECT_EQ(c.motion.start_x, -0.35);
  EXPECT_EQ(c.motion.gravity.at(0.0), 9.81);
}

TEST(ReadCase, TakesEveryKeyOfTheRun) {
  const Case c = read_text(everything);
  ASSERT_TRUE(c.ground);
  const std::vector<Vec2> profile{{-10, -0.1}, {0, -0.1}, {0, 0}, {10, 0}};
  EXPECT_EQ(c.ground->shape.profile, profile);
  EXPECT_EQ(c.ground->shape.fillet, 0.02);
  EXPECT_EQ(c.ground->friction.coefficient, 0.3);
  EXPECT_EQ(c.ground->restitution, 0.5);
  EXPECT_EQ(c.initial.state, InitialState::stationary);
  EXPECT_EQ(c.initial.velocity, (Vec2{1.5, 0.0}));
  EXPECT_EQ(c.initial.displacement_gradient[0][1], 2.0);
  EXPECT_EQ(c.initial.displacement_gradient[1][0], -3.5);
  EXPECT_EQ(c.time.end, 0.12);
  EXPECT_EQ(c.time.step, 1.0e-6);
  EXPECT_EQ(c.time.scheme, Scheme::as_printed);
  EXPECT_EQ(c.solver_operator, "sparse");
  EXPECT_EQ(c.output.history_interval, 0.0);
  EXPECT_EQ(c.output.snapshots, 17);
  EXPECT_EQ(c.output.snapshots_from, 0.07);
  EXPECT_FALSE(c.output.stress);
  EXPECT_EQ(c.output.checkpoint_interval, 30.0);
  EXPECT_TRUE(c.warnings.empty());
}

const std::string least = R"(schema = 1
disk = {outer_radius = 3, inner_radius = 1, mesh = {radial = 2, circumferential = 8}}
material = {youngs_modulus = 1, poissons_ratio = 0, density = 1}
motion = {angular_velocity = 0, speed = 0, height = 5}
time.end = 1
)";

const std::string free_disk = R"(schema = 1
disk = {outer_radius = 3, inner_radius = 1, rim = "free", mesh = {radial = 2, circumferential = 8}}
material = {youngs_modulus = 1, poissons_ratio = 0, density = 1}
time.end = 1
)";

TEST(ReadCase, FillsInDefaults) {
  const CaseFile file(least, "my-disk");
  const Case c = read_case(file.path());
  EXPECT_EQ(c.file, file.path());
  EXPECT_EQ(c.title, "my-disk");
  EXPECT_FALSE(c.disk.tread);
  EXPECT_FALSE(c.ground);
  EXPECT_EQ(c.time.safety, 0.8);
  EXPECT_FALSE(c.time.step);
  EXPECT_EQ(c.solver_operator, "auto");
  EXPECT_TRUE(c.warnings.empty());
  expect_round_trip(c);
}

/// What the manual says of a default is what a case without the key is run with.
TEST(ReadCase, DefaultsAreThoseOfTheManual) {
  const std::string ground = "[ground]\nprofile = 'flat'\n";
  const std::string rim =
      "[rim]\nfree = ['speed', 'height', 'angular_velocity']\nmass = 1\ninertia = 1\n";
  const std::string held = "\n" + write_case(read_text(least + ground + rim));
  const std::string free = "\n" + write_case(read_text(free_disk + ground));
  const std::string steady =
      "\n" + write_case(read_text(least + ground + "[analysis]\nkind = 'steady-rolling'\n",
                                  {"motion.angular_velocity=1"}));
  const std::string rolling_wheel =
      "\n" + write_case(read_text(least + ground + "[analysis]\nkind = 'steady-rolling'\n",
                                  {"motion.angular_velocity=1", "disk.width=0.1"}));
  const std::string pressed =
      "\n" + write_case(read_text(least + ground + "[analysis]\nkind = 'crush'\ndepth = 0.1\n",
                                  {"analysis.increments=4", "analysis.solver=latin"}));
  const std::string direct =
      "\n" + write_case(read_text(least + ground + "[analysis]\nkind = 'crush'\ndepth = 0.1\n",
                                  {"analysis.increments=4"}));
  const auto is_for_free_bodies = [](std::string_view key) {
    return key == "initial.position" || key == "initial.turn" || key == "initial.angle" ||
           key == "initial.angular_velocity";
  };
  const std::string wheel = "\n" + write_case(read_text(least + ground, {"disk.width=0.1"}));
  const std::string inflated =
      "\n" + write_case(read_text(rubber("model = 'neo-hooke'\nshear_modulus = 1e6"),
                                  {"disk.width=0.1", "inflation={}"}));
  const std::string windowed =
      "\n" + write_case(read_text(rubber("model = 'neo-hooke'\nshear_modulus = 1e6"),
                                  {"disk.width=0.1", "inflation={nonlinear = 'window'}"}));
  const auto is_for_wheels = [](std::string_view key) {
    return key == "disk.mesh.axial" || key == "motion.slip_angle" || key == "motion.camber" ||
           key == "motion.turn_slip";
  };
  for (const CaseKey& key : case_keys()) {
    const bool written = !key.use.required && key.use.standard.empty() &&
                         !key.path.starts_with("mesh.") && !key.path.starts_with("section.") &&
                         key.path.find("[]") == std::string_view::npos;
    if (!written) continue;
    const bool is_steady = !means_to(key, AnalysisKind::dynamic);
    const bool is_crush = means_to(key, AnalysisKind::crush);
    const std::string& text = is_steady && is_crush
                                  ? key.path == "analysis.solver" ? direct : pressed
                              : is_steady && is_for_wheels(key.path) ? rolling_wheel
                              : is_steady                            ? steady
                              : is_for_free_bodies(key.path)         ? free
                              : is_for_wheels(key.path)              ? wheel
                              : key.path == "inflation.window"       ? windowed
                              : key.path.starts_with("inflation.")   ? inflated
                                                                     : held;
    const auto table = table_of(key.path);
    const auto begin = text.find(fmt::format("\n[{}]\n", table));
    ASSERT_NE(begin, std::string::npos) << key.path;
    const std::string part = text.substr(begin, text.find("\n\n", begin) - begin) + "\n";
    EXPECT_NE(part.find(fmt::format("\n{} = {}\n", leaf_of(key.path), default_text(key))),
              std::string::npos)
        << key.path << " in" << part;
  }
}

TEST(ReadCase, WarnsOfLocking) {
  EXPECT_TRUE(read_text(with_line(12, "poissons_ratio = 0.49")).warnings.empty());
  EXPECT_EQ(read_text(with_line(12, "poissons_ratio = 0.495")).warnings.size(), 1U);
}

TEST(ReadCase, TakesTheCasesOfTheRepository) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_folder() / "cases")) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path());
    const Case c = read_case(entry.path());
    EXPECT_TRUE(c.warnings.empty());
    expect_round_trip(c);
    EXPECT_TRUE(file_text(entry.path()).starts_with("#:schema schema/case.json\n# "));
    ++count;
  }
  EXPECT_GE(count, 5);
}

TEST(WriteCase, RoundTrips) {
  expect_round_trip(read_text(base));
  expect_round_trip(read_text(treaded()));
  expect_round_trip(read_text(everything));
}

TEST(WriteCase, RoundTripsBodies) {
  expect_round_trip(read_text(free_disk, {"initial.position=[0.1, 0.2]", "initial.turn=-0.3"}));
  const std::vector<std::string> mesh{
      "mesh.file=/a \"b\"/c.msh",
      "mesh.scale=1e-3",
      "mesh.contact=skin",
      "material.integration=b-bar",
      "material.region=[{surface = 'é', density = 0.1}, {surface = 'b', youngs_modulus = 3}]",
      "motion={gravity = [[0, 0], [0.3, 9.81]]}",
      "contact={between = 'bodies', friction = 0.7, impact = 'energy-safe'}",
      "load.pressure=[{curve = 'c', value = 3}, {curve = 'c', value = [[1, 2], [3, -0.0]]}]",
      "initial={position = [0.1, 0.7], angle = 0.3, angular_velocity = -0.1}",
      "initial.region=[{surface = 'b', velocity = [1e-300, 0.3]}]",
      "solver={contact_iterations = 5, dump_contacts = 6}",
      "output.probe=[{name = 'a', position = [0.1, 0.2]}, {name = 'b-1', position = [3, 4]}]"};
  const std::string bare =
      "schema = 1\nmaterial = {youngs_modulus = 1, poissons_ratio = 0, density = 1}\n"
      "time.end = 1\n";
  expect_round_trip(read_text(bare, mesh));
  auto held = mesh;
  held[5] = "motion={angular_velocity = 1, speed = [[0, 1], [0.1, 2]], height = 2}";
  held.insert(held.end(), {"mesh.clamped=rim", "material.stress_stiffening=centrifugal"});
  expect_round_trip(read_text(bare, held));
}

const std::string crush = R"(schema = 1
disk = {outer_radius = 3, inner_radius = 1, mesh = {radial = 2, circumferential = 8}}
material = {youngs_modulus = 1, poissons_ratio = 0, density = 1}
ground = {profile = [[-1, 0.25], [0, 0.25], [1, 0.25]], friction = 0.3}
analysis = {kind = "crush", depth = 0.125, increments = 4}
)";

TEST(ReadCase, TakesACrushWithoutMotionAndTime) {
  const Case c = read_text(crush);
  EXPECT_EQ(c.analysis.kind, AnalysisKind::crush);
  EXPECT_EQ(c.analysis.depth.at(0.0), 0.125);
  EXPECT_EQ(c.analysis.increments, 4);
  EXPECT_TRUE(c.warnings.empty());
  expect_round_trip(c);
}

TEST(ReadCase, TakesASlideAfterTheCrush) {
  const Case c = read_text(crush, {"analysis.slide=-0.25", "analysis.slide_increments=3"});
  EXPECT_EQ(c.analysis.slide.at(0.0), -0.25);
  EXPECT_EQ(c.analysis.slide_increments, 3);
  EXPECT_TRUE(c.warnings.empty());
  expect_round_trip(c);
  const Case none = read_text(crush, {"analysis.slide=0.0", "analysis.slide_increments=3"});
  EXPECT_EQ(none.analysis.slide_increments, 0);
  expect_round_trip(none);
}

/// One warning names what has no effect; the case as run has none of it, and so no warning.
TEST(ReadCase, ACrushLeavesOutWhatOnlyMotionHas) {
  const Case c =
      read_text(everything, {"analysis.kind=crush", "analysis.depth=0.02", "analysis.increments=40",
                             "ground.profile=flat", "output.checkpoint_interval=60.0"});
  ASSERT_EQ(c.warnings.size(), 1U);
  for (const char* name : {"[damping]", "motion.angular_velocity", "motion.gravity", "[initial]",
                           "[time]", "ground.restitution", "solver.operator",
                           "output.history_interval", "output.snapshots,", "output.snapshots_from"})
    EXPECT_NE((c.warnings[0] + ",").find(name), std::string::npos) << name;
  expect_round_trip(c);
  EXPECT_TRUE(read_text(write_case(c)).warnings.empty());
}

using Points = std::vector<std::array<double, 2>>;

TEST(WriteCase, RoundTripsAwkwardNumbers) {
  Case c = read_text(base);
  c.title = "tab\t, bell\x07, delete\x7f, \"\"\", '\\', return\r, é";
  c.motion.start_x = -0.0;
  c.motion.gravity = dynamics::Table(5e-324);
  c.material.youngs_modulus = 1.7976931348623157e308;
  c.damping.mass = 1e22;
  c.damping.stiffness = 0.1 + 0.2;
  c.motion.speed = dynamics::Table(Points{{-0.0, 1.0}});
  c.motion.height = dynamics::Table(Points{{2.0, 0.3}});
  expect_round_trip(c);
}

TEST(WriteCase, NumbersReadBackToTheBit) {
  std::mt19937_64 random(7);
  std::string text;
  std::vector<double> numbers;
  while (numbers.size() < 5000) {
    const auto x = std::bit_cast<double>(random());
    if (!std::isfinite(x)) continue;
    text += fmt::format("{}[{}, {}]", numbers.empty() ? "" : ",", numbers.size(), toml_number(x));
    numbers.push_back(x);
  }
  const Case c = read_text(with_line(20, "speed = [" + text + "]"));
  const auto& points = c.motion.speed.points();
  ASSERT_EQ(points.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(points[i][1]), std::bit_cast<std::uint64_t>(numbers[i]));
}

TEST(Settings, ReplaceAndAdd) {
  const Case c = read_text(
      treaded(), {"ground.friction=0.6", "disk.tread.depth = 0.015", "material.plane=stress",
                  "motion.angular_velocity=[[0,0],[0.01,30]]", "title=Plane stress, μ = \"0.6\"",
                  "output.stress=false", "initial.velocity=[1, 2]", "solver.operator='sparse'"});
  EXPECT_EQ(c.ground->friction.coefficient, 0.6);
  EXPECT_EQ(c.disk.tread->depth, 0.015);
  EXPECT_EQ(c.material.plane, fem::Plane::stress);
  EXPECT_EQ(c.motion.angular_velocity.at(0.005), 15.0);
  EXPECT_EQ(c.title, "Plane stress, μ = \"0.6\"");
  EXPECT_FALSE(c.output.stress);
  EXPECT_EQ(c.initial.velocity, (Vec2{1, 2}));
  EXPECT_EQ(c.solver_operator, "sparse");
}

TEST(Settings, MakeTables) {
  EXPECT_EQ(
      read_text(least, {"ground.profile=flat", "ground.friction=1"}).ground->friction.coefficient,
      1.0);
  const Case c = read_text(treaded(), {"disk.tread={pitches=7, depth=0.01, land_columns=1, "
                                       "groove_columns=1, layers=1}"});
  EXPECT_EQ(c.disk.tread->pitches, 7);
}

TEST(Settings, LastOneCounts) {
  EXPECT_EQ(read_text(base, {"time.end=1", "time.end=2"}).time.end, 2.0);
}

TEST(Settings, StepTakesThePlaceOfTheFilesSafety) {
  const Case c = read_text(base, {"time.step=1e-6"});
  EXPECT_EQ(c.time.step, 1e-6);
  EXPECT_FALSE(read_text(everything, {"time.safety=0.5"}).time.step);
  EXPECT_EQ(faults_of(base, {"time.step=1e-6", "time.safety=0.5"}).size(), 1U);
}

TEST(Settings, FaultsNameTheSetting) {
  const auto faults = faults_of(base, {"ground.frction=0.6", "disk.outer_radius=wide", "nonsense",
                                       "grond.friction=1", "disk=5", "mesh.file=a.msh", "a b=1"});
  ASSERT_EQ(faults.size(), 6U) << faults[0].text();
  EXPECT_EQ(faults[0].file, "--set ground.frction=0.6");
  EXPECT_EQ(faults[0].line, 0);
  EXPECT_EQ(faults[0].key, "ground.frction");
  EXPECT_EQ(faults[0].found, "0.6");
  EXPECT_NE(faults[0].message.find("did you mean ground.friction?"), std::string::npos);
  EXPECT_EQ(faults[1].key, "grond.friction");
  EXPECT_NE(faults[1].message.find("did you mean ground.friction?"), std::string::npos);
  EXPECT_EQ(faults[2].file, "--set disk=5");  // which took all of [disk] away
  EXPECT_NE(faults[2].message.find("must be a table"), std::string::npos);
  EXPECT_EQ(faults[3].key, "mesh");
  EXPECT_NE(faults[3].message.find("is given together with [disk]"), std::string::npos);
  EXPECT_EQ(faults[4].file, "--set nonsense");
  EXPECT_EQ(faults[5].file, "--set a b=1");
}

TEST(Settings, TextThatIsNotToml) {
  EXPECT_EQ(read_text(base, {"title="}).title, "");
  EXPECT_EQ(read_text(base, {"title=a\nb = 2"}).title, "a\nb = 2");
  EXPECT_EQ(read_text(base, {"title=1\nb = 2"}).title, "1\nb = 2");
  EXPECT_EQ(read_text(base, {"title=\xff\xfe."}).title, "??.");
  const auto faults = faults_of(base, {"time.end=0,2"});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].found, "0,2");
  EXPECT_EQ(faults[0].message, "must be a float, not a string; it has a decimal comma: write 0.2");
}

}  // namespace
}  // namespace rondo::study::case_test
