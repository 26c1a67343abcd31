// SPDX-License-Identifier: BSD-3-Clause
/// From a case with a mesh from a file to a setup.
#include <gtest/gtest.h>

#include <numeric>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/crush/crush_setup.hpp"
#include "rondo/analysis/build/overlap.hpp"
#include "unit/analysis/mesh_fixture.hpp"

namespace rondo::study::mesh_build_test {
namespace {

using namespace test;

std::vector<Fault> faults_of_build(const MeshCaseFile& file,
                                   const std::vector<std::string>& settings) {
  try {
    build(file.read(settings), 1);
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(BuildMesh, FreeBodiesAndTheirMaterials) {
  const MeshCaseFile file(squares);
  const auto s = build(file.read({"material.region=[{surface = 'right', density = 3000}]"}), 1);
  ASSERT_EQ(s.model.free_bodies.size(), 2U);
  EXPECT_NEAR(s.model.free_bodies[0].mass, 1000.0, 1e-10);
  EXPECT_NEAR(s.model.free_bodies[1].mass, 3000.0, 1e-10);
  EXPECT_NEAR(norm(s.model.free_bodies[1].center - Vec2{1.6, 0.5}), 0.0, 1e-14);
  EXPECT_EQ(s.model.free.size(), 18U);
  EXPECT_NEAR(sum(s.model.mass), 4000.0, 1e-10);
  EXPECT_FALSE(s.model.contact);
  EXPECT_FALSE(s.model.surfaces);
  EXPECT_EQ(s.model.stiffness_operator, dynamics::StiffnessOperator::sparse);
  EXPECT_TRUE(s.warnings.empty());
}

TEST(BuildMesh, ContactsAndPressuresGoIntoTheModel) {
  const MeshCaseFile file(squares);
  const auto s = build(file.read({"ground={profile = [[-9, -1], [9, -1]], friction = 0.25}",
                                  "contact={between = 'all', friction = 0.5, restitution = 0.1}",
                                  "load.pressure=[{curve = 'top', value = [[0, 0], [1, 7]]}]",
                                  "solver={contact_iterations = 3, dump_contacts = 2}"}),
                       1);
  ASSERT_TRUE(s.model.contact);
  EXPECT_EQ(s.model.contact->law.friction.constant(), 0.25);
  EXPECT_EQ(s.model.contact->nodes, s.mesh.boundary);
  ASSERT_TRUE(s.model.surfaces);
  EXPECT_TRUE(s.model.surfaces->self);
  EXPECT_EQ(s.model.surfaces->law.friction.constant(), 0.5);
  EXPECT_EQ(s.model.surfaces->nodes, s.mesh.boundary);
  EXPECT_EQ(s.model.surfaces->edges.size(), 16U);
  ASSERT_EQ(s.model.pressures.size(), 1U);
  EXPECT_EQ(s.model.pressures[0].edges.size(), 4U);
  EXPECT_EQ(s.model.pressures[0].pressure.at(0.5), 3.5);
  EXPECT_EQ(s.model.coupled.most_iterations, 3);
  EXPECT_EQ(s.model.coupled.dump_above, 2);
  EXPECT_FALSE(build(file.read({"contact.between=bodies"}), 1).model.surfaces->self);
}

/// Turned about the origin of the file, then moved; each turns about its own center of mass.
TEST(BuildMesh, FreeBodiesArePlacedAndMove) {
  const MeshCaseFile file(squares);
  const auto s = build(
      file.read({"initial={position = [10.0, 20.0], angle = 1.5707963267948966, velocity = [1.0, "
                 "2.0], angular_velocity = 3.0}",
                 "initial.region=[{surface = 'right', velocity = [-4.0, 0.0]}]"}),
      1);
  const auto& right = s.model.free_bodies[1];
  EXPECT_NEAR(norm(s.model.free_bodies[0].center - Vec2{9.5, 20.5}), 0.0, 1e-14);
  EXPECT_NEAR(norm(right.center - Vec2{9.5, 21.6}), 0.0, 1e-14);
  EXPECT_EQ(s.mesh.coordinates, s.model.reference);
  Vec2 momentum;
  double spin = 0.0;
  for (const int node : right.nodes) {
    const auto k = static_cast<std::size_t>(node);
    const Vec2 arm = s.model.reference[k] - right.center;
    momentum += s.model.mass[k] * s.velocity.plane()[k];
    EXPECT_NEAR(norm(s.velocity.plane()[k] - Vec2{-4.0, 0.0} + 3.0 * turn90(arm)), 0.0, 1e-13);
    spin += s.model.mass[k] * cross(arm, s.velocity.plane()[k]);
  }
  EXPECT_NEAR(norm(momentum / right.mass - Vec2{-4.0, 0.0}), 0.0, 1e-13);
  EXPECT_LT(spin, 0.0);  // clockwise, as of the rim
  EXPECT_NEAR(
      norm(s.velocity.plane()[0] -
           (Vec2{1.0, 2.0} - 3.0 * turn90(s.model.reference[0] - s.model.free_bodies[0].center))),
      0.0, 1e-13);
}

/// Only "left" has a node on the line that is held: it turns with the rim, "right" is free.
TEST(BuildMesh, HeldAndFreeTogether) {
  std::string text = two_squares(0.1);
  text.replace(text.find("\n1 1 2 1 1 1 2\n"), 15, "\n1 1 2 6 6 1 2\n");
  text.replace(text.find("$PhysicalNames\n5\n"), 17, "$PhysicalNames\n6\n1 6 \"rim\"\n");
  const MeshCaseFile file(squares);
  std::ofstream(file.mesh()) << text;
  const auto s =
      build(file.read({"mesh.clamped=rim", "initial.state=stationary",
                       "motion={angular_velocity = 5, speed = 0, height = 0}",
                       "initial.position=[0.0, 0.5]", "material.stress_stiffening=centrifugal"}),
            1);
  ASSERT_EQ(s.model.free_bodies.size(), 1U);
  EXPECT_EQ(s.model.free_body[0], -1);
  EXPECT_EQ(s.model.free_body[9], 0);
  EXPECT_EQ(held_nodes(s.model).size(), 7U);  // two of nine are held
  EXPECT_EQ(s.model.reference[9], (Vec2{1.1, 0.5}));
  EXPECT_GT(norm(s.displacement.plane()[8]), 1e-6);  // the spin stretches what is held...
  EXPECT_GT(norm(s.prestress[8]), 1e-6);
  EXPECT_EQ(s.displacement.plane()[17], Vec2{});  // ... and nothing else
  EXPECT_EQ(s.prestress[17], Vec2{});
  const auto faults = faults_of_build(
      file, {"mesh.clamped=rim", "motion={angular_velocity = 5, speed = 0, height = 0}",
             "time.scheme=as-printed"});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].key, "time.scheme");
}

TEST(BuildMesh, AFreeDiskTurnsAsAWhole) {
  const auto s = build(read_text("schema = 1\n"
                                 "disk = {outer_radius = 0.3, inner_radius = 0.1, rim = 'free', "
                                 "mesh = {radial = 3, circumferential = 20}}\n"
                                 "material = {youngs_modulus = 1e6, poissons_ratio = 0.3, "
                                 "density = 1000}\ninitial.angular_velocity = 2\n"
                                 "load.pressure = [{curve = 'rim', value = 1}]\ntime.end = 0.01\n"),
                       1);
  EXPECT_EQ(s.model.free_bodies.size(), 1U);
  EXPECT_EQ(s.model.free.size(), s.model.n_nodes());
  EXPECT_EQ(s.mesh.n_sectors, 0);
  EXPECT_FALSE(s.model.sector);
  EXPECT_NEAR(s.velocity.plane()[0].x, -0.2, 1e-15);  // node 0 is at (0, -0.1): clockwise
  // Clockwise, so that the outward normal, on the right, points to the center.
  ASSERT_EQ(s.model.pressures[0].edges.size(), 20U);
  const auto& edge = s.model.pressures[0].edges[0];
  const Vec2 a = s.model.reference[static_cast<std::size_t>(edge[0])],
             b = s.model.reference[static_cast<std::size_t>(edge[1])];
  EXPECT_GT(dot(-turn90(b - a), -0.5 * (a + b)), 0.0);
}

/// As the case's rules do above 0.49 whatever the cells are.
TEST(BuildMesh, TrianglesThatLockAreWarnedOf) {
  const MeshCaseFile file(squares);
  std::ofstream(file.mesh()) << two_squares_of_triangles(0.1);
  const auto warnings = [&](const std::vector<std::string>& settings) {
    return build(file.read(settings), 1).warnings;
  };
  const auto told = warnings({"material.poissons_ratio=0.47"});
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("16 of 16 cells are triangles"), std::string::npos);
  EXPECT_NE(told[0].find("material.integration = \"b-bar\""), std::string::npos);
  const auto region = warnings({"material.region=[{surface = 'right', poissons_ratio = 0.48}]"});
  ASSERT_EQ(region.size(), 1U);
  EXPECT_NE(region[0].find("8 of 16 cells"), std::string::npos);
  EXPECT_TRUE(warnings({"material.poissons_ratio=0.45"}).empty());
  EXPECT_TRUE(warnings({"material.poissons_ratio=0.47", "material.integration=b-bar"}).empty());
  EXPECT_TRUE(warnings({"material.poissons_ratio=0.47", "material.plane=stress"}).empty());
}

TEST(WrongMeshes, NamesAreToldAtTheirKeys) {
  const MeshCaseFile file(squares);
  const auto told = [&](const std::vector<std::string>& settings) {
    const auto faults = faults_of_build(file, settings);
    EXPECT_EQ(faults.size(), 1U) << settings[0];
    return faults.empty() ? Fault{} : faults[0];
  };
  const Fault contact = told({"mesh.contact=skn"});
  EXPECT_EQ(contact.key, "mesh.contact");
  EXPECT_EQ(contact.file, "--set mesh.contact=skn");
  EXPECT_NE(contact.message.find("squares.msh"), std::string::npos);
  EXPECT_NE(contact.allowed.find("did you mean \"skin\"?"), std::string::npos);
  EXPECT_EQ(told({"mesh.clamped=rim", "motion={angular_velocity = 5, speed = 0, height = 0}"}).key,
            "mesh.clamped");
  EXPECT_EQ(told({"load.pressure=[{curve = 'top', value = 1}, {curve = 'x', value = 1}]"}).key,
            "load.pressure[1].curve");
  EXPECT_EQ(told({"material.region=[{surface = 'x'}]"}).key, "material.region[0].surface");
  EXPECT_EQ(told({"initial.region=[{surface = 'skin'}]"}).key, "initial.region[0].surface");
  EXPECT_EQ(told({"mesh.file=other.msh"}).key, "mesh.file");
}

/// It would do nothing, without a word.
TEST(WrongMeshes, PressureOnWhatIsHeldIsRefused) {
  const MeshCaseFile file(squares);
  const std::vector<std::string> held{"mesh.clamped=top",
                                      "motion={angular_velocity = 5, speed = 0, height = 0}",
                                      "load.pressure=[{curve = 'skin', value = 1}]"};
  EXPECT_EQ(build(file.read(held), 1).model.pressures.size(), 1U);  // some of it is held
  std::vector<std::string> nothing = held;
  nothing.back() = "load.pressure=[{curve = 'skin', value = 1}, {curve = 'top', value = 1}]";
  const auto faults = faults_of_build(file, nothing);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].key, "load.pressure[1].curve");
  EXPECT_NE(faults[0].message.find("every node of the curve \"top\" is held"), std::string::npos);
  EXPECT_NE(faults[0].allowed.find("mesh.clamped"), std::string::npos);
  try {
    static_cast<void>(
        build(read_text("schema = 1\ndisk = {outer_radius = 0.3, inner_radius = 0.1, "
                        "mesh = {radial = 3, circumferential = 20}}\n"
                        "material = {youngs_modulus = 1e6, poissons_ratio = 0.3, density = 1000}\n"
                        "motion = {angular_velocity = 0, speed = 0, height = 0.4}\n"
                        "load.pressure = [{curve = 'rim', value = 1}]\ntime.end = 0.01\n"),
              1));
    FAIL();
  } catch (const InputError& wrong) {
    ASSERT_EQ(wrong.faults().size(), 1U);
    EXPECT_EQ(wrong.faults()[0].key, "load.pressure[0].curve");
    EXPECT_NE(wrong.faults()[0].allowed.find("\"tread\""), std::string::npos);
    EXPECT_NE(wrong.faults()[0].allowed.find("cavity"), std::string::npos);
  }
}

