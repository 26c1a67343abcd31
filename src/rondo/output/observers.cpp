// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/observers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "rondo/io/files.hpp"
#include "rondo/model/corotated.hpp"
#include "rondo/output/probes.hpp"

namespace rondo::study {

std::vector<std::string> history_columns() {
  return {"time_s",
          "angle_rad",
          "center_x_m",
          "center_y_m",
          "force_x",
          "force_y",
          "torque",
          "contact_nodes",
          "sticking_nodes",
          "contact_length_m",
          "penetration_max_m",
          "slip_ratio",
          "kinetic",
          "strain",
          "work_frame",
          "work_contact",
          "dissipation_friction",
          "loss_impact",
          "work_rim",
          "dissipation_mass",
          "dissipation_stiffness",
          "work_scheme",
          "energy_residual",
          "work_load"};
}

std::vector<std::string> contact_columns() {
  return {"time_s", "node", "abscissa_m", "x_m", "y_m", "pressure_pa", "shear_pa"};
}

namespace {

/// Of a disk; of a mesh the largest of the candidates that are held. 0: all of them are free.
double rolling_radius(const Case& c, const Setup& setup) {
  if (!is_held(c)) return 0.0;
  if (!c.mesh) return c.disk.outer_radius;
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
      at_(place) {}

std::vector<std::string> History::columns() const {
  std::vector<std::string> names = history_columns();
  const std::vector<std::string> probes = probe_columns(case_.output.probes);
  names.insert(names.end(), probes.begin(), probes.end());
  return names;
}

double History::slip_ratio(double time) const {
  if (radius_ == 0.0) return 0.0;
  return dynamics::slip_ratio(case_.motion.angular_velocity.at(time) * radius_,
                              case_.motion.speed.at(time));
}

/// The step nearest to a multiple of the interval writes the row.
bool History::is_due(double time) const noexcept {
  return time + 0.5 * dt_ > static_cast<double>(at_.next) * interval_;
}

long long History::next_probed() const noexcept {
  if (setup_.probes.empty()) return std::numeric_limits<long long>::max();
  if (interval_ == 0.0) return at_.done + 1;
  const auto time = [&](long long step) { return static_cast<double>(step) * dt_; };
  // A guess, then the same comparison as that of the step itself.
  auto step = static_cast<long long>(static_cast<double>(at_.next) * interval_ / dt_ - 0.5);
  step = std::max(step, at_.done + 1);
  while (step > at_.done + 1 && is_due(time(step - 1))) --step;
  while (!is_due(time(step))) ++step;
  return step;
}

void History::append_probes(const dynamics::State* state, std::vector<double>& rows) const {
  if (setup_.probes.empty()) return;
  if (state)
    return study::append_probes({setup_.mesh, setup_.materials, setup_.model}, setup_.probes,
                                *state, rows);
  rows.insert(rows.end(), probe_columns(case_.output.probes).size(),
              std::numeric_limits<double>::quiet_NaN());
}

void History::observe(const dynamics::StepReport& step, const dynamics::State* state,
                      std::vector<double>& rows) {
  const dynamics::ContactReport& report = step.contact;
  at_.done = step.step;
  ++at_.steps;
  at_.impulse += report.impulse;
  at_.angular_impulse += report.angular_impulse;
  at_.penetration = std::max(at_.penetration, report.penetration);
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
  const dynamics::ContactReport& report = step.contact;
  const double time = step.frame.time;
  const double span = static_cast<double>(at_.steps) * dt_;
  const dynamics::Balance& b = step.balance;
  const dynamics::Works& w = b.works;
  const std::array row{time,
                       step.frame.angle,
                       step.frame.center.x,
                       step.frame.center.y,
                       at_.impulse.x / span,
                       at_.impulse.y / span,
                       at_.angular_impulse / span,
                       static_cast<double>(report.nodes),
                       static_cast<double>(report.sticking),
                       report.length,
                       at_.penetration,
                       slip_ratio(time),
                       b.kinetic,
                       b.strain,
                       w.frame,
                       w.contact,
                       w.dissipation_friction,
                       w.loss_impact,
                       w.rim,
                       w.dissipation_mass,
                       w.dissipation_stiffness,
                       w.scheme,
                       b.residual,
                       w.load};
  rows.insert(rows.end(), row.begin(), row.end());
  append_probes(state, rows);
}

namespace {

io::ResultsLayout layout(const Case& c, const Setup& setup, std::size_t n_snapshots) {
  constexpr bool quasi_static = false;
  return {&setup.mesh,     setup.model.mass, n_snapshots,          has_candidates(setup.model),
          c.output.stress, quasi_static,     setup.model.free_body};
}

}  // namespace

Snapshots::Snapshots(const std::filesystem::path& directory, const Case& c, const Setup& setup,
                     std::size_t planned)
    : setup_(setup),
      results_(directory, layout(c, setup, planned)),
      contact_csv_(directory / "contact.csv", contact_columns()) {
  make_room(c);
}

Snapshots::Snapshots(const std::filesystem::path& directory, const Case& c, const Setup& setup,
                     std::size_t planned, std::size_t kept, std::size_t contact_bytes)
    : setup_(setup),
      results_(directory, layout(c, setup, planned), kept),
      contact_csv_(directory / "contact.csv", contact_columns(), contact_bytes) {
  make_room(c);
}

void Snapshots::make_room(const Case& c) {
  const Setup& setup = setup_;
  if (c.output.stress) stress_.emplace(setup.mesh, setup.materials);
  const std::size_t nb = has_candidates(setup.model) ? setup.mesh.boundary.size() : 0;
  if (!setup.model.free_bodies.empty()) elastic_.resize(setup.mesh.n_nodes());
  rotations_.resize(setup.model.free_bodies.size());
  force_.resize(nb);
  force_fixed_.resize(nb);
  on_ground_.resize(nb);
  rows_.reserve(7 * nb);
}

void Snapshots::collect_contact(const dynamics::State& state) {
  std::fill(force_.begin(), force_.end(), Vec2{});
  std::fill(force_fixed_.begin(), force_fixed_.end(), Vec2{});
  std::fill(on_ground_.begin(), on_ground_.end(), char{0});
  // A node held by two facets gives the sum of both, in the frame of the deeper one (listed first).
  std::size_t last = force_.size();
  Vec2 normal;
  for (const dynamics::ActiveContact& c : state.active) {
    if (c.candidate != last) normal = c.normal;
    last = c.candidate;
    const Vec2 force = from_frame(c.normal, c.impulse) / setup_.model.dt;
    force_fixed_[c.candidate] += force;
    if (c.on_ground) on_ground_[c.candidate] = 1;
    force_[c.candidate] += to_frame(normal, force);
  }
}

void Snapshots::write_contact_rows(const dynamics::State& state) {
  rows_.clear();
  for (std::size_t k = 0; k < force_.size(); ++k) {
    if (force_[k].x <= 0.0) continue;
    const int node = setup_.mesh.boundary[k];
    const Vec2 x = position(setup_.model, state, static_cast<std::size_t>(node));
    const Vec2 traction = force_[k] / setup_.mesh.tributary[k];
    const double abscissa = on_ground_[k] ? setup_.model.contact->ground.abscissa(x)
                                          : std::numeric_limits<double>::quiet_NaN();
    for (const double value :
         {state.frame.time, static_cast<double>(node), abscissa, x.x, x.y, traction.x, traction.y})
      rows_.push_back(value);
  }
  contact_csv_.rows(rows_);
}

/// What a body's stress is of.
std::span<const Vec2> Snapshots::elastic(const dynamics::State& state) {
  if (elastic_.empty()) return state.u;
  dynamics::elastic_displacements(setup_.model, state.u, state.poses, elastic_);
  return elastic_;
}

void Snapshots::write(const dynamics::State& state) {
  io::Snapshot s;
  s.time = state.frame.time;
  s.time_velocity = state.step == 0 ? 0.0 : state.frame.time - 0.5 * setup_.model.dt;
  s.angle = state.frame.angle;
  s.angle_velocity = setup_.model.motion.angle(s.time_velocity);
  s.center = state.frame.center;
  s.displacement = state.u;
  s.velocity = state.v;
  if (has_candidates(setup_.model)) {
    collect_contact(state);
    s.contact_force = force_;
    s.contact_force_fixed = force_fixed_;
    write_contact_rows(state);
  }
  if (stress_) s.stress = (*stress_)(elastic(state));
  for (std::size_t b = 0; b < rotations_.size(); ++b) rotations_[b] = state.poses[b].rotation;
  s.body_rotation = rotations_;
  results_.write(s);
}

void Snapshots::sync() const {
  results_.sync();
  io::sync_file(contact_csv_.path());
}

void Snapshots::close() {
  contact_csv_.close();
  results_.close();
}

}  // namespace rondo::study
