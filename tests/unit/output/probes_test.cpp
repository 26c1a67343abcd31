// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/probes.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "rondo/analysis/build/build.hpp"
#include "unit/analysis/mesh_fixture.hpp"

namespace rondo::study::probes_test {
namespace {

using namespace test;

TEST(Probes, OutsideIsRefusedWithTheDistance) {
  const MeshCaseFile file(squares, 0.5);
  try {
    build(file.read({"output.probe=[{name = 'a', position = [0.5, 0.5]}, {name = 'b', position = "
                     "[1.2, 0.5]}]"}),
          1);
    FAIL() << "a probe between the bodies";
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 1U);
    EXPECT_EQ(error.faults()[0].key, "output.probe[1].position");
    EXPECT_NE(error.faults()[0].message.find("0.2 m away"), std::string::npos);
  }
}

/// A probe stays with its body, which is turned by a quarter and moved.
TEST(Probes, AreInTheMeshBeforeBodiesArePlaced) {
  const MeshCaseFile file(squares);
  const auto s =
      build(file.read({"output.probe[0].name=p", "output.probe[0].position=[0.2, 0.9]",
                       "initial.turn=-1.5707963267948966", "initial.position=[3.0, 0.0]"}),
            1);
  ASSERT_EQ(s.probes.size(), 1U);
  Vec2 x;
  for (std::size_t a = 0; a < 4; ++a)
    x += s.probes[0].weight[a] *
         s.model.reference[static_cast<std::size_t>(s.mesh.cells[s.probes[0].cell][a])];
  EXPECT_NEAR(norm(x - Vec2{3.0 - 0.9, 0.2}), 0.0, 1e-14);  // round-off of 3 m
}

/// Linear displacement and velocity: exact everywhere, stress too.
TEST(Probes, OfAHeldBodyAreInTheTurningFrame) {
  const MeshCaseFile file(squares);
  const auto s = build(file.read({"output.probe[0].name=p", "output.probe[0].position=[0.2, 0.9]",
                                  "mesh.clamped=foot", "mesh.contact=top",
                                  "motion={angular_velocity = 5, speed = 0, height = 0}"}),
                       1);
  dynamics::State state(s.model);
  for (std::size_t k = 0; k < s.model.n_nodes(); ++k) {
    state.u.plane()[k] = {1e-3 * s.model.reference[k].x, 0.0};
    state.v.plane()[k] = {0.0, s.model.reference[k].y};
  }
  std::vector<double> row;
  append_probes({s.mesh, s.materials, s.model, s.dilatation}, s.probes, state, row);
  const fem::Hooke d = fem::hooke(s.materials[0]);
  const std::vector<double> expected{
      2e-4, 0.0, 0.0, 0.9, 1e-3 * d.d11, 1e-3 * d.d12, 1e-3 * d.zz * (d.d11 + d.d12), 0.0};
  ASSERT_EQ(row.size(), expected.size());
  for (std::size_t i = 0; i < row.size(); ++i)
    EXPECT_NEAR(row[i], expected[i], 1e-14 * std::max(1.0, d.d11 * 1e-3)) << i;
}

/// A stretched body, turned by a quarter: its stress has turned with it.
TEST(Probes, OfAFreeBodyAreInTheFixedFrame) {
  const MeshCaseFile file(squares);
  const auto s =
      build(file.read({"output.probe[0].name=p", "output.probe[0].position=[0.5, 0.5]"}), 1);
  dynamics::State state(s.model);
  const Vec2 center = s.model.free_bodies[0].center, moved{7.0, 8.0};
  state.poses[0] = {moved, {0.0, 1.0}, 0.0};
  for (const int node : s.model.free_bodies[0].nodes) {
    const auto k = static_cast<std::size_t>(node);
    const Vec2 arm = s.model.reference[k] - center;
    state.u.plane()[k] = moved + turn90(Vec2{1.001 * arm.x, arm.y}) - s.model.reference[k];
  }
  std::vector<double> row;
  append_probes({s.mesh, s.materials, s.model, s.dilatation}, s.probes, state, row);
  const fem::Hooke d = fem::hooke(s.materials[0]);
  ASSERT_EQ(row.size(), 8U);
  EXPECT_NEAR(row[0], 6.5, 1e-14);
  EXPECT_NEAR(row[1], 7.5, 1e-14);
  const double bound = 1e-9 * d.d11;  // round-off of places of 8 m in strains of 1e-3
  EXPECT_NEAR(row[4], 1e-3 * d.d12, bound);
  EXPECT_NEAR(row[5], 1e-3 * d.d11, bound);
  EXPECT_NEAR(row[7], 0.0, bound);
}

/// Cauchy stress of a block of rubber stretched by half, along its own axis; likewise turned.
TEST(Probes, OfFreeRubberHaveCauchyStress) {
  const MeshCaseFile file(
      "schema = 1\nmesh = {file = 'squares.msh', contact = 'skin'}\n"
      "material = {model = 'neo-hooke', shear_modulus = 1e6, bulk_modulus = 1e8, density = 1000}\n"
      "time = {end = 1e-3}\noutput = {probe = [{name = 'p', position = [0.2, 0.9]}]}\n");
  const auto s = build(file.read(), 1);
  dynamics::State state(s.model);
  const Vec2 center = s.model.free_bodies[0].center, moved{7.0, 8.0};
  state.poses[0] = {moved, {0.0, 1.0}, 0.0};
  for (const int node : s.model.free_bodies[0].nodes) {
    const auto k = static_cast<std::size_t>(node);
    const Vec2 arm = s.model.reference[k] - center;
    state.u.plane()[k] = moved + turn90(Vec2{1.5 * arm.x, arm.y / 1.5}) - s.model.reference[k];
  }
  std::vector<double> row;
  append_probes({s.mesh, s.materials, s.model, s.dilatation}, s.probes, state, row);
  const double xx = 2.25, yy = 1.0 / 2.25, mean = (xx + yy + 1.0) / 3.0;  // of B, J = 1
  EXPECT_NEAR(row[4], 1e6 * (yy - mean), 1e-3);
  EXPECT_NEAR(row[5], 1e6 * (xx - mean), 1e-3);
  EXPECT_NEAR(row[6], 1e6 * (1.0 - mean), 1e-3);
  EXPECT_NEAR(row[7], 0.0, 1e-3);
}

TEST(Probes, ColumnsAreNamed) {
  const std::vector<ColumnLabel> columns = probe_columns({{"a-1", {}}});
  EXPECT_EQ(names_of(columns),
            (std::vector<std::string>{"a-1_ux", "a-1_uy", "a-1_vx", "a-1_vy", "a-1_sxx", "a-1_syy",
                                      "a-1_szz", "a-1_sxy"}));
  std::vector<std::string> units;
  for (const ColumnLabel& column : columns) units.push_back(column.unit);
  EXPECT_EQ(units, (std::vector<std::string>{"m", "m", "m/s", "m/s", "Pa", "Pa", "Pa", "Pa"}));
}

/// Of triangles by B-bar the mean dilatations at the corners: exact for a linear displacement.
TEST(Probes, OfTrianglesHaveTheMeanDilatation) {
  const MeshCaseFile file(squares);
  std::ofstream(file.mesh()) << two_squares_of_triangles(0.1);
  const auto s = build(file.read({"output.probe[0].name=p", "output.probe[0].position=[0.2, 0.4]",
                                  "mesh.clamped=foot", "mesh.contact=top",
                                  "material.poissons_ratio=0.499", "material.integration=b-bar",
                                  "motion={angular_velocity = 5, speed = 0, height = 0}"}),
                       1);
  ASSERT_FALSE(s.dilatation.empty());
  dynamics::State state(s.model);
  std::vector<double> row;
  const auto sxx_and_szz = [&](auto&& displacement) {
    for (std::size_t k = 0; k < s.model.n_nodes(); ++k)
      state.u.plane()[k] = displacement(s.model.reference[k]);
    row.clear();
    append_probes({s.mesh, s.materials, s.model, s.dilatation}, s.probes, state, row);
    return std::pair{row[4], row[6]};
  };
  const fem::Hooke d = fem::hooke(s.materials[0]);
  const auto linear = sxx_and_szz([](Vec2 x) { return Vec2{1e-3 * x.x, 0.0}; });
  EXPECT_NEAR(linear.first, 1e-3 * d.d11, 1e-10 * d.d11);
  EXPECT_NEAR(linear.second, 1e-3 * d.d12, 1e-10 * d.d11);
  // What changes the volume beyond x = 0.5 alone is felt by the corners there.
  const auto beyond = sxx_and_szz([](Vec2 x) {
    return Vec2{x.x > 0.9 && x.x < 1.05 ? 1e-3 : 0.0, 0.0};
  });
  EXPECT_GT(std::abs(beyond.second), 1e-5 * d.d12);
}

}  // namespace
}  // namespace rondo::study::probes_test
