// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/crush_setup.hpp"

#include <gtest/gtest.h>

#include <limits>

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
