// SPDX-License-Identifier: BSD-3-Clause
/// Rubber in what a case is built into: what is told, refused and warned of.
#include "rondo/analysis/build/rubber.hpp"

#include <gtest/gtest.h>

#include "rondo/analysis/base/strain_watch.hpp"
#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/physical.hpp"
#include "rondo/model/steps/step_table.hpp"
#include "unit/analysis/mesh_fixture.hpp"

namespace rondo::study::rubber_build_test {
namespace {

using namespace test;

const std::string neo = "model = 'neo-hooke'\nshear_modulus = 1e6";
/// Layers 11 and 12 of the base, of rubber.
const std::vector<std::string> tread{
    "material.region=[{layers = [11, 12], model = 'mooney-rivlin', c10 = 4e5, c01 = 1e5, "
    "bulk_modulus = 1e8, viscosity = [[0.3, 1e-3], [0.2, 1e-5]]}]"};

Setup at_step(double step) {
  Setup s;
  s.model.dt = step;
  return s;
}

/// @return key and message; empty: nothing is refused
template <class Work>
std::string refusal(Work&& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.faults().front().key + ": " + error.what();
  }
  return {};
}

testing::AssertionResult has(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << part << "\" is not in \"" << text << "\"";
}

TEST(RubberLines, TellLawModuliAndBranches) {
  const Case c = read_text(rubber(neo, "bulk_modulus = 1e8"),
                           {"material.viscosity=[{relative_modulus = 0.3, time = 1e-3}]"});
  const std::vector<Told> lines = rubber_lines(c, 2e-5);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].first, "rubber");
  EXPECT_EQ(lines[0].second,
            "neo-hooke, shear modulus 1e+06 Pa, bulk modulus 1e+08 Pa (100 times), Poisson's ratio "
            "0.495017 at small strain");
  EXPECT_EQ(lines[1].first, "viscosity");
  EXPECT_EQ(lines[1].second, "0.3 of the shear modulus, relaxing in 0.001 s, 50 steps");
  EXPECT_EQ(rubber_lines(c, 0.0)[1].second, "0.3 of the shear modulus, relaxing in 0.001 s");
}

TEST(RubberLines, OfARegionHaveItsName) {
  const std::vector<Told> lines = rubber_lines(read_text(base, tread), 1e-6);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].first, "rubber of layers 11, 12");
  EXPECT_TRUE(has(lines[0].second, "mooney-rivlin, shear modulus 1e+06 Pa"));
  EXPECT_TRUE(has(lines[2].second, "1e-05 s, 10 steps"));
  EXPECT_TRUE(rubber_lines(read_text(base), 1e-6).empty());
}

/// Of [material] the table's key is named, of a region its list.
TEST(Branches, BelowTheStepAreRefusedAndNearItWarnedOf) {
  const Case c = read_text(rubber(neo, "bulk_modulus = 1e8"),
                           {"material.viscosity=[{relative_modulus = 0.3, time = 1e-5}]",
                            "material.region=[{layers = [1], shear_modulus = 2e6}]"});
  const auto refused = [](const Case& of, double step) {
    return refusal([&] {
      study::Setup s = at_step(step);
      check_branches(of, s);
    });
  };
  EXPECT_TRUE(has(refused(c, 1.001e-5), "material.viscosity[0].time: "));
  EXPECT_TRUE(has(refused(c, 1.001e-5), "the step passes over it"));
  EXPECT_EQ(refused(c, 1e-5), "");
  const auto warned = [&](double step) {
    study::Setup s = at_step(step);
    check_branches(c, s);
    return s.warnings;
  };
  ASSERT_EQ(warned(2.6e-6).size(), 1U);  // not once more for the region
  EXPECT_TRUE(has(warned(2.6e-6)[0], "3.85 of the step"));
  EXPECT_TRUE(warned(2.5e-6).empty());
  EXPECT_TRUE(has(refused(read_text(base, tread), 1.1e-5), "material.region[0].viscosity: "));
}

/// Of a free disk; a held one may have it.
TEST(RubberBuild, StiffnessDampingOfFreeBodiesIsRefused) {
  const std::string text = R"(schema = 1
disk = {outer_radius = 0.3, inner_radius = 0.1, rim = "free", mesh = {radial = 2, circumferential = 20}}
material = {model = "neo-hooke", shear_modulus = 1e6, bulk_modulus = 1e8, density = 1100}
initial = {position = [0, 1]}
damping = {stiffness = 1e-6}
time = {end = 1e-3}
)";
  const std::string told = refusal([&] { build(read_text(text), 1); });
  EXPECT_TRUE(has(told, "damping.stiffness: "));
  EXPECT_TRUE(has(told, ":5:"));
}

