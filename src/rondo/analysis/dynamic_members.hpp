// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a motion in time has in run.json, besides shared_members().
#pragma once
#include "rondo/analysis/friction_watch.hpp"
#include "rondo/case/setup.hpp"
#include "rondo/output/contact_statistics.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {

/// Before the first step.
void describe_dynamic(const Case& c, const Setup& setup, Json& json);

struct DynamicEnd {
  const RunReport& report;
  const ContactStatistics& contact;
  double exchanged = 0.0;  ///< energy [J/m]
  int problems_kept = 0;
  const FrictionWatch& friction;
};
void summarise_dynamic(const DynamicEnd& end, Json& json);

std::vector<MemberText> dynamic_members();

}  // namespace rondo::study
