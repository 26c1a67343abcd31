// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid/solid_wheel.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/base/ring_candidates.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index;

/// Sectors for which the compliance is made beyond those that are needed.
constexpr int spare_sectors = 4;

}  // namespace

SolidWheel::SolidWheel(const SolidRing& ring, const WheelModel& model,
                       const dynamics::ContactModel& ground, const SolidWheelSettings& settings)
    : ReducedWheel(
          ring, model, settings,
          !ground.space && ground.ground.bends().empty() && !ground.ground.has_concave_corners()),
      ground_(ground),
      law_residual_(settings.law_residual),
      area_(tributaries_of(ring, ground)),
      memory_(at(n_nodes())),
      law_(settings.law_residual) {
  const std::vector<RingResidual>& residuals = model.residuals;
  const std::size_t n = memory_.size();
  if (!model.creep.empty())
    creep_.emplace(model.creep, residuals, model.later, ring.stiffness.turn,
                   settings.stiffness_damping, settings.dt);
  if (residuals.size() > 1 || creep_) {
    tables_.resize(residuals.front().blocks.size());
    made_.assign(at(ring.n_sectors()), -1);
  }
  in_sector_.resize(at(ring.n_contact()));
  near_.reserve(n);
  moved_.reserve(3 * n);
  touch_.reserve(n);
  cones_.reserve(n);
  before_.reserve(n);
  place_before_.reserve(n);
  if (!ground.law.friction.is_constant())
    friction_ = [this](std::size_t candidate, double slip, double force) {
      return friction_at(candidate, slip, force);
    };
  contacts_.reserve(n);
}

/// G of a lag; at a spin between those of the model made when it is asked for, as few lags are.
Eigen::Map<const Eigen::MatrixXd> SolidWheel::beyond(int lag) const {
  if (tables_.empty()) return model_.residuals.front().block(lag);
  const Index size = ring_.n_contact();
  const int d = wrapped(lag);
  double* const block = tables_.data() + d * size * size;
  if (made_[at(d)] == version_) return {block, size, size};
  made_[at(d)] = version_;
  Eigen::Map<Eigen::MatrixXd> sum(block, size, size);
  sum.setZero();
  for (std::size_t a = 0; a < model_.residuals.size(); ++a) {
    const double share = shares_[a];
    sum += (creep_ ? share * creep_->memory().new_at_once() : share) * model_.residuals[a].block(d);
    if (creep_) sum += share * creep_->memory().new_later() * model_.later[a].block(d);
  }
  return {block, size, size};
}

/// What the residual of a node does by a force on another that has always been there.
Eigen::Matrix3d SolidWheel::held(int to, int from) const {
  const int lag = sector(to) - sector(from);
  const Index row = Index{3} * local(to), column = Index{3} * local(from);
  if (!creep_) return beyond(lag).block<3, 3>(row, column);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t a = 0; a < model_.residuals.size(); ++a)
    sum +=
        shares_[a] *
        (creep_->memory().held_at_once() * model_.residuals[a].block(lag).block<3, 3>(row, column) +
         creep_->memory().held_later() * model_.later[a].block(lag).block<3, 3>(row, column));
  return sum;
}

/// What the residual of a node does by a force on another.
Vec3 SolidWheel::product(int to, int from, Vec3 force) const noexcept {
  const auto g = beyond(sector(to) - sector(from));
  const Index row = Index{3} * local(to), column = Index{3} * local(from);
  const auto line = [&](Index r) {
    return g(row + r, column) * force.x + g(row + r, column + 1) * force.y +
           g(row + r, column + 2) * force.z;
  };
  return {line(0), line(1), line(2)};
}

/// What the residual of all nodes that are remembered does, by the tables of the spin.
void SolidWheel::renew_residuals() {
  if (creep_) return;
  for (const int to : seen_) {
    Vec3 u;
    for (const int from : seen_)
      if (const Vec3 force = memory_of(from).filtered; force != Vec3{})
        u += product(to, from, force);
    memory_of(to).residual = u;
  }
}