/// Quadrilaterals take the step of packs, triangles the general one.
TEST(RubberBuild, ModelsHaveTheirForces) {
  const std::string neo_square =
      "schema = 1\nmesh = {file = 'squares.msh', contact = 'skin', clamped = 'foot'}\n"
      "material = {model = 'neo-hooke', shear_modulus = 1e6, bulk_modulus = 1e8, density = 1000}\n"
      "motion = {angular_velocity = 0, speed = 0, height = 0}\ntime = {end = 1e-3}\n";
  const MeshCaseFile file(neo_square);
  const study::Setup packs = build(file.read(), 1);
  ASSERT_TRUE(packs.model.rubber);
  EXPECT_EQ(packs.model.rubber->cells.size(), packs.mesh.cells.size());
  EXPECT_TRUE(packs.model.internal_force);
  EXPECT_EQ(step_of(packs.model), dynamics::StepKind::sparse);
  std::ofstream(file.mesh()) << two_squares_of_triangles(0.1);
  const study::Setup general = build(file.read(), 1);
  EXPECT_FALSE(general.model.rubber);
  EXPECT_TRUE(general.model.internal_force);
  EXPECT_EQ(step_of(general.model), dynamics::StepKind::general);
}

/// Only the cells of rubber are in packs, and K beside them is that of the others alone.
TEST(RubberBuild, LinearNeighboursKeepTheirStiffness) {
  const study::Setup s =
      build(read_text(base, {"material.region=[{layers = [11, 12], model = 'neo-hooke', "
                             "shear_modulus = 1e6, bulk_modulus = 1e8}]"}),
            1);
  ASSERT_TRUE(s.model.rubber);
  EXPECT_EQ(s.model.rubber->cells.size(), 2U * 180U);
  EXPECT_EQ(s.model.stiffness_operator, dynamics::StiffnessOperator::sparse);
  const fem::BlockCsr& linear = s.model.rubber->linear;
  ASSERT_EQ(linear.n_rows(), s.model.n_nodes());
  std::size_t empty = 0;
  for (std::size_t k = 0; k < linear.n_rows(); ++k)
    empty += linear.row_start[k] == linear.row_start[k + 1] ? 1 : 0;
  EXPECT_EQ(empty, (1U + 2U) * 180U);  // held, and outside layer 10
  const study::Setup none = build(read_text(base), 1);
  EXPECT_FALSE(none.model.rubber);
  EXPECT_FALSE(none.model.internal_force);
}

/// μ (1 + Σ g) and κ, of all cells and of some.
TEST(RubberBuild, TheCriticalStepIsThatOfTheStiffnessAtOnce) {
  constexpr double mu = 1.5e6, kappa = 1e8;  // 1e6 of the law, .3 and .2 of it in branches
  const std::string young =
                        fmt::format("youngs_modulus = {:.17g}", 9 * kappa * mu / (3 * kappa + mu)),
                    ratio = fmt::format("poissons_ratio = {:.17g}",
                                        (3 * kappa - 2 * mu) / (2 * (3 * kappa + mu)));
  const auto step = [](const std::string& text, const std::vector<std::string>& settings) {
    return build(read_text(text, settings), 1).critical.step;
  };
  const std::vector<std::string> branches{
      "material.viscosity=[{relative_modulus = 0.3, time = 1e-2}, {relative_modulus = 0.2, time = "
      "0.1}]"};
  const std::string viscous = rubber(neo, "bulk_modulus = 1e8"),
                    linear = rubber(young, ratio + "\nintegration = 'b-bar'");
  const double expected = step(linear, {});
  EXPECT_NEAR(step(viscous, branches), expected, 1e-9 * expected);
  EXPECT_GT(step(viscous, {}), 1.001 * expected);  // κ is most of it
  const std::string law = ", " + young + ", " + ratio + ", integration = 'b-bar'}]";
  const std::string soft =
      ", model = 'neo-hooke', shear_modulus = 1e6, bulk_modulus = 1e8, viscosity = [[0.3, 1e-2], "
      "[0.2, 0.1]]}]";
  const double of_layers = step(base, {"material.region=[{layers = [11, 12]" + law});
  EXPECT_NEAR(step(base, {"material.region=[{layers = [11, 12]" + soft}), of_layers,
              1e-9 * of_layers);
}

