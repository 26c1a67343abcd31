// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/wheel_rim.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index;

/// Matrices are kept for spins within this share of the largest.
constexpr double same_spin = 1e-3;
/// Relative error of the torque that a brake holds, due to round-off of the contacts.
constexpr double brake_slack = 1e-9;

double mean(const dynamics::Table& table, double from, double length) {
  return table.integral(from, length) / length;
}

Vec2 plane(const RimVector& v) noexcept {
  return {v[0], v[1]};
}

}  // namespace

WheelRim::WheelRim(const dynamics::Model& model, double theta, double largest_spin)
    : model_(model), rim_(*model.rim), theta_(theta), closeness_(same_spin * largest_spin) {
  RONDO_DEMAND(model.rim && largest_spin >= 0.0, largest_spin);
  const std::vector<double>& mass = model.lumped_mass.empty() ? model.mass : model.lumped_mass;
  for (const int k : model.free) {
    body_mass_ += mass[at(k)];
    body_inertia_ += mass[at(k)] * dot(model.reference[at(k)], model.reference[at(k)]);
  }
  mass_ = rim_.mass + body_mass_;
  inertia_ = rim_.inertia + body_inertia_;
  center_ = model.motion.center(0.0).plane();
  x_.add(center_.x);
  y_.add(center_.y);
  now_ = given(-model.dt);
  if (rim_.free_x) now_[0] = model.motion.speed.at(0.0);
  if (rim_.free_y) now_[1] = 0.0;
  end_ = now_;
  kept_spin_ = now_[2];
  for (RimVector* v : {&force_, &momentum_, &actual_, &error_}) v->setZero();
  set_frame(0.0, {});
  frame_.time = 0.0;
}

bool WheelRim::is_free(Index k) const noexcept {
  return k == 0 ? rim_.free_x : k == 1 ? rim_.free_y : rim_.free_spin;
}

/// Whether forces move the component in this try: not where a table or the brake holds it.
bool WheelRim::moves(Index k) const noexcept {
  return is_free(k) && !(k == 2 && brake_ == Brake::locks);
}

/// Velocities by the tables at the end of a step: those of the center are means over the step, so
/// that its kinks are spread over the step that ends there.
RimVector WheelRim::given(double t) const {
  const double dt = model_.dt;
  const Vec2 way = model_.motion.advance(t, dt).plane();
  return {way.x / dt, way.y / dt, -model_.motion.angular_velocity.at(t + dt)};
}

WheelMotion WheelRim::at_start() const {
  WheelMotion m;
  m.center = m.center_next = center_;
  m.spin_next = now_[2];
  return m;
}

RimVector WheelRim::momentum_of(const RimVector& v, const WheelSums& sums) const {
  return RimVector(mass_ * v[0], mass_ * v[1], inertia_ * v[2]) + sums.of(v[2]);
}

void WheelRim::start(const WheelSums& sums, const RimVector& force) {
  sums_ = sums;
  force_ = force;
  momentum_ = actual_ = momentum_of(now_, sums_);
}

WheelMotion WheelRim::begin(long long n) {
  const double dt = model_.dt, t = static_cast<double>(n) * dt;
  step_ = n;
  load_ = {mean(rim_.force_x, t, dt), mean(rim_.force_y, t, dt), -mean(rim_.torque, t, dt)};
  gravity_ = model_.motion.gravity_at(t + 0.5 * dt);
  const RimVector held = led_ ? *led_ : given(t);
  for (Index k = 0; k < 3; ++k)
    begun_[k] = !is_free(k) ? (held[k] - now_[k]) / dt : k == 2 ? rate_ : 0.0;
  end_ = now_ + dt * begun_;
  WheelMotion& m = motion_;
  m.angle = angle_.value();
  m.angle_next = m.angle + (rim_.free_spin || led_ ? 0.5 * dt * (now_[2] + end_[2])
                                                   : model_.motion.turn(t, dt));
  m.spin_next = end_[2];
  m.spin_rate = begun_[2];
  m.center = center_;
  const Vec2 table = model_.motion.center(t + dt).plane(), way = 0.5 * dt * plane(now_ + end_);
  m.center_next = {rim_.free_x || led_ ? center_.x + way.x : table.x,
                   rim_.free_y || led_ ? center_.y + way.y : table.y};
  m.pull = plane(begun_) - gravity_;
  const double ahead = (m.angle_next - m.angle) / dt;
  if (std::abs(ahead - kept_spin_) > closeness_) kept_spin_ = ahead;
  m.kept_spin = kept_spin_;
  braking_ = rim_.free_spin ? mean(rim_.brake, t, dt) : 0.0;
  direction_ = now_[2] > 0.0 ? 1.0 : -1.0;
  brake_ = braking_ == 0.0 ? Brake::off : now_[2] == 0.0 ? Brake::locks : Brake::slips;
  tries_ = 0;
  return m;
}

