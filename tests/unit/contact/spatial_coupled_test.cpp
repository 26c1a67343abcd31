// SPDX-License-Identifier: BSD-3-Clause
/// Contacts in space that share nodes: alone and in pairs as the other solvers have them, and a
/// corner of the ground on an edge whose nodes touch the ground as well.
#include "rondo/contact/coupled/spatial_coupled.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "rondo/contact/cone_pair.hpp"
#include "rondo/contact/coupled/node_to_segment.hpp"

namespace spatial_coupled_test {

using namespace rondo;
using namespace rondo::contact;

namespace {

/// Rows of a contact on some nodes.
struct Rows {
  std::vector<std::size_t> node;
  std::vector<SpatialBlock> block;
};

Rows on_facet(std::size_t node, double angle) {
  const Vec2 n{-std::sin(angle), std::cos(angle)}, t = turn90(n);
  return {{node}, {{Vec3(n), Vec3(t), Vec3{0.0, 0.0, 1.0}}}};
}

SpatialBlock in_space(const Block& h, double lateral) {
  return {Vec3{h[0], h[1], 0.0}, Vec3{h[2], h[3], 0.0}, Vec3{0.0, 0.0, lateral}};
}

/// The edge's normal points down, but for the angle.
Rows on_edge(std::size_t a, std::size_t b, double at, double angle) {
  const SegmentTouch touch{-1e-5, at, {std::sin(angle), -std::cos(angle)}};
  const SegmentRows h = segment_rows(touch, 0.02);
  return {{a, b}, {in_space(h.a, at - 1.0), in_space(h.b, -at)}};
}

/// Nodes that move by themselves, with masses of their own.
struct Nodes {
  std::vector<double> mass;
  std::vector<Vec3> velocity;
};

SpatialCoupled problem_of(const Nodes& nodes, const std::vector<Rows>& contacts, double friction) {
  const Complex turn{std::cos(1e-3), std::sin(1e-3)};
  SpatialCoupled p;
  for (const Rows& j : contacts) {
    Vec3 w;
    for (std::size_t a = 0; a < j.node.size(); ++a)
      w += contact::apply(j.block[a], nodes.velocity[j.node[a]]);
    p.free.push_back(w);
    p.bounce.push_back(0.0);
    p.friction.push_back(friction);
    for (const Rows& l : contacts) {
      SpatialBlock sum{};
      for (std::size_t a = 0; a < j.node.size(); ++a)
        for (std::size_t b = 0; b < l.node.size(); ++b) {
          if (j.node[a] != l.node[b]) continue;
          const auto response = [&](Vec3 r) { return (turn * r) / nodes.mass[j.node[a]]; };
          for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 row = j.block[a][i];
            sum[i] += Vec3{dot(row, response(l.block[b][0])), dot(row, response(l.block[b][1])),
                           dot(row, response(l.block[b][2]))};
          }
        }
      p.blocks.push_back(sum);
    }
  }
  return p;
}

struct Solved {
  std::vector<Vec3> impulse;
  std::vector<Status> status;
  CoupledResult result;
};

Solved solve(const SpatialCoupled& p) {
  Solved s{std::vector<Vec3>(p.size()), std::vector<Status>(p.size()), {}};
  SpatialWorkspace work;
  s.result = solve_coupled(p, {}, s.impulse, s.status, work);
  return s;
}

/// The law, asked of every contact by itself.
void expect_law(const SpatialCoupled& p, const Solved& s) {
  double scale = 0.0;
  for (std::size_t j = 0; j < p.size(); ++j) scale = std::max(scale, norm(p.free[j]));
  for (std::size_t j = 0; j < p.size(); ++j) {
    Vec3 w = p.free[j];
    for (std::size_t l = 0; l < p.size(); ++l) w += contact::apply(p.block(j, l), s.impulse[l]);
    const Vec3 r = s.impulse[j];
    const double mass = p.mass(j), along = std::hypot(r.y, r.z);
    EXPECT_GE(r.x, 0.0);
    EXPECT_LE(along, p.friction[j] * r.x * (1.0 + 1e-12) + 1e-300);
    EXPECT_LE(law_residual(r, w, p.bounce[j], p.friction[j], mass) / mass, 1e-11 * scale);
  }
}

}  // namespace

