// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/loaded_rim.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {
namespace {

/// Reduces |v| by `most`, but not below 0.
double slowed(double v, double most) noexcept {
  return v > most ? v - most : v < -most ? v + most : 0.0;
}

/// One direction of motion of the center.
struct Line {
  bool free;
  double mass, load, weight, elastic;  ///< [kg/m]; F, M g, force of the body [N/m]
  RimSupport support;
  double place, before;  ///< c_{n+1} [m]; v⁻ [m/s]
};

struct Moved {
  double velocity, reaction;
};

/// M (v⁺ - v⁻) = h [F + M g + q - k (c - c_ref) - k_d (v⁺ + v⁻)/2]; if prescribed, its reaction.
Moved moved(const Line& l, double held, double h) noexcept {
  const double force =
      l.load + l.weight + l.elastic - l.support.stiffness * (l.place - l.support.at);
  if (!l.free) return {held, l.mass * (held - l.before) / h - force};
  const double damping = l.support.damping;
  return {l.before + h * (force - damping * l.before) / (l.mass + 0.5 * h * damping), 0.0};
}

void add_works(const Line& l, const Moved& m, double h, Works& w) noexcept {
  const double mean = 0.5 * (l.before + m.velocity);
  w.rim_load += h * l.load * mean;
  w.gravity += h * l.weight * mean;
  w.held += h * m.reaction * mean;
  w.dissipation_support += h * l.support.damping * mean * mean;
}

}  // namespace

LoadedRim::LoadedRim(const Model& model) noexcept : model_(model), rim_(*model.rim) {
  const Vec2 center = model.motion.center(0.0).plane();
  x_.add(center.x);
  y_.add(center.y);
  velocity_.x = model.motion.speed.at(0.0) * std::cos(model.motion.slip_angle.at(0.0));
  if (!rim_.free_y) velocity_.y = model.motion.height.slope(0.0);
  spin_ = -model.motion.angular_velocity.at(0.0);
  frame_.center = center;
  frame_.rotation = {1.0, 0.0};
}

/// With σ = sin δ = Δt s: e^{iδ} - 1 = -σ²/(1 + √(1 - σ²)) + iσ.
Complex LoadedRim::turn_minus_one(double spin) const noexcept {
  const double sine = model_.dt * spin;
  return {-sine * sine / (1.0 + std::sqrt(std::max(0.0, 1.0 - sine * sine))), sine};
}

Vec2 LoadedRim::held_velocity(double from) const noexcept {
  return model_.motion.advance(from, model_.dt).plane() / model_.dt;
}

double LoadedRim::held_spin(double from) const noexcept {
  return std::sin(model_.motion.turn(from, model_.dt)) / model_.dt;
}

void LoadedRim::advance(const RimForce& q, double h) noexcept {
  const double t = frame_.time;
  const Vec2 g = model_.motion.gravity_at(t), held = held_velocity(t);
  const Vec2 elastic = frame_.rotation * q.force;
  const Line x{rim_.free_x, rim_.mass,      rim_.force_x.at(t), rim_.mass * g.x,
               elastic.x,   rim_.support_x, frame_.center.x,    velocity_before_.x};
  const Line y{rim_.free_y, rim_.mass,      rim_.force_y.at(t), rim_.mass * g.y,
               elastic.y,   rim_.support_y, frame_.center.y,    velocity_before_.y};
  const Moved to_x = moved(x, held.x, h), to_y = moved(y, held.y, h);
  velocity_ = {to_x.velocity, to_y.velocity};
  Works& w = energy_.works = {};
  add_works(x, to_x, h, w);
  add_works(y, to_y, h, w);

  advance_spin(q.moment, h);
  turn_ = std::asin(std::clamp(model_.dt * spin_, -1.0, 1.0));
  report_.velocity = 0.5 * (velocity_before_ + velocity_);
  report_.force = {to_x.reaction, to_y.reaction};
}

/// I (s⁺ - s⁻) = h [T + Σ y × q]; then the brake reduces |s⁺|, but not below 0.
void LoadedRim::advance_spin(double moment, double h) noexcept {
  const double t = frame_.time, driving = -rim_.torque.at(t), inertia = rim_.inertia;
  double braking = 0.0, reaction = 0.0;
  if (rim_.free_spin) {
    const double driven = spin_before_ + h * (driving + moment) / inertia;
    spin_ = slowed(driven, h * rim_.brake.at(t) / inertia);
    braking = inertia * (driven - spin_);
  } else {
    spin_ = held_spin(t);
    reaction = inertia * (spin_ - spin_before_) / h - moment;
  }
  const double mean = 0.5 * (spin_ + spin_before_);
  energy_.works.torque = h * driving * mean;
  energy_.works.dissipation_brake = braking * mean;
  energy_.works.held += h * reaction * mean;
  report_.spin = 0.0 - mean;
  report_.torque = 0.0 - reaction;
}

