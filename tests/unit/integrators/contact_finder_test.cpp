// SPDX-License-Identifier: BSD-3-Clause
/// The search for contacts only looks where something may have changed: it finds what a search of
/// everything finds, to the bit.
#include "rondo/integrators/general/contact_finder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include "support/blocks.hpp"

namespace rondo::dynamics::contact_finder_test {
namespace {

const fem::Material rubber{1.0e6, 0.3, 1000.0, fem::Plane::strain};

bool same(const ContactRow& a, const ContactRow& b) {
  if (a.kind != b.kind || a.key != b.key || a.normal != b.normal || a.point != b.point ||
      a.gap != b.gap || a.tributary != b.tributary || a.rows.count != b.rows.count)
    return false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.rows.count); ++i)
    if (a.rows.node[i] != b.rows.node[i]) return false;
  return true;
}

struct Seen {
  std::size_t rows = 0, most = 0, places = 0;
};

void expect_same(const std::vector<ContactRow>& found, const std::vector<ContactRow>& expected,
                 int n) {
  EXPECT_EQ(found.size(), expected.size()) << n;
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i)
    EXPECT_TRUE(same(found[i], expected[i])) << "step " << n << " row " << i;
}

double farthest(std::span<const Vec2> from, std::span<const Vec2> to) {
  double most = 0.0;
  for (std::size_t k = 0; k < from.size(); ++k) most = std::max(most, norm(to[k] - from[k]));
  return most;
}

/// Places of the nodes move by `step` each time; all that is found is the same as of a search that
/// knows nothing of before, by what looks at all places and by what only knows how far they came.
template <class Step>
Seen compare(const Model& model, int steps, Step&& step) {
  ContactFinder finder(model), travelled(model), fresh(model);
  State state(model), near_alone(model);
  std::vector<ContactRow> found, expected;
  Seen seen;
  for (int n = 0; n < steps; ++n) {
    const std::vector<Vec2> before = to_vector(state.u.plane());
    step(n, state.u.plane());
    fresh.forget();
    fresh.find(state, expected);
    finder.find(state, found);
    expect_same(found, expected, n);
    const std::span<const int> looked_at = travelled.boundary_after(farthest(before, state.u));
    for (const int node : looked_at)
      near_alone.u.plane()[static_cast<std::size_t>(node)] =
          state.u.plane()[static_cast<std::size_t>(node)];
    seen.places += looked_at.size();
    travelled.find(near_alone, found);
    expect_same(found, expected, n);
    if (testing::Test::HasFailure()) break;
    seen.rows += found.size();
    seen.most = std::max(seen.most, found.size());
  }
  EXPECT_LT(finder.builds(), fresh.builds() / 2);
  return seen;
}

/// Of every candidate and every edge, without lists.
std::size_t touches_by_trying_all(const Model& model, const State& state) {
  const contact::Boundary surface = contact::make_boundary(model.surfaces->edges, model.body);
  const auto at = [](int node) { return static_cast<std::size_t>(node); };
  std::vector<Vec2> x(model.n_nodes()), outward(model.n_nodes());
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = position(model, state, k);
  const auto normal = [&](const mesh::Edge& e) {
    const Vec2 along = x[at(e[1])] - x[at(e[0])];
    return -turn90(along) / norm(along);
  };
  for (const mesh::Edge& e : surface.edges)
    for (const int node : e) outward[at(node)] += normal(e);
  std::size_t n = 0;
  for (const int node : model.surfaces->nodes) {
    std::vector<int> facing;
    for (std::size_t i = 0; i < surface.edges.size(); ++i)
      if (dot(outward[at(node)], normal(surface.edges[i])) < 0.0)
        facing.push_back(static_cast<int>(i));
    const auto touches = contact::touch_boundary({x[at(node)], node, model.body[at(node)], false},
                                                 {surface, x, facing, 0.05});
    n += static_cast<std::size_t>(touches.count);
  }
  return n;
}

}  // namespace

/// Two blocks pass each other, one turning, touching at first here and then there.
TEST(ContactFinder, FindsWhatASearchOfEverythingFinds) {
  mesh::Mesh mesh;
  test::add_block(mesh, {.corner = {0.0, 0.0}, .columns = 10, .rows = 8});
  test::add_block(mesh, {.corner = {0.07, 0.99}, .columns = 9, .rows = 7});
  Model model = test::body_model(mesh, rubber, 0.0, 0.0, 0.8);
  test::add_surfaces(model, mesh, {0.3, 0.0});
  test::add_ground(model, mesh, {.profile = {{-9, 0.01}, {0.33, 0.01}, {9, -0.3}}, .fillet = 0.2},
                   {0.3, 0.0});
  bool tried = false;
  const Seen seen = compare(model, 400, [&](int n, std::span<Vec2> u) {
    const Complex turn = rotation(0.3 * std::sin(0.01 * n));
    for (const int node : model.free_bodies[1].nodes) {
      const auto k = static_cast<std::size_t>(node);
      const Vec2 arm = model.reference[k] - model.free_bodies[1].center;
      u[k] = turn * arm - arm + Vec2{0.004 * n, 0.02 * std::sin(0.05 * n)};
    }
    if (n != 20) return;
    State state(model);
    state.u = to_vector(u);
    ContactFinder finder(model);
    std::vector<ContactRow> rows;
    finder.find(state, rows);
    std::erase_if(rows, [](const ContactRow& row) { return row.kind != ContactKind::segment; });
    EXPECT_EQ(rows.size(), touches_by_trying_all(model, state));
    tried = rows.size() > 3;
  });
  EXPECT_TRUE(tried);
  EXPECT_GT(seen.rows, 3000U);
  EXPECT_GT(seen.most, 15U);
  EXPECT_LT(seen.places, 400 * model.surfaces->nodes.size() * 3 / 4);
}

/// A strip that is bent until its ends overlap: it may touch itself.
TEST(ContactFinder, FindsWhereABodyTouchesItself) {
  mesh::Mesh mesh;
  test::add_block(mesh,
                  {.corner = {0.0, 0.0}, .width = 6.0, .height = 0.3, .columns = 60, .rows = 3});
  Model model = test::body_model(mesh, rubber, 0.0, 0.0, 0.8);
  test::add_surfaces(model, mesh, {0.3, 0.0}, true);
  const Seen seen = compare(model, 300, [&](int n, std::span<Vec2> u) {
    const double radius = 6.0 / (4.0 + 0.01 * n);  // ends meet at 2π of 6
    for (std::size_t k = 0; k < u.size(); ++k) {
      const Vec2 x = model.reference[k];
      u[k] = (radius - x.y) * direction_at(x.x / radius) - x;
    }
  });
  EXPECT_GT(seen.rows, 20U);
}

}  // namespace rondo::dynamics::contact_finder_test
