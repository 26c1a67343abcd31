// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steps of the reference beside those of an operator: how far two runs differ.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "rondo/integrators/general/general_integrator.hpp"
#include "rondo/integrators/general/wheel_integrator.hpp"
#include "rondo/integrators/integrator.hpp"
#include "rondo/integrators/start.hpp"

namespace rondo::test {

/// The reference, step by step.
class Reference {
 public:
  Reference(const dynamics::Model& model, dynamics::State start)
      : state(std::move(start)), steps_(reference(model, state)) {}

  const dynamics::StepReport& step() {
    steps_->advance({&last, 1}, &state);
    return last;
  }

  dynamics::State state;  ///< after the last step
  dynamics::StepReport last;

 private:
  static std::unique_ptr<dynamics::Integrator> reference(const dynamics::Model& model,
                                                         const dynamics::State& start) {
    if (model.rim) return std::make_unique<dynamics::WheelIntegrator>(model, start);
    return std::make_unique<dynamics::GeneralIntegrator>(model, start);
  }

  std::unique_ptr<dynamics::Integrator> steps_;
};

/// The largest difference of quantities of a kind, and their largest size.
struct Difference {
  double error = 0.0, size = 0.0;

  void see(double a, double b) {
    size = std::max(size, std::abs(a));
    if (!(std::abs(a - b) <= error)) error = std::abs(a - b);  // NaN comes through
  }
  void see(Vec3 a, Vec3 b) {
    see(a.x, b.x);
    see(a.y, b.y);
    see(a.z, b.z);
  }
  void see(const Field& a, const Field& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) see(a.plane()[i], b.plane()[i]);
  }
};

/// Two runs: decisions are the same, quantities differ by round-off.
class Comparison {
 public:
  /// Of contacts that share nodes only what a node feels in all is compared: how they share it, and
  /// so which of them press or stick, is not unique (docs/theory.md, 4.7).
  enum class Contacts { one_by_one, by_node };
  explicit Comparison(Contacts contacts = Contacts::one_by_one) : contacts_(contacts) {}

  void see(const dynamics::StepReport& a, const dynamics::StepReport& b) {
    ASSERT_EQ(a.step, b.step);
    ASSERT_EQ(a.frame.time, b.frame.time);
    see(a.frame, b.frame);
    see(a.rim, b.rim);
    const dynamics::ContactReport &c = a.contact, &d = b.contact;
    if (contacts_ == Contacts::one_by_one) {
      ASSERT_EQ(c.nodes, d.nodes) << "step " << a.step;
      ASSERT_EQ(c.sticking, d.sticking) << "step " << a.step;
    }
    ASSERT_EQ(c.pairs, d.pairs) << "step " << a.step;
    ASSERT_EQ(c.pairs_not_converged, d.pairs_not_converged) << "step " << a.step;
    impulse_.see(c.impulse, d.impulse);
    impulse_.see(c.angular_impulse / radius, d.angular_impulse / radius);
    length_.see(c.length, d.length);
    gap_.see(c.penetration, d.penetration);
    slip_.see(c.free_velocity, d.free_velocity);
    work_.see(c.work, d.work);
    work_.see(c.dissipation_friction, d.dissipation_friction);
    work_.see(c.loss_impact, d.loss_impact);
    work_.see(c.work_rim, d.work_rim);
    see(a.balance, b.balance);
  }
  void see(const dynamics::State& a, const dynamics::State& b) {
    ASSERT_EQ(a.step, b.step);
    frame_.see(a.frame.angle, b.frame.angle);
    u_.see(a.u, b.u);
    v_.see(a.v, b.v);
    v_.see(a.v_next, b.v_next);
    if (contacts_ == Contacts::by_node) return see(by_node(a.active), by_node(b.active));
    ASSERT_EQ(a.active.size(), b.active.size());
    for (std::size_t i = 0; i < a.active.size(); ++i) see(a.active[i], b.active[i]);
  }
  void expect_within(double bound) const {
    for (const auto& [kind, d] : {std::pair{"displacement", u_},
                                  {"velocity", v_},
                                  {"impulse", impulse_},
                                  {"length in contact", length_},
                                  {"gap", gap_},
                                  {"normal", normal_},
                                  {"relative velocity", slip_},
                                  {"work of a step", work_},
                                  {"energy", energy_},
                                  {"place of the rim", frame_},
                                  {"velocity of the rim", rim_},
                                  {"reaction of the rim", reaction_}})
      EXPECT_LE(d.error, bound * d.size) << kind;
  }
  /// A rim that follows its tables is where it is to the bit.
  void expect_the_same_frames() const { EXPECT_EQ(frame_.error, 0.0); }

