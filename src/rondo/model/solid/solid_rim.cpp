// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/solid/solid_rim.hpp"

#include <cmath>

namespace rondo::dynamics {

SolidRim::SolidRim(const Model& model) noexcept
    : model_(model),
      ground_(model.motion.camber),
      rim_(model),
      frame_(rim_.frame()),
      lateral_(model.motion.speed.at(0.0) * std::sin(model.motion.slip_angle.at(0.0))) {
  lateral_before_ = lateral_;
}

double SolidRim::lateral_rate(double t) const noexcept {
  if (!model_.solid) return 0.0;
  return model_.motion.advance(t, model_.dt).z / model_.dt;
}

/// From the co-rotating frame to (t1, n, t2).
Vec3 SolidRim::on_ground(Vec3 force) const noexcept {
  return ground_.from_wheel(rim_.frame().rotation * force);
}

/// The force on the rim in the directions in which it may move.
RimForce SolidRim::in_plane(const RimForceOf<Vec3>& q) const noexcept {
  if (model_.motion.camber == 0.0) return {q.force.plane(), q.moment};
  return {conj(rim_.frame().rotation) * on_ground(q.force).plane(), q.moment};
}

void SolidRim::start(const RimForceOf<Vec3>& q) noexcept {
  rim_.start(in_plane(q));
  lateral_ = lateral_rate(0.0);
}

void SolidRim::move() noexcept {
  lateral_before_ = lateral_;
  rim_.move();
  frame_ = rim_.frame();
  if (!model_.solid) return;
  frame_.slip_angle = model_.motion.slip_angle.at(frame_.time);
  frame_.center.z = model_.motion.center(frame_.time).z;
  frame_.advance_before.z = model_.dt * lateral_before_;
}

void SolidRim::take(const RimForceOf<Vec3>& q) noexcept {
  rim_.take(in_plane(q));
  lateral_force_ = on_ground(q.force).z;
  lateral_ = lateral_rate(frame_.time);
  FrameStep frame = rim_.frame();
  frame.slip_angle = frame_.slip_angle;
  frame.center.z = frame_.center.z;
  frame.advance_before.z = frame_.advance_before.z;
  frame.advance.z = model_.dt * lateral_;
  frame_ = frame;
}

Vec3 SolidRim::velocity_before() const noexcept {
  return ground_.to_wheel({rim_.velocity_before(), lateral_before_});
}

Vec3 SolidRim::velocity() const noexcept {
  return ground_.to_wheel({rim_.velocity(), lateral_});
}

StepEnergy SolidRim::energy() const noexcept {
  StepEnergy energy = rim_.energy();
  energy.works.held -= 0.5 * model_.dt * lateral_force_ * (lateral_before_ + lateral_);
  return energy;
}

Vec3 SolidRim::gravity() const noexcept {
  return conj(frame_.rotation) * ground_.to_wheel(model_.motion.gravity_at(frame_.time));
}

Vec3 SolidRim::travel(Vec3 arm, Vec3 velocity) const noexcept {
  const Vec3 center = SolidRim::velocity();
  const Vec2 way = model_.dt * (velocity.plane() - conj(rim_.frame().rotation) * center.plane());
  return {way + conj(rim_.turn()) * (arm.plane() + way), model_.dt * (velocity.z - center.z)};
}

Vec3 SolidRim::velocity_of(Vec3 arm, Vec3 travel) const noexcept {
  const Vec3 center = velocity();
  const Vec2 way = travel.plane() + rim_.turn() * (arm.plane() + travel.plane());
  return {way / model_.dt + conj(rim_.frame().rotation) * center.plane(),
          travel.z / model_.dt + center.z};
}

void SolidRim::restore(long long step, std::span<const double> saved) {
  rim_.restore(step, saved);
  frame_ = rim_.frame();
  lateral_ = lateral_rate(frame_.time);
}

}  // namespace rondo::dynamics
