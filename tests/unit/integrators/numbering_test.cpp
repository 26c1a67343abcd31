// SPDX-License-Identifier: BSD-3-Clause
/// The order of the rows of the sparse operator.
#include "rondo/integrators/fused/numbering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "support/models.hpp"

namespace numbering_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

/// Blocks without values: every node with itself, and both ways along the edges.
fem::BlockCsr graph(int n, const std::vector<std::pair<int, int>>& edges) {
  std::vector<std::set<int>> rows(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) rows[static_cast<std::size_t>(i)].insert(i);
  for (const auto& [a, b] : edges) {
    rows[static_cast<std::size_t>(a)].insert(b);
    rows[static_cast<std::size_t>(b)].insert(a);
  }
  fem::BlockCsr k;
  k.row_start.push_back(0);
  for (const std::set<int>& row : rows) {
    k.column.insert(k.column.end(), row.begin(), row.end());
    k.row_start.push_back(static_cast<std::int64_t>(k.column.size()));
  }
  return k;
}

std::vector<int> sorted(std::vector<int> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

struct Disk {
  fem::BlockCsr k;
  std::vector<int> free;
};

/// A disk, its nodes numbered sector by sector, or by chance.
Disk disk(int radial, int circumferential, bool by_chance) {
  const test::DiskCase c = test::rolling_disk(radial, circumferential);
  mesh::Mesh mesh = mesh::make_disk(c.disk);
  if (by_chance) {
    std::vector<int> number(mesh.n_nodes());
    std::iota(number.begin(), number.end(), 0);
    std::shuffle(number.begin(), number.end(), std::mt19937(1));
    const auto renumber = [&](int& node) { node = number[static_cast<std::size_t>(node)]; };
    const std::vector<Vec2> coordinates = mesh.coordinates;
    for (std::size_t i = 0; i < number.size(); ++i)
      mesh.coordinates[static_cast<std::size_t>(number[i])] = coordinates[i];
    for (mesh::Cell& cell : mesh.cells) std::for_each(cell.begin(), cell.end(), renumber);
    std::for_each(mesh.clamped.begin(), mesh.clamped.end(), renumber);
    std::sort(mesh.clamped.begin(), mesh.clamped.end());
  }
  return {fem::assemble_stiffness(mesh, {&c.material, 1}), fem::free_nodes(mesh)};
}

}  // namespace

TEST(Numbering, BandwidthOfAChain) {
  const fem::BlockCsr k = graph(5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}});
  const Bandwidth in_order = bandwidth(k, std::vector{0, 1, 2, 3, 4});
  EXPECT_EQ(in_order.maximum, 1);
  EXPECT_DOUBLE_EQ(in_order.mean, 8.0 / 13.0);  // 5 blocks at 0, 8 at 1
  const Bandwidth mixed = bandwidth(k, std::vector{0, 2, 4, 1, 3});
  EXPECT_EQ(mixed.maximum, 3);
  EXPECT_DOUBLE_EQ(mixed.mean, 2.0 * (3 + 2 + 3 + 2) / 13.0);
}

TEST(Numbering, TheWidthOfADiskNumberedByChanceIsRestored) {
  const int radial = 12;
  const Disk given = disk(radial, 90, false), lost = disk(radial, 90, true);
  const std::vector<int> order = row_order(lost.k, lost.free);
  EXPECT_EQ(sorted(order), lost.free);
  const Bandwidth found = bandwidth(lost.k, order);
  EXPECT_GT(bandwidth(lost.k, lost.free).mean, 10.0 * found.mean);
  EXPECT_LT(found.mean, 1.1 * bandwidth(given.k, given.free).mean);
  EXPECT_LE(found.maximum, 4 * radial);  // both ways round, a column of nodes and the next
}

TEST(Numbering, AGoodOrderIsKept) {
  const Disk given = disk(6, 90, false);
  EXPECT_EQ(row_order(given.k, given.free), given.free);
  const fem::BlockCsr chain = graph(4, {{0, 1}, {1, 2}, {2, 3}});
  const std::vector<int> forwards{0, 1, 2, 3}, backwards{3, 2, 1, 0};  // as good as each other
  EXPECT_EQ(row_order(chain, forwards), forwards);
  EXPECT_EQ(row_order(chain, backwards), backwards);
}

TEST(Numbering, AChainIsWalkedFromAnEnd) {
  const fem::BlockCsr k = graph(6, {{2, 5}, {5, 0}, {0, 3}, {3, 1}, {1, 4}});
  const std::vector<int> order = row_order(k, std::vector{0, 1, 2, 3, 4, 5});
  EXPECT_EQ(sorted(order), (std::vector{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(bandwidth(k, order).maximum, 1);
}

/// Two chains, each other's nodes between; a node with a block of its own only; one without any.
TEST(Numbering, PartsComeOneAfterTheOther) {
  fem::BlockCsr k = graph(9, {{0, 2}, {2, 4}, {4, 6}, {1, 3}, {3, 5}});
  k.column.pop_back();  // of node 8
  --k.row_start.back();
  const std::vector<int> nodes{0, 1, 2, 3, 4, 5, 6, 7, 8};
  const std::vector<int> order = row_order(k, nodes);
  EXPECT_EQ(sorted(order), nodes);
  EXPECT_EQ(bandwidth(k, nodes).maximum, 2);
  EXPECT_EQ(bandwidth(k, order).maximum, 1);
}

TEST(Numbering, NoNodes) {
  const fem::BlockCsr k = graph(0, {});
  EXPECT_TRUE(row_order(k, {}).empty());
  EXPECT_EQ(bandwidth(k, {}).maximum, 0);
  EXPECT_EQ(bandwidth(k, {}).mean, 0.0);
}

}  // namespace numbering_test