void SolidWheel::fill_step(std::size_t harmonic, double spin, double rate) {
  const RingHarmonic& of = harmonics_[harmonic];
  Modes& s = modes_[harmonic];
  const double half = 0.5 * settings_.dt;
  fill_lever(harmonic, spin);
  s.stiff = rate * of.coriolis - spin * spin * of.planar;
  s.stiff.diagonal().array() += of.squares.array();
  const auto damping = settings_.mass_damping + settings_.stiffness_damping * of.squares.array();
  s.step = 2.0 * half * spin * of.coriolis + half * s.lever * s.stiff;
  s.step.diagonal().array() += s.turn + half * damping;
  factorise(harmonic);
}

/// The matrices of a step, and what depends on the tables of its spin.
void SolidWheel::use_spin(const WheelMotion& m) {
  const double before = spin_;
  ReducedWheel::use_spin(m);
  if (!new_table_) return;
  n_made_ = 0;
  if (creep_) creep_->use(shares_);
  if (spin_ != before && !tables_.empty()) renew_residuals();
}

/// W of the window: G/(1 + β/Δt) and the answer of the modes, block after block by the lag.
void SolidWheel::make_window() {
  if (n_window_ <= n_made_) return;
  n_made_ = std::min(n_window_ + spare_sectors, ring_.n_sectors());
  const Index size = ring_.n_contact();
  window_.resize(size, n_made_);
  const double share = 1.0 - filter();
  for (int lag = 1 - n_made_; lag < n_made_; ++lag) {
    block_ = share * beyond(lag);
    for (std::size_t h = 0; h < modes_.size(); ++h) {
      const Complex turn =
          ring_.stiffness
              .turn[at(static_cast<long long>(harmonics_[h].k) * wrapped(lag) % ring_.n_sectors())];
      block_ += turn.re * modes_[h].answer.real() - turn.im * modes_[h].answer.imag();
    }
    window_.set(lag, block_);
  }
}

/// The modes at the end of the step without new forces.
void SolidWheel::move_modes(const SolidMotion& motion) {
  const WheelMotion& m = motion.plane;
  const double spin = (m.angle_next - m.angle) / settings_.dt;
  const Vec3 pull = motion.attitude_next.from_fixed(Vec3(m.pull, motion.lateral_pull));
  const Complexes back(pull.x, -pull.y);  // conj
  const Complexes tilting = motion.tilting(spin);
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    Modes& s = modes_[h];
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    s.outside.setZero();
    if (of.k == 0)
      s.outside =
          spin * spin * of.reference - m.spin_rate * of.turned - pull.z * of.axial + of.load;
    if (of.k == 1) {
      s.outside -= 0.5 * back * of.translation.conjugate();
      s.outside -= tilting * of.tilt;
    }
    if (m.kept_spin) s.outside.noalias() -= m.spin_rate * (of.coriolis * s.state.head(r));
    s.before = s.state;
    s.held = (1.0 - settings_.theta) * s.force;
    s.pushed = s.outside + s.held;
    const auto y = s.before.head(r), p = s.before.tail(r);
    s.pushed *= 0.5 * settings_.dt;
    s.pushed += p;
    s.pushed.noalias() -= s.lever * (s.stiff * y);
    if (creep_) s.strain.take_from(branches(h), s.pushed);
    finish_middle(h);
  }
  move_contact();
}

/// Displacement of a contact node by the modes. @param of (3C) amplitudes of each harmonic
Vec3 SolidWheel::modal(int node, Complex turn, const Vector Modes::*of) const noexcept {
  const Index c = Index{3} * local(node);
  Vec3 u;
  for_waves(harmonics_, turn, [&](std::size_t h, Complex wave) {
    const Complexes* amplitude = (modes_[h].*of).data() + c;
    const double weight = harmonics_[h].weight();
    u += weight * Vec3(real_product(wave, amplitude[0]), real_product(wave, amplitude[1]),
                       real_product(wave, amplitude[2]));
  });
  return u;
}

SolidWheelReport SolidWheel::step(const SolidMotion& m) {
  SolidWheelReport report;
  use_spin(m.plane);
  move_modes(m);
  find_near(m);
  solve(m, report);
  take_forces(m, report);
  account(m, report);
  remember(m);
  return report;
}

}  // namespace rondo::rom