TEST(SpatialCoupled, OneContactIsThatOfTheLawAlone) {
  const Nodes nodes{{0.01}, {{3.0, -2.0, 0.7}}};
  for (const double friction : {0.0, 0.3, 5.0}) {
    const SpatialCoupled p = problem_of(nodes, {on_facet(0, 0.2)}, friction);
    const auto alone = solve_spatial({p.free[0], p.block(0, 0), 0.0}, friction);
    const Solved s = solve(p);
    EXPECT_TRUE(s.result.converged);
    EXPECT_EQ(s.status[0], alone.status);
    EXPECT_LE(norm(s.impulse[0] - alone.impulse), 1e-15 * norm(alone.impulse));
  }
}

TEST(SpatialCoupled, TwoFacetsAtANodeStopItAsTheirOwnSolverDoes) {
  const Nodes nodes{{0.01}, {{0.4, -2.0, 0.5}}};
  const SpatialCoupled p = problem_of(nodes, {on_facet(0, 0.6), on_facet(0, -0.6)}, 0.4);
  const auto pair = solve_spatial_pair(
      {p.free[0],
       p.block(0, 0),
       {},
       rotation_between(Vec2{-std::sin(0.6), std::cos(0.6)}, Vec2{std::sin(0.6), std::cos(0.6)})},
      0.4);
  ASSERT_TRUE(pair.converged);
  const Solved s = solve(p);
  EXPECT_TRUE(s.result.converged);
  expect_law(p, s);
  const auto after = [&](Vec3 first, Vec3 second) {
    return p.free[0] + contact::apply(p.block(0, 0), first) + contact::apply(p.block(0, 1), second);
  };
  EXPECT_LE(norm(after(s.impulse[0], s.impulse[1]) -
                 after(pair.contact[0].impulse, pair.contact[1].impulse)),
            1e-11);
}

/// Both nodes of the edge on the ground, and a corner between them: W is singular.
TEST(SpatialCoupled, CornersOnEdgesWhoseNodesTouchAreSolved) {
  std::mt19937 random(3);
  const auto in = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  int slow = 0;
  for (int k = 0; k < 2000; ++k) {
    Nodes nodes;
    for (int i = 0; i < 3; ++i) {
      nodes.mass.push_back(in(0.005, 0.02));
      nodes.velocity.push_back({in(-5.0, 5.0), in(-10.0, 3.0), in(-2.0, 2.0)});
    }
    std::vector<Rows> contacts{on_facet(0, in(-0.7, 0.7)),
                               on_edge(0, 1, in(0.05, 0.95), in(-0.5, 0.5))};
    if (k % 2 == 0) contacts.push_back(on_facet(1, in(-0.7, 0.7)));
    if (k % 3 == 0) contacts.push_back(on_edge(1, 2, in(0.05, 0.95), in(-0.5, 0.5)));
    const SpatialCoupled p = problem_of(nodes, contacts, in(0.0, 0.6));
    const Solved s = solve(p);
    ASSERT_TRUE(s.result.converged) << k << ": " << s.result.residual;
    expect_law(p, s);
    slow += s.result.iterations > 20 ? 1 : 0;
  }
  EXPECT_GT(slow, 20);  // sweeps alone do not solve them
  EXPECT_LT(slow, 400);
}

/// What cannot be solved in so many iterations is told, with impulses inside the cones.
TEST(SpatialCoupled, TooFewIterationsAreTold) {
  const Nodes nodes{{0.01, 0.01}, {{4.0, -5.0, 0.3}, {-1.0, -4.0, 2.0}}};
  const SpatialCoupled p =
      problem_of(nodes, {on_facet(0, 0.1), on_edge(0, 1, 0.4, 0.1), on_facet(1, -0.2)}, 0.5);
  std::vector<Vec3> impulse(p.size());
  std::vector<Status> status(p.size());
  SpatialWorkspace work;
  const CoupledResult result = solve_coupled(p, {.most_iterations = 1}, impulse, status, work);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, 1);
  for (const Vec3 r : impulse) EXPECT_LE(std::hypot(r.y, r.z), 0.5 * r.x * (1.0 + 1e-12));
}

}  // namespace spatial_coupled_test