TEST(WrongMeshes, TheFileItselfIsNamed) {
  const MeshCaseFile file(squares);
  std::ofstream(file.mesh()) << "no mesh";
  const auto faults = faults_of_build(file, {});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].file, file.mesh().string());
}

TEST(WrongMeshes, WhatIsOfFreeBodiesAlone) {
  const MeshCaseFile file(squares);
  const std::vector<std::string> held{"mesh.clamped=foot", "mesh.contact=top",
                                      "motion={angular_velocity = 5, speed = 0, height = 0}"};
  EXPECT_TRUE(faults_of_build(file, held).empty());
  for (const char* setting :
       {"initial.position=[0, 1]", "initial.angle=1", "initial.angular_velocity=1",
        "initial.region=[{surface = 'left'}]"}) {
    auto settings = held;
    settings.emplace_back(setting);
    const auto faults = faults_of_build(file, settings);
    ASSERT_EQ(faults.size(), 1U) << setting;
    EXPECT_NE(faults[0].message.find("the mesh has none"), std::string::npos);
  }
}

TEST(WrongMeshes, BodiesInTheGround) {
  const MeshCaseFile file(squares);
  const auto faults = faults_of_build(file, {"ground={profile = [[-9, 0.3], [9, 0.3]]}"});
  ASSERT_EQ(faults.size(), 1U);  // cells are 0.5 m
  EXPECT_EQ(faults[0].key, "initial.position");
  EXPECT_NE(faults[0].message.find("0.3 m deep"), std::string::npos) << faults[0].text();
  EXPECT_EQ(build(file.read({"ground={profile = [[-9, 0.2], [9, 0.2]]}"}), 1).warnings.size(), 1U);
}

