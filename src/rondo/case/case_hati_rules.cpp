// SPDX-License-Identifier: BSD-3-Clause
/// Rules of time.scheme = "hati": which part is fine, and which motions it supports
/// (docs/cases.md).
#include <algorithm>

#include "rondo/case/case_rules.hpp"

namespace rondo::study {
namespace {

constexpr const char* elsewhere = "time.scheme = \"symplectic\"";

void check_fine(CaseValues& in, const Case& c) {
  const std::string fine = "solver.hati.fine";
  check_part(in, c, fine);
  const bool layers = in.has(fine + ".layers"), region = in.has(fine + ".region");
  if (layers == region)
    in.fault(fine, layers ? "chooses elements by more than one key" : "chooses no elements",
             "{layers = [...]} of a [disk], or {region = \"...\"} of a [mesh]");
}

/// The matrix that joins the parts is factorised once, for one angular velocity.
void check_spin(CaseValues& in, const Case& c) {
  constexpr std::string_view key = "motion.angular_velocity";
  const auto& points = c.motion.angular_velocity.points();
  if (in.good({key}) && !std::ranges::all_of(points, [&](const auto& point) {
        return point[1] == points.front()[1];
      }))
    in.fault(key, "varies, but the scheme \"hati\" is factored for one angular velocity",
             std::string("a number, or ") + elsewhere);
}

void check_hati_motion(CaseValues& in, const Case& c) {
  if (is_held(c)) check_spin(in, c);
  if (c.initial.state == InitialState::steady_rolling)
    in.fault("initial.state",
             "is known half a step after t = 0, and the scheme \"hati\" begins at t = 0",
             std::string("\"rest\" or \"stationary\", or ") + elsewhere);
}

}  // namespace

void check_hati(CaseValues& in, Case& c) {
  if (c.time.scheme == Scheme::hati) {
    if (!c.hati)
      return in.fault("time.scheme", "\"hati\" needs to know which elements are explicit",
                      "[solver.hati] with fine = {layers = [...]} and ratio beside it");
    check_fine(in, c);
    check_hati_motion(in, c);
    return;
  }
  const bool meant = means_to(*find_case_key("solver.hati.ratio"), c.analysis.kind);
  if (c.hati && meant && in.good({"time.scheme"}))
    in.fault("solver.hati", "is for the scheme \"hati\" only", "time.scheme = \"hati\" beside it");
  c.hati.reset();
}

}  // namespace rondo::study