/// Forces on the rim but those of the ground and of the brake, for mean velocities and place.
RimVector WheelRim::outside(const RimVector& v, Vec2 place) const {
  const auto line = [&](double load, double weight, const dynamics::RimSupport& s, double x,
                        double rate) {
    return load + mass_ * weight - s.stiffness * (x - s.at) - s.damping * rate;
  };
  return {line(load_[0], gravity_.x, rim_.support_x, place.x, v[0]),
          line(load_[1], gravity_.y, rim_.support_y, place.y, v[1]), load_[2]};
}

/// Momentum at the end of the step is that at its start and what forces give, for accelerations z
/// beyond those of begin(): lines_ z = known_ + what the new forces give.
void WheelRim::set_lines(const WheelAnswer& a) {
  const double dt = model_.dt;
  const Vec2 moment = 0.5 * (sums_.moment + a.free.moment);
  const auto line = [&](const dynamics::RimSupport& s) {
    return dt * (mass_ + 0.5 * dt * (s.damping + 0.5 * dt * s.stiffness));
  };
  lines_ = a.by_rate;
  lines_(0, 0) += line(rim_.support_x);
  lines_(1, 1) += line(rim_.support_y);
  lines_(2, 2) += dt * (inertia_ + 2.0 * a.free.stretch + a.free.square);
  lines_(0, 2) -= dt * a.free.moment.y;
  lines_(1, 2) += dt * a.free.moment.x;
  lines_(2, 0) -= dt * moment.y;
  lines_(2, 1) += dt * moment.x;
  const RimVector middle = 0.5 * (now_ + end_);
  known_ = momentum_ - error_ - momentum_of(end_, a.free) +
           dt * (outside(middle, 0.5 * (center_ + motion_.center_next)) + (1.0 - theta_) * force_);
  known_[2] -= dt * (cross(moment, motion_.pull) - aside_ * moment.x);
}

RimVector WheelRim::hold() {
  const double dt = model_.dt;
  right_ = known_;
  if (brake_ == Brake::slips) right_[2] -= dt * braking_ * direction_;
  RimVector held = RimVector::Zero();
  if (brake_ == Brake::locks) held[2] = -now_[2] / dt - begun_[2];
  Eigen::Matrix3d lines = lines_;
  at_rest_ = right_;
  for (Index k = 0; k < 3; ++k) {
    if (moves(k)) continue;
    lines.row(k) = Eigen::RowVector3d::Unit(k);
    at_rest_[k] = held[k];
  }
  answer_ = lines.inverse();
  at_rest_ = answer_ * at_rest_;
  for (Index k = 0; k < 3; ++k)
    if (!moves(k)) answer_.col(k).setZero();
  return at_rest_;
}

bool WheelRim::settled(const RimVector& push) {
  ++tries_;
  gave_up_ = false;
  change_ = at_rest_ + answer_ * push;
  for (Index k = 0; k < 3; ++k)
    if (is_free(k)) end_[k] = now_[k] + model_.dt * (begun_[k] + change_[k]);
  constexpr int most_tries = 4;
  if (brake_ == Brake::off) return true;
  if (brake_ == Brake::slips) {
    if (end_[2] * direction_ >= 0.0) return true;
    gave_up_ = tries_ >= most_tries;
    if (gave_up_) return true;
    brake_ = Brake::locks;
    return false;
  }
  end_[2] = 0.0;
  const double torque = (lines_.row(2).dot(change_) - right_[2] - push[2]) / model_.dt;
  if (std::abs(torque) <= braking_ * (1.0 + brake_slack)) return true;
  gave_up_ = tries_ >= most_tries;
  if (gave_up_) return true;
  brake_ = Brake::slips;
  direction_ = torque > 0.0 ? -1.0 : 1.0;
  return false;
}

