// SPDX-License-Identifier: BSD-3-Clause
/// Which step each shipped case takes: a change of the table of steps shows here.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/registry.hpp"
#include "rondo/case/case_keys.hpp"
#include "rondo/case/features/case_features.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study::step_choice_test {
namespace {

using dynamics::StepKind;

/// All others are "fused cyclic".
const std::map<std::string, StepKind> others{
    {"bar-fine-tip", StepKind::sparse},
    {"bar-on-wall", StepKind::bodies},
    {"block-on-incline", StepKind::bodies},
    {"bouncing-bar", StepKind::bodies},
    {"rolling-pitches", StepKind::sparse},
    {"rolling-spokes", StepKind::sparse},
    {"rubber-roller", StepKind::sparse},
    {"rubber-rolling", StepKind::sparse},
    {"rubber-tyre", StepKind::wheel},
    {"thrown-disk", StepKind::bodies},
    {"two-disks", StepKind::bodies},
    {"two-steps", StepKind::hati},
    {"tyre-cleat", StepKind::solid_cyclic},
    {"tyre-lane-change", StepKind::solid_cyclic},
    {"tyre-load", StepKind::solid_cyclic},
    {"tyre-rolling", StepKind::solid_cyclic},
    {"tyre-section", StepKind::bodies},
    {"tyre-section-implicit", StepKind::general},
    {"tyre-standing", StepKind::solid_cyclic},
    {"wheel3d-cleat", StepKind::solid_cyclic},
    {"wheel3d-cleat-sharp", StepKind::solid_cyclic},
    {"wheel3d-cleat-30", StepKind::solid_cyclic},
    {"wheel3d-car", StepKind::solid_cyclic},
    {"wheel3d-cleats", StepKind::solid_cyclic},
    {"wheel3d-cobbles", StepKind::solid_cyclic},
    {"wheel3d-cornering", StepKind::solid_cyclic},
    {"wheel3d-load", StepKind::solid_cyclic},
    {"wheel3d-mu-split", StepKind::solid_cyclic},
    {"wheel3d-standing", StepKind::solid_cyclic},
    {"wheel3d-treaded", StepKind::solid_cyclic},
    {"wheel3d-tyre", StepKind::solid_cyclic},
};

/// Of a disk the case tells all; of a mesh its model does.
StepKind step_of_case(const Case& c) {
  return c.mesh ? step_of(build(c, 1).model) : dynamics::choose_step(features_of(c))->kind;
}

TEST(StepChoice, OfTheShippedCases) {
  std::size_t seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(RONDO_CASES)) {
    if (entry.path().extension() != ".toml") continue;
    const Case c = read_case(entry.path());
    if (!in_time.contain(c.analysis.kind)) continue;
    const auto known = others.find(entry.path().stem().string());
    seen += known == others.end() ? 0 : 1;
    EXPECT_EQ(row_of(step_of_case(c)).name,
              row_of(known == others.end() ? StepKind::cyclic : known->second).name)
        << entry.path();
  }
  EXPECT_EQ(seen, others.size());
}

TEST(Registry, HasARowForEveryKindOfAnalysis) {
  for (std::size_t k = 0; k < std::size(analysis_kinds); ++k)
    for (const bool solid : {false, true}) {
      Case c;
      c.analysis.kind = static_cast<AnalysisKind>(k);
      if (solid) c.wheel.width = 0.1;
      EXPECT_EQ(type_of(c).kind, c.analysis.kind);
      EXPECT_FALSE(type_of(c).finds_modes);
    }
}

}  // namespace
}  // namespace rondo::study::step_choice_test
