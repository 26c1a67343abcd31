// SPDX-License-Identifier: BSD-3-Clause
/// What friction takes by node and by place (docs/wear.md): its sums are the ledger's, in all
/// steps, and the fused steps have what the readable ones have, with the same bits for any threads.
#include "rondo/model/friction_work.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "integrator_cases.hpp"
#include "rondo/core/sum.hpp"
#include "rondo/integrators/general/general_integrator.hpp"
#include "rondo/integrators/general/wheel_integrator.hpp"
#include "rondo/integrators/integrator.hpp"
#include "rondo/integrators/solid/solid_integrator.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/mesh/edges.hpp"
#include "rondo/model/steps/step_table.hpp"
#include "support/blocks.hpp"
#include "support/implicit.hpp"
#include "support/solid_wheel.hpp"
#include "support/stepping.hpp"

namespace friction_work_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

enum class By { itself, readable };

std::unique_ptr<Integrator> step_of_model(const Model& model, const State& state, By by) {
  if (by == By::itself) return make_integrator(model, state);
  if (model.solid) return std::make_unique<SolidIntegrator>(model, state);
  if (model.rim) return std::make_unique<WheelIntegrator>(model, state);
  return std::make_unique<GeneralIntegrator>(model, state);
}

/// What a run found.
struct Found {
  std::vector<double> nodes, places, saved;
  double by_nodes = 0.0, by_places = 0.0;  ///< sums of them                       [J/m], [J]
  double ledger = 0.0;                     ///< of the reports, and in the last balance
  double balance = 0.0;                    ///< of the steps but for the last one
  double before_last = 0.0;                ///< of the reports but for the last one
  double exchanged = 0.0;                  ///< Σ |friction of a step|
};

double sum_over(const std::vector<double>& values, const std::function<double(std::size_t)>& by) {
  CompensatedSum sum;
  for (std::size_t k = 0; k < values.size(); ++k) sum.add(values[k] * by(k));
  return sum.value();
}

Found run(Model model, const std::vector<Vec2>& u, const std::vector<Vec2>& v, int steps,
          int threads = 1, By by = By::itself) {
  model.threads = threads;
  model.friction_work = std::make_shared<FrictionWork>(model);
  const FrictionWork& work = *model.friction_work;
  const State state = model.solid
                          ? start(model, Field(model.n_nodes(), 3), Field(model.n_nodes(), 3))
                          : start(model, u, v);
  const auto integrator = step_of_model(model, state, by);
  std::vector<StepReport> reports(40);
  Found f;
  CompensatedSum ledger;
  for (int n = 0; n < steps; n += 40) {
    integrator->advance(reports);
    for (const StepReport& r : reports) {
      f.before_last = ledger.value();
      ledger.add(r.contact.dissipation_friction);
      f.exchanged += std::abs(r.contact.dissipation_friction);
    }
  }
  f.ledger = ledger.value();
  f.balance = reports.back().balance.works.dissipation_friction;
  f.nodes = work.by_node();
  f.places = work.by_place();
  f.saved = model.friction_work->save();
  const std::vector<double>& tributary =
      model.contact ? model.contact->tributary : model.surfaces->tributary;
  f.by_nodes = sum_over(f.nodes, [&](std::size_t k) { return tributary[k]; });
  const std::size_t across = work.across().count;
  f.by_places = sum_over(f.places, [&](std::size_t i) {
    const bool at_side = i % across == 0 || i % across + 1 == across;
    const double width = model.solid ? (at_side ? 0.5 : 1.0) * work.across().distance : 1.0;
    return work.along().distance * width;
  });
  return f;
}

void expect_sums(const Found& f, bool places = true) {
  EXPECT_GT(f.exchanged, 0.0);
  EXPECT_NEAR(f.by_nodes, f.ledger, 1e-12 * f.exchanged);
  EXPECT_NEAR(f.before_last, f.balance, 1e-12 * f.exchanged) << "the ledger's own sum";
  EXPECT_NEAR(places ? f.by_places : f.by_nodes, f.by_nodes, 1e-13 * f.exchanged);
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (const double x : a) largest = std::max(largest, std::abs(x));
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-8 * largest) << k;
}

