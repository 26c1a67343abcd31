// SPDX-License-Identifier: BSD-3-Clause
/// @file  A motion in time as its caller stops, sees and drives it; what its end tells.
#include <fmt/format.h>

#include "rondo/analysis/build/rim.hpp"
#include "rondo/analysis/build/stability.hpp"
#include "rondo/analysis/dynamic.hpp"
#include "rondo/analysis/elements/corner_words.hpp"

namespace rondo::study {
namespace {

HistoryPlace never_due() {
  HistoryPlace place;
  place.next = HistoryPlace::never;
  return place;
}

/// Refuses models that keep a copy of the tables, or numbers made of them.
void refuse_fixed_motion(const Case& c, const dynamics::Model& model) {
  if (model.subdomains)
    throw case_error(c, "time.scheme",
                     "parts with steps of their own have the motion of the rim from the start",
                     "\"symplectic\"; or the tables in the case");
  if (!dynamics::has_sharp_corners(model)) return;
  const CornerWords words = corner_words(c, model);
  throw case_error(c, "ground.fillet",
                   "contact at " + words.corners + " has the motion of the rim from the start",
                   words.instead + "; or the tables in the case");
}

void copy_pressures(const Case& c, dynamics::Model& model) {
  for (std::size_t k = 0; k < c.pressures.size(); ++k) {
    if (k < model.pressures.size()) model.pressures[k].pressure = c.pressures[k].pressure;
    if (model.solid && k < model.solid->pressures.size())
      model.solid->pressures[k].pressure = c.pressures[k].pressure;
  }
}

}  // namespace

/// Only the run tells it where the motion does not say the height (else: plausible.hpp).
void DynamicAnalysis::warn_of_no_contact() {
  const bool falls = !is_held(case_) || (case_.rim && case_.rim->free_y);
  if (!case_.ground || !falls || contact_.contact_steps > 0) return;
  warn(fmt::format(
      "nothing has touched the ground in the whole run, to t = {:.6g} s: {}; are lengths in m, "
      "forces in N?",
      static_cast<double>(steps_) * setup_.model.dt,
      case_.rim ? "[rim] and its loads have not brought the body down to it"
                : "initial.position, initial.velocity and motion.gravity do not lead there"));
}

void DynamicAnalysis::warn_of_left_corners() {
  const auto& c = contact_;
  if (!setup_.model.solid || c.clusters_not_converged == 0) return;
  warn(
      fmt::format("{} times a corner of the ground was left out of a step, of {} groups of "
                  "contacts in all: with "
                  "the contacts beside it, it was beyond the solver. The forces of these steps are "
                  "a little too "
                  "small; a finer mesh, or fewer corners within an element, makes this rarer",
                  c.clusters_not_converged, c.clusters));
}

void DynamicAnalysis::pause_at(long long step) {
  pause_ = step;
  since_pause_.emplace(case_, setup_, never_due());
}

const dynamics::State* DynamicAnalysis::state() {
  if (state_.step != steps_ || !integrator_ || (from_ && !last_)) return nullptr;
  return &state_;
}

std::vector<double> DynamicAnalysis::row() const {
  std::vector<double> row;
  if (last_ && since_pause_) History(*since_pause_).finish(*last_, last_state_, row);
  return row;
}

std::vector<ColumnLabel> DynamicAnalysis::row_columns() const {
  return History(case_, setup_).columns();
}

void DynamicAnalysis::take_tables() {
  refuse_fixed_motion(case_, setup_.model);
  check_motion(case_, setup_);
  setup_.model.motion = case_.motion;
  set_rim_loads(case_, setup_.model);
  copy_pressures(case_, setup_.model);
  warn_of_faster_spin();
}

/// Warns of a spin above all before; build() has warned by the tables as they were.
void DynamicAnalysis::warn_of_faster_spin() {
  const double spin = case_.motion.angular_velocity.largest();
  if (spin <= fastest_) return;
  fastest_ = spin;
  const std::size_t told = setup_.warnings.size();
  warn_of_softening(case_, setup_);
  for (std::size_t k = told; k < setup_.warnings.size(); ++k) warn(setup_.warnings[k]);
  setup_.warnings.resize(told);
}

}  // namespace rondo::study
