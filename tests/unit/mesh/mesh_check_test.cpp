// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/mesh_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mesh_check_test {

using namespace rondo;
using namespace rondo::mesh;

namespace {

/// Nodes on a grid of 4 × 3, numbered by rows.
Mesh grid() {
  Mesh m;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) m.coordinates.push_back({1.0 * x, 1.0 * y});
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      const int k = 4 * y + x;
      m.cells.push_back({k, k + 1, k + 5, k + 4});
    }
  return m;
}

CellShape shape_of(std::vector<Vec2> x, Cell cell) {
  Mesh m;
  m.coordinates = std::move(x);
  return cell_shape(m, cell);
}

const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

}  // namespace

TEST(CellShape, OfQuadrilaterals) {
  EXPECT_EQ(shape_of(square, {0, 1, 2, 3}), CellShape::good);
  EXPECT_EQ(shape_of(square, {0, 3, 2, 1}), CellShape::clockwise);
  EXPECT_EQ(shape_of(square, {0, 1, 1, 3}), CellShape::repeated);
  EXPECT_EQ(shape_of(square, {0, 1, 2, 0}), CellShape::repeated);
  EXPECT_EQ(shape_of(square, {0, 1, 3, 2}), CellShape::flat) << "a bow tie: the areas cancel";
  EXPECT_EQ(shape_of({{0, 0}, {3, 0}, {1, 1}, {0, 3}}, {0, 1, 2, 3}), CellShape::concave);
  EXPECT_EQ(shape_of({{0, 0}, {2, 0}, {1, 1}, {0, 2}}, {0, 1, 2, 3}), CellShape::concave)
      << "a corner of 180 degrees has no mass";
  EXPECT_EQ(shape_of({{0, 0}, {4, 0}, {1, 1}, {2, 1}}, {0, 1, 2, 3}), CellShape::concave)
      << "edges that cross, with a positive area";
  EXPECT_EQ(shape_of({{0, 0}, {1, 0}, {2, 0}, {3, 0}}, {0, 1, 2, 3}), CellShape::flat);
}

TEST(CellShape, OfTriangles) {
  EXPECT_EQ(shape_of(square, {0, 1, 2, -1}), CellShape::good);
  EXPECT_EQ(shape_of(square, {0, 2, 1, -1}), CellShape::clockwise);
  EXPECT_EQ(shape_of({{0, 0}, {1, 1}, {3, 3}}, {0, 1, 2, -1}), CellShape::flat);
  EXPECT_EQ(shape_of({{7, 7}, {7, 7}, {7, 7}}, {0, 1, 2, -1}), CellShape::flat);
}

TEST(CellShape, DoesNotDependOnSizeOrPlace) {
  for (const double size : {1e-9, 1.0, 1e9}) {
    std::vector<Vec2> x;
    for (const Vec2 corner : square) x.push_back(size * (corner + Vec2{1000.0, -1000.0}));
    EXPECT_EQ(shape_of(x, {0, 1, 2, 3}), CellShape::good);
    EXPECT_EQ(shape_of(x, {0, 3, 2, 1}), CellShape::clockwise);
  }
  // As thin as a step could bear.
  EXPECT_EQ(shape_of({{0, 0}, {1, 0}, {1, 1e-6}, {0, 1e-6}}, {0, 1, 2, 3}), CellShape::good);
}

TEST(CellShape, ReversedIsTheOtherSense) {
  EXPECT_EQ(shape_of(square, reversed({0, 3, 2, 1})), CellShape::good);
  EXPECT_EQ(shape_of(square, reversed({0, 2, 1, -1})), CellShape::good);
  EXPECT_EQ(reversed(reversed({4, 5, 6, 7})), (Cell{4, 5, 6, 7}));
}

TEST(CheckCells, SortsThemByKind) {
  Mesh m = grid();
  EXPECT_EQ(check_cells(m).count(), 0U);
  m.cells[1] = reversed(m.cells[1]);
  m.cells[3][2] = m.cells[3][1];
  m.cells.push_back({0, 1, 2, -1});
  const BadCells bad = check_cells(m);
  EXPECT_EQ(bad.clockwise, std::vector<int>{1});
  EXPECT_EQ(bad.repeated, std::vector<int>{3});
  EXPECT_EQ(bad.flat, std::vector<int>{6});
  EXPECT_EQ(bad.count(), 3U);
}

TEST(DuplicateCells, InAnyOrderOfCorners) {
  Mesh m = grid();
  EXPECT_TRUE(duplicate_cells(m).empty());
  m.cells.push_back({5, 4, 0, 1});
  m.cells.push_back({0, 1, 5, -1});  // a part of it is no duplicate
  m.cells.push_back({1, 5, 0, -1});
  const auto pairs = duplicate_cells(m);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0], (std::array<int, 2>{8, 7}));
  EXPECT_EQ(pairs[1], (std::array<int, 2>{6, 0}));
}

