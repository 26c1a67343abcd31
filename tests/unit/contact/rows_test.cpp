// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/rows.hpp"

#include <gtest/gtest.h>

#include <random>

#include "rondo/contact/coupled/clusters.hpp"
#include "rondo/contact/coupled/node_to_segment.hpp"
#include "rondo/core/complex.hpp"
#include "support/contact_oracles.hpp"

namespace rows_test {

using namespace rondo;
using namespace rondo::contact;

namespace {

/// A segment a→b anywhere, and a point beside it at foot ξ and gap g.
struct Place {
  Vec2 a, b, p;
  SegmentTouch touch;
  double length;
};

Place random_place(std::mt19937& random) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Place out;
  out.a = {u(random), u(random)};
  out.length = 0.1 + 0.05 * u(random);
  const Vec2 along = direction_at(3.0 * u(random));
  out.b = out.a + out.length * along;
  out.touch = {.gap = 0.05 * u(random), .at = 0.5 + 0.7 * u(random), .normal = -turn90(along)};
  out.p = out.a + out.touch.at * out.length * along + out.touch.gap * out.touch.normal;
  return out;
}

}  // namespace

TEST(NodeToSegment, EveryRigidMotionGivesZero) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const Place x = random_place(random);
    const SegmentRows h = segment_rows(x.touch, x.length);
    const Vec2 shift{u(random), u(random)}, about{u(random), u(random)};
    const double rate = 10.0 * u(random);
    const auto v = [&](Vec2 point) { return shift + rate * turn90(point - about); };
    const Vec2 w = apply(h.point, v(x.p)) + apply(h.a, v(x.a)) + apply(h.b, v(x.b));
    ASSERT_LT(norm(w), 2e-14);  // roundings of velocities up to 30
  }
}

TEST(NodeToSegment, ImpulsesHaveNoResultantAndNoMoment) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const Place x = random_place(random);
    const SegmentRows h = segment_rows(x.touch, x.length);
    const Vec2 r{u(random), u(random)};
    const Vec2 on_p = transposed(h.point, r), on_a = transposed(h.a, r), on_b = transposed(h.b, r);
    ASSERT_LT(norm(on_p + on_a + on_b), 1e-15);
    // Roundings of arms up to 1.5 and impulses up to 2.
    ASSERT_LT(std::abs(cross(x.p, on_p) + cross(x.a, on_a) + cross(x.b, on_b)), 4e-15);
    ASSERT_LT(norm(on_p - from_frame(x.touch.normal, r)),
              1e-15);  // r acts on the point, in its frame
  }
}

TEST(NodeToSegment, TheRateOfTheGapIsTheNormalVelocity) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const double dt = 1e-6;
  for (int i = 0; i < 1000; ++i) {
    const Place x = random_place(random);
    const Vec2 vp{u(random), u(random)}, va{u(random), u(random)}, vb{u(random), u(random)};
    const auto gap = [&](double t) {
      const Vec2 a = x.a + t * va, along = x.b + t * vb - a;
      return -cross(along, x.p + t * vp - a) / norm(along);
    };
    const SegmentRows h = segment_rows(x.touch, x.length);
    const Vec2 w = apply(h.point, vp) + apply(h.a, va) + apply(h.b, vb);
    // A central difference: its error is dt² times third derivatives of order v³/L² = 1e4.
    ASSERT_NEAR((gap(dt) - gap(-dt)) / (2.0 * dt), w.x, 1e-7);
  }
}

TEST(NodeToSegment, TangentialVelocityIsThatOfTheFootOnTheSegment) {
  // The segment along +x, its body above: n = -y, t = +x. The point slides to the right.
  const SegmentTouch touch{.gap = 0.0, .at = 0.25, .normal = {0.0, -1.0}};
  const SegmentRows h = segment_rows(touch, 2.0);
  EXPECT_EQ(apply(h.point, {3.0, 0.0}), (Vec2{0.0, 3.0}));
  EXPECT_EQ(apply(h.a, {1.0, 0.0}), (Vec2{0.0, -0.75}));
  EXPECT_EQ(apply(h.b, {1.0, 0.0}), (Vec2{0.0, -0.25}));
  EXPECT_EQ(apply(h.point, {0.0, -1.0}).x, 1.0);  // away from the body
}

TEST(NodeToSegment, ACornerOfTheGroundIsAPointAtRest) {
  const SegmentTouch touch{.gap = -0.01, .at = 0.4, .normal = {0.0, -1.0}};
  const ContactRows node = node_rows(touch, 0.5, 7, 8, 9), corner = corner_rows(touch, 0.5, 8, 9);
  EXPECT_EQ(node.count, 3);
  EXPECT_EQ(corner.count, 2);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(corner.node[k], node.node[k + 1]);
    EXPECT_EQ(corner.block[k], node.block[k + 1]);
  }
}

