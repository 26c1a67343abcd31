// SPDX-License-Identifier: BSD-3-Clause
/// The scheme "hati": the same bits however it is run, and what contact feels of the interface.
#include <gtest/gtest.h>

#include "support/parts.hpp"

namespace rondo::dynamics::hati_test {
namespace {

/// A disk of 8 layers over flat ground with a step, the outer `fine` layers fine.
test::Built disk(int fine, int ratio, int threads = 1) {
  auto c = test::rolling_disk(8, 40);
  c.motion.height = Table({{0.0, 0.3}, {0.002, 0.296}});
  auto b = test::build(c);
  test::add_ground(b, {.profile = {{-1.0, 0.0}, {-0.3, 0.0}, {-0.29, 0.004}, {1.0, 0.004}}},
                   {0.3, 0.0});
  b.model.contact->edges = b.mesh.contact_edges;
  const double layer = (0.3 - 0.15) / 8;
  test::divide(b.model, b.mesh, b.materials.front(),
               test::cells_beyond(b.mesh, 0.3 - (fine + 0.5) * layer), ratio, 1.0);
  b.model.dt = ratio * 0.8 * test::fine_critical_step(b.model, b.mesh, b.materials.front());
  b.model.threads = threads;
  return b;
}

/// State and reports of some steps, in one call or one by one, with a stop in between or not.
struct Course {
  State state;
  Works works;
  Vec2 impulse;
  double residual = 0.0;
};

Course course(const test::Built& b, bool one_by_one, int stop_after = 0) {
  constexpr int n = 60;
  Course c{State(b.model), {}, {}, 0.0};
  auto run = std::make_unique<HatiIntegrator>(b.model, test::start_at_rest(b.model));
  std::vector<StepReport> reports(one_by_one ? 1 : n);
  for (int step = 1; step <= n; step += static_cast<int>(reports.size())) {
    run->advance(reports, &c.state);
    for (const StepReport& report : reports) c.impulse += report.contact.impulse.plane();
    if (step != stop_after) continue;
    const SavedState saved = run->save();
    run = std::make_unique<HatiIntegrator>(b.model, test::start_at_rest(b.model));
    run->restore(saved);
  }
  c.works = reports.back().balance.works;
  c.residual = reports.back().balance.relative;
  return c;
}

void expect_same(const Course& a, const Course& b) {
  EXPECT_EQ(a.state.u, b.state.u);
  EXPECT_EQ(a.state.v, b.state.v);
  EXPECT_EQ(a.impulse, b.impulse);
  EXPECT_EQ(a.works.frame, b.works.frame);
  EXPECT_EQ(a.works.contact, b.works.contact);
  EXPECT_EQ(a.works.interface, b.works.interface);
  EXPECT_EQ(a.residual, b.residual);
  ASSERT_EQ(a.state.active.size(), b.state.active.size());
  for (std::size_t i = 0; i < a.state.active.size(); ++i)
    EXPECT_EQ(a.state.active[i].impulse, b.state.active[i].impulse);
}

}  // namespace

TEST(Hati, SameBitsStoppedOneByOneAndWithThreads) {
  const Course whole = course(disk(4, 3), false);
  EXPECT_GT(whole.impulse.y, 0.0);
  EXPECT_FALSE(whole.state.active.empty());
  EXPECT_LT(whole.residual, 1e-14);
  expect_same(course(disk(4, 3), true), whole);
  expect_same(course(disk(4, 3), true, 25), whole);
  expect_same(course(disk(4, 3, 2), false), whole);
}

/// Impulses of the candidates are those of the fine steps, summed.
TEST(Hati, ActiveContactsHaveTheWholeImpulse) {
  const auto b = disk(4, 4);
  HatiIntegrator run(b.model, test::start_at_rest(b.model));
  State state(b.model);
  StepReport report;
  int touching = 0;
  for (int step = 0; step < 60; ++step) {
    run.advance({&report, 1}, &state);
    Vec2 sum, fine;
    for (const ActiveContact& a : state.active) sum += from_frame(a.normal, a.impulse.plane());
    for (const FineContact& f : run.fine_contacts()) fine += f.report.impulse.plane();
    EXPECT_NEAR(norm(sum - report.contact.impulse.plane()), 0.0, 1e-12 * norm(sum) + 1e-300);
    EXPECT_NEAR(norm(fine - report.contact.impulse.plane()), 0.0, 1e-12 * norm(sum) + 1e-300);
    touching += state.active.empty() ? 0 : 1;
  }
  EXPECT_GT(touching, 10);
}

/// At m elements from the coarse part a contact does not feel it within a coarse step; nearer it
/// does, and the report says so.
TEST(Hati, ContactFeelsTheJointNearerThanTheRatio) {
  const auto felt = [](int layers, int ratio) {
    const auto b = disk(layers, ratio);
    HatiIntegrator run(b.model, test::start_at_rest(b.model));
    StepReport report;
    bool any = false;
    for (int step = 0; step < 60; ++step) {
      run.advance({&report, 1});
      any = any || report.contact_felt_joint;
    }
    return any;
  };
  EXPECT_FALSE(felt(1, 1));
  EXPECT_FALSE(felt(4, 4));
  EXPECT_TRUE(felt(3, 4));
  EXPECT_TRUE(felt(1, 2));
}

TEST(Hati, DistanceIsCountedInElements) {
  const auto b = disk(3, 1);
  const std::vector<int> distance = distance_to_interface(*b.model.subdomains);
  EXPECT_EQ(b.model.subdomains->interface.size(), 40U);
  for (std::size_t k = 0; k < distance.size(); ++k) {
    const double layers = (norm(b.mesh.coordinates[k]) - 0.15) / (0.15 / 8);
    const int expected = static_cast<int>(std::lround(layers)) - 5;
    EXPECT_EQ(distance[k], expected < 0 ? -1 : expected) << k;
  }
}

}  // namespace rondo::dynamics::hati_test