/// Contacts at facets, at corners, with restitution, on a loaded rim, without mass; of a tread.
std::vector<test::RollingCase> plane_cases() {
  const mesh::Tread tread{20, 0.02, 3, 1, 2};
  std::vector<test::RollingCase> all{test::everything("smooth", 6, 90),
                                     test::everything("treaded", 3, tread),
                                     test::sharp(test::everything("smooth", 6, 90)),
                                     test::sharp(test::everything("treaded", 3, tread)),
                                     test::small_arcs(test::everything("smooth", 6, 90)),
                                     test::massless(test::everything("smooth", 6, 90)),
                                     test::everything("restitution", 6, 90)};
  all.back().law = {0.3, 0.5};
  all.back().ground = test::ledge();
  for (const std::size_t k : {0U, 2U}) all.push_back(test::on_rim(all[k], false, true, true));
  for (test::RollingCase& c : all) c.disk.motion.start_x = -0.02;
  return all;
}

class PlaneWork : public testing::TestWithParam<std::tuple<test::RollingCase, StiffnessOperator>> {
};

/// A box wheel with camber and slip, over flat ground or a post with sharp corners.
Model wheel(const mesh::Mesh& mesh, bool post) {
  test::Cornering rolling;
  rolling.camber = 0.05;
  rolling.slip_angle = 0.05;
  Model m = test::cornering_model(mesh, rolling);
  contact::GroundShape ground;
  if (post) ground.profile = {{-9, 0}, {0.02, 0}, {0.02, 0.003}, {0.03, 0.003}, {0.03, 0}, {9, 0}};
  test::touch_corners(mesh, ground, {.friction = 0.3}, m);
  return m;
}

}  // namespace

TEST_P(PlaneWork, IsThatOfTheLedgerAndOfTheReadableStep) {
  const auto& [c, of] = GetParam();
  const test::Built b = test::build(c);
  const Model model = test::model_with(b, of);
  const std::vector<Vec2> u = test::some_displacement(b), v = test::some_velocity(b);
  const Found fused = run(model, u, v, 400);
  expect_sums(fused);
  const Found threads = run(model, u, v, 400, 3);
  EXPECT_EQ(fused.saved, threads.saved);
  const Found readable = run(b.model, u, v, 400, 1, By::readable);
  expect_sums(readable);
  if (b.model.contact->ground.corners().empty()) expect_near(readable.nodes, fused.nodes);
}

INSTANTIATE_TEST_SUITE_P(FrictionWork, PlaneWork,
                         testing::Combine(testing::ValuesIn(plane_cases()),
                                          testing::ValuesIn(test::both_operators)),
                         [](const auto& info) {
                           return std::get<0>(info.param).name + "_" + std::to_string(info.index);
                         });

TEST(FrictionWork, OfImplicitElementsAtTheGround) {
  test::Built b = test::build(test::everything("", 6, 90));
  b.model.implicit = test::implicit_part(b.mesh, b.materials, test::cells_of_layers(b.mesh, {6}));
  b.model.motion.start_x = -0.02;
  const std::vector<Vec2> u = test::some_displacement(b), v = test::some_velocity(b);
  const Found readable = run(b.model, u, v, 400, 1, By::readable);
  expect_sums(readable);
  for (const StiffnessOperator of : test::both_operators) {
    const Found fused = run(test::model_with(b, of), u, v, 400, 2);
    expect_sums(fused);
    expect_near(readable.nodes, fused.nodes);
  }
}

TEST(FrictionWork, OfAWheelInThreeDimensions) {
  const mesh::Mesh mesh = mesh::make_wheel(test::box_wheel(3, 4, 90));
  for (const bool post : {false, true}) {
    const Model model = wheel(mesh, post);
    ASSERT_EQ(step_of(model), StepKind::solid_cyclic);
    const Found fused = run(model, {}, {}, 400);
    expect_sums(fused);
    EXPECT_EQ(fused.saved, run(model, {}, {}, 400, 3).saved);
    const Found readable = run(model, {}, {}, 400, 1, By::readable);
    expect_sums(readable);
    if (!post) expect_near(readable.nodes, fused.nodes);
    // Within the footprint, and on both sides of the wheel's plane.
    const std::size_t across = 5, along = fused.places.size() / across;
    double front = 0.0, left = 0.0, right = 0.0;
    for (std::size_t i = 0; i < fused.places.size(); ++i) {
      if (std::abs(static_cast<double>(i / across) + 0.5 - 0.5 * static_cast<double>(along)) > 8)
        front += std::abs(fused.places[i]);
      (i % across < across / 2 ? left : right) += std::abs(fused.places[i]);
    }
    EXPECT_EQ(front, 0.0);
    EXPECT_GT(std::min(left, right), 0.0);
  }
}

