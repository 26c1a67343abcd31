// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/segment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace segment_test {

using namespace rondo;
using namespace rondo::contact;

namespace {

/// A closed polygon, counter-clockwise: its body is inside.
struct Body {
  std::vector<Vec2> points;
  Boundary boundary;
  std::vector<int> all;
};

Body body_of(std::vector<Vec2> points, std::vector<int> body_of_node = {}) {
  std::vector<std::array<int, 2>> edges;
  const int n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i) edges.push_back({i, (i + 1) % n});
  Body out{std::move(points), make_boundary(edges, body_of_node), {}};
  out.all.resize(edges.size());
  std::iota(out.all.begin(), out.all.end(), 0);
  return out;
}

EdgeTouches touches(const Body& b, Vec2 p, double deepest = 0.5) {
  return touch_boundary({.position = p}, {b.boundary, b.points, b.all, deepest});
}

bool inside(const std::vector<Vec2>& points, Vec2 p) {
  bool in = false;
  for (std::size_t i = 0, j = points.size() - 1; i < points.size(); j = i++) {
    const Vec2 a = points[i], b = points[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) in = !in;
  }
  return in;
}

double distance_to(const std::vector<Vec2>& points, Vec2 p) {
  double least = 1e300;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 a = points[i], d = points[(i + 1) % points.size()] - a;
    const double at = std::clamp(dot(d, p - a) / dot(d, d), 0.0, 1.0);
    least = std::min(least, norm(p - a - at * d));
  }
  return least;
}

/// A square with a notch whose bottom corners are reflex joints at right angles.
const std::vector<Vec2> notched{{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

}  // namespace

TEST(Segment, GapFootAndNormalByHand) {
  const Vec2 a{0.0, 0.0}, b{2.0, 0.0};  // the body above, outwards is downwards
  const auto touch = touch_segment({0.5, 0.1}, a, b, 0.5);
  ASSERT_TRUE(touch);
  EXPECT_EQ(touch->gap, -0.1);
  EXPECT_EQ(touch->at, 0.25);
  EXPECT_EQ(touch->normal, (Vec2{0.0, -1.0}));
  EXPECT_TRUE(touch_segment({0.5, 0.0}, a, b, 0.5));     // g <= 0 touches
  EXPECT_FALSE(touch_segment({0.5, -1e-9}, a, b, 0.5));  // outside
  EXPECT_FALSE(touch_segment({0.5, 0.51}, a, b, 0.5));   // too deep
  EXPECT_TRUE(touch_segment({0.0, 0.1}, a, b, 0.5));     // at its ends
  EXPECT_TRUE(touch_segment({2.0, 0.1}, a, b, 0.5));
  EXPECT_FALSE(touch_segment({-1e-9, 0.1}, a, b, 0.5));  // beyond them
  EXPECT_FALSE(touch_segment({2.0 + 1e-9, 0.1}, a, b, 0.5));
}

/// Near a joint every point inside belongs to one of its two segments, none outside to any.
TEST(Segment, JointsLeaveNoGapAndNoPointTwice) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  int counted = 0;
  for (int round = 0; round < 2000; ++round) {
    const double turn = 2.5 * u(random), start = 3.0 * u(random);  // > 0 convex, < 0 reflex
    const Vec2 joint{u(random), u(random)};
    const Vec2 q = joint - direction_at(start), r = joint + direction_at(start + turn);
    for (int i = 0; i < 50; ++i) {
      const Vec2 p = joint + 0.2 * Vec2{u(random), u(random)};
      const auto first = touch_segment(p, {q, q, joint, r}, 0.3);
      const auto second = touch_segment(p, {q, joint, r, r}, 0.3);
      const double g1 = -cross(joint - q, p - q), g2 = -cross(r - joint, p - joint);
      const bool in = turn > 0.0 ? g1 <= 0.0 && g2 <= 0.0 : g1 <= 0.0 || g2 <= 0.0;
      ASSERT_EQ(static_cast<int>(first.has_value()) + static_cast<int>(second.has_value()),
                in ? 1 : 0);
      counted += in ? 1 : 0;
    }
  }
  EXPECT_GT(counted, 10000);
}

TEST(Segment, OnTheBisectorTheFirstOneHolds) {
  const Vec2 q{0.0, 0.0}, joint{1.0, 0.0}, r{1.0, 1.0};  // convex, exact on the diagonal
  EXPECT_TRUE(touch_segment({0.75, 0.25}, {q, q, joint, r}, 0.5));
  EXPECT_FALSE(touch_segment({0.75, 0.25}, {q, joint, r, r}, 0.5));
  EXPECT_TRUE(touch_segment(joint, {q, q, joint, r}, 0.5));  // node on node: the foot is the joint
  EXPECT_FALSE(touch_segment(joint, {q, joint, r, r}, 0.5));
}