/// Found by fuzzing: the nodes of a cell were all at one place.
TEST(WrongMeshes, BodiesTooFarAwayForTheNumbers) {
  const MeshCaseFile file(squares);
  const auto faults = faults_of_build(file, {"initial.position=[1e-9, 1e300]"});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].key, "initial.position");
  EXPECT_NE(faults[0].message.find("do not resolve"), std::string::npos) << faults[0].text();
}

TEST(WrongMeshes, BodiesInEachOther) {
  const MeshCaseFile deep(squares, -0.3), shallow(squares, -0.2), touching(squares, 0.0);
  const auto faults = faults_of_build(deep, {"contact.between=bodies"});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].key, "contact.between");
  EXPECT_NE(faults[0].message.find("0.3 m inside each other"), std::string::npos);
  const auto untold = faults_of_build(deep, {});  // nor without contact
  ASSERT_EQ(untold.size(), 1U);
  EXPECT_EQ(untold[0].key, "mesh.file");
  for (const char* part :
       {"overlap, 0.3 m deep", "body 1 (\"left\") and body 2 (\"right\")", "0.5)"})
    EXPECT_NE(untold[0].message.find(part), std::string::npos) << untold[0].message;
  EXPECT_NE(untold[0].allowed.find("BooleanFragments"), std::string::npos);
  EXPECT_EQ(build(shallow.read({"contact.between=bodies"}), 1).warnings.size(), 1U);
  for (const auto& warning : build(touching.read({"contact.between=bodies"}), 1).warnings)
    EXPECT_EQ(warning.find("inside"), std::string::npos) << warning;
}

