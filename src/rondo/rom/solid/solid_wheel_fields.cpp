// SPDX-License-Identifier: BSD-3-Clause
/// Fields of all nodes: the start of a run from them, and those after a step.
#include <cmath>
#include <utility>
#include <vector>

#include "rondo/core/dense.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/solid/wheel_ground.hpp"
#include "rondo/rom/solid/solid_wheel.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index;

constexpr double touching_share = 1e-6;  ///< of the radius: nodes that near touch at the start

}  // namespace

void SolidWheel::begin(const SolidMotion& m) {
  for (Memory& memory : memory_) memory = {};
  seen_.clear();
  last_ = {};
  if (creep_) creep_->clear();
  use_spin(still(m.plane));
  rest_modes();
}

void SolidWheel::start(const SolidMotion& m) {
  begin(m);
  const double spin = m.plane.spin_next;
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const RingHarmonic& of = harmonics_[h];
    if (of.k != 0) continue;
    Matrix stiff = -spin * spin * of.planar;
    stiff.diagonal().array() += of.squares.array();
    modes_[h].state.head(of.squares.size()) =
        rondo::solve(stiff, Vector(spin * spin * of.reference + of.load));
  }
  move_contact();
  find_near(m);
  solved_.clear();
  cones_.clear();
  remember(m);
}

void SolidWheel::start(const SolidMotion& m, std::span<const Vec3> u, std::span<const Vec3> v) {
  begin(m);
  project(m.plane.angle_next, u, false);
  project(m.plane.angle_next, v, true);
  move_contact();
  find_near(m);
  solved_.clear();
  cones_.clear();
  press_at_start(m, u);
  remember(m);
}

/// Forces of the ground at the start: those under which the residual has the nodes that touch it
/// where the field has them, as far as they press.
void SolidWheel::press_at_start(const SolidMotion& m, std::span<const Vec3> u) {
  std::vector<std::size_t> nodes;
  const Complex frame = rotation(m.plane.angle_next);
  for (std::size_t i = 0; i < near_.size(); ++i) {
    Near& near = near_[i];
    const Vec3 moved = conj(near.turn) * (frame * u[node_of(near.node)]);
    const Vec3 free = near.place;
    near.place = arm(near.node) + moved;
    if (touch_of(near, m).gap <= touching_share * model_.radius)
      nodes.push_back(i);
    else
      near.place = free;
  }
  Eigen::VectorXd forces;
  for (std::size_t left = nodes.size() + 1; nodes.size() < left && !nodes.empty();) {
    left = nodes.size();
    const auto n = static_cast<Index>(3 * nodes.size());
    Eigen::MatrixXd g(n, n);
    Eigen::VectorXd by(n);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Near& to = near_[nodes[i]];
      const Vec3 moved = to.place - to.free;
      const auto row = static_cast<Index>(3 * i);
      by.segment<3>(row) << moved.x, moved.y, moved.z;
      for (std::size_t j = 0; j < nodes.size(); ++j) {
        const Near& from = near_[nodes[j]];
        g.block<3, 3>(row, static_cast<Index>(3 * j)) = held(to.node, from.node);
      }
    }
    forces = rondo::solve(g, by);
    std::vector<std::size_t> pressed;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      Near& near = near_[nodes[i]];
      const auto row = static_cast<Index>(3 * i);
      near.force = {forces[row], forces[row + 1], forces[row + 2]};
      if (dot(touch_of(near, m).frame.normal, fixed(near, near.force, m)) > 0.0)
        pressed.push_back(nodes[i]);
      else
        near.force = {};
    }
    nodes = std::move(pressed);
  }
  for (Modes& s : modes_) s.ground.setZero();
  if (creep_) creep_->clear_forces();
  for (const std::size_t i : nodes) {
    const Near& near = near_[i];
    push_modes(near.node, near.wave, near.force);
    if (creep_)
      creep_->add_force(sector(near.node), Index{3} * local(near.node), near.force);
    else
      memory_of(near.node).filtered = near.force;
    const Vec3 force = fixed(near, near.force, m);
    last_.force += force;
    last_.moment += cross(fixed(near, near.place, m), force);
  }
  for (std::size_t h = 0; h < modes_.size(); ++h)
    modes_[h].force.noalias() = harmonics_[h].contact.adjoint() * modes_[h].ground;
  for (const Near& near : near_) seen_.push_back(near.node);
  if (creep_) {
    creep_->start();
    creep_->use(shares_);
  }
  renew_residuals();
}