TEST(Segment, InsideAReflexWedgeTheFootIsBeyondTheEnd) {
  const Vec2 q{0.0, 0.0}, joint{1.0, 0.0}, r{1.0, -1.0};  // turns inwards by a right angle
  const auto touch = touch_segment({1.05, 0.1}, {q, q, joint, r}, 0.3);
  const auto other = touch_segment({1.05, 0.1}, {q, joint, r, r}, 0.3);
  ASSERT_TRUE(touch && !other);
  EXPECT_NEAR(touch->at, 1.05, 1e-15);
  EXPECT_NEAR(touch->gap, -0.1, 1e-15);
  // Too far from the segment itself, though not behind its line.
  EXPECT_FALSE(touch_segment({1.0 + 0.2, 0.25}, {q, q, joint, r}, 0.3));
}

TEST(Boundary, NeighboursFollowEachOther) {
  const Boundary b = make_boundary({{5, 6}, {3, 5}, {8, 9}}, {});
  EXPECT_EQ(b.beside[0], (std::array<int, 2>{1, -1}));
  EXPECT_EQ(b.beside[1], (std::array<int, 2>{-1, 0}));
  EXPECT_EQ(b.beside[2], (std::array<int, 2>{-1, -1}));
  // Two squares that hang together at node 2: none follows another there.
  const Boundary two = make_boundary({{1, 2}, {2, 3}, {4, 2}, {2, 5}}, {});
  EXPECT_EQ(two.beside[0], (std::array<int, 2>{-1, -1}));
  EXPECT_EQ(two.beside[3], (std::array<int, 2>{-1, -1}));
}

TEST(Boundary, ANodeIsHeldWhereItIsLeastDeep) {
  const Body b = body_of(notched);
  const auto at = [&](Vec2 p) { return touches(b, p); };
  EXPECT_EQ(at({0.5, 0.1}).count, 1);
  EXPECT_EQ(at({0.5, 0.1}).at[0].edge, 0);
  EXPECT_EQ(at({0.02, 0.1}).at[0].edge, 7);  // convex corner: the nearer side
  EXPECT_EQ(at({0.1, 0.02}).at[0].edge, 0);
  EXPECT_EQ(at({1.5, 1.5}).count, 0);  // in the notch
  EXPECT_EQ(at({1.5, -0.1}).count, 0);
  EXPECT_EQ(at({1.5, 0.9}).at[0].edge, 4);                           // its bottom
  const Body strip = body_of({{0, 0}, {3, 0}, {3, 0.3}, {0, 0.3}});  // thinner than the limit
  EXPECT_EQ(touches(strip, {1.5, 0.1}).at[0].edge, 0);
  EXPECT_EQ(touches(strip, {1.5, 0.25}).at[0].edge, 2);
  EXPECT_EQ(touches(strip, {1.5, 0.25}).count, 1);
}

TEST(Boundary, AReflexJointHoldsByBothSegments) {
  const Body b = body_of(notched);
  const EdgeTouches t = touches(b, {0.95, 0.9});  // behind the bottom and a wall of the notch
  ASSERT_EQ(t.count, 2);
  EXPECT_EQ(t.at[0].edge + t.at[1].edge, 4 + 5);
  for (int i = 0; i < 2; ++i) {
    const SegmentTouch& touch = t.at[static_cast<std::size_t>(i)].touch;
    const bool bottom = t.at[static_cast<std::size_t>(i)].edge == 4;
    EXPECT_NEAR(touch.gap, bottom ? -0.1 : -0.05, 1e-15);
    EXPECT_EQ(touch.normal, bottom ? (Vec2{0.0, 1.0}) : (Vec2{1.0, 0.0}));
  }
  EXPECT_EQ(touches(b, {0.95, 1.1}).count, 1);  // behind the wall only
  // A joint that turns inwards by 0.05 rad holds by the nearer segment alone.
  const Body flat = body_of({{0, 0}, {2, 0}, {2, 1}, {1, 0.95}, {0, 1}});
  EXPECT_EQ(touches(flat, {1.0, 0.9}).count, 1);
  const Body bent = body_of({{0, 0}, {2, 0}, {2, 1}, {1, 0.9}, {0, 1}});
  EXPECT_EQ(touches(bent, {1.0, 0.85}).count, 2);
}

