// SPDX-License-Identifier: BSD-3-Clause
/// Sharp corners of the ground at the edges around a wheel in three dimensions: which are found,
/// and what they do to the nodes.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "rondo/integrators/solid/corner_finder.hpp"
#include "rondo/mesh/edges.hpp"
#include "rondo/mesh/solid/wheel.hpp"
#include "support/solid_wheel.hpp"

namespace solid_corners_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

constexpr double camber = 0.1;

/// A box wheel over a post as thin as 2 mm, which is `height` high and begins at x = `at`.
Model over_a_post(const mesh::Mesh& mesh, double at, double height) {
  test::Cornering rolling;
  rolling.camber = camber;
  Model m = test::cornering_model(mesh, rolling);
  contact::GroundShape ground;
  ground.profile = {{-9, 0}, {at, 0}, {at, height}, {at + 0.002, height}, {at + 0.002, 0}, {9, 0}};
  test::touch_corners(mesh, ground, {.friction = 0.3}, m);
  return m;
}

/// Contacts of the undeformed wheel with its center `height` above y = 0.
std::vector<CornerRow> rows_at(const Model& m, CornerFinder& finder, double height) {
  const GroundFrame ground(camber);
  for (const int node : m.contact->nodes) {
    const auto k = static_cast<std::size_t>(node);
    const Vec3 x = ground.from_wheel({m.reference[k].x, m.reference[k].y, m.solid->axial[k]});
    finder.set_place(static_cast<int>(k), x + Vec3{0.0, height, 0.0});
  }
  std::vector<CornerFinder::Near> near;
  finder.find_near(finder.deepest(), near);
  std::vector<CornerRow> rows;
  finder.find(near, rows);
  return rows;
}

int count(const std::vector<CornerRow>& rows, ContactKind kind) {
  int n = 0;
  for (const CornerRow& row : rows) n += row.kind == kind ? 1 : 0;
  return n;
}

}  // namespace

TEST(SolidCorners, RowsAreRingsAndPiecesOfRings) {
  const mesh::Mesh smooth = mesh::make_wheel(test::box_wheel(3, 4, 90));
  const Model m = over_a_post(smooth, 0.0, 0.001);
  const EdgeRows rings = edge_rows(m);
  EXPECT_EQ(rings.boundary.edges.size(), 5U * 90U);
  EXPECT_EQ(rings.boundary.body.back(), 4);
  for (const auto& [before, after] : rings.boundary.beside) EXPECT_TRUE(before >= 0 && after >= 0);
  EXPECT_NEAR(rings.deepest[0], 0.5 * 0.6 * std::sin(std::numbers::pi / 90.0), 1e-15);

  mesh::Wheel treaded = test::box_wheel(4, 4);
  treaded.disk.tread = mesh::Tread{20, 0.02, 3, 1, 2};
  const EdgeRows pieces = edge_rows(over_a_post(mesh::make_wheel(treaded), 0.0, 0.001));
  EXPECT_EQ(pieces.boundary.edges.size(), 5U * 20U * 3U);
  EXPECT_EQ(pieces.boundary.body.back(), 5 * 20 - 1);
  int ends = 0;
  for (const auto& [before, after] : pieces.boundary.beside)
    ends += (before < 0 ? 1 : 0) + (after < 0 ? 1 : 0);
  EXPECT_EQ(ends, 2 * 5 * 20);
}

/// A column of nodes is straight below the center, at x = 0, the next 20.9 mm beside it.
TEST(SolidCorners, ALineTouchesEveryRowOfEdgesWhereItIsDeepest) {
  const mesh::Mesh mesh = mesh::make_wheel(test::box_wheel(3, 4, 90));
  const Model m = over_a_post(mesh, 0.008, 0.003);
  CornerFinder finder(m);
  // The leaning wheel's lowest shoulder is .05 sin γ below its middle: the rows come down in turn.
  int before = 0;
  for (const double height : {0.31, 0.305, 0.3015, 0.2985, 0.296}) {
    const std::vector<CornerRow> rows = rows_at(m, finder, height);
    const int corners = count(rows, ContactKind::corner);
    EXPECT_GE(corners, before) << height;
    before = corners;
    for (const CornerRow& row : rows) {
      if (row.kind == ContactKind::facet) continue;
      EXPECT_LE(row.gap, 0.0);
      EXPECT_GE(row.gap, -finder.deepest());
      // The line is where both nodes say.
      Vec2 place;
      for (std::size_t i = 0; i < 2; ++i)
        place += row.weight[i] * finder.places()[static_cast<std::size_t>(row.node[i])];
      EXPECT_NEAR(norm(place - row.point), -row.gap, 1e-15);
    }
  }
  EXPECT_EQ(before, 10);  // both edges of the post, on five rows
}