TEST(EdgeTable, KnowsTheCellsOfEveryEdge) {
  const Mesh m = grid();
  const EdgeTable table(m);
  std::size_t edges = 0, inside = 0;
  table.each([&](int, std::span<const CellEdge> cells) {
    ++edges;
    inside += cells.size() == 2;
  });
  EXPECT_EQ(edges, 17U);  // 3 rows of 3, 2 columns of 4
  EXPECT_EQ(inside, 7U);
  const auto shared = table.find({6, 5});
  ASSERT_EQ(shared.size(), 2U);
  EXPECT_EQ(shared[0].cell, 1);
  EXPECT_EQ(shared[1].cell, 4);
  EXPECT_NE(shared[0].rising, shared[1].rising);
  EXPECT_TRUE(table.find({0, 5}).empty());
  EXPECT_TRUE(crowded_edges(table).empty());
  const std::vector<Edge> boundary = boundary_edges(table);
  EXPECT_EQ(boundary.size(), 10U);
  for (const Edge& edge : {Edge{0, 1}, Edge{3, 7}, Edge{9, 8}, Edge{4, 0}})  // the body on the left
    EXPECT_EQ(std::count(boundary.begin(), boundary.end(), edge), 1) << edge[0];
  const std::vector<char> flags = boundary_flags(table, m.n_nodes());
  for (const std::size_t k : {5U, 6U}) EXPECT_FALSE(flags[k]);
  EXPECT_EQ(std::count(flags.begin(), flags.end(), 1), 10);
}

TEST(EdgeTable, CrowdedAndFoldedEdges) {
  Mesh m = grid();
  m.cells.push_back({1, 2, 5, -1});  // over cell 1: on the same side of the edge 1 2
  auto crowded = crowded_edges(EdgeTable(m));
  ASSERT_EQ(crowded.size(), 2U);
  EXPECT_EQ(crowded[0].nodes, (Edge{1, 2}));
  EXPECT_EQ(crowded[0].cells, (std::vector<int>{1, 6}));
  EXPECT_EQ(crowded[1].nodes, (Edge{1, 5}));
  EXPECT_EQ(crowded[1].cells.size(), 3U);
}

TEST(InOrder, OpenLinesFirst) {
  // A closed line 4 5 6, and 9 1 2 that is open.
  const std::vector<Edge> edges{{6, 4}, {1, 2}, {4, 5}, {9, 1}, {5, 6}};
  EXPECT_EQ(in_order(edges), (std::vector<Edge>{{9, 1}, {1, 2}, {4, 5}, {5, 6}, {6, 4}}));
}

TEST(InOrder, TakesEveryEdgeOfAStar) {
  // Lines that all pass node 0: each edge once, in a time that does not grow with the square.
  constexpr int n = 50000;
  std::vector<Edge> edges;
  for (int k = 0; k < n; ++k) {
    edges.push_back({0, 2 * k + 1});
    edges.push_back({2 * k + 1, 2 * k + 2});
    edges.push_back({2 * k + 2, 0});
  }
  std::vector<Edge> ordered = in_order(edges);
  for (std::size_t k = 1; k < ordered.size(); ++k) ASSERT_EQ(ordered[k][0], ordered[k - 1][1]);
  std::sort(ordered.begin(), ordered.end());
  std::sort(edges.begin(), edges.end());
  EXPECT_EQ(ordered, edges);
}

TEST(CoincidentNodes, AsByComparingAll) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  Mesh m;
  m.coordinates = {{-1.0, -1.0}, {1.0, 1.0}};  // size 2: near is up to 2e-9, far above 4e-9 √2
  for (int k = 0; k < 500; ++k) m.coordinates.push_back({place(random), place(random)});
  for (int k = 0; k < 200; ++k) {
    const auto of = static_cast<std::size_t>(random() % 500) + 2;
    const Vec2 off{place(random), place(random)};
    m.coordinates.push_back(m.coordinates[of] + (k % 2 == 0 ? 1.99e-9 : 2e-8) / norm(off) * off);
  }
  std::vector<double> nearest(m.n_nodes(), 1.0);  // of those before
  for (std::size_t k = 0; k < m.n_nodes(); ++k)
    for (std::size_t j = 0; j < k; ++j)
      nearest[k] = std::min(nearest[k], norm(m.coordinates[k] - m.coordinates[j]));
  std::vector<char> found(m.n_nodes(), 0);
  for (const auto& [later, earlier] : coincident_nodes(m)) {
    EXPECT_LT(earlier, later);
    found[static_cast<std::size_t>(later)] = 1;
  }
  int near = 0;
  for (std::size_t k = 0; k < m.n_nodes(); ++k) {
    EXPECT_TRUE(found[k] || nearest[k] > 2e-9) << nearest[k];
    EXPECT_TRUE(!found[k] || nearest[k] < 6e-9) << nearest[k];
    near += nearest[k] < 2e-9;
  }
  EXPECT_GE(near, 100);
}

TEST(CoincidentNodes, OfNothingAndOfOnePlace) {
  Mesh m;
  EXPECT_TRUE(coincident_nodes(m).empty());
  m.coordinates = {{1, 1}, {1, 1}};  // no size to compare with: the cells have no area either
  EXPECT_TRUE(coincident_nodes(m).empty());
  m.coordinates.push_back({1e12, 1});
  EXPECT_EQ(coincident_nodes(m).size(), 1U);
}

}  // namespace mesh_check_test
