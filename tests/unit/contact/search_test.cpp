// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "rondo/core/vec2.hpp"

namespace search_test {

using namespace rondo;
using contact::SegmentGrid;

namespace {

struct Scene {
  std::vector<Vec2> x;
  std::vector<std::array<int, 2>> edges;
};

Scene random_scene(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Scene s;
  const int n = 2 + static_cast<int>(random() % 200);
  const double size = std::pow(10.0, 3.0 * u(random)), width = seed % 3 == 0 ? 1e-6 : 1.0;
  for (int i = 0; i < n; ++i) s.x.push_back({size * u(random), width * size * u(random)});
  const auto node = [&] { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (unsigned i = 0; i < 1 + random() % 150; ++i) {
    const int a = node();
    if (seed % 2 == 0)
      s.edges.push_back({a, (a + 1) % n});
    else
      s.edges.push_back({a, node()});
  }
  return s;
}

bool in_box(const Scene& s, int edge, Vec2 p, double reach) {
  const auto [i, j] = s.edges[static_cast<std::size_t>(edge)];
  const Vec2 a = s.x[static_cast<std::size_t>(i)], b = s.x[static_cast<std::size_t>(j)];
  return p.x >= std::min(a.x, b.x) - reach && p.x <= std::max(a.x, b.x) + reach &&
         p.y >= std::min(a.y, b.y) - reach && p.y <= std::max(a.y, b.y) + reach;
}

/// All within the margin are found, none beyond margin and twice the skin, in ascending order.
void compare(const Scene& s, const SegmentGrid& grid, double margin, double skin, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<int> found;
  for (int i = 0; i < 100; ++i) {
    const Vec2 a = s.x[random() % s.x.size()], b = s.x[random() % s.x.size()];
    const double at = 1.5 * static_cast<double>(random() % 1000) / 1000.0 - 0.25;
    const Vec2 p = a + at * (b - a) + Vec2{0.5 * margin, -0.5 * margin};
    grid.near(p, found);
    ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
    ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
    for (int e = 0; e < static_cast<int>(s.edges.size()); ++e) {
      const bool reported = std::binary_search(found.begin(), found.end(), e);
      if (in_box(s, e, p, margin)) {
        ASSERT_TRUE(reported) << seed << " " << i << " " << e;
      }
      if (!in_box(s, e, p, margin + 2.0 * skin + 1e-12)) {
        ASSERT_FALSE(reported) << seed;
      }
    }
  }
}

}  // namespace

TEST(Search, FindsWhatTryingAllFinds) {
  SegmentGrid grid;  // its memory serves all
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Scene s = random_scene(seed);
    const double margin = 0.01 * static_cast<double>(seed % 7), skin = 0.005 * (seed % 5);
    grid.build(s.x, s.edges, margin, skin);
    compare(s, grid, margin, skin, seed);
  }
}

TEST(Search, IsRightWhileNodesMoveAndBuildsOnlyPastTheSkin) {
  Scene s = random_scene(8);
  const double margin = 0.02, skin = 0.01;
  SegmentGrid grid;
  EXPECT_TRUE(grid.update(s.x, s.edges, margin, skin));
  std::mt19937 random(9);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  int built = 0;
  for (int step = 0; step < 100; ++step) {
    for (Vec2& x : s.x) x += 0.1 * skin * Vec2{1.0 + 0.1 * u(random), 0.1 * u(random)};
    built += grid.update(s.x, s.edges, margin, skin) ? 1 : 0;
    compare(s, grid, margin, skin, static_cast<unsigned>(step));
  }
  EXPECT_GE(built, 8);  // the skin lasts 9 or 10 of the steps
  EXPECT_LE(built, 12);
  EXPECT_EQ(grid.builds(), built + 1);
  EXPECT_TRUE(grid.update(s.x, s.edges, 0.03, skin));
  s.edges.pop_back();
  EXPECT_TRUE(grid.update(s.x, s.edges, 0.03, skin));
}

TEST(Search, NoEdgesNoNeighbours) {
  SegmentGrid grid;
  std::vector<int> found{1, 2};
  grid.near({}, found);
  EXPECT_TRUE(found.empty());
  grid.build({}, {}, 0.1, 0.1);
  grid.near({}, found);
  EXPECT_TRUE(found.empty());
}

TEST(Search, BodiesFarApartTakeNoMoreCellsThanEdgesNeed) {
  // 2000 short edges about two places a kilometre apart.
  Scene s;
  for (int i = 0; i <= 2000; ++i) s.x.push_back({(i < 1000 ? 0.0 : 1000.0) + 1e-4 * i, 1e-4 * i});
  for (int i = 0; i < 2000; ++i)
    if (i != 999) s.edges.push_back({i, i + 1});
  SegmentGrid grid;
  grid.build(s.x, s.edges, 1e-3, 0.0);
  EXPECT_LT(grid.cells(), 20 * s.edges.size());
  compare(s, grid, 1e-3, 0.0, 3);
}

}  // namespace search_test