TEST(SolidCorners, PushesOfALineHaveNoMomentAboutIt) {
  const mesh::Mesh mesh = mesh::make_wheel(test::box_wheel(3, 4, 90));
  const Model m = over_a_post(mesh, 0.008, 0.003);
  CornerFinder finder(m);
  const std::vector<CornerRow> rows = rows_at(m, finder, 0.297);
  ASSERT_GT(count(rows, ContactKind::corner), 0);
  const GroundFrame ground(camber);
  for (const CornerRow& row : rows) {
    if (row.kind == ContactKind::facet) continue;
    const Vec3 impulse{2.0, 0.7, -0.4};
    Vec3 sum;
    double moment = 0.0;  // about the line
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 push = ground.from_wheel(contact::transposed(row.block[i], impulse));
      const Vec2 x = finder.places()[static_cast<std::size_t>(row.node[i])];
      sum += push;
      moment += cross(x - row.point, push.plane());
    }
    const Vec2 n = row.normal;
    EXPECT_NEAR(norm(sum + Vec3(from_frame(n, {impulse.x, impulse.y}), impulse.z)), 0.0, 1e-14);
    EXPECT_NEAR(moment, 0.0, 1e-16);
    EXPECT_NEAR(contact::transposed(row.block[1], {0.0, 0.0, 1.0}).z,
                -row.weight[1] * std::cos(camber), 1e-15);
  }
}

TEST(SolidCorners, TheNearerNodeInPlaceOfAnEdgeIsPushedAlongItsNormal) {
  const mesh::Mesh mesh = mesh::make_wheel(test::box_wheel(3, 4, 90));
  const Model m = over_a_post(mesh, 0.004, 0.003);
  CornerFinder finder(m);
  int corners = 0;
  for (const CornerRow& row : rows_at(m, finder, 0.297)) {
    if (row.kind == ContactKind::facet) continue;
    ++corners;
    const CornerRow at_node = finder.at_nearer_node(row);
    EXPECT_EQ(at_node.node[0], row.node[row.weight[1] > 0.5 ? 1 : 0]);
    EXPECT_EQ(at_node.count, 1);
    EXPECT_EQ(at_node.key, row.key);
    EXPECT_EQ(norm(at_node.normal + row.normal), 0.0);
    const Vec3 push = contact::transposed(at_node.block[0], {2.0, 0.7, -0.4});
    const Vec3 expected(from_frame(at_node.normal, {2.0, 0.7}), -0.4);
    EXPECT_NEAR(norm(GroundFrame(camber).from_wheel(push) - expected), 0.0, 1e-15);
  }
  EXPECT_GT(corners, 3);
}

/// A comb of posts 1 mm apart under each edge: their first and last say what those between do.
TEST(SolidCorners, OfManyCornersOnAnEdgeTheOuterOnesHoldIt) {
  const mesh::Mesh mesh = mesh::make_wheel(test::box_wheel(3, 4, 90));
  Model m = over_a_post(mesh, 0.0, 0.001);
  contact::GroundShape comb;
  comb.profile = {{-9, 0}};
  for (int i = -60; i < 60; ++i) {
    comb.profile.push_back({0.001 * i, 0.0});
    comb.profile.push_back({0.001 * i + 0.0005, 0.0005});
  }
  comb.profile.push_back({0.06, 0.0});
  comb.profile.push_back({9, 0});
  m.contact->ground = contact::Ground(comb, m.contact->ground.spacing());
  CornerFinder finder(m);
  const std::vector<CornerRow> rows = rows_at(m, finder, 0.298);
  std::map<std::array<int, 2>, int> of_edge;
  for (const CornerRow& row : rows)
    if (row.kind == ContactKind::corner) ++of_edge[row.node];
  EXPECT_GT(of_edge.size(), 4U);
  for (const auto& [edge, n] : of_edge) EXPECT_LE(n, 2);
  EXPECT_GT(finder.left_to_others().size(), 4U * of_edge.size());
}

}  // namespace solid_corners_test
