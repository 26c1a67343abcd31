// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/observers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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
          "energy_residual"};
}

std::vector<std::string> contact_columns() {
  return {"time_s", "node", "abscissa_m", "x_m", "y_m", "pressure_pa", "shear_pa"};
}

History::History(const Case& c, const Setup& setup)
    : case_(c), dt_(setup.model.dt), interval_(c.output.history_interval) {}

double History::slip_ratio(double time) const {
  const double rim = case_.motion.angular_velocity.at(time) * case_.disk.outer_radius;
  const double speed = case_.motion.speed.at(time);
  const double scale = std::max(std::abs(speed), std::abs(rim));
  return scale > 0.0 ? (rim - speed) / scale : 0.0;
}

void History::observe(const dynamics::StepReport& step, bool last, std::vector<double>& rows) {
  const dynamics::ContactReport& report = step.contact;
  ++steps_;
  impulse_ += report.impulse;
  angular_impulse_ += report.angular_impulse;
  penetration_ = std::max(penetration_, report.penetration);
  const double time = step.frame.time;
  // The step nearest to a multiple of the interval writes the row.
  const bool due = time + 0.5 * dt_ > static_cast<double>(next_) * interval_;
  if (!due && !last) return;
  const double span = static_cast<double>(steps_) * dt_;
  const dynamics::Balance& b = step.balance;
  const dynamics::Works& w = b.works;
  const std::array<double, n_history_columns> row{time,
                                                  step.frame.angle,
                                                  step.frame.center.x,
                                                  step.frame.center.y,
                                                  impulse_.x / span,
                                                  impulse_.y / span,
                                                  angular_impulse_ / span,
                                                  static_cast<double>(report.nodes),
                                                  static_cast<double>(report.sticking),
                                                  report.length,
                                                  penetration_,
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
                                                  b.residual};
  rows.insert(rows.end(), row.begin(), row.end());
  if (interval_ > 0.0) next_ = static_cast<long long>((time + 0.5 * dt_) / interval_) + 1;
  steps_ = 0;
  impulse_ = {};
  angular_impulse_ = penetration_ = 0.0;
}

std::vector<long long> snapshot_steps(int count, double from, double dt, long long n_steps) {
  std::vector<long long> steps;
  const double end = static_cast<double>(n_steps) * dt;
  for (int j = 0; j < count; ++j) {
    const double share = count > 1 ? static_cast<double>(j) / (count - 1) : 1.0;
    const auto step = static_cast<long long>(std::llround((from + share * (end - from)) / dt));
    const long long within = std::clamp(step, 0LL, n_steps);
    if (steps.empty() || within > steps.back()) steps.push_back(within);
  }
  return steps;
}

namespace {

io::ResultsLayout layout(const Case& c, const Setup& setup, std::size_t n_snapshots) {
  return {&setup.mesh, setup.model.mass, n_snapshots, setup.model.contact.has_value(),
          c.output.stress};
}

}  // namespace

Snapshots::Snapshots(const std::filesystem::path& directory, const Case& c, const Setup& setup,
                     std::size_t planned)
    : setup_(setup),
      results_(directory, layout(c, setup, planned)),
      contact_csv_(directory / "contact.csv", contact_columns()) {
  if (c.output.stress) stress_.emplace(setup.mesh, std::span(&c.material, 1));
  const std::size_t nb = setup.model.contact ? setup.mesh.boundary.size() : 0;
  force_.resize(nb);
  force_fixed_.resize(nb);
  rows_.reserve(7 * nb);
}

void Snapshots::collect_contact(const dynamics::State& state) {
  std::fill(force_.begin(), force_.end(), Vec2{});
  std::fill(force_fixed_.begin(), force_fixed_.end(), Vec2{});
  // A node held by two facets gives the sum of both, in the frame of the deeper one (listed first).
  std::size_t last = force_.size();
  Vec2 normal;
  for (const dynamics::ActiveContact& c : state.active) {
    if (c.candidate != last) normal = c.normal;
    last = c.candidate;
    const Vec2 force = (c.normal * c.impulse) / setup_.model.dt;
    force_fixed_[c.candidate] += force;
    force_[c.candidate] += conj(normal) * force;
  }
}

void Snapshots::write_contact_rows(const dynamics::State& state) {
  rows_.clear();
  for (std::size_t k = 0; k < force_.size(); ++k) {
    if (force_[k].x <= 0.0) continue;
    const int node = setup_.mesh.boundary[k];
    const Vec2 x = position(setup_.model, state, static_cast<std::size_t>(node));
    const Vec2 traction = force_[k] / setup_.mesh.tributary[k];
    for (const double value :
         {state.frame.time, static_cast<double>(node), setup_.model.contact->ground.abscissa(x),
          x.x, x.y, traction.x, traction.y})
      rows_.push_back(value);
  }
  contact_csv_.rows(rows_);
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
  if (setup_.model.contact) {
    collect_contact(state);
    s.contact_force = force_;
    s.contact_force_fixed = force_fixed_;
    write_contact_rows(state);
  }
  if (stress_) s.stress = (*stress_)(state.u);
  results_.write(s);
}

void Snapshots::close() {
  contact_csv_.close();
  results_.close();
}

}  // namespace rondo::study