void LoadedRim::start(const RimForce& q) noexcept {
  velocity_before_ = velocity_;
  spin_before_ = spin_;
  advance(q, 0.5 * model_.dt);
}

/// R is updated by increments, whose rounding does not grow with θ, and normalised.
void LoadedRim::move() noexcept {
  const double dt = model_.dt;
  ++step_;
  velocity_before_ = velocity_;
  spin_before_ = spin_;
  x_.add(dt * velocity_.x);
  y_.add(dt * velocity_.y);
  angle_.add(turn_);
  Complex r = frame_.rotation;
  r += r * turn_before();
  r = (1.5 - 0.5 * norm_squared(r)) * r;
  const double at = static_cast<double>(step_) * dt;
  frame_ = {};
  frame_.time = at;
  frame_.spin = spin_before_;
  frame_.angle = angle_.value();
  frame_.turn_before = turn_;
  frame_.rotation = r;
  frame_.center = Vec2{x_.value(), y_.value()};
  frame_.advance_before = dt * velocity_before_;
  const Vec3 before = frame_.center - frame_.advance_before;
  const auto spring = [](const RimSupport& s, double now, double last) {
    return 0.5 * s.stiffness * (now - s.at) * (last - s.at);
  };
  energy_.kinetic_rim = 0.5 * rim_.mass * dot(velocity_before_, velocity_before_) +
                        0.5 * rim_.inertia * spin_before_ * spin_before_;
  energy_.support = spring(rim_.support_x, frame_.center.x, before.x) +
                    spring(rim_.support_y, frame_.center.y, before.y);
}

void LoadedRim::take(const RimForce& q) noexcept {
  advance(q, model_.dt);
  frame_.spin = -report_.spin;
  frame_.turn = turn_;
  frame_.advance = model_.dt * velocity_;
}

std::vector<double> LoadedRim::save() const {
  const Complex r = frame_.rotation;
  return {
      x_.sum(),    x_.correction(), y_.sum(), y_.correction(), angle_.sum(), angle_.correction(),
      velocity_.x, velocity_.y,     spin_,    turn_,           r.re,         r.im};
}

void LoadedRim::restore(long long step, std::span<const double> s) {
  RONDO_DEMAND(s.size() == n_numbers && step >= 0, s.size(), step);
  step_ = step;
  x_ = {s[0], s[1]};
  y_ = {s[2], s[3]};
  angle_ = {s[4], s[5]};
  velocity_ = {s[6], s[7]};
  spin_ = s[8];
  turn_ = s[9];
  frame_ = {};
  frame_.time = static_cast<double>(step) * model_.dt;
  frame_.rotation = {s[10], s[11]};
  frame_.angle = angle_.value();
  frame_.center = Vec2{x_.value(), y_.value()};
}

RimForce pressure_on_rim(const Model& model, std::span<const Vec2> load) noexcept {
  RimForce sum;
  std::size_t next_free = 0;
  for (std::size_t k = 0; k < load.size(); ++k) {
    if (next_free < model.free.size() && static_cast<std::size_t>(model.free[next_free]) == k) {
      ++next_free;
      continue;
    }
    sum.force += load[k];
    sum.moment += cross(model.reference[k], load[k]);
  }
  return sum;
}

/// y₂ = e^{-iδ}(y₁ + Δt R̄(V - ċ)), minus y₁.
Vec2 LoadedRim::travel(Vec2 arm, Vec2 velocity) const noexcept {
  const Vec2 way = model_.dt * (velocity - conj(frame_.rotation) * velocity_);
  return way + conj(turn()) * (arm + way);
}

Vec2 LoadedRim::velocity_of(Vec2 arm, Vec2 travel) const noexcept {
  const Vec2 way = travel + turn() * (arm + travel);
  return way / model_.dt + conj(frame_.rotation) * velocity_;
}

Vec2 LoadedRim::gravity() const noexcept {
  return conj(frame_.rotation) * model_.motion.gravity_at(frame_.time);
}

}  // namespace rondo::dynamics
