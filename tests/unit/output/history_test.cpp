// SPDX-License-Identifier: BSD-3-Clause
/// When a row of history.csv is due, what it is the mean of, and where it goes on.
#include "rondo/output/history.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "rondo/analysis/build/build.hpp"
#include "unit/case/case_fixture.hpp"

namespace history_test {

using namespace rondo;
using namespace rondo::study;

namespace {

struct Built {
  Case c;
  Setup setup;
};

Built built(std::vector<std::string> settings) {
  settings.insert(settings.begin(), {"disk.mesh.radial=2", "disk.mesh.circumferential=24"});
  Built b{test::read_text(test::base, settings), {}};
  b.setup = build(b.c, 1);
  return b;
}

dynamics::StepReport step_of(const Built& b, long long number, double impulse) {
  dynamics::StepReport step;
  step.step = number;
  step.frame.time = static_cast<double>(number) * b.setup.model.dt;
  step.contact.impulse = Vec2{impulse, 2.0 * impulse};
  step.contact.penetration = impulse;
  return step;
}

double value(const std::vector<ColumnLabel>& columns, const std::vector<double>& row,
             const char* name) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == name) return row.at(i);
  ADD_FAILURE() << "no column " << name;
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

TEST(History, EveryStepIsARowWhereNoIntervalIsGiven) {
  const Built b = built({"output.history_interval=0"});
  History history(b.c, b.setup);
  std::vector<double> rows;
  for (long long k = 1; k <= 3; ++k) history.observe(step_of(b, k, 1.0), nullptr, rows);
  EXPECT_EQ(rows.size(), 3 * history.columns().size());
  EXPECT_EQ(history.next_row(), 4);
  EXPECT_TRUE(history.needs_boundary()) << "the contact length of a row";
  EXPECT_FALSE(history.needs_state()) << "no probe";
}

TEST(History, TheContactLengthIsThatOfTheDeformedBoundary) {
  const Built b = built({"output.history_interval=0"});
  dynamics::StepReport step = step_of(b, 1, 1.0);
  dynamics::State state(b.setup.model);
  for (std::size_t i = 0; i < state.u.size(); ++i)
    state.u.plane()[i] = 0.1 * b.setup.mesh.coordinates[i];
  for (const std::size_t k : {3U, 4U}) {
    dynamics::ActiveContact contact;
    contact.candidate = k;
    contact.impulse = {1.0, 0.0, 0.0};
    state.active.push_back(contact);
    step.contact.length += b.setup.mesh.tributary[k];
  }
  History history(b.c, b.setup);
  std::vector<double> row, blind;
  history.observe(step, &state, row);
  EXPECT_NEAR(value(history.columns(), row, "contact_length_m"), 1.1 * step.contact.length, 1e-15);
  history.observe(step_of(b, 2, 1.0), nullptr, blind);
  EXPECT_EQ(value(history.columns(), blind, "contact_length_m"), 0.0) << "nothing touches";
}

/// A wheel in three dimensions has a row without displacements and one with them.
TEST(History, TheFootprintIsThatOfTheRow) {
  const Built b = built({"output.history_interval=0", "disk.width=0.1", "ground.profile=flat",
                         "ground.fillet=0", "motion.height=0.4"});
  dynamics::StepReport step = step_of(b, 1, 1.0);
  dynamics::State state(b.setup.model);
  for (std::size_t k = 0; k < b.setup.mesh.boundary.size(); ++k) {
    const auto node = static_cast<std::size_t>(b.setup.mesh.boundary[k]);
    dynamics::ActiveContact contact;
    contact.candidate = k;
    contact.impulse = {b.setup.mesh.coordinates[node].y < -0.28 ? 1.0 : 0.0, 0.0, 0.0};
    state.active.push_back(contact);
    if (contact.impulse.x > 0.0) step.contact.length += b.setup.mesh.tributary[k];
  }
  History history(b.c, b.setup);
  std::vector<double> blind, row;
  history.observe(step, nullptr, blind);
  step.step = 2;
  history.observe(step, &state, row);
  const std::vector<ColumnLabel> columns = history.columns();
  for (const char* name : {"footprint_length_m", "footprint_width_m", "pressure_mean_pa"})
    EXPECT_TRUE(std::isnan(value(columns, blind, name))) << name;
  // Rows of nodes at ±15 and 0 degrees; half of the edges reach to places half way to ±30 degrees.
  EXPECT_NEAR(value(columns, row, "footprint_length_m"),
              0.3 * (std::sin(std::numbers::pi / 12.0) + std::sin(std::numbers::pi / 6.0)), 1e-14);
  EXPECT_NEAR(value(columns, row, "footprint_width_m"), 0.1, 1e-15);
  EXPECT_NEAR(value(columns, row, "pressure_mean_pa"), 2.0 / b.setup.model.dt / step.contact.length,
              1e-6);
}

TEST(History, ForcesAreMeansOverTheIntervalAndPenetrationItsLargest) {
  Built b = built({});
  b.c.output.history_interval = 4.0 * b.setup.model.dt;
  History history(b.c, b.setup);
  std::vector<double> row;
  for (const double impulse : {1.0, 5.0, 2.0}) {
    EXPECT_TRUE(row.empty());
    history.observe(step_of(b, history.place().done + 1, impulse), nullptr, row);
  }
  history.observe(step_of(b, 4, 0.0), nullptr, row);
  const auto columns = history.columns();
  ASSERT_EQ(row.size(), columns.size());
  const double span = 4.0 * b.setup.model.dt;
  EXPECT_DOUBLE_EQ(value(columns, row, "force_x"), 8.0 / span);
  EXPECT_DOUBLE_EQ(value(columns, row, "force_y"), 16.0 / span);
  EXPECT_EQ(value(columns, row, "penetration_max_m"), 5.0);
  EXPECT_EQ(history.place().next, 2);
  EXPECT_EQ(history.place().steps, 0);
}

TEST(History, TheLastStepsHaveARowOfTheirOwn) {
  Built b = built({});
  b.c.output.history_interval = 4.0 * b.setup.model.dt;
  History history(b.c, b.setup);
  std::vector<double> rows;
  for (long long k = 1; k <= 4; ++k) history.observe(step_of(b, k, 1.0), nullptr, rows);
  const std::size_t whole = rows.size();
  history.finish(step_of(b, 4, 1.0), nullptr, rows);
  EXPECT_EQ(rows.size(), whole) << "its row is there";
  history.observe(step_of(b, 5, 3.0), nullptr, rows);
  history.finish(step_of(b, 5, 3.0), nullptr, rows);
  ASSERT_EQ(rows.size(), 2 * whole);
  const std::vector<double> last(rows.begin() + static_cast<std::ptrdiff_t>(whole), rows.end());
  EXPECT_DOUBLE_EQ(value(history.columns(), last, "force_x"), 3.0 / b.setup.model.dt);
}

/// The rows are those of a history that saw all steps itself.
TEST(History, GoesOnFromItsPlace) {
  Built b = built({});
  b.c.output.history_interval = 3.5 * b.setup.model.dt;
  History whole(b.c, b.setup);
  std::vector<double> all, parts;
  for (long long k = 1; k <= 20; ++k)
    whole.observe(step_of(b, k, std::sqrt(static_cast<double>(k))), nullptr, all);
  HistoryPlace place;
  for (long long k = 1; k <= 20; ++k) {
    History part(b.c, b.setup, place);
    part.observe(step_of(b, k, std::sqrt(static_cast<double>(k))), nullptr, parts);
    place = part.place();
  }
  EXPECT_EQ(all, parts);
  EXPECT_GT(all.size(), 4 * whole.columns().size());
}

/// Means over steps at which the center is at different heights.
TEST(History, TheMomentsAboutTheContactCentreAreThoseOfEachStep) {
  Built b = built({"disk.width=0.1", "motion.camber=0.1", "ground.profile=flat", "ground.fillet=0",
                   "motion.height=0.4"});
  b.c.output.history_interval = 100.0;
  History history(b.c, b.setup);
  std::vector<double> row;
  double aligning = 0.0, overturning = 0.0;
  for (long long k = 1; k <= 2; ++k) {
    dynamics::StepReport step = step_of(b, k, static_cast<double>(k));
    step.contact.moment_aligning = 5.0;
    step.contact.moment_overturning = -7.0;
    step.frame.center.y = 0.3 - 0.01 * static_cast<double>(k);
    const double aside = step.frame.center.y * std::tan(0.1), impulse = static_cast<double>(k);
    aligning += (5.0 - aside * impulse) / (2.0 * b.setup.model.dt);
    overturning += (-7.0 + aside * 2.0 * impulse) / (2.0 * b.setup.model.dt);
    history.observe(step, nullptr, row);
    if (k == 2) history.finish(step, nullptr, row);
  }
  EXPECT_NEAR(value(history.columns(), row, "moment_aligning_iso"), aligning,
              1e-12 * std::abs(aligning));
  EXPECT_NEAR(value(history.columns(), row, "moment_overturning_iso"), overturning,
              1e-12 * std::abs(overturning));
}

TEST(History, TheStateOfRowsWithProbesIsAskedForInTurn) {
  Built b = built({"output.probe=[{name = 'rim', position = [0.2, 0.0]}]"});
  b.c.output.history_interval = 3.5 * b.setup.model.dt;
  History history(b.c, b.setup);
  EXPECT_TRUE(history.needs_state());
  std::vector<double> rows;
  for (long long k = 1; k <= 40; ++k) {
    const bool wanted = history.next_row() == k;
    const std::size_t before = rows.size();
    dynamics::State state(b.setup.model);
    history.observe(step_of(b, k, 1.0), wanted ? &state : nullptr, rows);
    EXPECT_EQ(rows.size() > before, wanted) << "step " << k;
  }
  EXPECT_FALSE(std::any_of(rows.begin(), rows.end(), [](double x) { return std::isnan(x); }));
}

TEST(History, TakesEveryStepOnce) {
  const Built b = built({"output.history_interval=0"});
  History history(b.c, b.setup);
  std::vector<double> rows;
  history.observe(step_of(b, 2, 1.0), nullptr, rows);
  EXPECT_DEATH(history.observe(step_of(b, 2, 1.0), nullptr, rows), "step.step > at_.done");
}

}  // namespace history_test
