// SPDX-License-Identifier: BSD-3-Clause
/// Fields of all nodes: the start of a run from them, and those after a step.
#include "rondo/rom/wheel/ring_wheel.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "rondo/core/dense.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index;

constexpr double touching_share = 1e-6;  ///< of the radius: nodes that near touch at the start

}  // namespace

void RingWheel::begin(const WheelMotion& m) {
  use_spin(still(m));
  for (Memory& memory : memory_) memory = {};
  active_.clear();
  seen_.clear();
  if (creep_) creep_->clear();
  if (sliding_) sliding_->clear();
  rest_modes();
}

/// What the modes do to the contact nodes.
void RingWheel::move_contact() {
  if (!is_whole())
    ReducedWheel::move_contact();
  else if (!modes_.empty())
    real_.place = modes_[0].state.head(real_.place.size()).real();
}

/// Places of the nodes near the ground at the start.
void RingWheel::look_at_start(const WheelMotion& m, std::span<const Vec2> u,
                              std::span<const Vec2> v) {
  move_contact();
  find_near(m);
  solved_.clear();
  touch_.clear();
  contacts_.clear();
  law_.clear();
  if (!u.empty()) press_at_start(m, u);
  remember(m);
  if (sliding_ && !v.empty()) slide_at_start(m, v);
}

/// Near nodes that the field has on the ground; they get its places.
std::vector<std::size_t> RingWheel::touching(const WheelMotion& m, std::span<const Vec2> u) {
  std::vector<std::size_t> nodes;
  const Complex frame = rotation(m.angle_next);
  for (std::size_t i = 0; i < near_.size(); ++i) {
    Near& near = near_[i];
    const Vec2 place = near.turn * arm(near.node) + frame * u[node_of(near.node)];
    if (ground_.facet_near(m.center_next + place).gap > touching_share * model_.radius) continue;
    near.place = place;
    nodes.push_back(i);
  }
  return nodes;
}

/// (2m) Forces in the frames of the sectors under which the residual has these nodes where they
/// are.
Eigen::VectorXd RingWheel::forces_that_hold(std::span<const std::size_t> nodes) const {
  const auto n = static_cast<Index>(2 * nodes.size());
  Eigen::MatrixXd g(n, n);
  Eigen::VectorXd moved(n);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Near& near = near_[nodes[i]];
    const Vec2 by = conj(near.turn) * (near.place - near.free);
    const auto row = static_cast<Index>(2 * i);
    moved.segment<2>(row) << by.x, by.y;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      const Block b = held(near.node, near_[nodes[j]].node);
      g.block<2, 2>(row, static_cast<Index>(2 * j)) << b[0], b[1], b[2], b[3];
    }
  }
  return rondo::solve(g, moved);
}

/// Forces of the ground at the start, of nodes that it presses.
void RingWheel::press_at_start(const WheelMotion& m, std::span<const Vec2> u) {
  std::vector<std::size_t> nodes = touching(m, u);
  Eigen::VectorXd forces;
  forces_.clear();
  const auto own = [&](std::size_t i) {
    const auto row = static_cast<Index>(2 * i);
    return Vec2{forces[row], forces[row + 1]};
  };
  for (std::size_t left = nodes.size() + 1; nodes.size() < left && !nodes.empty();) {
    left = nodes.size();
    forces = forces_that_hold(nodes);
    std::vector<std::size_t> pressed;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Near& near = near_[nodes[i]];
      const Vec2 normal = ground_.facet_near(m.center_next + near.place).normal;
      if (dot(normal, near.turn * own(i)) > 0.0) pressed.push_back(nodes[i]);
    }
    nodes = std::move(pressed);
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Near& near = near_[nodes[i]];
    near.own = own(i);
    push_modes(near.node, near.wave, near.own);
    if (is_whole()) real_.push += real_.on_modes(near.node, near.own);
    if (creep_) {
      forces_.push_back({near.node, near.own});
    } else {
      memory_of(near.node).filtered = memory_of(near.node).filtered_before = near.own;
      active_.push_back(near.node);
    }
    const Vec2 normal = ground_.facet_near(m.center_next + near.place).normal,
               force = near.turn * near.own;
    const double pressed = dot(normal, force), shear = dot(tangent_of(normal), force);
    if (sliding_) sliding_->press(near.node, pressed);
    solved_.push_back(nodes[i]);
    touch_.push_back({0.0, normal});
    const double most = friction_of(solved_.size() - 1, m) * pressed;
    law_.emplace_back();
    law_.back().normal = pressed;
    law_.back().status =
        std::abs(shear) < 0.999 * most ? contact::Status::stick : contact::Status::slip;
    if (law_.back().status == contact::Status::slip && most > 0.0)
      law_.back().side = -std::copysign(1.0, shear);
  }
  end_push();
  if (creep_) creep_->start(forces_);
}

RimVector RingWheel::force_at_start() const {
  RimVector sum = RimVector::Zero();
  for (const Near& near : near_) {
    const Vec2 force = near.turn * near.own;
    sum += RimVector(force.x, force.y, cross(near.place, force));
  }
  return sum;
}

