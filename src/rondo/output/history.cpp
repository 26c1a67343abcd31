// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/history.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/core/contract.hpp"
#include "rondo/model/solid/swept_part.hpp"
#include "rondo/output/probes.hpp"

namespace rondo::study {
namespace {

/// The radius of a disk, or the largest one of constrained candidates of a mesh. 0: all are free.
double rolling_radius(const Case& c, const Setup& setup) {
  if (!is_held(c)) return 0.0;
  if (is_generated(c) && !c.inflation) return c.disk.outer_radius;
  double radius = 0.0;
  for (const int node : setup.mesh.boundary) {
    const auto k = static_cast<std::size_t>(node);
    if (!in_fixed_frame(setup.model, k)) radius = std::max(radius, norm(setup.model.reference[k]));
  }
  return radius;
}

}  // namespace

History::History(const Case& c, const Setup& setup, const HistoryPlace& place)
    : case_(c),
      setup_(setup),
      dt_(setup.model.dt),
      interval_(c.output.history_interval),
      radius_(rolling_radius(c, setup)),
      features_{.solid = setup.model.solid.has_value(),
                .rim = setup.model.rim.has_value(),
                .massless = has_massless_contact(setup.model),
                .rubber = has_internal_work(setup),
                .window = dynamics::has_window(setup.model),
                .hati = setup.model.subdomains.has_value()},
      ground_(setup.model.motion.camber),
      at_(place) {
  RONDO_DEMAND(dt_ > 0.0 && std::isfinite(dt_) && interval_ >= 0.0, dt_, interval_);
  RONDO_DEMAND(place.next > 0 && place.steps >= 0 && place.done >= place.steps, place.next,
               place.steps, place.done);
  RONDO_DEMAND(setup.probes.size() == c.output.probes.size(), setup.probes.size(),
               c.output.probes.size());
  if (setup.model.contact || setup.model.surfaces)
    boundary_ = std::make_shared<const mesh::DeformedBoundary>(setup.mesh);
}

std::vector<ColumnLabel> History::columns() const {
  std::vector<ColumnLabel> labels = history_labels(features_);
  for (ColumnLabel& probe : probe_columns(case_.output.probes)) labels.push_back(std::move(probe));
  return labels;
}

double History::slip_ratio(const dynamics::StepReport& step) const {
  if (radius_ == 0.0) return 0.0;
  if (setup_.model.rim) return dynamics::slip_ratio(step.rim.spin * radius_, step.rim.velocity.x);
  const double t = step.frame.time;
  return dynamics::slip_ratio(case_.motion.angular_velocity.at(t) * radius_, case_.motion.ahead(t));
}

/// The step nearest to a multiple of the interval writes the row.
bool History::is_due(double time) const noexcept {
  return at_.next != HistoryPlace::never &&
         time + 0.5 * dt_ > static_cast<double>(at_.next) * interval_;
}

long long History::next_row() const noexcept {
  if (at_.next == HistoryPlace::never) return HistoryPlace::never;
  if (interval_ == 0.0) return at_.done + 1;
  const auto time = [&](long long step) { return static_cast<double>(step) * dt_; };
  // An estimate, corrected by the same comparison as in is_due().
  auto step = static_cast<long long>(static_cast<double>(at_.next) * interval_ / dt_ - 0.5);
  step = std::max(step, at_.done + 1);
  while (step > at_.done + 1 && is_due(time(step - 1))) --step;
  while (!is_due(time(step))) ++step;
  return step;
}

/// The length in the report, stretched like the boundary at nodes in contact, and the footprint.
void History::measure_contact(const dynamics::StepReport& step, const dynamics::State* state,
                              HistoryRecord& row) const {
  row.contact_length = step.contact.length;
  if (!boundary_ || row.contact_length == 0.0) return;
  if (!state) {
    row.contact_length = std::numeric_limits<double>::quiet_NaN();
    row.footprint_length = row.footprint_width = row.contact_length;
    return;
  }
  mesh::Footprint footprint(ground_, rotation(step.frame.angle));
  double undeformed = 0.0, deformed = 0.0;
  std::size_t last = setup_.mesh.boundary.size();
  for (const dynamics::ActiveContact& c : state->active) {
    if (c.impulse.x <= 0.0 || c.candidate == last) continue;
    last = c.candidate;
    RONDO_ASSERT(last < setup_.mesh.tributary.size(), last, setup_.mesh.tributary.size());
    undeformed += setup_.mesh.tributary[last];
    deformed += boundary_->extent(last, state->u);
    if (features_.solid) boundary_->widen(last, state->u, footprint);
  }
  if (undeformed > 0.0) row.contact_length *= deformed / undeformed;
  row.footprint_length = footprint.length();
  row.footprint_width = footprint.width();
}

void History::append_probes(const dynamics::State* state, std::vector<double>& rows) const {
  if (setup_.probes.empty()) return;
  if (state)
    return study::append_probes({setup_.mesh, setup_.materials, setup_.model, setup_.dilatation},
                                setup_.probes, *state, rows);
  rows.insert(rows.end(), probe_columns(case_.output.probes).size(),
              std::numeric_limits<double>::quiet_NaN());
}

void History::observe(const dynamics::StepReport& step, const dynamics::State* state,
                      std::vector<double>& rows) {
  RONDO_DEMAND(step.step > at_.done, step.step, at_.done);
  const dynamics::ContactReport& report = step.contact;
  at_.done = step.step;
  ++at_.steps;
  at_.impulse += report.impulse;
  at_.angular_impulse += report.angular_impulse;
  at_.aligning += report.moment_aligning;
  at_.overturning += report.moment_overturning;
  const GroundMoments iso = ground_.about_contact_centre(
      {report.moment_aligning, report.moment_overturning}, report.impulse, step.frame.center.y);
  at_.aligning_iso += iso.aligning;
  at_.overturning_iso += iso.overturning;
  at_.penetration = std::max(at_.penetration, report.penetration);
  at_.iterations = std::max(at_.iterations, report.cluster_iterations);
  at_.extensions = std::max(at_.extensions, report.extensions);
  at_.hub_impulse += dt_ * step.rim.force;
  at_.hub_angular_impulse += dt_ * step.rim.torque;
  if (!is_due(step.frame.time)) return;
  append_row(step, state, rows);
  if (interval_ > 0.0)
    at_.next = static_cast<long long>((step.frame.time + 0.5 * dt_) / interval_) + 1;
  const long long next = at_.next;
  at_ = {};
  at_.next = next;
  at_.done = step.step;
}

void History::finish(const dynamics::StepReport& step, const dynamics::State* state,
                     std::vector<double>& rows) {
  if (at_.steps > 0) append_row(step, state, rows);
}

void History::append_row(const dynamics::StepReport& step, const dynamics::State* state,
                         std::vector<double>& rows) {
  RONDO_DEMAND(at_.steps > 0, step.step);  // the means below are over them
  [[maybe_unused]] const std::size_t before = rows.size();
  const double span = static_cast<double>(at_.steps) * dt_;
  HistoryRecord r;
  r.time = step.frame.time;
  r.angle = step.frame.angle;
  r.center = step.frame.center;
  r.force = at_.impulse / span;
  r.torque = at_.angular_impulse / span;
  r.nodes = step.contact.nodes;
  r.sticking = step.contact.sticking;
  measure_contact(step, state, r);
  r.penetration = at_.penetration;
  r.slip_ratio = slip_ratio(step);
  r.balance = step.balance;
  r.moment_aligning = at_.aligning / span;
  r.moment_overturning = at_.overturning / span;
  r.moments_iso = {at_.aligning_iso / span, at_.overturning_iso / span};
  r.slip_angle = step.frame.slip_angle;
  r.rim = step.rim;
  r.rim.force = at_.hub_impulse / span;
  r.rim.torque = at_.hub_angular_impulse / span;
  r.iterations = at_.iterations;
  r.extensions = at_.extensions;
  r.material = step.material;
  append_history(features_, r, rows);
  append_probes(state, rows);
  RONDO_ASSERT(rows.size() - before == columns().size(), rows.size() - before, columns().size());
}

}  // namespace rondo::study
