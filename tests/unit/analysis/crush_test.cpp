// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/crush/crush_setup.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "rondo/analysis/build/crush/crush_path.hpp"

namespace crush_test {

using namespace rondo;

namespace {

statics::CrushReport solved() {
  statics::CrushReport r;
  r.converged = true;
  r.residual = 1e-14;
  return r;
}

bool holds(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST(CrushTrouble, NoneWhereAllIsWell) {
  EXPECT_EQ(study::crush_trouble(solved(), {}, 1e-10), "");
}

TEST(CrushTrouble, NotSolvedNamesTheFrictionAndWhatWasTried) {
  statics::CrushReport r;
  r.residual = 8e-4;
  r.sweeps = 5000;
  r.pivots = 70;
  r.pivoting = statics::Pivoting::failed;
  const std::string text = study::crush_trouble(r, {}, 1e-10);
  for (const char* part : {"0.0008", "1e-10", "5000 sweeps", "70 pivots", "ground.friction"})
    EXPECT_TRUE(holds(text, part)) << part << ": " << text;
  EXPECT_TRUE(holds(text, "found none"));
  r.pivoting = statics::Pivoting::used;
  EXPECT_FALSE(holds(study::crush_trouble(r, {}, 1e-10), "found none"));
}

TEST(CrushTrouble, OutOfRangeComesBeforeFriction) {
  statics::CrushReport r;
  r.residual = std::numeric_limits<double>::quiet_NaN();
  r.sweeps = 5000;
  const std::string text = study::crush_trouble(r, {}, 1e-10);
  EXPECT_TRUE(holds(text, "out of the range")) << text;
  EXPECT_FALSE(holds(text, "friction")) << text;
}

TEST(CrushTrouble, ResidualsOfEquilibriumAndEnergy) {
  statics::CrushReport r = solved();
  r.equilibrium = 2e-9;
  EXPECT_TRUE(holds(study::crush_trouble(r, {}, 1e-10), "equilibrium 2e-09"));
  statics::CrushWorks works;
  works.relative = 3e-9;
  EXPECT_TRUE(holds(study::crush_trouble(solved(), works, 1e-10), "residual 3e-09"));
}

TEST(CrushPath, OfNumbersGoesDownThenAlong) {
  study::AnalysisCase a;
  a.depth = dynamics::Table(0.02);
  a.increments = 4;
  a.slide = dynamics::Table(-0.01);
  a.slide_increments = 2;
  const study::CrushPath path(a);
  EXPECT_EQ(path.n_increments(), 6);
  const double depths[] = {0.0, 0.005, 0.01, 0.015, 0.02, 0.02, 0.02};
  const double slides[] = {0.0, 0.0, 0.0, 0.0, 0.0, -0.005, -0.01};
  for (int k = 0; k <= 6; ++k) {
    EXPECT_DOUBLE_EQ(path.depth(k), depths[k]) << k;
    EXPECT_DOUBLE_EQ(path.slide(k), slides[k]) << k;
  }
  EXPECT_EQ(path.parameter(6), 1.5);
  EXPECT_TRUE(path.has_slide());
  EXPECT_FALSE(path.is_of_tables());
  EXPECT_EQ(path.target(4), "depth 0.02 m");
  EXPECT_EQ(path.target(5), "depth 0.02 m, slide -0.005 m");
}

TEST(CrushPath, OfALoadReachesItThenKeepsIt) {
  study::AnalysisCase a;
  a.load = 2000.0;
  a.increments = 4;
  a.slide = dynamics::Table(0.01);
  a.slide_increments = 1;
  const study::CrushPath path(a);
  EXPECT_TRUE(path.has_load());
  EXPECT_EQ(path.load(0), 0.0);
  EXPECT_DOUBLE_EQ(path.load(3), 1500.0);
  EXPECT_EQ(path.load(5), 2000.0);
  EXPECT_EQ(path.target(4), "load 2000 N");
  EXPECT_EQ(path.target(5), "load 2000 N, slide 0.01 m");
}

TEST(CrushPath, OfTablesFollowsThem) {
  study::AnalysisCase a;
  a.depth = dynamics::Table({{0.0, 0.0}, {4.0, 0.02}, {8.0, 0.0}});
  a.increments = 8;
  study::CrushPath path(a);
  EXPECT_EQ(path.n_increments(), 8);
  EXPECT_EQ(path.parameter(8), 1.0);
  EXPECT_EQ(path.largest_depth(), 0.02);
  EXPECT_FALSE(path.has_slide());
  EXPECT_EQ(path.depth(0), 0.0);
  EXPECT_EQ(path.depth(4), 0.02);
  EXPECT_DOUBLE_EQ(path.depth(7), 0.005);
  EXPECT_EQ(path.depth(8), 0.0);
  EXPECT_EQ(path.target(4), "depth 0.02 m");
  a.slide = dynamics::Table({{0.0, 0.0}, {4.0, 0.0}, {8.0, -0.01}});
  path = study::CrushPath(a);
  EXPECT_TRUE(path.has_slide());
  EXPECT_DOUBLE_EQ(path.slide(6), -0.005);
  EXPECT_EQ(path.target(4), "depth 0.02 m, slide 0 m");
}

}  // namespace crush_test
