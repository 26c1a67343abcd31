// SPDX-License-Identifier: BSD-3-Clause
/// Sharp corners of the ground at the edges around a wheel in three dimensions: which are found,
/// and what they do to the nodes.
#include <gtest/gtest.h>

#include <cmath>
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
  const std::vector<mesh::Edge> edges = mesh::rolling_edges(mesh, "tread");
  m.contact.emplace(
      ContactModel{contact::Ground(ground, mesh::longest_edge(mesh.coordinates, edges)),
                   {.friction = 0.3},
                   mesh.boundary,
                   mesh.tributary,
                   edges});
  return m;
}

/// Contacts of the undeformed wheel with its center `height` above y = 0.
std::vector<CornerRow> rows_at(const Model& m, CornerFinder& finder, double height) {
  const GroundFrame ground(camber);
  for (const int node : m.contact->nodes) {
    const auto k = static_cast<std::size_t>(node);
    const Vec3 x = ground.from_wheel({m.reference[k].x, m.reference[k].y, m.solid->axial[k]});
    finder.places()[k] = x.plane() + Vec2{0.0, height};
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

TEST(SolidCorners, ACornerAtANodeOnTheGroundIsLeftToIt) {
  const mesh::Mesh mesh = mesh::make_wheel(test::box_wheel(3, 4, 90));
  // The nodes at x = 0 are on the post, beside its left edge.
  const Model on = over_a_post(mesh, -0.0003, 0.003);
  CornerFinder finder(on);
  const std::vector<CornerRow> rows = rows_at(on, finder, 0.297);
  for (const CornerRow& row : rows)
    if (row.kind == ContactKind::corner) {
      EXPECT_GT(std::min(row.weight[0], row.weight[1]), 0.03);
    }
  EXPECT_GE(finder.left_to_nodes().size(), 3U);
  EXPECT_GE(count(rows, ContactKind::corner), 3);  // of the other edge of the post
  const Model beside = over_a_post(mesh, 0.004, 0.003);
  CornerFinder other(beside);
  EXPECT_GE(count(rows_at(beside, other, 0.297), ContactKind::corner), 6);
  EXPECT_TRUE(other.left_to_nodes().empty());
}

}  // namespace solid_corners_test
