// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/simulation/simulation.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "rondo/analysis/run.hpp"
#include "rondo/analysis/simulation/drive.hpp"
#include "rondo/analysis/simulation/solve.hpp"
#include "rondo/core/error.hpp"

namespace rondo::study::simulation_test {
namespace {

constexpr const char* small = R"(schema = 1
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = 3
circumferential = 40
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[damping]
mass = 200.0
stiffness = 2.0e-5
[motion]
angular_velocity = 33.333333
speed = 10.0
height = [[0, 0.3], [0.004, 0.296]]
[ground]
profile = "flat"
friction = 0.3
[time]
end = 0.01
[output]
snapshots = 5
)";

Case small_case(const std::vector<std::string>& settings = {}) {
  return read_case_text("small.toml", small, settings);
}

std::vector<double> stepped(const Case& c, long long every, RunOptions options = {}) {
  Simulation s(c, std::move(options));
  while (!s.is_over()) {
    s.aim(s.steps_made() + every);
    while (!s.go_on(1.0)) {
    }
  }
  static_cast<void>(s.finish());
  return *s.rows();
}

TEST(Simulation, HasTheSameRowsHoweverItIsCutAndAsSolvedAtOnce) {
  const Case c = small_case();
  const Solution whole = solve_case(c, {});
  EXPECT_EQ(whole.report.status, RunStatus::done);
  EXPECT_EQ(whole.rows.size() % whole.columns.size(), 0U);
  EXPECT_EQ(whole.snapshots.count, 5U);
  EXPECT_EQ(whole.snapshots.displacement.size(), 5 * 2 * whole.mesh.n_nodes());
  EXPECT_EQ(whole.snapshots.velocity.size(), whole.snapshots.displacement.size());
  EXPECT_EQ(whole.snapshots.contact_force.size(), 5 * 2 * whole.mesh.boundary.size());
  EXPECT_EQ(whole.json.at("status"), "done");
  for (const long long every : {1, 7, 1000}) EXPECT_EQ(stepped(c, every), whole.rows) << every;
}

TEST(Simulation, TwoThreadsHaveTheRowsOfOne) {
  const Case one = small_case(), other = small_case({"ground.friction=0.1"});
  const std::vector<double> alone = stepped(one, 10), alone_too = stepped(other, 10);
  std::vector<double> found, found_too;
  std::thread worker([&] { found = stepped(one, 10); });
  found_too = stepped(other, 10);
  worker.join();
  EXPECT_EQ(found, alone);
  EXPECT_EQ(found_too, alone_too);
}

TEST(Simulation, ShownFieldsStayWhereTheyAreAndAreOfTheLastStep) {
  Simulation s(small_case(), {});
  const auto shown = s.fields();
  ASSERT_NE(shown, nullptr);
  const double* data = shown->displacement.data();
  const std::vector<double> before = shown->displacement;
  s.aim(40);
  ASSERT_TRUE(s.go_on(100.0));
  EXPECT_EQ(s.fields()->displacement.data(), data);
  EXPECT_NE(shown->displacement, before);
  const dynamics::State* state = s.state();
  for (std::size_t i = 0; i < shown->nodes; ++i) {
    EXPECT_EQ(shown->displacement[2 * i], state->u.plane()[i].x);
    EXPECT_EQ(shown->velocity[2 * i + 1], state->v.plane()[i].y);
  }
}

TEST(Simulation, WhatIsNoMotionOrWantsFilesIsRefused) {
  EXPECT_THROW(
      Simulation(
          small_case({"analysis.kind=crush", "analysis.depth=0.01", "analysis.increments=3"}), {}),
      InputError);
  EXPECT_THROW(Simulation(small_case({"solver.dump_contacts=1"}), {}), InputError);
  RunOptions resumed;
  resumed.resume = true;
  EXPECT_THROW(Simulation(small_case(), resumed), InputError);
}

TEST(Drive, ATableIsLedOverAndWasWhatItWas) {
  const dynamics::Table table({{0.0, 1.0}, {2.0, 3.0}, {5.0, 9.0}});
  const dynamics::Table led = led_over(table, 3.0, 3.5, -1.0);
  for (const double t : {-1.0, 0.0, 0.7, 2.0, 2.9, 3.0}) EXPECT_NEAR(led.at(t), table.at(t), 1e-15);
  EXPECT_DOUBLE_EQ(led.at(3.25), 2.0);
  EXPECT_EQ(led.at(3.5), -1.0);
  EXPECT_EQ(led.at(100.0), -1.0);
  const dynamics::Table again = led_over(led, 3.0, 4.0, 5.0);  // what was to come is dropped
  EXPECT_EQ(again.points().size(), 4U);
  EXPECT_EQ(again.at(4.0), 5.0);
}

TEST(Drive, AConstantKeepsItsBits) {
  const dynamics::Table constant(33.7), led = led_over(constant, 0.1, 0.2, 1.0);
  for (const double t : {0.0, 0.05, 0.0999}) {
    EXPECT_EQ(led.at(t), constant.at(t));
    EXPECT_EQ(led.integral(0.0, t), constant.integral(0.0, t));
  }
}

TEST(Drive, KeysAreThoseOfTablesThatCount) {
  Case c = small_case({"rim.free=['height','angular_velocity']", "rim.mass=10", "rim.inertia=1",
                       "motion.height=0.3"});
  EXPECT_EQ(driven_keys(c), (std::vector<std::string>{"motion.speed", "motion.gravity",
                                                      "rim.force_y", "rim.torque", "rim.brake"}));
  EXPECT_EQ(&driven_table(c, "rim.brake", 2.0), &c.rim->brake);
  EXPECT_THROW(static_cast<void>(driven_table(c, "rim.brake", -2.0)), InputError);
  EXPECT_THROW(static_cast<void>(driven_table(c, "motion.height", 1.0)), InputError);
  EXPECT_THROW(static_cast<void>(driven_table(c, "no.such", 1.0)), InputError);
}

}  // namespace
}  // namespace rondo::study::simulation_test
