// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/moving_rim.hpp"

#include <Eigen/LU>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/pod/dense.hpp"
#include "rondo/rom/reduced_model.hpp"

namespace rondo::rom {

using pod::multiply;

namespace {

/// Relative error of the force that a brake holds, due to round-off of the contacts.
constexpr double brake_slack = 1e-9;

double mean(const dynamics::Table& table, double from, double length) {
  return table.integral(from, length) / length;
}

/// ċ and s according to the tables.
RimVector given(const dynamics::Motion& motion, double t) {
  return {motion.speed.at(t), motion.height.slope(t), -motion.angular_velocity.at(t)};
}

/// E⊥: columns of unit fields along x and y, turned by -90 degrees.
Eigen::Matrix<double, Eigen::Dynamic, 2> turned(const MatrixXd& translation) {
  Eigen::Matrix<double, Eigen::Dynamic, 2> out(translation.rows(), 2);
  out.col(0) = -translation.col(1);
  out.col(1) = translation.col(0);
  return out;
}

}  // namespace

MovingRim::MovingRim(const dynamics::Model& model, const ReducedModel& reduced)
    : model_(model), rim_(*model.rim), reduced_(reduced), body_(*reduced.rim) {
  RONDO_DEMAND(model.rim && reduced.rim && reduced.frame == ModelFrame::rectified);
  const Index r = reduced.size();
  center_ = model.motion.center(0.0).plane();
  x_.add(center_.x);
  y_.add(center_.y);
  now_ = given(model.motion, 0.0);
  if (rim_.free_y) now_[1] = 0.0;
  end_ = now_;
  spin_before_ = now_[2];
  for (VectorXd* v : {&q_arm_, &late_, &turned_arm_, &carried_arm_, &load_modes_, &work_})
    v->setZero(r);
  across_ = turned(reduced.translation);
  forward_.resize(r, 3);
  back_.resize(r, 3);
}

bool MovingRim::is_free(Index k) const noexcept {
  return k == 0 ? rim_.free_x : k == 1 ? rim_.free_y : rim_.free_spin;
}

void MovingRim::begin(long long n, const VectorXd& q) {
  const double dt = model_.dt, t = static_cast<double>(n) * dt;
  step_ = n;
  load_ = {mean(rim_.force_x, t, dt), mean(rim_.force_y, t, dt), -mean(rim_.torque, t, dt)};
  gravity_ = model_.motion.gravity_at(t + 0.5 * dt);
  const RimVector held = led_ ? *led_ : given(model_.motion, t + dt);
  for (Index k = 0; k < 3; ++k) end_[k] = is_free(k) ? now_[k] : held[k];
  const double ahead =
      rim_.free_spin ? 1.5 * now_[2] - 0.5 * spin_before_ : 0.5 * (now_[2] + held[2]);
  const bool serves =
      (rim_.free_spin || led_) && std::abs(ahead - spin_) <= same_spin * std::abs(ahead);
  if (!serves) spin_ = ahead;
  if (q_before_.size() == 0) q_before_ = q;
  q_arm_ = 1.5 * q - 0.5 * q_before_;
  braking_ = rim_.free_spin ? mean(rim_.brake, t, dt) : 0.0;
  direction_ = now_[2] > 0.0 ? 1.0 : -1.0;
  brake_ = braking_ == 0.0 ? Brake::off : now_[2] == 0.0 ? Brake::locks : Brake::slips;
  tries_ = 0;
}

void MovingRim::use(const StepMatrices& matrices) {
  set_lines(matrices);
  const double h = 0.5 * model_.dt;
  const MatrixXd velocity = matrices.push_inverse() * forward_;
  const MatrixXd displacement = h * (matrices.carry() * velocity);
  for (std::size_t k = 0; k < 3; ++k) {
    response_.velocity[k] = velocity.col(static_cast<Index>(k));
    response_.displacement[k] = displacement.col(static_cast<Index>(k));
  }
}

/// B, C and D of (R.8), as if all components were free.
void MovingRim::set_lines(const StepMatrices& matrices) {
  const ReducedModel& m = reduced_;
  const double h = 0.5 * model_.dt;
  multiply(m.turn, q_arm_, turned_arm_);
  turned_arm_ += m.turned_reference;
  multiply(body_.carried_turn, q_arm_, carried_arm_);
  carried_arm_ += m.reference + q_arm_;
  forward_.leftCols(2) = m.translation;
  forward_.col(2) = turned_arm_ - h * spin_ * carried_arm_;
  MatrixXd along(m.size(), 3);  // of q̄ - q
  along.leftCols(2) = spin_ * across_;
  along.col(2) = spin_ * (m.reference + q_arm_);
  back_ = h * (matrices.carry().transpose() * along);
  back_.leftCols(2) += m.translation;
  back_.col(2) += turned_arm_ + h * spin_ * carried_arm_;
  const Eigen::Vector2d offset = across_.transpose() * q_arm_;
  const auto line = [&](const dynamics::RimSupport& s) {
    return rim_.mass + body_.mass + h * h * s.stiffness + h * s.damping;
  };
  mass_ << line(rim_.support_x), 0.0, offset[0], 0.0, line(rim_.support_y), offset[1], offset[0],
      offset[1],
      rim_.inertia + body_.inertia + 2.0 * m.reference.dot(q_arm_) + q_arm_.squaredNorm();
}

/// Constrains prescribed components, and the spin if a brake locks it.
void MovingRim::hold(const StepMatrices& matrices) {
  MatrixXd back = back_;
  Eigen::Matrix3d d = mass_;
  for (Index k = 0; k < 3; ++k) {
    const bool free = is_free(k) && !(k == 2 && brake_ == Brake::locks);
    response_.free[k] = free ? 1.0 : 0.0;
    if (free) continue;
    back.col(k).setZero();
    d.row(k) = Eigen::RowVector3d::Unit(k);
  }
  for (std::size_t k = 0; k < 3; ++k)
    for (Index i = 0; i < 3; ++i)
      d(i, static_cast<Index>(k)) -= back.col(i).dot(response_.velocity[k]);
  response_.inverse = d.inverse();
  back = matrices.push_inverse().transpose() * back;
  for (std::size_t k = 0; k < 3; ++k) response_.back[k] = back.col(static_cast<Index>(k));
}

/// Parts of the right sides of (R.8) that are known at the beginning of the step.
void MovingRim::set_known(const StepMatrices& matrices, const VectorXd& q, const VectorXd& p) {
  const ReducedModel& m = reduced_;
  const double h = 0.5 * model_.dt;
  work_.noalias() = matrices.carry() * q;
  work_ = spin_ * (work_ - q) + 0.5 * late_;
  const VectorXd arm = m.reference + q_arm_;
  const Eigen::Vector2d momentum = m.translation.transpose() * p - across_.transpose() * work_;
  const double whole = rim_.mass + body_.mass;
  const Eigen::Vector2d offset = across_.transpose() * q_arm_;
  const auto line = [&](Index k, const dynamics::RimSupport& s, double g, double c) {
    const double weight = whole * g;
    return whole * now_[k] + momentum[k] + offset[k] * now_[2] +
           h * (load_[k] + weight - s.stiffness * (c - s.at));
  };
  known_[0] = line(0, rim_.support_x, gravity_.x, center_.x);
  known_[1] = line(1, rim_.support_y, gravity_.y, center_.y);
  known_[2] = mass_(2, 2) * now_[2] + offset.dot(now_.head<2>()) + turned_arm_.dot(p) -
              arm.dot(work_) + h * (load_[2] + offset.dot(Eigen::Vector2d(gravity_.x, gravity_.y)));
  multiply(m.turn, late_, work_);
  const Eigen::Vector2d g(gravity_.x, gravity_.y);
  load_modes_ = 2.0 * (m.translation * (now_.head<2>() + h * g) + now_[2] * turned_arm_) - work_;
}

void MovingRim::try_step(StepMatrices& matrices, const VectorXd& q, const VectorXd& p,
                         VectorXd& q_end, VectorXd& p_end) {
  if (tries_ == 0) set_known(matrices, q, p);
  hold(matrices);
  direct_.setZero();
  if (brake_ == Brake::locks) end_[2] = 0.0;
  matrices.advance(q, p, load_modes_, q_end, p_end, work_);
  RimVector right = known_;
  if (brake_ == Brake::slips) right[2] -= 0.5 * model_.dt * braking_ * direction_;
  work_ = 0.5 * (p + p_end);
  for (Index k = 0; k < 3; ++k)
    right[k] = response_.free[k] != 0.0 ? right[k] : 0.5 * (now_[k] + end_[k]);
  // p̄ without the rim is A⁻¹ of its right side; C times it enters equations of free components.
  for (Index k = 0; k < 3; ++k)
    if (response_.free[k] != 0.0) right[k] -= back_.col(k).dot(work_);
  const RimVector mean_velocity = response_.inverse * right;
  for (std::size_t k = 0; k < 3; ++k) {
    const double twice = 2.0 * mean_velocity[static_cast<Index>(k)];
    p_end -= twice * response_.velocity[k];
    q_end -= twice * response_.displacement[k];
  }
  for (Index k = 0; k < 3; ++k)
    if (response_.free[k] != 0.0) end_[k] = 2.0 * mean_velocity[k] - now_[k];
}

void MovingRim::push(StepMatrices& matrices, const VectorXd& modes, const RimVector& direct,
                     VectorXd& q_end, VectorXd& p_end) {
  direct_ = direct;
  const RimVector z = response_.change(modes, direct);
  matrices.add_response(modes, q_end, p_end);
  for (std::size_t k = 0; k < 3; ++k) {
    p_end -= z[static_cast<Index>(k)] * response_.velocity[k];
    q_end -= z[static_cast<Index>(k)] * response_.displacement[k];
  }
  for (Index k = 0; k < 3; ++k)
    if (response_.free[k] != 0.0) end_[k] += z[k];
}

/// Residual of the rim's equations: mean forces that constrain it or brake it.
RimVector MovingRim::reaction(const VectorXd& p_mid) const {
  return (mass_ * velocity_mean() + back_.transpose() * p_mid - known_ - 0.5 * direct_) /
         (0.5 * model_.dt);
}

bool MovingRim::settled(const VectorXd& p_mid) {
  ++tries_;
  gave_up_ = false;
  if (brake_ == Brake::off) return true;
  constexpr int most_tries = 4;
  if (brake_ == Brake::slips) {
    if (end_[2] * direction_ >= 0.0) return true;
    brake_ = Brake::locks;
    return false;
  }
  const double torque = reaction(p_mid)[2];
  if (std::abs(torque) <= braking_ * (1.0 + brake_slack)) return true;
  gave_up_ = tries_ >= most_tries;
  if (gave_up_) return true;
  brake_ = Brake::slips;
  direction_ = torque > 0.0 ? -1.0 : 1.0;
  return false;
}

Vec2 MovingRim::center_end() const noexcept {
  const double dt = model_.dt;
  const Vec2 held = model_.motion.center(static_cast<double>(step_ + 1) * dt).plane();
  const RimVector v = velocity_mean();
  return {rim_.free_x || led_ ? center_.x + dt * v[0] : held.x,
          rim_.free_y || led_ ? center_.y + dt * v[1] : held.y};
}

dynamics::StepEnergy MovingRim::energy(const VectorXd& q, const VectorXd& p) const {
  const ReducedModel& m = reduced_;
  const Eigen::Vector2d c = now_.head<2>();
  const double s = now_[2];
  dynamics::StepEnergy e;
  e.kinetic = 0.5 * (p.squaredNorm() + body_.mass * c.squaredNorm() +
                     s * s * (body_.inertia + 2.0 * m.reference.dot(q) + q.squaredNorm())) +
              p.dot(m.translation * c) + s * (m.turned_reference.dot(p) + p.dot(m.turn * q)) +
              s * c.dot(across_.transpose() * q);
  e.kinetic_rim = 0.5 * (rim_.mass * c.squaredNorm() + rim_.inertia * s * s);
  const auto spring = [](const dynamics::RimSupport& at, double place) {
    return 0.5 * at.stiffness * (place - at.at) * (place - at.at);
  };
  e.support = spring(rim_.support_x, center_.x) + spring(rim_.support_y, center_.y);
  return e;
}

void MovingRim::add_works(const RimVector& v, const RimVector& force, const VectorXd& p_mid,
                          dynamics::Works& w) const {
  const double dt = model_.dt;
  const Eigen::Vector2d g(gravity_.x, gravity_.y), c = v.head<2>();
  const Eigen::Vector2d momentum = (rim_.mass + body_.mass) * c +
                                   reduced_.translation.transpose() * p_mid +
                                   v[2] * (across_.transpose() * q_arm_);
  w.gravity += dt * g.dot(momentum);
  w.rim_load += dt * load_.head<2>().dot(c);
  w.torque += dt * load_[2] * v[2];
  for (Index k = 0; k < 3; ++k)
    if (!is_free(k)) w.held += dt * force[k] * v[k];
  if (brake_ == Brake::slips) w.dissipation_brake += dt * braking_ * direction_ * v[2];
  if (brake_ == Brake::locks) w.dissipation_brake -= dt * force[2] * v[2];
  w.dissipation_support +=
      dt * (rim_.support_x.damping * c[0] * c[0] + rim_.support_y.damping * c[1] * c[1]);
}

/// Work of the errors of s_A and q_A, and of those of the previous step (R.9).
double MovingRim::scheme_work(const VectorXd& q, const VectorXd& p, const VectorXd& q_end,
                              const VectorXd& p_end) {
  const ReducedModel& m = reduced_;
  const RimVector v = velocity_mean(), dv = end_ - now_;
  const VectorXd q_mid = 0.5 * (q + q_end), p_mid = 0.5 * (p + p_end);
  const VectorXd dq = q_end - q, dp = p_end - p;
  VectorXd moved = m.turn * late_;
  double work = -(p_mid.dot(moved) + v.head<2>().dot(across_.transpose() * late_) +
                  v[2] * (m.reference + q_arm_).dot(late_));
  late_ = (v[2] - spin_) * dq + dv[2] * (q_mid - q_arm_);
  const VectorXd whole = 0.5 * (end_[2] * q_end + now_[2] * q), rest = whole - v[2] * q_arm_;
  moved = across_ * v.head<2>() + v[2] * m.reference + whole - m.turn * p_mid;
  work += moved.dot(late_);
  moved = across_ * dv.head<2>() + dv[2] * (m.reference + q_arm_) + spin_ * dq - m.turn * dp;
  return work + moved.dot(rest);
}

void MovingRim::finish(const VectorXd& q, const VectorXd& p, const VectorXd& q_end,
                       const VectorXd& p_end, dynamics::Works& works) {
  work_ = 0.5 * (p + p_end);
  const RimVector v = velocity_mean(), force = reaction(work_);
  add_works(v, force, work_, works);
  works.scheme += scheme_work(q, p, q_end, p_end);
  report_ = {};
  report_.velocity = {end_[0], end_[1]};
  report_.spin = 0.0 - end_[2];
  if (!rim_.free_x) report_.force.x = force[0];
  if (!rim_.free_y) report_.force.y = force[1];
  if (!rim_.free_spin) report_.torque = 0.0 - force[2];
  move(v);
  spin_before_ = now_[2];
  now_ = end_;
  q_before_ = q;
}

void MovingRim::move(const RimVector& v) {
  const double dt = model_.dt, t = static_cast<double>(step_) * dt;
  const Vec2 held = model_.motion.center(t + dt).plane(), before = center_;
  x_.add(dt * v[0]);
  y_.add(dt * v[1]);
  const double turn = rim_.free_spin || led_ ? dt * v[2] : model_.motion.turn(t, dt);
  angle_.add(turn);
  center_ = {rim_.free_x || led_ ? x_.value() : held.x, rim_.free_y || led_ ? y_.value() : held.y};
  set_frame(turn, center_ - before);
}

void MovingRim::set_frame(double turn, Vec2 way) {
  frame_ = {};
  frame_.time = static_cast<double>(step_) * model_.dt + model_.dt;
  frame_.spin = end_[2];
  frame_.angle = angle_.value();
  frame_.turn_before = turn;
  frame_.rotation = rotation(frame_.angle);
  frame_.center = center_;
  frame_.advance_before = way;
}

SavedRim MovingRim::save() const {
  SavedRim s;
  s.numbers = {x_.sum(),
               x_.correction(),
               y_.sum(),
               y_.correction(),
               angle_.sum(),
               angle_.correction(),
               center_.x,
               center_.y,
               now_[0],
               now_[1],
               now_[2],
               spin_before_,
               spin_,
               frame_.turn_before,
               frame_.advance_before.x,
               frame_.advance_before.y};
  s.displacement_before.assign(q_before_.begin(), q_before_.end());
  s.late.assign(late_.begin(), late_.end());
  return s;
}

void MovingRim::restore(long long n, const SavedRim& s) {
  const auto& a = s.numbers;
  step_ = n - 1;
  x_ = {a[0], a[1]};
  y_ = {a[2], a[3]};
  angle_ = {a[4], a[5]};
  center_ = {a[6], a[7]};
  now_ = end_ = RimVector(a[8], a[9], a[10]);
  spin_before_ = a[11];
  spin_ = a[12];
  const auto vector = [](const std::vector<double>& v) {
    return Eigen::Map<const VectorXd>(v.data(), static_cast<Index>(v.size()));
  };
  q_before_ = vector(s.displacement_before);
  late_ = vector(s.late);
  set_frame(a[13], {a[14], a[15]});
}

}  // namespace rondo::rom
