// SPDX-License-Identifier: BSD-3-Clause
/// Figures of a physical kind: what is told, what is warned of, and that it is not too much.
#include <gtest/gtest.h>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/crush/crush_setup.hpp"
#include "rondo/analysis/build/physical.hpp"
#include "rondo/mesh/locate.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study::test::physical_test {
namespace {

const std::string wheel = R"(schema = 1
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = 3
circumferential = 40
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[motion]
angular_velocity = 33.333333
speed = 10.0
height = [[0, 0.3], [0.004, 0.29]]
[ground]
profile = "flat"
[time]
end = 0.02
)";

std::string figure(const Setup& s, const std::string& name) {
  for (const auto& [what, value] : s.figures)
    if (what == name) return value;
  return {};
}

/// All warnings, empty where there is none.
std::string warning(const std::vector<std::string>& settings) {
  std::string all;
  for (const std::string& text : build(read_text(wheel, settings), 1).warnings) all += text + '\n';
  return all;
}

testing::AssertionResult has(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << part << "\" is not in \"" << text << "\"";
}

TEST(Physical, FiguresOfAWheel) {
  const study::Setup s = build(read_text(wheel), 1);
  EXPECT_TRUE(s.warnings.empty()) << s.warnings[0];
  EXPECT_TRUE(has(figure(s, "deflection"), "0.01 m, 6.67 % of the 0.15 m"));
  EXPECT_TRUE(has(figure(s, "contact pressure"), "1.5e+06 Pa, 0.073 of E"));
  EXPECT_TRUE(has(figure(s, "stiffness"), "as rubber"));
  EXPECT_TRUE(has(figure(s, "slip ratio"), "-1e-08"));
  EXPECT_TRUE(has(figure(s, "speed"), "10 m/s, 0.12 of the shear wave"));
}

TEST(Physical, OfALedgeTheNearestGroundCounts) {
  const std::string ledge = "ground.profile=[[-10, -0.1], [0, -0.1], [0, 0], [10, 0]]";
  EXPECT_TRUE(has(figure(build(read_text(wheel, {ledge, "motion.start_x=-0.1"}), 1), "deflection"),
                  "0.01 m"));
  EXPECT_TRUE(has(figure(build(read_text(wheel, {"motion.height=0.4"}), 1), "deflection"),
                  "none: 0.1 m above"));
}

TEST(Physical, WarnsByThem) {
  EXPECT_TRUE(has(warning({"motion.height=[[0, 0.3], [0.004, 0.2]]"}), "66.7 % of the 0.15 m"));
  EXPECT_TRUE(has(warning({"motion.speed=36"}), "slip ratio is -0.722"));
  EXPECT_TRUE(has(warning({"motion.speed=60", "motion.angular_velocity=200"}), "shear waves"));
  EXPECT_TRUE(has(warning({"material.youngs_modulus=20", "motion.angular_velocity=0.001",
                           "motion.speed=0.0003"}),
                  "softer than gels"));
  EXPECT_TRUE(has(warning({"material.density=1.1"}), "lighter than foams"));
  EXPECT_TRUE(has(warning({"material.density=1.1e6"}), "heavier than any metal"));
  EXPECT_TRUE(has(warning({"disk.outer_radius=300", "disk.inner_radius=150", "motion.height=300",
                           "motion.angular_velocity=0.0333333333"}),
                  "600 m long"));
}

/// A locked wheel, and one that spins in place, are meant so.
TEST(Physical, NotOfWhatIsMeant) {
  EXPECT_EQ(warning({"motion.speed=0"}), "");
  EXPECT_EQ(warning({"motion.angular_velocity=0"}), "");
  EXPECT_EQ(warning({"motion.height=0.4", "motion.angular_velocity=[[0, 33.3], [1, 33.3]]"}), "");
}

/// A core of steel under rubber: what touches is the rubber, whatever [material] says.
TEST(Physical, OfTwoMaterials) {
  const Case c = read_text(wheel);
  study::Setup s = build(c, 1);
  fem::Material rubber = s.materials[0], steel = rubber;
  steel.youngs_modulus = 2.1e11;
  steel.density = 7850.0;
  s.mesh.region_names = {"core", "rubber"};
  for (const mesh::Cell& cell : s.mesh.cells)
    s.mesh.region.push_back(norm(mesh::middle_of(s.mesh.coordinates, cell)) > 0.2 ? 1 : 0);
  const auto told = [&](const fem::Material& core, const fem::Material& tread) {
    s.materials = {core, tread};
    s.figures.clear();
    tell_physical_figures(c, s);
  };
  told(steel, rubber);
  EXPECT_TRUE(has(figure(s, "contact pressure"), "1.5e+06 Pa, 0.073 of E"));
  EXPECT_EQ(figure(s, "stiffness"), "E = 2e+07 Pa, as rubber; to E = 2.1e+11 Pa, as metals");
  told(rubber, steel);
  EXPECT_TRUE(has(figure(s, "contact pressure"), "1.5e+10 Pa, 0.073 of E"));
}

/// They are told with what is refused, which they may be the cause of.
TEST(Physical, UnitsBesideARefusal) {
  const auto refusal = [](const std::vector<std::string>& settings) -> std::string {
    const Case c = read_text(wheel, settings);
    SharedBody shared;
    std::string alone, all;
    for (SharedBody* kept : {static_cast<SharedBody*>(nullptr), &shared}) try {
        static_cast<void>(build(c, 1, kept));
      } catch (const InputError& error) {
        (kept ? all : alone) = error.what();
      }
    EXPECT_EQ(alone, all);
    return alone;
  };
  const std::string told = refusal({"time.step=1", "material.density=1.1e6"});
  EXPECT_TRUE(has(told, "above the critical step"));
  EXPECT_TRUE(has(told, "this may be the cause: a material with"));
  EXPECT_TRUE(has(refusal({"motion.start_x=1e300", "material.density=1.1e6"}), "heavier than any"));
  EXPECT_FALSE(has(refusal({"time.step=1"}), "cause"));
}

TEST(Physical, OfACrush) {
  const Case c = read_text(wheel, {"analysis={kind = 'crush', depth = 0.1, increments = 4}"});
  CrushSetup s = build_crush(c);
  tell_physical_figures(c, s);
  ASSERT_EQ(s.warnings.size(), 1U);
  EXPECT_TRUE(has(s.warnings[0], "66.7 %"));
}

}  // namespace
}  // namespace rondo::study::test::physical_test