/// Two blocks rub on each other and on the ground: each has half of what is between them.
TEST(FrictionWork, OfBodiesIsSharedByBoth) {
  mesh::Mesh mesh;
  test::add_block(mesh, {.corner = {0.0, 0.0}, .columns = 5, .rows = 4});
  test::add_block(mesh, {.corner = {0.07, 1.001}, .columns = 9, .rows = 7, .turned = 0.004});
  const fem::Material rubber{1.0e6, 0.3, 1000.0, fem::Plane::strain};
  Model model = test::body_model(mesh, rubber, 1.0, 1e-5, 0.8);
  model.motion.gravity = Table(9.81);
  test::add_surfaces(model, mesh, {0.5, 0.1});
  test::add_ground(model, mesh, {.profile = {{-9, -0.001}, {9, -0.001}}}, {0.4, 0.2});
  const std::vector<Vec2> u(model.n_nodes());
  std::vector<Vec2> v(model.n_nodes());
  for (std::size_t k = 0; k < v.size(); ++k)
    v[k] = model.free_body[k] == 0 ? Vec2{0.5, -0.5} : Vec2{-0.5, -2.0};
  const Found fused = run(model, u, v, 400);
  EXPECT_TRUE(fused.places.empty()) << "free bodies have no center";
  expect_sums(fused, false);
  EXPECT_EQ(fused.saved, run(model, u, v, 400, 2).saved);
  const Found readable = run(model, u, v, 400, 1, By::readable);
  expect_sums(readable, false);
  expect_near(readable.nodes, fused.nodes);
}

TEST(FrictionWork, WhatIsBetweenTwoPlacesBelongsToBoth) {
  const PlaceAxis axis{-0.75, 0.5, 4};
  EXPECT_EQ(axis.places(), (std::vector<double>{-0.75, -0.25, 0.25, 0.75}));
  struct Row {
    double x;
    std::size_t before;
    double behind;
  };
  for (const auto& [x, before, behind] : {Row{-5.0, 0, 0.0},
                                          {-0.75, 0, 0.0},
                                          {-0.5, 0, 0.5},
                                          {-0.25, 1, 0.0},
                                          {0.0, 1, 0.5},
                                          {0.625, 2, 0.75},
                                          {0.75, 2, 1.0},
                                          {7.0, 2, 1.0}}) {
    EXPECT_EQ(axis.share_of(x).before, before) << x;
    EXPECT_EQ(axis.share_of(x).behind, behind) << x;
  }
  EXPECT_EQ(PlaceAxis{}.share_of(3.0).behind, 0.0) << "one place has all";
}

/// A row of nodes that is shifted by some of the distance of two rows does not jump from one place
/// to the other, and the sides of the tread are as dense as the nodes there.
TEST(FrictionWork, PlacesAreAsDenseAsTheNodes) {
  const Model model = wheel(mesh::make_wheel(test::box_wheel(3, 4, 90)), false);
  FrictionWork work(model);
  const std::vector<double> z = work.across().places();
  for (const double shift : {0.0, 0.4, 0.5, 0.6}) {
    work.clear();
    for (std::size_t row = 0; row < z.size(); ++row) {
      const double share = row == 0 || row + 1 == z.size() ? 0.5 : 1.0;  // of the area
      ActiveContact c;
      c.before = c.after = {0.0, -1.0, 0.0};
      c.impulse = {1.0, share, 0.0};
      work.add({0.0, 0.0, z[row] + shift * work.across().distance}, {&c, 1});
    }
    work.settle();
    const std::vector<double> places = work.by_place();
    const std::size_t row = places.size() / z.size() / 2 * z.size();
    for (std::size_t k = 1; k + 2 < z.size(); ++k)
      EXPECT_NEAR(places[row + k + 1], places[row + k], (0.51 * shift + 1e-12) * places[row + 2])
          << shift;
    if (shift == 0.0) {
      EXPECT_NEAR(places[row], places[row + 1], 1e-12 * places[row]);
    }
  }
}

/// As long as the nodes are apart, out to the radius, both ways.
TEST(FrictionWork, PlacesFollowTheNodes) {
  const test::Built b = test::build(test::everything("", 6, 90));
  const FrictionWork plane(b.model);
  EXPECT_EQ(plane.along().count, 29U);  // 90/π
  EXPECT_NEAR(plane.along().places().front(), -plane.along().places().back(), 1e-15);
  EXPECT_EQ(plane.across().count, 1U);
  const FrictionWork space(wheel(mesh::make_wheel(test::box_wheel(3, 4, 90)), false));
  EXPECT_EQ(space.along().count, 29U);
  ASSERT_EQ(space.across().count, 5U);
  const std::vector<double> z = space.across().places();
  EXPECT_NEAR(z.front(), -0.05, 1e-15);
  EXPECT_NEAR(z.back(), 0.05, 1e-15);
}

}  // namespace friction_work_test