TEST(Delassus, IsTheProductOfRowsAndResponses) {
  for (const double turn : {0.0, 0.2}) {
    test::Scene scene = test::chain({.upper = 9, .lower = 7, .both_ways = true, .turn = turn});
    scene.add(ground_rows(3, direction_at(1.4)), 0.3);
    scene.add(ground_rows(3, direction_at(1.7)), 0.3);
    const auto nc = static_cast<Eigen::Index>(scene.contacts.size());
    const auto nodes = static_cast<Eigen::Index>(scene.response.size());
    Eigen::MatrixXd h = Eigen::MatrixXd::Zero(2 * nc, 2 * nodes);
    Eigen::MatrixXd g = Eigen::MatrixXd::Zero(2 * nodes, 2 * nodes);
    for (Eigen::Index j = 0; j < nc; ++j) {
      const ContactRows& c = scene.contacts[static_cast<std::size_t>(j)];
      for (std::size_t k = 0; k < static_cast<std::size_t>(c.count); ++k) {
        const Block& b = c.block[k];
        h.block<2, 2>(2 * j, 2 * c.node[k]) << b[0], b[1], b[2], b[3];
      }
    }
    for (Eigen::Index k = 0; k < nodes; ++k) {
      const Complex z = scene.response[static_cast<std::size_t>(k)];
      g.block<2, 2>(2 * k, 2 * k) << z.re, -z.im, z.im, z.re;
    }
    const Eigen::MatrixXd expected = h * g * h.transpose();
    const CoupledProblem p = test::problem_of(scene);
    // Sums of a few products: relative to the largest entry.
    EXPECT_LT((test::dense(p) - expected).cwiseAbs().maxCoeff(),
              1e-15 * expected.cwiseAbs().maxCoeff());
    for (std::size_t j = 0; j < p.size(); ++j) {
      const Block& w = diagonal_block(p, j);
      EXPECT_NEAR(p.mass[j], 2.0 / (w[0] + w[3]), 1e-15 * p.mass[j]);
      for (int k = p.row_start[j] + 1; k < p.row_start[j + 1]; ++k)
        EXPECT_LT(p.column[static_cast<std::size_t>(k) - 1], p.column[static_cast<std::size_t>(k)]);
    }
    const double skew = (test::dense(p) - test::dense(p).transpose()).norm();
    EXPECT_EQ(skew < 1e-12, turn == 0.0);
  }
}

TEST(Delassus, TheSameMemoryServesTheNextProblem) {
  const test::Scene large = test::chain({.upper = 12, .lower = 9, .both_ways = true});
  const test::Scene small = test::chain({.upper = 4, .lower = 5});
  DelassusBuilder builder;
  CoupledProblem p, fresh;
  builder.build(large.contacts, large.response, p);
  builder.build(small.contacts, small.response, p);
  DelassusBuilder().build(small.contacts, small.response, fresh);
  EXPECT_EQ(p.row_start, fresh.row_start);
  EXPECT_EQ(p.column, fresh.column);
  EXPECT_EQ(p.blocks, fresh.blocks);
  EXPECT_EQ(p.mass, fresh.mass);
}

TEST(Clusters, AreTheContactsThatSharedNodesJoin) {
  std::mt19937 random(4);
  ClusterFinder finder;
  for (int round = 0; round < 300; ++round) {
    const int nodes = 1 + static_cast<int>(random() % 40), nc = static_cast<int>(random() % 30);
    std::vector<int> start{0}, list;
    for (int j = 0; j < nc; ++j) {
      for (unsigned k = 0; k < 1 + random() % 3; ++k)
        list.push_back(static_cast<int>(random() % static_cast<unsigned>(nodes)));
      start.push_back(static_cast<int>(list.size()));
    }
    const auto share = [&](int i, int j) {
      for (int a = start[static_cast<std::size_t>(i)]; a < start[static_cast<std::size_t>(i) + 1];
           ++a)
        for (int b = start[static_cast<std::size_t>(j)]; b < start[static_cast<std::size_t>(j) + 1];
             ++b)
          if (list[static_cast<std::size_t>(a)] == list[static_cast<std::size_t>(b)]) return true;
      return false;
    };
    std::vector<int> label(static_cast<std::size_t>(nc));
    for (int j = 0; j < nc; ++j) label[static_cast<std::size_t>(j)] = j;
    for (bool changed = true; changed;) {
      changed = false;
      for (int i = 0; i < nc; ++i)
        for (int j = 0; j < nc; ++j) {
          int &a = label[static_cast<std::size_t>(i)], &b = label[static_cast<std::size_t>(j)];
          if (share(i, j) && a != b) a = b = std::min(a, b), changed = true;
        }
    }
    const Clusters& clusters = finder.find(start, list, static_cast<std::size_t>(nodes));
    std::vector<int> seen;
    int before = -1;
    for (std::size_t k = 0; k < clusters.size(); ++k) {
      ASSERT_FALSE(clusters[k].empty());
      ASSERT_GT(clusters[k].front(), before);  // in the order of their first contacts
      before = clusters[k].front();
      ASSERT_TRUE(std::is_sorted(clusters[k].begin(), clusters[k].end()));
      for (const int j : clusters[k]) {
        ASSERT_EQ(label[static_cast<std::size_t>(j)], before);
        seen.push_back(j);
      }
    }
    std::sort(seen.begin(), seen.end());
    ASSERT_EQ(seen.size(), static_cast<std::size_t>(nc));
    ASSERT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
  }
}

}  // namespace rows_test
