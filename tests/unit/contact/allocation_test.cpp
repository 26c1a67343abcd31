// SPDX-License-Identifier: BSD-3-Clause
/// Coupled contact allocates nothing once its memory has held the largest problem.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "rondo/contact/coupled/clusters.hpp"
#include "rondo/contact/residual.hpp"
#include "rondo/contact/search.hpp"
#include "rondo/contact/segment.hpp"
#include "rondo/contact/space/obstacle_ground.hpp"
#include "rondo/contact/space/road_ground.hpp"
#include "support/allocations.hpp"
#include "support/contact_problems.hpp"
#include "support/crg_files.hpp"

namespace allocation_test {

using namespace rondo;
using namespace rondo::contact;
using test::allocations;

TEST(Allocation, NoneOnceTheMemoryIsLargeEnough) {
  // The first takes sweeps and one Newton step, the second all that the solver has.
  const std::vector<test::ChainShape> shapes{
      {.upper = 60, .lower = 45},
      {.upper = 20, .lower = 20, .offset = 0.0, .both_ways = true, .friction = 1.0}};
  std::vector<test::Scene> scenes;
  std::vector<CoupledProblem> problems(2);
  DelassusBuilder builder;
  for (const auto& shape : shapes) scenes.push_back(test::chain(shape));
  for (std::size_t i = 0; i < 2; ++i) problems[i] = test::problem_of(scenes[i]);
  CoupledWorkspace work;
  std::vector<Vec2> impulse(60);
  std::vector<Status> status(60);
  const auto solve_all = [&] {
    bool converged = true;
    for (std::size_t i = 0; i < 2; ++i) {
      builder.build(scenes[i].contacts, scenes[i].response, problems[i]);
      const std::size_t nc = problems[i].size();
      std::fill(impulse.begin(), impulse.end(), Vec2{});
      converged = solve_coupled(problems[i], {}, {impulse.data(), nc}, {status.data(), nc}, work)
                      .converged &&
                  converged;
    }
    return converged;
  };
  EXPECT_TRUE(solve_all());
  const long before = allocations();
  EXPECT_TRUE(solve_all());
  EXPECT_EQ(allocations() - before, 0);
}

TEST(Allocation, NoneInSearchAndClusters) {
  std::vector<Vec2> x;
  std::vector<std::array<int, 2>> edges;
  for (int i = 0; i <= 200; ++i) x.push_back(direction_at(0.03 * i));
  for (int i = 0; i < 200; ++i) edges.push_back({i, i + 1});
  std::vector<int> starts, nodes;
  for (int i = 0; i <= 200; ++i) starts.push_back(2 * i);
  for (const auto& [a, b] : edges) nodes.insert(nodes.end(), {a, b});
  const Boundary boundary = make_boundary(edges, {});
  SegmentGrid grid;
  ClusterFinder finder;
  std::vector<int> near;
  long found = 0;
  const auto search = [&] {
    grid.build(x, edges, 0.01, 0.02);
    for (const Vec2 p : x) {
      grid.near(0.99 * p, near);
      found += touch_boundary({.position = 0.995 * p}, {boundary, x, near, 0.02}).count;
    }
    found += static_cast<long>(finder.find(starts, nodes, x.size()).size());
  };
  search();
  const long before = allocations();
  search();
  EXPECT_EQ(allocations() - before, 0);
  EXPECT_GT(found, 100);
}

/// It is asked in each time step.
TEST(Allocation, NoneOnARoad) {
  const RoadGround ground(
      road::Surface(test::road_by([](double u, double v) { return 0.1 * std::sin(u) * v; }, 3.0,
                                  0.2, 12, {-1.0, -0.3, 0.0, 0.1})),
      {4.0, 0.0, 0.0});
  const long before = allocations();
  int touched = 0;
  for (int k = 0; k < 100; ++k) {
    const Vec3 place{0.01 * k, 0.002 * (k % 7 - 3), -0.002 * k};
    if (place.y <= ground.top(place.x - 0.1, place.x + 0.1)) touched += ground.touches(place).count;
  }
  EXPECT_EQ(allocations() - before, 0);
  EXPECT_GT(touched, 10);
  EXPECT_LT(touched, 90);
}

TEST(ObstacleGround, AllocatesNothing) {
  const auto waves = [](double u, double v) { return 0.01 * std::sin(4.0 * u) + 0.05 * v; };
  std::vector<double> v;
  for (int j = -40; j <= 40; ++j) v.push_back(0.0125 * j);
  const auto road = std::make_shared<const RoadGround>(
      road::Surface(test::road_by(waves, -1.0, 0.0125, 161, v)), RoadPlacing{});
  const ObstacleGround ground(
      road, std::vector{Obstacle{ObstacleKind::cleat, 0.1, 0.02, 0.06, 0.5, 0.008},
                        Obstacle{ObstacleKind::pothole, 0.4, 0.03, 0.08, -0.4, 0.01}});
  const auto before = allocations();
  int touching = 0;
  for (int k = 0; k < 1000; ++k)
    touching +=
        ground.touches({-0.1 + 0.0007 * k, 0.01 * std::sin(17.0 * k), 0.0001 * k - 0.05}).count;
  EXPECT_EQ(allocations(), before);
  EXPECT_GT(touching, 100);
}

}  // namespace allocation_test
