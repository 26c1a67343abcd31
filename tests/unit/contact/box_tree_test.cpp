// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/box_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace box_tree_test {

using namespace rondo;
using namespace rondo::contact;

namespace {

using Line = std::vector<Vec2>;

BoxTree tree_of(const Line& line) {
  std::vector<BoxTree::Box> boxes;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 a = line[i], b = line[i + 1];
    boxes.push_back(
        {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}});
  }
  return BoxTree(boxes);
}

double distance(const Line& line, std::size_t i, Vec2 x) {
  const Vec2 d = line[i + 1] - line[i];
  const double along = std::clamp(dot(x - line[i], d) / dot(d, d), 0.0, 1.0);
  return norm(x - line[i] - along * d);
}

/// The first of the nearest pieces, its distance, and how many pieces were looked at.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  std::size_t piece = 0, looks = 0;

  double look(const Line& line, std::size_t i, Vec2 x) {
    ++looks;
    const double found = box_tree_test::distance(line, i, x);
    if (found < distance || (found == distance && i < piece)) {
      distance = found;
      piece = i;
    }
    return distance;
  }
};

/// @return pieces looked at on the mean
double compare(const Line& line, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const BoxTree tree = tree_of(line);
  constexpr int trials = 300;
  double looks = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    const double far = trial % 10 == 0 ? 50.0 : 1.2;
    // Corners of the line are as far from two pieces.
    const Vec2 x = trial % 3 == 0 ? line[static_cast<std::size_t>(trial) % line.size()]
                                  : Vec2{far * (unit(random) - 0.1), far * (unit(random) - 0.5)};
    Nearest all, near;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) all.look(line, i, x);
    tree.each_near(x, [&](std::size_t i) { return near.look(line, i, x); });
    EXPECT_EQ(near.distance, all.distance) << trial;
    EXPECT_EQ(near.piece, all.piece) << trial;
    looks += static_cast<double>(near.looks) / trials;
  }
  return looks;
}

}  // namespace

/// The same piece and the same bits as a look at all, on lines that go on to the right, with
/// vertical pieces, and on lines that go back and cross themselves.
TEST(BoxTree, FindsWhatALookAtAllFinds) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const std::size_t n : {1U, 7U, 8U, 9U, 100U, 1025U, 4000U}) {
    Line road{{0.0, 0.0}}, tangle{{0.5, 0.0}};
    for (std::size_t i = 0; i < n; ++i) {
      const double step = 1.0 / static_cast<double>(n);
      road.push_back({road.back().x + (i % 3 == 0 ? 0.0 : step), 0.01 * unit(random)});
      tangle.push_back(tangle.back() + 8.0 * step * Vec2{unit(random) - 0.5, unit(random) - 0.5});
    }
    const double looks = compare(road, random);
    compare(tangle, random);
    if (n == 4000U) {
      EXPECT_LT(looks, 600.0);
    }
  }
}

/// Pieces that go on for ever, and no pieces.
TEST(BoxTree, InfiniteAndEmpty) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::vector<BoxTree::Box> boxes{{{-infinity, 0.0}, {0.0, 0.0}},
                                        {{0.0, 0.0}, {infinity, infinity}}};
  const BoxTree tree(boxes);
  for (const Vec2 x : {Vec2{-1e9, 1.0}, Vec2{1e9, 1e9}, Vec2{1e100, -1e100}}) {
    int looks = 0;
    tree.each_near(x, [&](std::size_t) { return ++looks, infinity; });
    EXPECT_EQ(looks, 2);
  }
  BoxTree().each_near({}, [](std::size_t) {
    ADD_FAILURE();
    return 0.0;
  });
}

}  // namespace box_tree_test