void RingWheel::start(const WheelMotion& m) {
  begin(m);
  for (std::size_t h = 0; h < modes_.size(); ++h)
    if (harmonics_[h].k == 0)
      for (Index j = 0; j < harmonics_[h].squares.size(); ++j)
        modes_[h].state[j] = m.spin_next * m.spin_next * harmonics_[h].reference[j] /
                             (harmonics_[h].squares[j] - m.spin_next * m.spin_next);
  look_at_start(m, {}, {});
}

void RingWheel::start(const WheelMotion& m, std::span<const Vec2> u, std::span<const Vec2> v) {
  begin(m);
  project(m.angle_next, u, false);
  project(m.angle_next, v, true);
  look_at_start(m, u, v);
}

/// (rows) What the filtered forces do beyond the modes, of a ring of one sector, where the tables
/// of all terms of the creep are one.
template <class Filtered>
Eigen::VectorXd RingWheel::by_contact(Filtered&& filtered) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(ring_.n_contact());
  for_remembered([&](int node) {
    const CreepField::Lagging of = filtered(node);
    const Vec2 le = of.at_once + of.later;
    force.segment<2>(Index{2} * node) << le.x, le.y;
  });
  Eigen::VectorXd u = Eigen::VectorXd::Zero(ring_.n_rows());
  for (std::size_t a = 0; a < model_.residuals.size(); ++a)
    u += shares_[a] * model_.residuals[a].by_contact(force);
  return u;
}

/// Writes a field of all free nodes, in the co-rotating frame.
/// @param constant (rows) part that is the same in all sectors
template <class Coefficients, class Filtered>
void RingWheel::write_field(double angle, const Eigen::VectorXd& constant,
                            Coefficients&& coefficients, Filtered&& filtered,
                            std::span<Vec2> field) const {
  const Index n_rows = ring_.n_rows(), size = ring_.n_contact();
  Eigen::VectorXd u(n_rows);
  std::vector<Vector> amplitudes;
  for (std::size_t h = 0; h < modes_.size(); ++h)
    amplitudes.emplace_back(harmonics_[h].weight() * (harmonics_[h].shapes * coefficients(h)));
  const Complex frame = rotation(angle);
  const int n = ring_.n_sectors();
  for (int j = 0; j < n; ++j) {
    const Complex turn = ring_.stiffness.turn[at(j)];
    u = constant;
    for_waves(harmonics_, frame * turn, [&](std::size_t h, Complex wave) {
      u += wave.re * amplitudes[h].real() - wave.im * amplitudes[h].imag();
    });
    if (model_.residuals.front().by_contact)
      u += by_contact(filtered);
    else
      for_remembered([&](int node) {
        const CreepField::Lagging of = filtered(node);
        const int d = (j - sector(node) + n) % n, c = 2 * local(node);
        const auto add = [&](const RingResidual& table, double share, Vec2 le) {
          const Eigen::Map<const Eigen::MatrixXd> all(table.fields.data() + d * size * n_rows,
                                                      n_rows, size);
          u += share * (le.x * all.col(c) + le.y * all.col(c + 1));
        };
        for (std::size_t a = 0; a < model_.residuals.size(); ++a) {
          add(model_.residuals[a], shares_[a], of.at_once);
          if (creep_) add(model_.later[a], shares_[a], of.later);
        }
      });
    for (Index a = 0; a < n_rows; a += 2)
      field[ring_.stiffness.node(at(a / 2), at(j))] = turn * Vec2{u[a], u[a + 1]};
  }
}

void RingWheel::contact_displacement(double angle, std::span<Vec2> u) const {
  const Complex frame = rotation(angle);
  for (int node = 0; node < n_nodes(); ++node) {
    const Complex turn = ring_.stiffness.turn[at(sector(node))];
    u[node_of(node)] = turn * displacement(node, frame * turn, Forces::now);
  }
}

void RingWheel::displacement(double angle, std::span<Vec2> u) const {
  write_field(
      angle, centrifugal_,
      [&](std::size_t h) { return modes_[h].state.head(harmonics_[h].squares.size()); },
      [&](int node) {
        return creep_ ? creep_->lagging(node)
                      : CreepField::Lagging{memory_of(node).filtered, Vec2{}};
      },
      u);
}

void RingWheel::velocity(double angle, std::span<Vec2> v) const {
  write_field(
      angle, Eigen::VectorXd::Zero(ring_.n_rows()), [&](std::size_t h) { return mean_velocity(h); },
      [&](int node) {
        const double dt = settings_.dt;
        if (!creep_) {
          const Memory& memory = memory_of(node);
          return CreepField::Lagging{(memory.filtered - memory.filtered_before) / dt, Vec2{}};
        }
        const CreepField::Lagging now = creep_->lagging(node),
                                  before = creep_->lagging_before(node);
        return CreepField::Lagging{(now.at_once - before.at_once) / dt,
                                   (now.later - before.later) / dt};
      },
      v);
}

}  // namespace rondo::rom