/// Sides that coincide, with the same nodes and with others, and a corner that touches a side.
TEST(WrongMeshes, SidesOfTwoBodiesThatNothingJoins) {
  const MeshCaseFile touching(squares, 0.0);
  for (const auto& settings :
       {std::vector<std::string>{}, {"contact.between=bodies", "mesh.contact=foot"}}) {
    const auto faults = faults_of_build(touching, settings);
    ASSERT_EQ(faults.size(), 1U);
    for (const char* part : {"sides of two bodies coincide", "\"left\"", "\"right\"", "(1, 0.25)"})
      EXPECT_NE(faults[0].message.find(part), std::string::npos) << faults[0].message;
    EXPECT_NE(faults[0].allowed.find("BooleanFragments"), std::string::npos);
  }
  EXPECT_TRUE(faults_of_build(touching, {"contact.between=bodies"}).empty());
}

/// A crush refuses contact.between, which is therefore no advice to it.
TEST(WrongMeshes, SidesThatCoincideInACrush) {
  const MeshCaseFile touching(squares, 0.0), apart(squares, 0.1);
  for (const AnalysisKind kind : {AnalysisKind::dynamic, AnalysisKind::crush}) {
    Case c = touching.read({});
    c.analysis.kind = kind;
    const auto s = build(apart.read({}), 1);
    std::vector<Vec2> x = s.mesh.coordinates;
    for (Vec2& place : x)
      if (place.x > 1.05) place.x -= 0.1;
    std::vector<std::string> warnings;
    try {
      refuse_overlaps(c, {s.mesh, x}, warnings);
      ADD_FAILURE();
    } catch (const InputError& error) {
      const std::string& advice = error.faults().at(0).allowed;
      EXPECT_NE(advice.find("BooleanFragments"), std::string::npos);
      EXPECT_EQ(advice.find("contact.between") == std::string::npos, kind == AnalysisKind::crush);
    }
  }
}