WheelMotion WheelRim::moved() const {
  const double dt = model_.dt;
  const Vec2 way = 0.5 * dt * plane(now_ + end_);
  WheelMotion m = motion_;
  if (rim_.free_x) m.center_next.x = center_.x + way.x;
  if (rim_.free_y) m.center_next.y = center_.y + way.y;
  if (rim_.free_spin) m.angle_next = m.angle + 0.5 * dt * (now_[2] + end_[2]);
  m.spin_next = end_[2];
  m.spin_rate = (end_[2] - now_[2]) / dt;
  return m;
}

void WheelRim::add_energy(dynamics::StepEnergy& e) const {
  const Vec2 v = plane(now_);
  const double s = now_[2];
  const RimVector of = sums_.of(s);
  e.kinetic += 0.5 * body_mass_ * dot(v, v) + dot(v, plane(of)) + s * sums_.swirl +
               0.5 * s * s * (body_inertia_ + 2.0 * sums_.stretch + sums_.square);
  e.kinetic_rim = 0.5 * (rim_.mass * dot(v, v) + rim_.inertia * s * s);
  const auto spring = [](const dynamics::RimSupport& at, double place) {
    return 0.5 * at.stiffness * (place - at.at) * (place - at.at);
  };
  e.support = spring(rim_.support_x, center_.x) + spring(rim_.support_y, center_.y);
}

void WheelRim::add_works(const RimVector& v, const RimVector& held, dynamics::Works& w) const {
  const double dt = model_.dt;
  w.rim_load += dt * dot(plane(load_), plane(v));
  w.torque += dt * load_[2] * v[2];
  for (Index k = 0; k < 3; ++k)
    if (!is_free(k)) w.held += dt * held[k] * v[k];
  if (brake_ == Brake::slips) w.dissipation_brake += dt * braking_ * direction_ * v[2];
  if (brake_ == Brake::locks) w.dissipation_brake -= dt * held[2] * v[2];
  w.dissipation_support +=
      dt * (rim_.support_x.damping * v[0] * v[0] + rim_.support_y.damping * v[1] * v[1]);
}

/// Work by which the step misses the balance of energies: of what the balances of momentum missed,
/// of products of changes in the step, and of forces whose means differ on the two sides.
double WheelRim::scheme_work(const End& end, const RimVector& missed) const {
  const double dt = model_.dt, s = now_[2], s_end = end_[2];
  const RimVector v = 0.5 * (now_ + end_), change = end_ - now_;
  const Vec2 momentum = 0.5 * plane(sums_.of(s) + end.sums.of(s_end));
  const Vec2 moment = 0.5 * (sums_.moment + end.sums.moment);
  const double begun = (motion_.angle_next - motion_.angle) / dt;
  const RimVector force = theta_ * end.force + (1.0 - theta_) * force_;
  return missed.dot(v) + dot(plane(change), momentum - end.middle - v[2] * turn90(moment)) +
         (begun * begun - s * s_end) * (end.sums.stretch - sums_.stretch) +
         0.5 * (kept_spin_ * kept_spin_ - s * s_end) * (end.sums.square - sums_.square) +
         change[2] * (0.5 * (sums_.swirl + end.sums.swirl) - end.swirl) + dt * force.dot(v) -
         end.rim_work;
}