 private:
  void see(const dynamics::FrameStep& a, const dynamics::FrameStep& b) {
    frame_.see(a.center, b.center);
    frame_.see(Vec2{a.rotation.re, a.rotation.im}, Vec2{b.rotation.re, b.rotation.im});
  }
  void see(const dynamics::RimReport& a, const dynamics::RimReport& b) {
    rim_.see(a.velocity, b.velocity);
    rim_.see(a.spin, b.spin);
    // On a loaded rim relative velocities are what absolute ones of that size leave.
    v_.size = std::max({v_.size, norm(a.velocity), radius * std::abs(a.spin)});
    reaction_.see(a.force, b.force);
    reaction_.see(a.torque, b.torque);
  }
  static constexpr double radius = 0.3;  // of the disk [m]

  void see(const dynamics::Balance& a, const dynamics::Balance& b) {
    const dynamics::Works &w = a.works, &x = b.works;
    for (const auto& [of_a, of_b] : {std::pair{a.kinetic, b.kinetic},
                                     {a.strain, b.strain},
                                     {w.frame, x.frame},
                                     {w.contact, x.contact},
                                     {w.dissipation_friction, x.dissipation_friction},
                                     {w.loss_impact, x.loss_impact},
                                     {w.rim, x.rim},
                                     {w.dissipation_mass, x.dissipation_mass},
                                     {w.dissipation_stiffness, x.dissipation_stiffness},
                                     {w.scheme, x.scheme},
                                     {a.kinetic_rim, b.kinetic_rim},
                                     {a.support, b.support},
                                     {w.gravity, x.gravity},
                                     {w.rim_load, x.rim_load},
                                     {w.torque, x.torque},
                                     {w.held, x.held},
                                     {w.dissipation_brake, x.dissipation_brake},
                                     {w.dissipation_support, x.dissipation_support},
                                     {a.exchanged, b.exchanged},
                                     {a.otherwise, b.otherwise},
                                     {a.residual, b.residual}})
      energy_.see(of_a, of_b);
  }
  using Impulses = std::map<std::size_t, Vec2>;  ///< by candidate, fixed frame

  static Impulses by_node(const std::vector<dynamics::ActiveContact>& active) {
    Impulses sums;
    for (const dynamics::ActiveContact& c : active)
      sums[c.candidate] += from_frame(c.normal, c.impulse.plane());
    return sums;
  }
  void see(const Impulses& a, const Impulses& b) {
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [candidate, impulse] : a) {
      ASSERT_TRUE(b.contains(candidate)) << candidate;
      impulse_.see(impulse, b.at(candidate));
    }
  }
  void see(const dynamics::ActiveContact& a, const dynamics::ActiveContact& b) {
    ASSERT_EQ(a.candidate, b.candidate);
    ASSERT_EQ(a.status, b.status);
    normal_.see(a.normal, b.normal);
    gap_.see(a.gap, b.gap);
    slip_.see(a.before, b.before);
    slip_.see(a.free, b.free);
    slip_.see(a.after, b.after);
    slip_.see(a.bounce, b.bounce);
    impulse_.see(a.impulse, b.impulse);
  }

  Contacts contacts_;
  Difference u_, v_, impulse_, length_, normal_, slip_, work_, energy_, frame_, rim_;
  Difference reaction_{0.0, 1e4};  // a sum of forces of that size [N/m]
  Difference gap_{0.0, radius};    // a difference of positions of that size
};

}  // namespace rondo::test