/// Amplitudes of the forces on the nodes that are remembered.
/// @param filtered force on a node that the residual answers to
template <class Filtered>
HarmonicCreep::Lagging SolidWheel::amplitudes_of(Filtered&& filtered) const {
  const int n = ring_.n_sectors();
  const Index half = n / 2 + 1;
  Matrix forces = Matrix::Zero(ring_.n_contact(), half);
  for (const int node : seen_) {
    const Vec3 force = filtered(memory_of(node));
    if (force == Vec3{}) continue;
    for (Index k = 0; k < half; ++k) {
      const Complex turn = ring_.stiffness.turn[at(static_cast<long long>(k) * sector(node) % n)];
      const Complexes back = Complexes(turn.re, -turn.im) / static_cast<double>(n);
      forces.col(k).segment<3>(Index{3} * local(node)) +=
          back * Eigen::Vector3d(force.x, force.y, force.z);
    }
  }
  return {forces, Matrix::Zero(ring_.n_contact(), half)};
}

/// Writes a field of all free nodes, in the co-rotating frame.
/// @param constant (rows) part that is the same in all sectors
/// @param forces that the residual answers to
template <class Coefficients>
void SolidWheel::write_field(double angle, const Eigen::VectorXd& constant,
                             Coefficients&& coefficients, const HarmonicCreep::Lagging& forces,
                             std::span<Vec3> field) const {
  const int n = ring_.n_sectors();
  const Index half = n / 2 + 1;
  if (!field_ || field_->spin() != spin_)
    field_ = std::make_unique<SolidFields>(ring_, harmonics_, spin_, model_.creep);
  Matrix amplitude = (*field_)(forces.at_once, forces.later);
  const Complex frame = rotation(angle);
  Complex wave{1.0, 0.0};
  int reached = 0;
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    for (; reached < harmonics_[h].k; ++reached) wave = wave * frame;
    amplitude.col(harmonics_[h].k) +=
        Complexes(wave.re, wave.im) * (harmonics_[h].shapes * coefficients(h));
  }
  for (int j = 0; j < n; ++j) {
    const Complex turn = ring_.stiffness.turn[at(j)];
    Eigen::VectorXd u = constant;
    for (Index k = 0; k < half; ++k) {
      const Complex turned = ring_.stiffness.turn[at(static_cast<long long>(k) * j % n)];
      const double weight = harmonic_weight(static_cast<int>(k), n);
      u += weight * (turned.re * amplitude.col(k).real() - turned.im * amplitude.col(k).imag());
    }
    for (Index a = 0; a < ring_.n_rows(); a += 3)
      field[ring_.stiffness.node(at(a / 3), at(j))] = turn * Vec3{u[a], u[a + 1], u[a + 2]};
  }
}

void SolidWheel::contact_displacement(double angle, std::span<Vec3> u) const {
  const Complex frame = rotation(angle);
  for (int j = 0; j < ring_.n_sectors(); ++j) {
    const Complex turn = ring_.stiffness.turn[at(j)];
    if (creep_) creep_->write(creep_->now(), j, in_sector_);
    for (int c = 0; c < n_contact_; ++c) {
      const int row = ring_.contact[at(c)], node = j * n_contact_ + c;
      const Vec3 spun{centrifugal_[3 * row], centrifugal_[3 * row + 1], centrifugal_[3 * row + 2]};
      const double* crept = &in_sector_[at(3 * c)];
      const Vec3 residual = creep_ ? Vec3(crept[0], crept[1], crept[2]) : memory_of(node).residual;
      u[ring_.stiffness.node(at(row), at(j))] =
          turn * (spun + modal(node, frame * turn, &Modes::contact) + residual);
    }
  }
}

void SolidWheel::displacement(double angle, std::span<Vec3> u) const {
  write_field(
      angle, centrifugal_,
      [&](std::size_t h) { return Vector(modes_[h].state.head(harmonics_[h].squares.size())); },
      creep_ ? creep_->lagging()
             : amplitudes_of([](const Memory& memory) { return memory.filtered; }),
      u);
}

void SolidWheel::velocity(double angle, std::span<Vec3> v) const {
  const double dt = settings_.dt;
  HarmonicCreep::Lagging rate;
  if (creep_) {
    const HarmonicCreep::Lagging before = creep_->lagging_before();
    rate = creep_->lagging();
    rate.at_once = (rate.at_once - before.at_once) / dt;
    rate.later = (rate.later - before.later) / dt;
  } else {
    rate = amplitudes_of(
        [&](const Memory& memory) { return (memory.filtered - memory.filtered_before) / dt; });
  }
  write_field(
      angle, Eigen::VectorXd::Zero(ring_.n_rows()), [&](std::size_t h) { return mean_velocity(h); },
      rate, v);
}

}  // namespace rondo::rom