/// Bars that cross: no node of one is in the other. And a body twice at one place.
TEST(WrongMeshes, OverlapsWithoutANodeInside) {
  const std::string head =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"skin\"\n2 2 \"one\"\n"
      "2 3 \"two\"\n$EndPhysicalNames\n$Nodes\n8\n";
  const std::string cells =
      "$EndNodes\n$Elements\n4\n1 1 2 1 1 1 2\n2 1 2 1 1 5 6\n3 3 2 2 2 1 2 3 4\n"
      "4 3 2 3 3 5 6 7 8\n$EndElements\n";
  const std::string flat = "1 -2 -0.5 0\n2 2 -0.5 0\n3 2 0.5 0\n4 -2 0.5 0\n";
  const std::string tall = "5 -0.5 -3 0\n6 0.7 -3 0\n7 0.7 3 0\n8 -0.5 3 0\n";
  const std::string again = "5 -2 -0.5 0\n6 2 -0.5 0\n7 2 0.5 0\n8 -2 0.5 0\n";
  const std::string beside = "5 -2 0.6 0\n6 2 0.6 0\n7 2 1.6 0\n8 -2 1.6 0\n";
  const MeshCaseFile file(squares);
  const auto faults_with = [&](const std::string& second) {
    std::ofstream(file.mesh()) << head + flat + second + cells;
    return faults_of_build(file, {});
  };
  for (const std::string& second : {tall, again}) {
    const auto faults = faults_with(second);
    ASSERT_EQ(faults.size(), 1U) << second;
    for (const char* part : {"bodies overlap", "\"one\"", "\"two\""})
      EXPECT_NE(faults[0].message.find(part), std::string::npos) << faults[0].message;
  }
  EXPECT_TRUE(faults_with(beside).empty());
}

TEST(WrongMeshes, OneBodyWithTwoMotions) {
  std::string text = two_squares(0.1);
  const auto at = text.rfind(" 3 2 4 4 ");  // the last cell of the left square goes to "right"
  text.replace(at, 9, " 3 2 5 5 ");
  const MeshCaseFile file(squares);
  std::ofstream(file.mesh()) << text;
  const std::string regions =
      "initial.region=[{{surface = 'left', velocity = [1, 0]}}, {{surface "
      "= 'right', velocity = [{}, 0]}}]";
  EXPECT_TRUE(faults_of_build(file, {fmt::format(fmt::runtime(regions), 1)}).empty());
  const auto faults = faults_of_build(file, {fmt::format(fmt::runtime(regions), 2)});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].key, "initial.region[1].surface");
  EXPECT_NE(faults[0].message.find("\"left\", which has a different motion"), std::string::npos);
}

TEST(WrongMeshes, ACrushNeedsEveryBodyHeld) {
  const MeshCaseFile file(squares);
  const std::vector<std::string> crush{"analysis={kind = 'crush', depth = 0.01, increments = 2}",
                                       "ground.profile=flat", "mesh.clamped=top",
                                       "mesh.contact=foot"};
  const auto setup = build_crush(file.read(crush));
  EXPECT_EQ(setup.model.nodes.size(), 6U);
  EXPECT_EQ(setup.within_reach, 6U);
  auto free = crush;
  free[2] = "mesh.clamped=rim";
  std::string text = two_squares(0.1);
  text.replace(text.find("\n1 1 2 1 1 1 2\n"), 15, "\n1 1 2 6 6 1 2\n");
  text.replace(text.find("$PhysicalNames\n5\n"), 17, "$PhysicalNames\n6\n1 6 \"rim\"\n");
  std::ofstream(file.mesh()) << text;
  EXPECT_THROW(build_crush(file.read(free)), InputError);
}

}  // namespace
}  // namespace rondo::study::mesh_build_test