/// A free body turns, and linear elements take that for strain where the others are rubber.
TEST(RubberBuild, LinearFreeBodiesBesideRubberAreRefused) {
  const MeshCaseFile file(
      "schema = 1\nmesh = {file = 'squares.msh', contact = 'skin'}\n"
      "material = {youngs_modulus = 1e6, poissons_ratio = 0.3, density = 1000}\n"
      "time = {end = 1e-3}\n");
  const std::string rubbery = "model = 'neo-hooke', shear_modulus = 1e6, bulk_modulus = 1e8}";
  const std::string one = "material.region=[{surface = 'left', " + rubbery + "]";
  const std::string told = refusal([&] { build(file.read({one}), 1); });
  EXPECT_TRUE(has(told, "material.model: "));
  EXPECT_TRUE(has(told, "has linear elements"));
  const std::string both =
      "material.region=[{surface = 'left', " + rubbery + ", {surface = 'right', " + rubbery + "]";
  EXPECT_EQ(refusal([&] { build(file.read({both}), 1); }), "");
}

/// One cell, stretched by half.
TEST(RubberBuild, LargeStrainsAreNoNews) {
  mesh::Mesh cell;
  cell.coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  cell.cells = {{0, 1, 2, 3}};
  const std::vector<Vec2> u{{0, 0}, {0.5, 0}, {0.5, 0}, {0, 0}};
  const auto warnings = [&](const fem::Material& material) {
    const std::vector<fem::Material> materials{material};
    StrainWatch watch(cell, materials);
    EXPECT_EQ(watch.look(u, {}, 0.0), "");
    RunReport report;
    Json json{{"warnings", Json::array()}};
    watch.summarise({}, json, report);
    EXPECT_NEAR(report.strain_max, 0.5, 1e-15);
    return report.warnings.size();
  };
  EXPECT_EQ(warnings(read_text(base).material), 1U);
  EXPECT_EQ(warnings(read_text(rubber(neo)).material), 0U);
}

/// Of a linear cell beside rubber that is strained more.
TEST(RubberBuild, LargeStrainsOfLinearNeighboursAreTold) {
  mesh::Mesh cells;
  cells.coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {2, 1}};
  cells.cells = {{0, 1, 2, 3}, {1, 4, 5, 2}};
  cells.region = {0, 1};
  cells.region_names = {"tread", "belt"};
  const std::vector<fem::Material> materials{read_text(rubber(neo)).material,
                                             read_text(base).material};
  const auto warnings = [&](double of_belt) {
    const double end = 0.5 + of_belt;
    StrainWatch watch(cells, materials);
    EXPECT_EQ(watch.look(std::vector<Vec2>{{}, {0.5, 0}, {0.5, 0}, {}, {end, 0}, {end, 0}}, {}, 2),
              "");
    RunReport report;
    Json json{{"warnings", Json::array()}};
    watch.summarise({}, json, report);
    EXPECT_NEAR(report.strain_max, 0.5, 1e-15);
    return report.warnings;
  };
  EXPECT_TRUE(warnings(0.09).empty());
  ASSERT_EQ(warnings(0.11).size(), 1U);
  EXPECT_TRUE(has(warnings(0.11)[0], "the largest strain of linear elements is 0.11 (cell 1 of"));
  EXPECT_TRUE(has(warnings(0.11)[0], "t = 2 s"));
}

/// 0.01 m of the wall of 0.15 m are shallow; 0.1 m are deep, and rubber may be so deep.
TEST(RubberBuild, DeepOnesAreNotWarnedOf) {
  const std::vector<std::string> deep{"motion.height=[[0, 0.31], [0.01, 0.2]]",
                                      "ground.profile=flat", "time.end=0.02",
                                      "motion.angular_velocity=200", "motion.speed=60"};
  const Case c = read_text(base, deep);
  study::Setup s = build(c, 1);
  const auto small_strain = [&] {
    return std::ranges::count_if(s.warnings, [](const std::string& text) {
      return text.find("law of the material is for small") != std::string::npos;
    });
  };
  EXPECT_EQ(small_strain(), 2);  // deflection and speed
  s.warnings.clear();
  s.materials[0].rubber.emplace();
  tell_physical_figures(c, s);
  EXPECT_EQ(small_strain(), 0);
  s.warnings.clear();
  s.materials.push_back(c.material);  // a linear part that is no slower
  s.materials.back().youngs_modulus *= 1.1;
  tell_physical_figures(c, s);
  EXPECT_EQ(small_strain(), 1);  // speed
}

}  // namespace
}  // namespace rondo::study::rubber_build_test