TEST(Boundary, ABodyAndItsOwnNodes) {
  const Body b = body_of(notched, std::vector<int>(8, 0));
  const auto query = BoundaryQuery{b.boundary, b.points, b.all, 0.5};
  for (int node = 0; node < 8; ++node)  // nothing at rest touches itself
    EXPECT_EQ(
        touch_boundary({b.points[static_cast<std::size_t>(node)], node, 0, true}, query).count, 0);
  // The notch closes: a node of one wall behind the other.
  std::vector<Vec2> closing = notched;
  closing[3].x = 0.95;
  closing[3].y = 1.8;
  const auto moved = BoundaryQuery{b.boundary, closing, b.all, 0.5};
  const EdgeTouches self = touch_boundary({closing[3], 3, 0, true}, moved);
  ASSERT_EQ(self.count, 1);
  EXPECT_EQ(self.at[0].edge, 5);
  EXPECT_EQ(touch_boundary({closing[3], 3, 0, false}, moved).count, 0);  // not asked for
}

/// The arc's point under each segment is another one; beyond a joint the node is what touches.
TEST(Boundary, AnArcOfTheGroundTouchesWhereTheSegmentMeetsItFirst) {
  const Body b = body_of({{0, 0.1}, {1, 0}, {2, 0.1}, {2, 1}, {0, 1}});
  const auto at = [&](double x, double top) {  // of a post with a round head of radius 0.2
    const Corner head{{x, top}, {Vec2{-1, 0}, Vec2{1, 0}}, {x, top - 0.2}, 0.2};
    return touch_boundary({.position = head.position, .bend = &head},
                          {b.boundary, b.points, b.all, 0.3});
  };
  const double slope = std::atan(0.1);
  const EdgeTouches left = at(0.5, 0.1);
  ASSERT_EQ(left.count, 1);
  EXPECT_EQ(left.at[0].edge, 0);
  // The center is 0.15 below the segment, along y.
  EXPECT_NEAR(left.at[0].touch.gap, 0.15 * std::cos(slope) - 0.2, 1e-15);
  EXPECT_NEAR(left.at[0].touch.at * norm(Vec2{1.0, 0.1}),
              0.5 / std::cos(slope) + 0.15 * std::sin(slope), 1e-15);
  EXPECT_EQ(at(1.5, 0.1).at[0].edge, 1);
  EXPECT_EQ(at(1.0, 0.1).count, 0);  // on either side the foot is beyond the node
  EXPECT_EQ(at(0.5, 0.04).count, 0);
}

TEST(Boundary, EachBodyHoldsByItself) {
  // Two blocks side by side, a point in both: a crevice holds by both walls.
  std::vector<Vec2> points{{0, 0}, {1.01, 0}, {1.01, 1}, {0, 1}, {1, 0}, {2, 0}, {2, 1}, {1, 1}};
  const std::vector<int> body{0, 0, 0, 0, 1, 1, 1, 1};
  std::vector<std::array<int, 2>> edges;
  for (int i = 0; i < 4; ++i) edges.push_back({i, (i + 1) % 4});
  for (int i = 0; i < 4; ++i) edges.push_back({4 + i, 4 + (i + 1) % 4});
  const Boundary boundary = make_boundary(edges, body);
  std::vector<int> all{0, 1, 2, 3, 4, 5, 6, 7};
  const EdgeTouches t = touch_boundary({.position = {1.004, 0.5}}, {boundary, points, all, 0.3});
  ASSERT_EQ(t.count, 2);
  EXPECT_EQ(t.at[0].edge, 1);
  EXPECT_EQ(t.at[1].edge, 7);
  EXPECT_NEAR(t.at[0].touch.gap, -0.006, 1e-15);
  EXPECT_NEAR(t.at[1].touch.gap, -0.004, 1e-15);
}

/// On random stars a point touches if it is inside and no deeper than the limit, at the depth of
/// its distance from the boundary wherever the foot is on a segment.
TEST(Boundary, TouchesWhatIsInsideARandomBody) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  int held = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<Vec2> points;
    const int n = 12 + static_cast<int>(random() % 20);
    for (int i = 0; i < n; ++i)
      points.push_back((1.0 + 0.1 * u(random)) * direction_at(2.0 * std::numbers::pi * i / n));
    const Body b = body_of(points);
    for (int i = 0; i < 300; ++i) {
      const Vec2 p = (1.0 + 0.1 * u(random)) * direction_at(4.0 * u(random));
      const double depth = distance_to(points, p);
      const EdgeTouches t = touches(b, p, 0.1);
      const bool in = inside(points, p);
      if (!in) {
        ASSERT_EQ(t.count, 0);
      }
      if (!in || depth > 0.09) continue;
      ASSERT_GE(t.count, 1) << round << " " << i;
      const SegmentTouch& touch = t.at[0].touch;
      if (touch.at > 0.0 && touch.at < 1.0) {
        ASSERT_LT(-touch.gap - depth, 0.02);
      }
      ++held;
    }
  }
  EXPECT_GT(held, 10000);
}

}  // namespace segment_test