void WheelRim::finish(const End& end, dynamics::Works& works) {
  const double dt = model_.dt, t = static_cast<double>(step_) * dt;
  const WheelMotion m = moved();
  const RimVector v = 0.5 * (now_ + end_), change = end_ - now_;
  const Vec2 moment = 0.5 * (sums_.moment + end.sums.moment);
  RimVector force =
      outside(v, 0.5 * (m.center + m.center_next)) + theta_ * end.force + (1.0 - theta_) * force_;
  force[2] -= cross(moment, plane(change) / dt - gravity_) + end.aside;
  if (brake_ == Brake::slips) force[2] -= braking_ * direction_;
  const RimVector after = momentum_of(end_, end.sums);
  RimVector missed = after - actual_ - dt * force, held = RimVector::Zero();
  for (Index k = 0; k < 3; ++k) {
    if (moves(k)) {
      momentum_[k] += dt * force[k];
      error_[k] += after[k] - momentum_[k];
      continue;
    }
    held[k] = missed[k] / dt;
    momentum_[k] = after[k];
    missed[k] = error_[k] = 0.0;
  }
  add_works(v, held, works);
  const Vec2 carried = mass_ * plane(v) + end.middle + v[2] * turn90(moment);
  works.gravity += dt * dot(gravity_, carried);
  works.scheme += scheme_work(end, missed);
  report_ = {};
  report_.velocity = plane(end_);
  report_.spin = 0.0 - end_[2];
  if (!rim_.free_x) report_.force.x = held[0];
  if (!rim_.free_y) report_.force.y = held[1];
  if (!rim_.free_spin) report_.torque = 0.0 - held[2];

  x_.add(dt * v[0]);
  y_.add(dt * v[1]);
  const double turn = rim_.free_spin || led_ ? dt * v[2] : model_.motion.turn(t, dt);
  angle_.add(turn);
  const Vec2 before = center_;
  const Vec2 table = model_.motion.center(t + dt).plane();
  center_ = {rim_.free_x || led_ ? x_.value() : table.x,
             rim_.free_y || led_ ? y_.value() : table.y};
  most_spin_ = std::max(most_spin_, std::abs(end_[2]));
  rate_ = brake_ == Brake::locks ? 0.0 : change[2] / dt;
  now_ = end_;
  sums_ = end.sums;
  actual_ = after;
  force_ = end.force;
  set_frame(turn, center_ - before);
}

void WheelRim::set_frame(double turn, Vec2 way) {
  frame_ = {};
  frame_.time = static_cast<double>(step_) * model_.dt + model_.dt;
  frame_.spin = now_[2];
  frame_.angle = angle_.value();
  frame_.turn_before = turn;
  frame_.turn = model_.dt * now_[2];
  frame_.rotation = rotation(frame_.angle);
  frame_.center = center_;
  frame_.advance_before = way;
}

std::vector<double> WheelRim::save() const {
  const WheelSums& s = sums_;
  std::vector<double> out{x_.sum(),
                          x_.correction(),
                          y_.sum(),
                          y_.correction(),
                          angle_.sum(),
                          angle_.correction(),
                          center_.x,
                          center_.y,
                          kept_spin_,
                          rate_,
                          s.momentum.x,
                          s.momentum.y,
                          s.moment.x,
                          s.moment.y,
                          s.swirl,
                          s.stretch,
                          s.square,
                          frame_.turn_before,
                          frame_.advance_before.x,
                          frame_.advance_before.y};
  for (const RimVector* v : {&now_, &force_, &momentum_, &error_})
    out.insert(out.end(), v->begin(), v->end());
  out.push_back(most_spin_);
  return out;
}

void WheelRim::restore(long long n, std::span<const double> a) {
  RONDO_DEMAND(a.size() == n_numbers && n >= 0, a.size(), n);
  step_ = n - 1;
  x_ = {a[0], a[1]};
  y_ = {a[2], a[3]};
  angle_ = {a[4], a[5]};
  center_ = {a[6], a[7]};
  kept_spin_ = a[8];
  rate_ = a[9];
  sums_ = {{a[10], a[11]}, {a[12], a[13]}, a[14], a[15], a[16]};
  std::size_t i = 20;
  for (RimVector* v : {&now_, &force_, &momentum_, &error_})
    for (double& x : *v) x = a[i++];
  most_spin_ = a[i];
  end_ = now_;
  actual_ = momentum_of(now_, sums_);
  set_frame(a[17], {a[18], a[19]});
}

}  // namespace rondo::rom
